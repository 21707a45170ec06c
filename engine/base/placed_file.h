// A file that is read and written at places of it, from any number of threads at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace stereonav {

class PlacedFile {
public:
    enum class For {
        Reading,
        Writing,  // what was there is lost; a link is not followed, which is an error
        GoingOn,  // what was there stays; the same
    };

    PlacedFile() = default;
    // error() tells whether it could be opened.
    PlacedFile(const std::filesystem::path& file, For what);
    ~PlacedFile();
    PlacedFile(PlacedFile&& other) noexcept;
    PlacedFile& operator=(PlacedFile&& other) noexcept;

    int error() const { return mError; }  // why it is not open, as errno; 0: it is
    // Reads `bytes` bytes from byte `at` on. Returns 0, or the error as errno; ENODATA where the file ends
    // before.
    int read(std::uint64_t at, void* to, std::size_t bytes) const;
    // Writes `bytes` bytes from byte `at` on. Returns 0, or the error as errno.
    int write(std::uint64_t at, const void* from, std::size_t bytes) const;
    // Gives the file that size, and all of its room at once: a full disk shows before the work is done.
    // Returns 0, or the error as errno.
    int reserve(std::uint64_t bytes) const;
    int toDisk() const;  // waits until what was written is there; 0, or the error as errno

private:
    int mDescriptor = -1;
    int mError = 0;
};

}  // namespace stereonav
