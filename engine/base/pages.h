// Memory that is taken page by page, as it is: LazyArray's volumes may be large and yet hold little.
#pragma once

#include <cstddef>

#include "engine/base/lazy_array.h"

namespace stereonav {

// Returns the bytes of the pages in use, for memory that begins with a page; `bytes` where that can not be
// told.
std::size_t residentBytes(const void* start, std::size_t bytes);

template <typename T>
std::size_t residentBytes(const LazyArray<T>& array) {
    return residentBytes(array.data(), array.size() * sizeof(T));
}

// Gives back the whole pages of this memory that hold nothing but zeros: it reads the same as before. Some
// systems take a page for what was only read. Nobody may write to it meanwhile; reading is fine.
void releaseZeroPages(const void* start, std::size_t bytes);

// Does the same for `count` elements from `first` on.
template <typename T>
void releaseZeroPages(const LazyArray<T>& array, std::size_t first, std::size_t count) {
    releaseZeroPages(array.data() + first, count * sizeof(T));
}

}  // namespace stereonav
