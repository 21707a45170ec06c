// A file that is read and written at given offsets, from any number of threads at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace stereonav {

class PlacedFile {
public:
    enum class For {
        Reading,
        Writing,  // the former content is lost; a link is not followed but is an error
        GoingOn,  // the former content stays; links as for Writing
    };

    PlacedFile() = default;
    // Opens the file; error() tells whether that succeeded.
    PlacedFile(const std::filesystem::path& file, For what);
    ~PlacedFile();
    PlacedFile(PlacedFile&& other) noexcept;
    PlacedFile& operator=(PlacedFile&& other) noexcept;

    int error() const { return mError; }  // why the file is not open, as errno; 0: it is open
    // Reads `bytes` bytes from byte `at` on. Returns 0, or the error as errno; ENODATA where the file ends
    // before.
    int read(std::uint64_t at, void* to, std::size_t bytes) const;
    // Writes `bytes` bytes from byte `at` on. Returns 0, or the error as errno.
    int write(std::uint64_t at, const void* from, std::size_t bytes) const;
    // Sets the file's size and reserves its disk space at once, so that a full disk is noticed before the
    // work is done. Returns 0, or the error as errno.
    int reserve(std::uint64_t bytes) const;
    int toDisk() const;  // waits until written data are on the disk; returns 0, or the error as errno

private:
    int mDescriptor = -1;
    int mError = 0;
};

}  // namespace stereonav
