// Memory that is taken page by page, as it is: LazyArray's volumes may be large and yet hold little.
#pragma once

#include <cstddef>

#include "engine/base/lazy_array.h"

namespace stereonav {

// Bytes of the pages in use, of memory that begins with a page; all of them where that can not be told.
std::size_t residentBytes(const void* start, std::size_t bytes);

template <typename T>
std::size_t residentBytes(const LazyArray<T>& array) {
    return residentBytes(array.data(), array.size() * sizeof(T));
}

}  // namespace stereonav
