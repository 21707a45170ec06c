// One eye's samples in a slab, stored by rows of its pixels and read by the other eye, which sees the same
// samples shifted along the rows (sweep_sharing.h). Included by kernels only.
#pragma once

#include "engine/medium/sweep/kernel_medium.h"

namespace stereonav::STEREONAV_ISA {

// A slab as lanes see it: the light that it sends, and its opacity along the ray.
struct Sighting {
    Colors sent;
    F opacity, passes;  // 0 to 1: 1 - passes
    F depth;            // view depth, metres
    M looked, seen;     // looked: was sampled; seen: is not empty
};
STEREONAV_INLINE Sighting nothingSeen(F depth, M looked) {
    const F zero(0.0f);
    return {{{zero, zero, zero}}, zero, F(1.0f), depth, looked, maskFromBits(0)};
}

// Place of a packet's stored numbers: four columns, kLanes / 4 rows, slab after slab.
struct SharedPlace {
    float* first = nullptr;  // slab 0: first colour of the light; then the other colours and the opacity
};
constexpr int kSharedSlab = SharedRows::kNumbers * kLanes;
constexpr int kSharedPacket = SweepChunk::kMost * kSharedSlab;
// Returns the place of a packet's numbers. x: column of the picture, a multiple of four; row: among the
// stored rows.
STEREONAV_INLINE SharedPlace sharedPlace(const SharedRows& rows, int x, int row) {
    const std::int64_t packets = rows.columns / 4;
    return {rows.numbers + (row / (kLanes / 4) * packets + x / 4) * kSharedPacket};
}
constexpr float kNotLooked = -1.0f;  // an opacity that marks samples that were not taken

STEREONAV_INLINE void keepSighting(const SharedPlace& at, int n, const Sighting& s) {
    float* to = at.first + n * kSharedSlab;
    const F zero(0.0f);
    for (int k = 0; k < 3; ++k) store(to + k * kLanes, select(s.seen, s.sent.c[k], zero));
    store(to + 3 * kLanes, select(s.looked, select(s.seen, s.opacity, zero), F(kNotLooked)));
}
// Stores that these slabs are empty.
STEREONAV_INLINE void keepNothing(const SharedPlace& at, std::uint32_t slabs) {
    for (; slabs; slabs &= slabs - 1) {
        float* to = at.first + __builtin_ctz(slabs) * kSharedSlab;
        for (int k = 0; k < SharedRows::kNumbers; ++k) store(to + k * kLanes, F(0.0f));
    }
}
// Stores that these slabs were not sampled.
STEREONAV_INLINE void keepNotLooked(const SharedPlace& at, std::uint32_t slabs) {
    for (; slabs; slabs &= slabs - 1)
        store(at.first + __builtin_ctz(slabs) * kSharedSlab + 3 * kLanes, F(kNotLooked));
}

// Reads columns i and i + 1 of a packet's rows, for lanes m. With AVX-512 two packets are loaded and looked
// up where they contain all columns, which is so except where slabs are seen nearly along.
class SharedColumns {
public:
    STEREONAV_INLINE SharedColumns(I i, M lanes) : mLanes(lanes), mColumn(i) {
        mRow = shiftLeft<2>(shiftRight<2>(laneIndex()));
#if defined(STEREONAV_ISA_avx512)
        const int least = leastOf(i, lanes, 0x7fffffff) & ~3;
        const I from = i - I(least);
        mNear = !any(andNot(lanes, within(from, I(6))));
        mOffset = static_cast<std::int64_t>(least / 4) * kSharedPacket;
        const I next = from + I(1);
        mFirst = mRow + (from & I(3)) + shiftLeft<4>(shiftRight<2>(from));
        mSecond = mRow + (next & I(3)) + shiftLeft<4>(shiftRight<2>(next));
#endif
    }
    // Reads both columns; from: column 0.
    STEREONAV_INLINE FPair read(const float* from) const {
#if defined(STEREONAV_ISA_avx512)
        if (mNear) {
            const F a = loadF(from + mOffset), b = loadF(from + mOffset + kSharedPacket);
            return {_mm512_permutex2var_ps(a.v, mFirst.v, b.v), _mm512_permutex2var_ps(a.v, mSecond.v, b.v)};
        }
#endif
        const auto column = [&](I i) {
            const I index = shiftRight<2>(i) * I(kSharedPacket) + mRow + (i & I(3));
            return gather(from, index, mLanes, F(0.0f));
        };
        return {column(mColumn), column(mColumn + I(1))};
    }

private:
    M mLanes;
    I mColumn, mRow;  // mRow: its first lane
#if defined(STEREONAV_ISA_avx512)
    bool mNear;
    std::int64_t mOffset;  // index of the first packet's numbers
    I mFirst, mSecond;     // indices into both packets
#endif
};

// Shares of a ray's light below which one of the two neighbouring pixels is enough, and below which none is
// needed. With 1/4 and 1/256; brighter rays take samples of their own.
constexpr float kFaint = 1.0f / 4, kFaintest = 1.0f / 256;

// How a packet of the other eye reads.
struct SharedReader {
    const SharedRows* rows = nullptr;
    SharedPlace at{};  // column 0
    F column = 0.0f;   // column of an infinitely far place
    F cosine = 0.0f;   // dot product of axis and ray of depth 1
    F bend = 0.0f;     // change of the ray's length with the parallax

    SharedReader() = default;
    STEREONAV_INLINE SharedReader(const SharedRows& r, const SweepEye& eye, F x, F y, int row)
        : rows(&r), at(sharedPlace(r, 0, row)), column(x + F(r.column)) {
        const F wx = mulAdd(x, F(static_cast<float>(eye.perX)), F(static_cast<float>(eye.xMin))),
                wy = F(static_cast<float>(eye.yMax)) - y * F(static_cast<float>(eye.perY));
        cosine = mulAdd(wx, F(static_cast<float>(eye.axis[0])),
                        mulAdd(wy, F(static_cast<float>(eye.axis[1])), F(static_cast<float>(eye.axis[2]))));
        bend = wx / mulAdd(wx, wx, mulAdd(wy, wy, F(1.0f)));
    }

    // Reads slab n at that view depth for lanes m, whose remaining share of light is `left`; looked: lanes
    // that the first eye has sampled.
    STEREONAV_INLINE Sighting read(int n, F depth, F left, M m) const {
        const F parallax = cosine * F(rows->parallax[n]);
        const F x = mulAdd(parallax, F(rows->perParallax), column);
        const I i = floorToInt(x);
        const F zero(0.0f), one(1.0f);
        Sighting s = nothingSeen(depth, m & within(i, I(rows->width - 2)));
        if (!any(s.looked)) return s;
        const SharedColumns columns(i, s.looked);
        const float* from = at.first + n * kSharedSlab;
        const FPair opacity = columns.read(from + 3 * kLanes);
        F share = x - toFloat(i);
        const M first = opacity.first >= zero, second = opacity.second >= zero;
        const M either = s.looked & (first | second), both = first & second;
        if (any(andNot(s.looked, both))) {
            // One of the neighbouring rays has ended: the other one is used alone where the remaining light
            // is faint.
            const M alone = andNot(either, both) & (left < F(kFaint));
            const M neither = andNot(s.looked, first | second) & (left < F(kFaintest));
            share = select(alone, select(first, zero, one), share);
            s.looked = (s.looked & both) | alone | neither;
        }
        const F rest = one - share;
        const auto mixed = [&](const FPair& p) { return mulAdd(p.first, rest, p.second * share); };
        const F most = mixed(opacity);
        s.seen = s.looked & (most > zero);
        if (!any(s.seen)) return s;
        // Lengths of both rays in the slab differ by the factor 1 + more: opacities become 1 - (1 - a)^(1 +
        // more).
        const F more = mulAdd(parallax * F(-rows->lengthening[n]), bend, F(rows->lengthening[n] - 1));
        const F bent = mulAdd(mulAdd(most, F(0.4f), F(0.5f)), most, one);
        const F factor = mulAdd(more * (one - most), bent, one);
        s.opacity = min(most * factor, one);
        s.passes = one - s.opacity;
        for (int k = 0; k < 3; ++k) s.sent.c[k] = mixed(columns.read(from + k * kLanes)) * factor;
        return s;
    }
};

}  // namespace stereonav::STEREONAV_ISA
