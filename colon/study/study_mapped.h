// A file's bytes as memory, for as long as it lives. Shared among colon/study/*.cpp only.
#pragma once

#include <sys/mman.h>

#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/regular_file.h"

namespace stereonav {

class MappedFile {
public:
    // Throws Error; an empty file has no bytes.
    explicit MappedFile(const std::filesystem::path& file) {
        const RegularFile opened(file);
        if (opened.size() == 0) return;
        void* const data = mmap(nullptr, opened.size(), PROT_READ, MAP_PRIVATE, opened.descriptor(), 0);
        if (data == MAP_FAILED)
            throw Error(file.string(), "", "can not be opened", "check the name and its permissions");
        mData = data;
        mBytes = opened.size();
    }
    ~MappedFile() {
        if (mData) munmap(mData, mBytes);
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    const unsigned char* data() const { return static_cast<const unsigned char*>(mData); }
    std::size_t size() const { return mBytes; }
    // Says that these bytes, from a page's start on, are not needed soon: they count as this process's memory
    // no more.
    void release(std::size_t start, std::size_t bytes) const {
        madvise(static_cast<unsigned char*>(mData) + start, bytes, MADV_DONTNEED);
    }

private:
    void* mData = nullptr;
    std::size_t mBytes = 0;
};

}  // namespace stereonav
