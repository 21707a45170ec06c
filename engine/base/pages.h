// Memory by pages: LazyArray's volumes may be large although few of their pages are in use.
#pragma once

#include <cstddef>

#include "engine/base/lazy_array.h"

namespace stereonav {

// Returns the bytes of the pages in use, for memory that begins at a page; `bytes` where the system does not
// tell.
std::size_t residentBytes(const void* start, std::size_t bytes);

template <typename T>
std::size_t residentBytes(const LazyArray<T>& array) {
    return residentBytes(array.data(), array.size() * sizeof(T));
}

// Gives pages of this memory that hold nothing but zeros back to the system; they still read as zeros. That
// includes pages that some systems take for memory that was only read. Nobody may write to the memory
// meanwhile; reading is allowed.
void releaseZeroPages(const void* start, std::size_t bytes);

// Calls releaseZeroPages() for `count` elements from `first` on.
template <typename T>
void releaseZeroPages(const LazyArray<T>& array, std::size_t first, std::size_t count) {
    releaseZeroPages(array.data() + first, count * sizeof(T));
}

}  // namespace stereonav
