// What one eye saw in a slab, kept by rows of its pixels, and read by the other eye, which sees the same
// shifted along the rows (sweep_sharing.h). Included by kernels only.
#pragma once

#include "engine/medium/kernel_medium.h"

namespace stereonav::STEREONAV_ISA {

// What a slab shows to lanes: light that it sends of itself, and how opaque it is along the ray.
struct Sighting {
    Colors sent;
    F opacity, passes;  // 1 - opacity
    F depth;
    M looked, seen;  // seen: something is there
};
STEREONAV_INLINE Sighting nothingSeen(F depth, M looked) {
    const F zero(0.0f);
    return {{{zero, zero, zero}}, zero, F(1.0f), depth, looked, maskFromBits(0)};
}

// Numbers of a packet, four pixels a row, to rows `next` apart.
STEREONAV_INLINE void storeRows(float* to, std::int64_t next, F numbers) {
#if defined(STEREONAV_ISA_avx512)
    _mm_storeu_ps(to, _mm512_castps512_ps128(numbers.v));
    _mm_storeu_ps(to + next, _mm512_extractf32x4_ps(numbers.v, 1));
    _mm_storeu_ps(to + 2 * next, _mm512_extractf32x4_ps(numbers.v, 2));
    _mm_storeu_ps(to + 3 * next, _mm512_extractf32x4_ps(numbers.v, 3));
#else
    float all[kLanes];
    store(all, numbers);
    for (int row = 0; row < kLanes / 4; ++row)
        __builtin_memcpy(to + row * next, all + 4 * row, 4 * sizeof(float));
#endif
}

// Where a packet's numbers are kept: row: of the rows that are kept.
struct SharedPlace {
    float* first;        // of slab 0: light's first colour
    std::int64_t plane;  // from colour to colour, and on to the opacity
    std::int64_t next, slab;
};
STEREONAV_INLINE SharedPlace sharedPlace(const SharedRows& rows, int x, int row) {
    SharedPlace p;
    p.plane = rows.pitch;
    p.next = SharedRows::kNumbers * rows.pitch;
    p.slab = SharedRows::kRows * p.next;
    p.first = rows.numbers + row * p.next + x;
    return p;
}
constexpr float kNotLooked = -1.0f;  // as an opacity

STEREONAV_INLINE void keepSighting(const SharedPlace& at, int n, const Sighting& s) {
    float* to = at.first + n * at.slab;
    const F zero(0.0f);
    for (int k = 0; k < 3; ++k) storeRows(to + k * at.plane, at.next, select(s.seen, s.sent.c[k], zero));
    storeRows(to + 3 * at.plane, at.next, select(s.looked, select(s.seen, s.opacity, zero), F(kNotLooked)));
}
// Slabs of which is known that nothing is there.
STEREONAV_INLINE void keepNothing(const SharedPlace& at, std::uint32_t slabs) {
    for (; slabs; slabs &= slabs - 1) {
        float* to = at.first + __builtin_ctz(slabs) * at.slab;
        for (int k = 0; k < SharedRows::kNumbers; ++k) storeRows(to + k * at.plane, at.next, F(0.0f));
    }
}
STEREONAV_INLINE void keepNotLooked(const SharedPlace& at, std::uint32_t slabs) {
    for (; slabs; slabs &= slabs - 1)
        storeRows(at.first + __builtin_ctz(slabs) * at.slab + 3 * at.plane, at.next, F(kNotLooked));
}

// Columns index and index + 1 of a packet's rows, of lanes m. In AVX-512 rows are loaded once and looked up,
// where a packet's columns lie close together, as they do but where the slabs are seen along.
struct SharedColumns {
    I index;
    M m;
#if defined(STEREONAV_ISA_avx512)
    bool near;
    int least;
    I word;  // in two registers of two rows
    STEREONAV_INLINE SharedColumns(I i, M lanes, std::int64_t next) : m(lanes) {
        least = leastOf(i, lanes, 0x7fffffff);
        const I from = i - I(least), row = shiftRight<2>(laneIndex());
        near = !any(lanes & ~within(from, I(6)));
        word = shiftLeft<3>(row) + from;
        index = row * I(static_cast<int>(next)) + i;
    }
    STEREONAV_INLINE FPair read(const float* plane, std::int64_t next) const {
        if (!near) return gatherPair(plane, index, m);
        const float* p = plane + least;
        const auto two = [&](const float* row) {
            return _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(row)),
                                      _mm256_loadu_ps(row + next), 1);
        };
        const __m512 above = two(p), below = two(p + 2 * next);
        return {_mm512_permutex2var_ps(above, word.v, below),
                _mm512_permutex2var_ps(above, (word + I(1)).v, below)};
    }
#else
    STEREONAV_INLINE SharedColumns(I i, M lanes, std::int64_t next) : m(lanes) {
        index = shiftRight<2>(laneIndex()) * I(static_cast<int>(next)) + i;
    }
    STEREONAV_INLINE FPair read(const float* plane, std::int64_t) const {
        return gatherPair(plane, index, m);
    }
#endif
};

// What is left of a ray's light where one of the two pixels it lies between is enough, and where none is
// needed any more. With 1/4 and 1/256 (own samples where the rest is brighter).
constexpr float kFaint = 1.0f / 4, kFaintest = 1.0f / 256;

// How the other eye's packet reads.
struct SharedReader {
    const SharedRows* rows = nullptr;
    SharedPlace at{};  // of column 0
    F column = 0.0f;   // of a place infinitely far away
    F cosine = 0.0f;   // axis . ray, of depth 1
    F bend = 0.0f;     // how the ray's length changes with the parallax

    SharedReader() = default;
    STEREONAV_INLINE SharedReader(const SharedRows& r, const SweepEye& eye, F x, F y, int row)
        : rows(&r), at(sharedPlace(r, 0, row)), column(x + F(r.column)) {
        const F wx = mulAdd(x, F(static_cast<float>(eye.perX)), F(static_cast<float>(eye.xMin))),
                wy = F(static_cast<float>(eye.yMax)) - y * F(static_cast<float>(eye.perY));
        cosine = mulAdd(wx, F(static_cast<float>(eye.axis[0])),
                        mulAdd(wy, F(static_cast<float>(eye.axis[1])), F(static_cast<float>(eye.axis[2]))));
        bend = wx / mulAdd(wx, wx, mulAdd(wy, wy, F(1.0f)));
    }

    // Of slab n at that depth of lanes m, of whose light `left` is left; looked: lanes that the first eye has
    // looked at.
    STEREONAV_INLINE Sighting read(int n, F depth, F left, M m) const {
        const F parallax = cosine * F(rows->parallax[n]);
        const F x = mulAdd(parallax, F(rows->perParallax), column);
        const I i = floorToInt(x);
        const F zero(0.0f), one(1.0f);
        Sighting s = nothingSeen(depth, m & within(i, I(rows->width - 2)));
        if (!any(s.looked)) return s;
        const SharedColumns columns(i, s.looked, at.next);
        const float* from = at.first + n * at.slab;
        const FPair opacity = columns.read(from + 3 * at.plane, at.next);
        F share = x - toFloat(i);
        const M first = opacity.first >= zero, second = opacity.second >= zero;
        const M either = s.looked & (first | second), both = first & second;
        if (any(andNot(s.looked, both))) {
            // One of the rays has ended: the other alone counts where the rest is faint.
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
        // Ways through the slab differ by the factor 1 + more: opacities as 1 - (1 - a)^(1 + more).
        const F more = mulAdd(parallax * F(-rows->lengthening[n]), bend, F(rows->lengthening[n] - 1));
        const F bent = mulAdd(mulAdd(most, F(0.4f), F(0.5f)), most, one);
        const F factor = mulAdd(more * (one - most), bent, one);
        s.opacity = min(most * factor, one);
        s.passes = one - s.opacity;
        for (int k = 0; k < 3; ++k) s.sent.c[k] = mixed(columns.read(from + k * at.plane, at.next)) * factor;
        return s;
    }
};

}  // namespace stereonav::STEREONAV_ISA
