#include "engine/base/placed_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "engine/base/own_folder.h"

namespace stereonav {

PlacedFile::PlacedFile(const std::filesystem::path& file, For what) {
    const int how = what == For::Reading   ? O_RDONLY
                    : what == For::Writing ? O_RDWR | O_CREAT | O_TRUNC
                                           : O_RDWR | O_CREAT;
    const int follow = what == For::Reading ? 0 : O_NOFOLLOW;
    const bool own = file.parent_path() == cachePlace();
    mDescriptor = open(file.c_str(), how | follow | O_CLOEXEC, own ? 0600 : 0666);
    if (mDescriptor < 0) mError = errno;
}

PlacedFile::~PlacedFile() {
    if (mDescriptor >= 0) close(mDescriptor);
}

PlacedFile::PlacedFile(PlacedFile&& other) noexcept
    : mDescriptor(std::exchange(other.mDescriptor, -1)), mError(other.mError) {}

PlacedFile& PlacedFile::operator=(PlacedFile&& other) noexcept {
    std::swap(mDescriptor, other.mDescriptor);
    std::swap(mError, other.mError);
    return *this;
}

int PlacedFile::read(std::uint64_t at, void* to, std::size_t bytes) const {
    auto* out = static_cast<char*>(to);
    while (bytes > 0) {
        const ssize_t got = pread(mDescriptor, out, bytes, static_cast<off_t>(at));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return got < 0 ? errno : ENODATA;
        out += got, at += static_cast<std::uint64_t>(got), bytes -= static_cast<std::size_t>(got);
    }
    return 0;
}

int PlacedFile::write(std::uint64_t at, const void* from, std::size_t bytes) const {
    const auto* in = static_cast<const char*>(from);
    while (bytes > 0) {
        const ssize_t put = pwrite(mDescriptor, in, bytes, static_cast<off_t>(at));
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) return put < 0 ? errno : ENOSPC;
        in += put, at += static_cast<std::uint64_t>(put), bytes -= static_cast<std::size_t>(put);
    }
    return 0;
}

int PlacedFile::reserve(std::uint64_t bytes) const {
    const int failed = posix_fallocate(mDescriptor, 0, static_cast<off_t>(bytes));
    if (failed != EOPNOTSUPP && failed != EINVAL) return failed;
    return ftruncate(mDescriptor, static_cast<off_t>(bytes)) == 0 ? 0 : errno;
}

int PlacedFile::toDisk() const {
    return fsync(mDescriptor) == 0 ? 0 : errno;
}

}  // namespace stereonav
