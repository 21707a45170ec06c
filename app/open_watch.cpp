// Replacements for the C library's functions that open files; they precede the library's own for the program
// and all libraries. Each calls the original and notes files opened for reading (engine/base/files_read.h):
// GDAL, ITK and GDCM open parts, masks and slices that nobody named, and a list by hand would miss some.
#include <dlfcn.h>
#include <fcntl.h>

#include <cstdarg>
#include <cstdio>

#include "engine/base/files_read.h"

namespace {

using stereonav::noteFileRead;

template <typename Function>
Function* nextOf(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int noted(int file, int flags) {
    const bool reads = (flags & O_ACCMODE) != O_WRONLY && (flags & (O_CREAT | O_TRUNC | O_PATH)) == 0;
    if (file >= 0 && reads) noteFileRead(file);
    return file;
}

std::FILE* noted(std::FILE* file, const char* mode) {
    if (file && mode[0] == 'r') noteFileRead(fileno(file));
    return file;
}

// Returns the mode that follows the flags, which has a meaning only where a file may be created.
mode_t modeAfter(int flags, std::va_list rest) {
    const bool makes = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
    return makes ? va_arg(rest, mode_t) : 0;
}

}  // namespace

// Declares other names in C++, since headers declare the true ones, some of them with a body.
#define STEREONAV_INSTEAD_OF(name) asm(name) __attribute__((visibility("default"), used))

extern "C" {

int stereonavOpen(const char* path, int flags, ...) STEREONAV_INSTEAD_OF("open");
int stereonavOpen64(const char* path, int flags, ...) STEREONAV_INSTEAD_OF("open64");
int stereonavOpenAt(int folder, const char* path, int flags, ...) STEREONAV_INSTEAD_OF("openat");
int stereonavOpenAt64(int folder, const char* path, int flags, ...) STEREONAV_INSTEAD_OF("openat64");
// Entry that fortified libraries call where they give no mode.
int stereonavOpen2(const char* path, int flags) STEREONAV_INSTEAD_OF("__open_2");
int stereonavOpen642(const char* path, int flags) STEREONAV_INSTEAD_OF("__open64_2");
std::FILE* stereonavFopen(const char* path, const char* mode) STEREONAV_INSTEAD_OF("fopen");
std::FILE* stereonavFopen64(const char* path, const char* mode) STEREONAV_INSTEAD_OF("fopen64");

int stereonavOpen(const char* path, int flags, ...) {
    static auto* const next = nextOf<int(const char*, int, ...)>("open");
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = modeAfter(flags, rest);
    va_end(rest);
    return noted(next(path, flags, mode), flags);
}

int stereonavOpen64(const char* path, int flags, ...) {
    static auto* const next = nextOf<int(const char*, int, ...)>("open64");
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = modeAfter(flags, rest);
    va_end(rest);
    return noted(next(path, flags, mode), flags);
}

int stereonavOpenAt(int folder, const char* path, int flags, ...) {
    static auto* const next = nextOf<int(int, const char*, int, ...)>("openat");
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = modeAfter(flags, rest);
    va_end(rest);
    return noted(next(folder, path, flags, mode), flags);
}

int stereonavOpenAt64(int folder, const char* path, int flags, ...) {
    static auto* const next = nextOf<int(int, const char*, int, ...)>("openat64");
    std::va_list rest;
    va_start(rest, flags);
    const mode_t mode = modeAfter(flags, rest);
    va_end(rest);
    return noted(next(folder, path, flags, mode), flags);
}

int stereonavOpen2(const char* path, int flags) {
    static auto* const next = nextOf<int(const char*, int)>("__open_2");
    return noted(next(path, flags), flags);
}

int stereonavOpen642(const char* path, int flags) {
    static auto* const next = nextOf<int(const char*, int)>("__open64_2");
    return noted(next(path, flags), flags);
}

std::FILE* stereonavFopen(const char* path, const char* mode) {
    static auto* const next = nextOf<std::FILE*(const char*, const char*)>("fopen");
    return noted(next(path, mode), mode);
}

std::FILE* stereonavFopen64(const char* path, const char* mode) {
    static auto* const next = nextOf<std::FILE*(const char*, const char*)>("fopen64");
    return noted(next(path, mode), mode);
}
}
