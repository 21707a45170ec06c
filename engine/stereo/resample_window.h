// Included by resample_kernel.cpp only: reads the left row at the sources of a block of right pixels. The
// sources nearly always lie so close together that two neighbouring registers and a permutation can replace a
// gather.
#pragma once

#include "engine/simd/simd_rows.h"

namespace stereonav::STEREONAV_ISA {
namespace {

// Sources at any distance; each index, and what is read beside it, lies within the tables.
struct FarWindow {
    I index;

    STEREONAV_INLINE I read(const void* table) const { return loadEach(table, index); }
    // Reads the elements at the sources, and those one further right.
    STEREONAV_INLINE IPair readPair(const void* table, int offset = 0) const {
        return loadEachPair(static_cast<const std::int32_t*>(table) + offset, index);
    }
};

#if defined(STEREONAV_PERMUTES)
// Sources that lie, together with what is read beside them, within 2 * kLanes elements from `base` on.
struct NearWindow {
    int base;
    I index;  // relative to base

    STEREONAV_INLINE I readAt(const void* table, I at) const {
        const std::int32_t* first = static_cast<const std::int32_t*>(table) + base;
        return permuted(loadI(first), loadI(first + kLanes), at);
    }
    STEREONAV_INLINE I read(const void* table) const { return readAt(table, index); }
    STEREONAV_INLINE IPair readPair(const void* table, int offset = 0) const {
        return {readAt(table, index + I(offset)), readAt(table, index + I(offset + 1))};
    }
};
#endif

}  // namespace
}  // namespace stereonav::STEREONAV_ISA
