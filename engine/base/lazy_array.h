// A large array of zeros whose memory is taken page by page as it is written, so that volumes in which few
// places are used take little memory. Not copied implicitly: see share().
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace stereonav {

template <typename T>
class LazyArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    // Bytes behind the last element that vector code may read (zeros).
    static constexpr std::size_t kPadding = 64;

    LazyArray() = default;
    // An array of `count` zeros. Throws std::bad_alloc when the address space does not hold it.
    explicit LazyArray(std::size_t count) : mCount(count) {
        if (count == 0) return;
        void* p = mmap(nullptr, bytes(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
                       -1, 0);
        if (p == MAP_FAILED) throw std::bad_alloc();
        mData = std::shared_ptr<T>(static_cast<T*>(p), [size = bytes()](T* data) { munmap(data, size); });
    }
    LazyArray(LazyArray&& other) noexcept { swap(other); }
    LazyArray& operator=(LazyArray&& other) noexcept {
        swap(other);
        return *this;
    }

    // Returns another array over the same memory, which is kept as long as one of the arrays exists. From
    // then on none of them may be written to.
    LazyArray share() const {
        LazyArray same;
        same.mData = mData;
        same.mCount = mCount;
        return same;
    }

    // Returns this array's memory as elements of another type; leaves this array empty.
    template <typename U>
    LazyArray<U> as() && {
        static_assert(sizeof(U) % sizeof(T) == 0 && alignof(U) <= 64);
        LazyArray<U> same;
        same.mData = std::shared_ptr<U>(mData, reinterpret_cast<U*>(mData.get()));
        same.mCount = mCount / (sizeof(U) / sizeof(T));
        mData = nullptr;
        mCount = 0;
        return same;
    }

    // Gives whole pages of memory back to the system. These elements must not be read any more; they may
    // become zeros.
    void release(std::size_t first, std::size_t count) {
        const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
        const auto start = reinterpret_cast<std::uintptr_t>(mData.get() + first);
        const std::uintptr_t from = (start + page - 1) / page * page;
        const std::uintptr_t to = (start + count * sizeof(T)) / page * page;
        if (from < to) madvise(reinterpret_cast<void*>(from), to - from, MADV_DONTNEED);
    }

    // Asks for large pages: fewer address translations where rays access memory at random, but memory is
    // taken in steps of 2 MB.
    void preferLargePages() {
        if (mData) madvise(mData.get(), bytes(), MADV_HUGEPAGE);
    }

    std::size_t size() const { return mCount; }
    bool empty() const { return mCount == 0; }
    T* data() { return mData.get(); }
    const T* data() const { return mData.get(); }
    T& operator[](std::size_t i) { return mData.get()[i]; }
    const T& operator[](std::size_t i) const { return mData.get()[i]; }

private:
    template <typename U>
    friend class LazyArray;

    std::size_t bytes() const { return mCount * sizeof(T) + kPadding; }
    void swap(LazyArray& other) noexcept {
        std::swap(mData, other.mData);
        std::swap(mCount, other.mCount);
    }
    std::shared_ptr<T> mData;
    std::size_t mCount = 0;
};

}  // namespace stereonav
