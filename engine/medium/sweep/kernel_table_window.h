// Reads entries of a table that lie close together for a packet's lanes: they are loaded once and looked up
// in registers, with the same results as gathers. Neighbouring rays mostly meet neighbouring values. AVX-512
// only: its permutes reach 32 entries. Included by kernels only.
#pragma once

#include "engine/medium/sweep/kernel_block.h"
#include "engine/medium/sweep/kernel_table.h"

namespace stereonav::STEREONAV_ISA {

#if defined(STEREONAV_ISA_avx512)

class TableWindow {
public:
    // Loads the entries around `entry` of lanes m.
    STEREONAV_INLINE TableWindow(I entry, M m)
        : mFirst(leastOf(entry, m, SweepTable::kColumns - kEntries)), mOffset(entry - I(mFirst)) {
        mHolds = !any(m & ~within(mOffset, I(kEntries - 2)));
    }
    // Returns whether the window holds all entries that those lanes read, with the next ones.
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

// Positions at which a packet's lanes m read a table: through a window, or by gathers.
struct TablePlaces {
    Column at;
    M m;
    TableWindow window;

    STEREONAV_INLINE TablePlaces(const Column& column, M lanes)
        : at(column), m(lanes), window(column.entry, lanes) {}
    // Keeps some of these lanes, whose entries may lie closer together.
    STEREONAV_INLINE void leave(M lanes) {
        m = lanes;
        if (!window.holds()) window = TableWindow(at.entry, lanes);
    }
    // Calls use(read); chooses once between window and gathers for all its reads.
    template <typename Use>
    STEREONAV_INLINE void read(const Use& use) const {
        if (window.holds())
            use([&](const float* member) { return window.between(member, at.share); });
        else
            use([&](const float* member) { return entryOf(member, at.entry, at.share, m); });
    }
    STEREONAV_INLINE F readOne(const float* member) const {
        return window.holds() ? window.between(member, at.share) : entryOf(member, at.entry, at.share, m);
    }
    STEREONAV_INLINE F readPairs(const std::uint32_t* pairs) const {
        return betweenHalves(window.holds() ? window.at(pairs) : gather(pairs, at.entry, m), at.share);
    }
};

}  // namespace stereonav::STEREONAV_ISA
