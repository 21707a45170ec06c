// Loaded before the program (LD_PRELOAD): makes the Nth call of one kind fail, once, and counts those of all.
//   FAULT_KIND   write, sync, rename, create, read, open or memory
//   FAULT_AT     which call fails; 0: none
//   FAULT_COUNT  a file of 7 64-bit numbers, in which the calls of each kind are counted, in the order above
//   FAULT_BYTES  memory: the least that counts; 0: all calls
// write, read and sync count on regular files alone; create is opening a file for writing, open one for
// reading; below FAULT_UNDER, where it is given.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum Kind { kWrite, kSync, kRename, kCreate, kRead, kOpen, kMemory, kKinds };

struct Layer {
    Kind kind = kKinds;
    std::uint64_t at = 0;
    std::size_t bytes = 0;
    char under[PATH_MAX] = {};
    std::atomic<std::uint64_t>* count = nullptr;
};
Layer layer;  // without a count until it is set up: what is called before passes

template <typename Function>
Function* nextOf(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

__attribute__((constructor)) void setUp() {
    const char* kind = std::getenv("FAULT_KIND");
    const char* count = std::getenv("FAULT_COUNT");
    if (!kind || !count) return;
    const int file = nextOf<int(const char*, int, ...)>("open")(count, O_RDWR | O_CLOEXEC);
    if (file < 0) return;
    void* page = mmap(nullptr, kKinds * sizeof(std::uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (page == MAP_FAILED) return;
    if (const char* at = std::getenv("FAULT_AT")) layer.at = std::strtoull(at, nullptr, 10);
    if (const char* bytes = std::getenv("FAULT_BYTES")) layer.bytes = std::strtoull(bytes, nullptr, 10);
    if (const char* under = std::getenv("FAULT_UNDER")) std::strncpy(layer.under, under, PATH_MAX - 1);
    layer.count = static_cast<std::atomic<std::uint64_t>*>(page);
    constexpr const char* kNames[] = {"write", "sync", "rename", "create", "read", "open", "memory"};
    for (int n = 0; n < kKinds; ++n)
        if (std::strcmp(kind, kNames[n]) == 0) layer.kind = static_cast<Kind>(n);
}

// Returns whether this call is the one that fails.
bool fails(Kind kind, int error) {
    if (!layer.count || ++layer.count[kind] != layer.at || layer.kind != kind) return false;
    errno = error;
    return true;
}

bool isUnder(const char* path) {
    if (!layer.under[0]) return true;
    char whole[PATH_MAX];
    if (path[0] != '/') {
        if (!getcwd(whole, sizeof whole)) return false;
        std::strncat(whole, "/", sizeof whole - std::strlen(whole) - 1);
        std::strncat(whole, path, sizeof whole - std::strlen(whole) - 1);
        path = whole;
    }
    return std::strncmp(path, layer.under, std::strlen(layer.under)) == 0;
}

bool isCounted(int file) {
    struct stat is {};
    if (fstat(file, &is) != 0 || !S_ISREG(is.st_mode)) return false;
    if (!layer.under[0]) return true;
    char link[64], path[PATH_MAX];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0) return false;
    path[length] = '\0';
    return isUnder(path);
}

bool failsOn(int file, Kind kind, int error) {
    return layer.count && isCounted(file) && fails(kind, error);
}

bool failsToOpen(const char* path, bool writes, int error) {
    return layer.count && isUnder(path) && fails(writes ? kCreate : kOpen, error);
}

bool failsToOpen(const char* path, int flags) {
    if (flags & (O_DIRECTORY | O_PATH)) return false;
    const bool writes = (flags & O_ACCMODE) != O_RDONLY;
    return failsToOpen(path, writes, writes ? ENOSPC : EACCES);
}

bool failsToAllocate(std::size_t bytes) {
    return bytes >= layer.bytes && fails(kMemory, ENOMEM);
}

mode_t modeAfter(int flags, std::va_list rest) {
    const bool makes = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
    return makes ? va_arg(rest, mode_t) : 0;
}

}  // namespace

// Under other names in C++, since headers declare the true ones, some of them with a body.
#define INSTEAD_OF(name) asm(name) __attribute__((visibility("default"), used))
#define FAULT_ONE(result, name, parameters, arguments, failing, failed) \
    extern "C" result fault_##name parameters INSTEAD_OF(#name);        \
    result fault_##name parameters {                                    \
        static auto* const next = nextOf<result parameters>(#name);     \
        if (failing) return failed;                                     \
        return next arguments;                                          \
    }

FAULT_ONE(ssize_t, write, (int file, const void* data, std::size_t bytes), (file, data, bytes),
          failsOn(file, kWrite, ENOSPC), -1)
FAULT_ONE(ssize_t, pwrite, (int file, const void* data, std::size_t bytes, off_t at), (file, data, bytes, at),
          failsOn(file, kWrite, ENOSPC), -1)
FAULT_ONE(ssize_t, pwrite64, (int file, const void* data, std::size_t bytes, off_t at),
          (file, data, bytes, at), failsOn(file, kWrite, ENOSPC), -1)
FAULT_ONE(ssize_t, writev, (int file, const iovec* parts, int count), (file, parts, count),
          failsOn(file, kWrite, ENOSPC), -1)
FAULT_ONE(int, ftruncate, (int file, off_t bytes), (file, bytes), failsOn(file, kWrite, ENOSPC), -1)
FAULT_ONE(int, ftruncate64, (int file, off_t bytes), (file, bytes), failsOn(file, kWrite, ENOSPC), -1)
FAULT_ONE(int, truncate, (const char* path, off_t bytes), (path, bytes),
          layer.count&& isUnder(path) && fails(kWrite, EIO), -1)
FAULT_ONE(int, fsync, (int file), (file), failsOn(file, kSync, EIO), -1)
FAULT_ONE(int, fdatasync, (int file), (file), failsOn(file, kSync, EIO), -1)
FAULT_ONE(int, rename, (const char* from, const char* to), (from, to),
          layer.count&& isUnder(to) && fails(kRename, EIO), -1)
FAULT_ONE(int, mkdir, (const char* path, mode_t mode), (path, mode),
          layer.count&& isUnder(path) && fails(kCreate, ENOSPC), -1)
FAULT_ONE(ssize_t, read, (int file, void* data, std::size_t bytes), (file, data, bytes),
          failsOn(file, kRead, EIO), -1)
FAULT_ONE(ssize_t, pread, (int file, void* data, std::size_t bytes, off_t at), (file, data, bytes, at),
          failsOn(file, kRead, EIO), -1)
FAULT_ONE(ssize_t, pread64, (int file, void* data, std::size_t bytes, off_t at), (file, data, bytes, at),
          failsOn(file, kRead, EIO), -1)
FAULT_ONE(ssize_t, readv, (int file, const iovec* parts, int count), (file, parts, count),
          failsOn(file, kRead, EIO), -1)
FAULT_ONE(int, __open_2, (const char* path, int flags), (path, flags), failsToOpen(path, flags), -1)
FAULT_ONE(int, __open64_2, (const char* path, int flags), (path, flags), failsToOpen(path, flags), -1)
FAULT_ONE(std::FILE*, fopen, (const char* path, const char* mode), (path, mode),
          failsToOpen(path, mode[0] != 'r', mode[0] != 'r' ? ENOSPC : EACCES), nullptr)
FAULT_ONE(std::FILE*, fopen64, (const char* path, const char* mode), (path, mode),
          failsToOpen(path, mode[0] != 'r', mode[0] != 'r' ? ENOSPC : EACCES), nullptr)
FAULT_ONE(void*, mmap64, (void* at, std::size_t bytes, int access, int flags, int file, off_t from),
          (at, bytes, access, flags, file, from), (flags & MAP_ANONYMOUS) && failsToAllocate(bytes),
          MAP_FAILED)
FAULT_ONE(int, posix_memalign, (void** to, std::size_t side, std::size_t bytes), (to, side, bytes),
          failsToAllocate(bytes), ENOMEM)
FAULT_ONE(void*, aligned_alloc, (std::size_t side, std::size_t bytes), (side, bytes), failsToAllocate(bytes),
          nullptr)
FAULT_ONE(void*, memalign, (std::size_t side, std::size_t bytes), (side, bytes), failsToAllocate(bytes),
          nullptr)

// What a stream holds back is written inside the C library, where no call is to be seen: it fails here.
FAULT_ONE(std::size_t, fwrite, (const void* data, std::size_t bytes, std::size_t count, std::FILE* to),
          (data, bytes, count, to), failsOn(fileno(to), kWrite, ENOSPC), 0)
extern "C" std::size_t fault_fread(void* data, std::size_t bytes, std::size_t count, std::FILE* from)
    INSTEAD_OF("fread");
std::size_t fault_fread(void* data, std::size_t bytes, std::size_t count, std::FILE* from) {
    static auto* const next = nextOf<std::size_t(void*, std::size_t, std::size_t, std::FILE*)>("fread");
    if (!failsOn(fileno(from), kRead, EIO)) return next(data, bytes, count, from);
    constexpr int kErrorSeen = 0x20;  // glibc's: ferror() tells of it
    from->_flags |= kErrorSeen;
    return 0;
}

// A file is closed all the same; what it held may be lost.
extern "C" int fault_close(int file) INSTEAD_OF("close");
int fault_close(int file) {
    static auto* const next = nextOf<int(int)>("close");
    int mode = 0;
    const bool counts =
        layer.count && isCounted(file) && (mode = fcntl(file, F_GETFL)) >= 0 && (mode & O_ACCMODE);
    const int result = next(file);
    return counts && fails(kSync, EIO) ? -1 : result;
}
extern "C" int fault_fclose(std::FILE* file) INSTEAD_OF("fclose");
int fault_fclose(std::FILE* file) {
    static auto* const next = nextOf<int(std::FILE*)>("fclose");
    const int number = fileno(file);
    const bool counts =
        layer.count && number >= 0 && isCounted(number) && (fcntl(number, F_GETFL) & O_ACCMODE) != O_RDONLY;
    const int result = next(file);
    return counts && fails(kSync, EIO) ? EOF : result;
}

#define FAULT_OPEN(name)                                                             \
    extern "C" int fault_##name(const char* path, int flags, ...) INSTEAD_OF(#name); \
    int fault_##name(const char* path, int flags, ...) {                             \
        static auto* const next = nextOf<int(const char*, int, ...)>(#name);         \
        std::va_list rest;                                                           \
        va_start(rest, flags);                                                       \
        const mode_t mode = modeAfter(flags, rest);                                  \
        va_end(rest);                                                                \
        return failsToOpen(path, flags) ? -1 : next(path, flags, mode);              \
    }
FAULT_OPEN(open)
FAULT_OPEN(open64)

// Memory. The C library itself asks these functions while dlsym() looks for them: then they are found
// already, or the call goes to its own names for them.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* fault_malloc(std::size_t bytes) INSTEAD_OF("malloc");
void* fault_calloc(std::size_t count, std::size_t bytes) INSTEAD_OF("calloc");
void* fault_realloc(void* old, std::size_t bytes) INSTEAD_OF("realloc");
void* fault_mmap(void* at, std::size_t bytes, int access, int flags, int file, off_t from) INSTEAD_OF("mmap");
void* fault_malloc(std::size_t bytes) {
    return failsToAllocate(bytes) ? nullptr : __libc_malloc(bytes);
}
void* fault_calloc(std::size_t count, std::size_t bytes) {
    return failsToAllocate(count * bytes) ? nullptr : __libc_calloc(count, bytes);
}
void* fault_realloc(void* old, std::size_t bytes) {
    return failsToAllocate(bytes) ? nullptr : __libc_realloc(old, bytes);
}
void* fault_mmap(void* at, std::size_t bytes, int access, int flags, int file, off_t from) {
    static auto* const next = nextOf<void*(void*, std::size_t, int, int, int, off_t)>("mmap");
    if ((flags & MAP_ANONYMOUS) && failsToAllocate(bytes)) return MAP_FAILED;
    return next(at, bytes, access, flags, file, from);
}
}
