// A file that is open to be read, and is a regular one for sure: what a name stands for is looked at once it
// is open, and opening waits for nobody. So a pipe or a device in a file's place is refused in one line, even
// where it got there a moment ago, and holds up nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace stereonav {

class RegularFile {
public:
    // Throws Error where it is not there, can not be opened, or is something else than a file.
    explicit RegularFile(const std::filesystem::path& file);
    ~RegularFile();
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;

    int descriptor() const { return mFile; }
    std::uint64_t size() const { return mSize; }  // bytes, when it was opened

    // Reads from where the last read() or seek() ended. Returns the bytes that were read, fewer than asked
    // for at the end alone. Throws DiskError.
    std::size_t read(void* to, std::size_t bytes);
    void seek(std::uint64_t byte);  // from the file's beginning; throws DiskError

private:
    std::filesystem::path mName;
    int mFile = -1;
    std::uint64_t mSize = 0;
};

// Returns the first bytes of a file, at most `bytes`. Throws Error as RegularFile() does, and DiskError.
std::string firstBytes(const std::filesystem::path& file, std::size_t bytes);

}  // namespace stereonav
