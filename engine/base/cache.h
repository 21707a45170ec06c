// What the program keeps unasked in cacheFolder() to save time: it may be gone at any time, and takes no more
// room than is said here. Light that was baked lies there too, under other extensions, and stays until the
// user takes it away.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace stereonav {

// Bytes of all that is kept: the least recently used files are removed beyond it.
constexpr std::uintmax_t kMostKept = 4'000'000'000;

// In cacheFolder(); the extensions of what is kept are .bin, .nrrd and .tiles. A link there, or a file of
// another user, is taken away: nothing of it is read, and nothing goes through it.
std::filesystem::path keptFile(const std::string& name);

// Calls write(file), which writes it whole or throws Error, then makes room. False where it can not be
// written.
bool keep(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write,
          std::uintmax_t most = kMostKept);

// Removes what crashed runs left half-written, and what is beyond `most` but for the file that was just
// written.
void makeRoom(const std::filesystem::path& justWritten, std::uintmax_t most = kMostKept);

// A kept file was of use: it is the last one to be removed.
void noteUse(const std::filesystem::path& file);

// What a kept file was made of, for who looks at what is kept. It lies beside it, as NAME.of.
// Nothing is noted of files elsewhere than in cacheFolder().
void noteSource(const std::filesystem::path& file, const std::filesystem::path& source);

struct Kept {
    std::filesystem::path file;
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type used;
    std::filesystem::path source;  // in full; "" where that is not known
    bool limited = false;          // counts in kMostKept
};

// All that lies in the folder, the last one used first; nothing where it is not there. Files that are still
// being written are left out.
std::vector<Kept> allKept(const std::filesystem::path& folder);

// With its note. False where it stays.
bool removeKept(const std::filesystem::path& file);

// The number of files that crashed runs left half-written, which are removed.
int removeLeftovers(const std::filesystem::path& folder);

}  // namespace stereonav
