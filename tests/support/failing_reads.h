// A disk that fails at a place of a file: pread() up to some byte returns what is before, and then EIO. It
// replaces the C library's function in a test program, of which only one file may include it.
#pragma once

#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <filesystem>

namespace stereonav::test {

class FailingReads {
public:
    // byte: place in the file, counted from 0.
    FailingReads(const std::filesystem::path& file, std::uint64_t byte) {
        struct stat is {};
        if (stat(file.c_str(), &is) == 0) sFile = is.st_ino;
        sByte = byte;
    }
    ~FailingReads() { sFile = 0; }
    FailingReads(const FailingReads&) = delete;
    FailingReads& operator=(const FailingReads&) = delete;

    // Returns how many of `bytes` bytes can be read from `at` on; for other files all.
    static std::size_t readable(int file, std::size_t bytes, off_t at) {
        struct stat is {};
        const std::uint64_t from = static_cast<std::uint64_t>(at), bad = sByte;
        if (sFile == 0 || fstat(file, &is) != 0 || is.st_ino != sFile || bad < from) return bytes;
        return static_cast<std::size_t>(std::min<std::uint64_t>(bytes, bad - from));
    }

private:
    inline static std::atomic<ino_t> sFile = 0;  // 0: none fails
    inline static std::atomic<std::uint64_t> sByte = 0;
};

}  // namespace stereonav::test

// Declares another name in C++, since the header declares the true one.
extern "C" ssize_t stereonavPread(int file, void* data, std::size_t bytes, off_t at) asm("pread")
    __attribute__((visibility("default"), used));
ssize_t stereonavPread(int file, void* data, std::size_t bytes, off_t at) {
    static auto* const next =
        reinterpret_cast<ssize_t (*)(int, void*, std::size_t, off_t)>(dlsym(RTLD_NEXT, "pread"));
    const std::size_t readable = stereonav::test::FailingReads::readable(file, bytes, at);
    if (readable > 0 || bytes == 0) return next(file, data, readable, at);
    errno = EIO;
    return -1;
}
