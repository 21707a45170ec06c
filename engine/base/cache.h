// Files that the program keeps unasked in cacheFolder() to save time: they may be gone at any time, and take
// no more room than is said here. Light that was baked lies there too, under other extensions, and stays
// until the user takes it away.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace stereonav {

// Most bytes of all kept files together: beyond it the least recently used ones are removed.
constexpr std::uintmax_t kMostKept = 4'000'000'000;

// Returns the place of the file `name` in cacheFolder(); the extensions of what is kept are .bin, .nrrd and
// .tiles. A link there, or a file of another user, is taken away: nothing of it is read, and nothing goes
// through it. Throws as cacheFolder() does.
std::filesystem::path keptFile(const std::string& name);

// Calls write(file), which writes it whole or throws Error, then makes room for at most `most` bytes. Returns
// false where the file can not be written.
bool keep(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write,
          std::uintmax_t most = kMostKept);

// Removes what crashed runs left half-written, and what is beyond `most` but for the file that was just
// written.
void makeRoom(const std::filesystem::path& justWritten, std::uintmax_t most = kMostKept);

// Notes that a kept file was of use: of all kept files it is removed last.
void noteUse(const std::filesystem::path& file);

// Notes beside a kept file, as NAME.of, what it was made of, for whoever looks at what is kept. Does nothing
// for files elsewhere than in cacheFolder().
void noteSource(const std::filesystem::path& file, const std::filesystem::path& source);

// A file in cacheFolder().
struct Kept {
    std::filesystem::path file;
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type used;  // when it was last written or of use
    std::filesystem::path source;          // in full; "" where that is not known
    bool limited = false;                  // counts in kMostKept
};

// Returns all that lies in the folder, the last one used first; nothing where there is no such folder. Files
// that are still being written are left out.
std::vector<Kept> allKept(const std::filesystem::path& folder);

// Removes a kept file and its note. Returns false where it stays.
bool removeKept(const std::filesystem::path& file);

// Removes the files that crashed runs left half-written, and notes of files that are gone. Returns how many
// files.
int removeLeftovers(const std::filesystem::path& folder);

}  // namespace stereonav
