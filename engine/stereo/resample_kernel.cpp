// The inverse warp of one row for one instruction set (STEREONAV_ISA), kLanes pixels at a time; the same bits
// as warp_oracle.cpp. Left pixels, right to left: columns, suffix minimum, survivors, links, and for each
// right pixel that is the first a survivor may begin, its source. Right pixels, left to right: a running
// maximum spreads the sources, and what lies there is mixed.
#include "engine/stereo/resample_colors.h"
#include "engine/stereo/resample_window.h"
#include "engine/stereo/warp_row.h"

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr int kLine = 16;  // pixels of a cache line

STEREONAV_INLINE int wholeLines(int width) {
    return (width + kLine - 1) / kLine * kLine;
}

STEREONAV_INLINE F infinity() {
    return F(__builtin_inff());
}

STEREONAV_INLINE M unlike(M a, M b) {
    return andNot(a, b) | andNot(b, a);
}

// Data of the blocks to the right, for a block of left pixels.
struct ToTheRight {
    F column;                     // column of the next block
    F leftmost;                   // least column of all blocks, in every lane
    I begin;                      // first right pixel whose centre is not left of it, in every lane
    M survives, met, wide, link;  // masks of the next block
};

STEREONAV_INLINE M linksOf(const ResampleRow& row, int i, F depth, F gap, M survives, ToTheRight& right) {
    M link = survives & lanesFrom<1>(survives, right.survives) & (gap >= F(row.minStretch)) &
             (gap <= F(row.maxStretch));
    if (row.surface) {
        const M met = depth < infinity();
        link = andNot(link, unlike(met, lanesFrom<1>(met, right.met)));
        right.met = met;
    }
    if (row.leftSpread) {
        const F most = (F(row.mostSpread) * depth) * depth;
        const M wide = F(row.scale) * loadF(row.leftSpread + i) > most;
        link = andNot(link, wide | lanesFrom<1>(wide, right.wide));
        right.wide = wide;
    }
    right.survives = survives;
    return link;
}

// Stores the inverse widths of links whose neighbours within reach hold, else 0. What the block's first lane
// lacks to its left is taken back by the next block.
STEREONAV_INLINE void storeInverses(const ResampleRow& row, int i, F gap, M link, ToTheRight& right) {
    const M all = firstLanes(kLanes);
    M usable = link;
    if (row.reach > 0) usable = usable & lanesFrom<1>(link, right.link);
    if (row.reach > 1) {
        usable = usable & lanesFrom<kLanes - 1>(all, link);
        if ((bits(link) >> (kLanes - 1) & 1u) == 0) row.inverse[i + kLanes] = 0.0f;
    }
    store(row.inverse + i, select(usable, F(1.0f) / select(usable, gap, F(1.0f)), F(0.0f)));
    right.link = link;
}

// The row by value here and below: what is stored can not change its pointers.
void findSources(const ResampleRow row) {
    for (int p = 0; p < wholeLines(row.width); p += kLanes) store(row.source + p, I(-1));
    const F centres = laneIndexF() + F(0.5f), width(static_cast<float>(row.width));
    const F scale(row.scale), shift(row.shift);
    const M none = firstLanes(0);
    ToTheRight right{infinity(), infinity(), I(row.width), none, none, none, none};
    for (int i = (row.width - 1) / kLanes * kLanes; i >= 0; i -= kLanes) {
        const F depth = loadF(row.leftDepth + i);
        const F moved = (F(static_cast<float>(i)) + centres) + (shift - scale / depth);
        const F column = select(firstLanes(row.width - i), moved, infinity());
        const F minimum = min(suffixMinimum(column, infinity()), right.leftmost);
        const M survives = column < lanesFrom<1>(minimum, right.leftmost);
        const I begin = ceilToInt(clamp(minimum - F(0.5f), F(0.0f), width));
        // The rightmost of survivors with the same first pixel has it: the others end before it.
        const M owns = begin < lanesFrom<1>(begin, right.begin);
        scatterNumbers(row.source, begin, i, owns, row.width + kRowPadding - 1);
        const F gap = lanesFrom<1>(column, right.column) - column;
        const M link = linksOf(row, i, depth, gap, survives, right);
        storeInverses(row, i, gap, link, right);
        store(row.column + i, column);
        right.column = column;
        right.leftmost = everyLane<0>(minimum);
        right.begin = everyLane<0>(begin);
    }
    if (row.reach > 1) row.inverse[0] = 0.0f;  // nothing is left of the first pixel
}

template <bool kCubic>
struct Reach {
    static constexpr int kBefore = kCubic ? 1 : 0, kAfter = kCubic ? 2 : 1;
};

// At t between the linked pixels, or the nearer of them.
template <bool kSurface>
STEREONAV_INLINE F depthAt(F a, F b, F t) {
    if constexpr (kSurface)
        return select(a < infinity(), a + t * (b - a), a);
    else
        return min(b, a);
}

// kLanes right pixels from p on, some of which have a source.
template <bool kCubic, bool kSurface, typename Window>
STEREONAV_INLINE void mixBlock(const ResampleRow& row, int p, const Window& window, M some) {
    const F inverse = asFloat(window.read(row.inverse));
    const M warped = some & (inverse > F(0.0f));
    storeBytes(row.holes + p, ~warped);
    if (!any(warped)) {
        store(row.color + p, I(0));
        store(row.depth + p, F(0.0f));
        return;
    }
    const F centre = F(static_cast<float>(p)) + (laneIndexF() + F(0.5f));
    const F t = (centre - asFloat(window.read(row.column))) * inverse;
    const IPair ends = window.readPair(row.leftDepth);
    const F depth = depthAt<kSurface>(asFloat(ends.first), asFloat(ends.second), t);
    store(row.depth + p, select(warped, depth, F(0.0f)));
    I color;
    if constexpr (kCubic) {
        const IPair left = window.readPair(row.leftColor, -1), right = window.readPair(row.leftColor, 1);
        color = cubicColors(left.first, left.second, right.first, right.second, t);
    } else {
        const IPair taps = window.readPair(row.leftColor);
        color = lerpColors(taps.first, taps.second, t);
    }
    store(row.color + p, select(warped, color, I(0)));
}

// source: of the block, spread, so not decreasing; -1 where there is none. A pixel with taps on both sides
// has a source that is not the first pixel.
template <bool kCubic, bool kSurface>
STEREONAV_INLINE void resampleBlock(const ResampleRow& row, int p, I source) {
    constexpr int kBefore = Reach<kCubic>::kBefore;
    const M some = source > I(kBefore - 1);
#if defined(STEREONAV_PERMUTES)
    // The left row may be read up to the stride.
    const int first = firstLane(source) - kBefore, end = row.stride - 2 * kLanes;
    const int base = first < 0 ? 0 : first < end ? first : end;
    if (lastLane(source) + Reach<kCubic>::kAfter - base < 2 * kLanes)
        return mixBlock<kCubic, kSurface>(row, p, NearWindow{base, source - I(base)}, some);
#endif
    mixBlock<kCubic, kSurface>(row, p, FarWindow{max(source, I(kBefore))}, some);
}

// The next row is most likely next.
STEREONAV_INLINE void prefetchBelow(const ResampleRow& row, int p) {
    __builtin_prefetch(row.leftDepth + row.stride + p);
    __builtin_prefetch(row.leftColor + row.stride + p);
    __builtin_prefetch(row.depth + row.stride + p, 1);
    __builtin_prefetch(row.color + row.stride + p, 1);
}

template <bool kCubic, bool kSurface>
void resampleBlocks(const ResampleRow row) {
    I carried(-1);
    for (int p = 0; p < wholeLines(row.width); p += kLanes) {
        if (p % kLine == 0) prefetchBelow(row, p);
        const I source = max(prefixMaximum(loadI(row.source + p), I(-1)), carried);
        store(row.source + p, source);
        carried = everyLane<kLanes - 1>(source);
        resampleBlock<kCubic, kSurface>(row, p, source);
    }
}

}  // namespace

void resampleRow(const ResampleRow& row) {
    findSources(row);
    if (row.surface)
        row.cubic ? resampleBlocks<true, true>(row) : resampleBlocks<false, true>(row);
    else
        row.cubic ? resampleBlocks<true, false>(row) : resampleBlocks<false, false>(row);
}

}  // namespace stereonav::STEREONAV_ISA
