// A file's bytes as memory, for as long as it lives. Shared among colon/study/*.cpp only.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "engine/base/error.h"

namespace stereonav {

class MappedFile {
public:
    // Throws Error; an empty file has no bytes.
    explicit MappedFile(const std::filesystem::path& file) {
        const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
        struct stat status {};
        if (descriptor >= 0 && fstat(descriptor, &status) == 0 && status.st_size > 0) {
            mBytes = static_cast<std::size_t>(status.st_size);
            mData = mmap(nullptr, mBytes, PROT_READ, MAP_PRIVATE, descriptor, 0);
        }
        if (descriptor >= 0) close(descriptor);
        if (descriptor < 0 || mData == MAP_FAILED)
            throw Error(file.string(), "", "can not be opened", "check the name and its permissions");
    }
    ~MappedFile() {
        if (mData) munmap(mData, mBytes);
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    const unsigned char* data() const { return static_cast<const unsigned char*>(mData); }
    std::size_t size() const { return mBytes; }
    // These bytes, from a page's start on, are not needed soon: they count as this process's memory no more.
    void release(std::size_t start, std::size_t bytes) const {
        madvise(static_cast<unsigned char*>(mData) + start, bytes, MADV_DONTNEED);
    }

private:
    void* mData = nullptr;
    std::size_t mBytes = 0;
};

}  // namespace stereonav
