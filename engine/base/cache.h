// Files that the program keeps in cacheFolder() to save time, without being asked. They may be gone at any
// time, and take no more room than kMostKept. Baked light lies there too, under other extensions, and stays
// until the user removes it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace stereonav {

// Most bytes of all kept files together: beyond it the least recently used ones are removed.
constexpr std::uintmax_t kMostKept = 4'000'000'000;

// Returns the path of the file `name` in cacheFolder(); the extensions of kept files are .bin, .nrrd and
// .tiles. A link at that path, or a file of another user, is removed: it is neither read nor written through.
// Throws as cacheFolder() does.
std::filesystem::path keptFile(const std::string& name);

// Calls write(file), which writes the whole file or throws Error, then makes room so that at most `most`
// bytes are kept. Returns false where the file can not be written.
bool keep(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write,
          std::uintmax_t most = kMostKept);

// Removes files that crashed runs left half-written, and the least recently used files beyond `most` bytes;
// never the file that was just written.
void makeRoom(const std::filesystem::path& justWritten, std::uintmax_t most = kMostKept);

// Notes that a kept file was used, so that it becomes the last of all to be removed.
void noteUse(const std::filesystem::path& file);

// Writes a note beside a kept file, NAME.of, which says what the file was made of, for listings of the cache.
// Does nothing for files outside cacheFolder().
void noteSource(const std::filesystem::path& file, const std::filesystem::path& source);

// A file in cacheFolder().
struct Kept {
    std::filesystem::path file;
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type used;  // time of the last write or use
    std::filesystem::path source;          // full path; "" where it is not known
    bool limited = false;                  // counts against kMostKept
};

// Returns all files in the folder, the most recently used first; empty where there is no such folder. Files
// that are still being written are left out.
std::vector<Kept> allKept(const std::filesystem::path& folder);

// Removes a kept file and its note. Returns false where it stays.
bool removeKept(const std::filesystem::path& file);

// Removes files that crashed runs left half-written, and notes of files that are gone. Returns the number of
// removed files.
int removeLeftovers(const std::filesystem::path& folder);

}  // namespace stereonav
