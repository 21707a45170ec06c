// A two-dimensional array of pixels. Row 0 is the top row; the centre of pixel (x, y) lies at
// (x + 0.5, y + 0.5) in continuous image coordinates.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

namespace stereonav {

// Rows start on 64-byte boundaries and their stride leaves at least kPadding elements behind the
// last pixel, which vector code may read and overwrite: [width, stride) of a row is scratch.
template <typename T>
class Plane {
public:
    static constexpr int kPadding = 16;

    Plane() = default;
    Plane(int width, int height) { resize(width, height); }
    Plane(const Plane& other) { *this = other; }
    Plane& operator=(const Plane& other) {
        if (this == &other) return *this;
        resize(other.mWidth, other.mHeight);
        if (byteCount() > 0) std::memcpy(static_cast<void*>(mData.get()), other.mData.get(), byteCount());
        return *this;
    }
    Plane(Plane&& other) noexcept { *this = std::move(other); }
    Plane& operator=(Plane&& other) noexcept {
        std::swap(mData, other.mData);
        std::swap(mWidth, other.mWidth);
        std::swap(mHeight, other.mHeight);
        std::swap(mStride, other.mStride);
        return *this;
    }

    // Changes the size in pixels. An unchanged size keeps the pixels; another one allocates new memory,
    // filled with zeros. Throws std::bad_alloc.
    void resize(int width, int height) {
        if (width == mWidth && height == mHeight) return;
        mWidth = width;
        mHeight = height;
        mStride = width > 0 && height > 0 ? (width + kPadding + 15) / 16 * 16 : 0;
        mData.reset();
        if (byteCount() == 0) return;
        const std::size_t bytes = (byteCount() + 63) / 64 * 64;
        mData.reset(static_cast<T*>(std::aligned_alloc(64, bytes)));
        if (!mData) throw std::bad_alloc();
        std::memset(static_cast<void*>(mData.get()), 0, bytes);
    }

    int width() const { return mWidth; }
    int height() const { return mHeight; }
    int stride() const { return mStride; }  // elements from row to row
    bool empty() const { return mStride == 0; }
    std::size_t byteCount() const { return sizeof(T) * static_cast<std::size_t>(mStride) * mHeight; }

    T* row(int y) { return mData.get() + static_cast<std::ptrdiff_t>(y) * mStride; }
    const T* row(int y) const { return mData.get() + static_cast<std::ptrdiff_t>(y) * mStride; }
    T& at(int x, int y) { return row(y)[x]; }
    const T& at(int x, int y) const { return row(y)[x]; }

private:
    struct Free {
        void operator()(T* p) const { std::free(p); }
    };
    std::unique_ptr<T, Free> mData;
    int mWidth = 0, mHeight = 0, mStride = 0;
};

}  // namespace stereonav
