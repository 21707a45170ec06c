// What the program keeps unasked in cacheFolder() to save time: it may be gone at any time, and takes no more
// room than is said here. Light that was baked lies there too, under other extensions, and stays until the
// user takes it away.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace stereonav {

// Of all that is kept, bytes: the least recently used files are removed beyond it.
constexpr std::uintmax_t kMostKept = 4'000'000'000;

// In cacheFolder(); the extensions of what is kept are .bin and .nrrd.
std::filesystem::path keptFile(const std::string& name);

// Calls write(file), which writes it whole or throws Error, then makes room. False where it can not be
// written.
bool keep(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write,
          std::uintmax_t most = kMostKept);

// A kept file was of use: it is the last one to be removed.
void noteUse(const std::filesystem::path& file);

}  // namespace stereonav
