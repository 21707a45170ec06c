// Entries of a table that a packet's lanes read close together are loaded once and looked up in registers:
// the same numbers as gathered. Neighbouring rays mostly meet neighbouring values. AVX-512 alone: its
// permutes reach 32 entries. Included by kernels only.
#pragma once

#include "engine/medium/kernel_block.h"
#include "engine/medium/kernel_table.h"

namespace stereonav::STEREONAV_ISA {

#if defined(STEREONAV_ISA_avx512)

class TableWindow {
public:
    // Around `entry` of lanes m.
    STEREONAV_INLINE TableWindow(I entry, M m)
        : mFirst(leastOf(entry, m, SweepTable::kColumns - kEntries)), mOffset(entry - I(mFirst)) {
        mHolds = !any(m & ~within(mOffset, I(kEntries - 2)));
    }
    // Whether it holds all that those lanes read, entries and the next.
    STEREONAV_INLINE bool holds() const { return mHolds; }

    STEREONAV_INLINE F between(const float* member, F share) const {
        const __m512 low = _mm512_loadu_ps(member + mFirst), high = _mm512_loadu_ps(member + mFirst + 16);
        const auto at = [&](I offset) -> F { return _mm512_permutex2var_ps(low, offset.v, high); };
        return lerp(at(mOffset), at(mOffset + I(1)), share);
    }
    STEREONAV_INLINE I at(const std::uint32_t* words) const {
        return _mm512_permutex2var_epi32(loadI(words + mFirst).v, mOffset.v, loadI(words + mFirst + 16).v);
    }

private:
    static constexpr int kEntries = 32;
    int mFirst;
    I mOffset;
    bool mHolds;
};

#else

class TableWindow {
public:
    STEREONAV_INLINE TableWindow(I, M) {}
    STEREONAV_INLINE bool holds() const { return false; }
    STEREONAV_INLINE F between(const float*, F share) const { return share; }
    STEREONAV_INLINE I at(const std::uint32_t*) const { return I(0); }
};

#endif

// How a packet's lanes m read a column of the table: through a window, or each on its own.
struct ColumnReader {
    TableWindow window;
    I entry;
    F share;
    M m;

    STEREONAV_INLINE ColumnReader(const Column& at, M lanes)
        : window(at.entry, lanes), entry(at.entry), share(at.share), m(lanes) {}
    // Of some of these lanes; where they lie apart, those may not.
    STEREONAV_INLINE void leave(M lanes) {
        m = lanes;
        if (!window.holds()) window = TableWindow(entry, lanes);
    }
    STEREONAV_INLINE F operator()(const float* member) const {
        return window.holds() ? window.between(member, share) : entryOf(member, entry, share, m);
    }
    STEREONAV_INLINE F operator()(const std::uint32_t* pairs) const {
        return betweenHalves(window.holds() ? window.at(pairs) : gather(pairs, entry, m), share);
    }
};

}  // namespace stereonav::STEREONAV_ISA
