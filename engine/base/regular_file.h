// A file that is open for reading and certainly a regular one: its type is tested after it was opened, and
// opening never blocks. So a pipe or a device in the place of a file is refused with one line, even if it was
// put there a moment ago.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace stereonav {

class RegularFile {
public:
    // Throws Error where the file does not exist, can not be opened, or is not a regular file.
    explicit RegularFile(const std::filesystem::path& file);
    ~RegularFile();
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;

    int descriptor() const { return mFile; }
    std::uint64_t size() const { return mSize; }  // bytes, when it was opened

    // Reads from where the last read() or seek() ended. Returns the number of bytes read: fewer than asked
    // for only at the end of the file. Throws DiskError.
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
