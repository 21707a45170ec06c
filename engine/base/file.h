// Files that are never half-written: the content goes beside its place and is renamed into it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace stereonav {

// Throws Error naming the path when it can not be read.
std::string readTextFile(const std::filesystem::path& path);

// Calls write(temporary) with a path in the same folder and the same extension, then renames it to
// `path`. On any exception the temporary is removed and `path` is as it was. Missing parent folders
// are created. Throws Error when the place can not be written.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path&)>& write);

void writeTextFile(const std::filesystem::path& path, const std::string& content);

// Where computed things are kept between runs: $XDG_CACHE_HOME/stereonav or ~/.cache/stereonav.
std::filesystem::path cacheFolder();

}  // namespace stereonav
