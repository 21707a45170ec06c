// Included by resample_kernel.cpp only: the inverse warp sixteen pixels at a time. Left pixels: from the
// right, columns, suffix minimum, survivors, links; from the left, each survivor is scattered to the
// first right pixel it can begin. Right pixels: a running maximum spreads the sources; sixteen of them
// nearly always come from 32 left pixels, so two registers and permutations stand for the gathers.
#pragma once

#include <immintrin.h>

#include "engine/stereo/warp_row.h"

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr int kLanes = 16;

struct Lanes {
    __m512i index;  // 0 .. 15
    __m512 centre;  // 0.5 .. 15.5
};

inline Lanes makeLanes() {
    const __m512i index = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    return {index, _mm512_add_ps(_mm512_cvtepi32_ps(index), _mm512_set1_ps(0.5f))};
}

inline __mmask16 lanesBefore(int count) {
    return static_cast<__mmask16>(count >= kLanes ? 0xffff : (1u << (count > 0 ? count : 0)) - 1u);
}

template <int count>
inline __m512 shiftedDown(__m512 low, __m512 high) {
    return _mm512_castsi512_ps(
        _mm512_alignr_epi32(_mm512_castps_si512(high), _mm512_castps_si512(low), count));
}

// Minimum of each lane and all lanes above it.
inline __m512 suffixMinimum(__m512 v, __m512 infinity) {
    v = _mm512_min_ps(v, shiftedDown<1>(v, infinity));
    v = _mm512_min_ps(v, shiftedDown<2>(v, infinity));
    v = _mm512_min_ps(v, shiftedDown<4>(v, infinity));
    return _mm512_min_ps(v, shiftedDown<8>(v, infinity));
}

// Maximum of each lane and all lanes below it; nothing is below -1.
inline __m512i prefixMaximum(__m512i v) {
    const __m512i none = _mm512_set1_epi32(-1);
    v = _mm512_max_epi32(v, _mm512_alignr_epi32(v, none, 15));
    v = _mm512_max_epi32(v, _mm512_alignr_epi32(v, none, 14));
    v = _mm512_max_epi32(v, _mm512_alignr_epi32(v, none, 12));
    return _mm512_max_epi32(v, _mm512_alignr_epi32(v, none, 8));
}

// Columns, survivors and links (each survivor's link to the next left pixel), right to left.
inline void findLinks(const ResampleRow& row) {
    const Lanes lanes = makeLanes();
    const __m512 infinity = _mm512_set1_ps(__builtin_inff());
    const __m512 scale = _mm512_set1_ps(row.scale), shift = _mm512_set1_ps(row.shift);
    const __m512 minStretch = _mm512_set1_ps(row.minStretch), maxStretch = _mm512_set1_ps(row.maxStretch);
    const int blocks = (row.width + kLanes - 1) / kLanes;
    __m512 next = infinity;      // the block to the right
    __m512 leftmost = infinity;  // of all blocks to the right, in every lane
    unsigned nextSurvivors = 0, nextMet = 0, nextWide = 0;
    _mm512_storeu_ps(row.column + blocks * kLanes, infinity);
    row.survivors[blocks] = row.links[blocks] = 0;
    for (int b = blocks - 1; b >= 0; --b) {
        const int i = b * kLanes;
        const __mmask16 inside = lanesBefore(row.width - i);
        const __m512 depth = _mm512_mask_loadu_ps(infinity, inside, row.leftDepth + i);
        const __m512 centre = _mm512_add_ps(_mm512_set1_ps(static_cast<float>(i)), lanes.centre);
        const __m512 column =
            _mm512_mask_add_ps(infinity, inside, centre, _mm512_sub_ps(shift, _mm512_div_ps(scale, depth)));
        const __m512 minimum = _mm512_min_ps(suffixMinimum(column, infinity), leftmost);
        const __m512 right = shiftedDown<1>(minimum, leftmost);
        const unsigned survivors = _mm512_cmp_ps_mask(column, right, _CMP_LT_OQ);
        const __m512 gap = _mm512_sub_ps(shiftedDown<1>(column, next), column);
        const __mmask16 even =
            _mm512_cmp_ps_mask(gap, minStretch, _CMP_GE_OQ) & _mm512_cmp_ps_mask(gap, maxStretch, _CMP_LE_OQ);
        unsigned both = survivors & (survivors >> 1 | nextSurvivors << 15);
        if (row.surface) {
            const unsigned met = _mm512_cmp_ps_mask(depth, infinity, _CMP_LT_OQ);
            both &= ~(met ^ (met >> 1 | nextMet << 15));
            nextMet = met;
        }
        if (row.leftSpread) {
            const __m512 spread = _mm512_maskz_loadu_ps(inside, row.leftSpread + i);
            const __m512 most = _mm512_mul_ps(_mm512_mul_ps(_mm512_set1_ps(row.mostSpread), depth), depth);
            const unsigned wide = _mm512_cmp_ps_mask(_mm512_mul_ps(scale, spread), most, _CMP_GT_OQ);
            both &= ~(wide | wide >> 1 | nextWide << 15);
            nextWide = wide;
        }
        row.survivors[b] = static_cast<std::uint16_t>(survivors);
        row.links[b] = static_cast<std::uint16_t>(both & even);
        _mm512_storeu_ps(row.column + i, column);
        leftmost = _mm512_broadcastss_ps(_mm512_castps512_ps128(minimum));
        next = column;
        nextSurvivors = survivors;
    }
}

// Inverse gaps of usable links; survivors to the first right pixel that they can begin, left to right:
// of lanes with one target the highest wins, as the later store does.
inline void scatterSurvivors(const ResampleRow& row) {
    const __m512i none = _mm512_set1_epi32(-1);
    for (int p = 0; p < row.width; p += kLanes) _mm512_storeu_si512(row.source + p, none);
    const Lanes lanes = makeLanes();
    const __m512 half = _mm512_set1_ps(0.5f), one = _mm512_set1_ps(1.0f);
    const __m512 width = _mm512_set1_ps(static_cast<float>(row.width));
    unsigned before = 0;  // links of the block to the left
    for (int i = 0, b = 0; i < row.width; i += kLanes, ++b) {
        const __m512 column = _mm512_loadu_ps(row.column + i);
        const unsigned link = row.links[b];
        unsigned usable = link;
        if (row.reach > 0) usable &= link >> 1 | static_cast<unsigned>(row.links[b + 1]) << 15;
        if (row.reach > 1) usable &= link << 1 | before >> 15;
        before = link;
        const __m512 gap = _mm512_sub_ps(_mm512_loadu_ps(row.column + i + 1), column);
        _mm512_storeu_ps(row.inverse + i, _mm512_maskz_div_ps(static_cast<__mmask16>(usable), one, gap));
        const __m512 first = _mm512_roundscale_ps(_mm512_sub_ps(column, half), _MM_FROUND_TO_POS_INF);
        const __mmask16 target = _mm512_mask_cmp_ps_mask(row.survivors[b], first, width, _CMP_LT_OQ);
        const __m512i begin = _mm512_cvttps_epi32(_mm512_max_ps(first, _mm512_setzero_ps()));
        _mm512_mask_i32scatter_epi32(row.source, target, begin,
                                     _mm512_add_epi32(_mm512_set1_epi32(i), lanes.index), 4);
    }
}

// Reads table[index + offset] for sixteen indices: from two registers when they lie close together.
struct Window {
    bool near;
    int base;
    __m512i index;     // near: index - base, else the index itself
    __mmask16 wanted;  // far: lanes to read

    __m512i read(const void* table, int offset) const {
        const __m512i at = _mm512_add_epi32(index, _mm512_set1_epi32(offset));
        if (!near) return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), wanted, at, table, 4);
        const int* first = static_cast<const int*>(table) + base;
        return _mm512_permutex2var_epi32(_mm512_loadu_si512(first), at, _mm512_loadu_si512(first + kLanes));
    }
    __m512 readFloats(const float* table, int offset) const {
        return _mm512_castsi512_ps(read(table, offset));
    }
};

// Sources of sixteen right pixels, not decreasing. stride: the left row may be read up to it.
inline Window makeWindow(__m512i source, __mmask16 some, int stride) {
    const int first = _mm_cvtsi128_si32(_mm512_castsi512_si128(source));
    const int last = _mm_cvtsi128_si32(
        _mm512_extracti32x4_epi32(_mm512_permutexvar_epi32(_mm512_set1_epi32(15), source), 0));
    int base = first > 1 ? first - 1 : 0;
    base = base < stride - 2 * kLanes ? base : stride - 2 * kLanes;
    const bool near = last + 2 - base < 2 * kLanes;
    return {near, base, near ? _mm512_sub_epi32(source, _mm512_set1_epi32(base)) : source, some};
}

// Red and blue in the low and high words, green in the low one; channels times 16.
struct Channels {
    __m512i redBlue, green;
};

inline Channels unpack(__m512i color) {
    const __m512i red = _mm512_and_si512(_mm512_slli_epi32(color, 4), _mm512_set1_epi32(0x3ff0));
    const __m512i blue = _mm512_and_si512(color, _mm512_set1_epi32(0x3ff00000));
    const __m512i green = _mm512_and_si512(_mm512_srli_epi32(color, 6), _mm512_set1_epi32(0x3ff0));
    return {_mm512_or_si512(red, blue), green};
}

inline __m512i packChannels(const Channels& c) {
    const __m512i low = _mm512_setzero_si512(), high = _mm512_set1_epi16(1023 * 16);
    const __m512i half = _mm512_set1_epi16(8);
    const auto limited = [&](__m512i v) {
        return _mm512_add_epi16(_mm512_min_epi16(_mm512_max_epi16(v, low), high), half);
    };
    const __m512i redBlue = limited(c.redBlue), green = limited(c.green);
    const __m512i red = _mm512_and_si512(_mm512_srli_epi32(redBlue, 4), _mm512_set1_epi32(0x3ff));
    const __m512i blue = _mm512_and_si512(redBlue, _mm512_set1_epi32(0x3ff00000));
    const __m512i middle = _mm512_and_si512(_mm512_slli_epi32(green, 6), _mm512_set1_epi32(0x3ff << 10));
    return _mm512_or_si512(_mm512_or_si512(red, blue), middle);
}

// A weight with 15 fraction bits in both words of a lane.
inline __m512i weightWords(__m512 weight) {
    const __m512 scaled = _mm512_mul_ps(weight, _mm512_set1_ps(32768.0f));
    const __m512i w = _mm512_cvtps_epi32(_mm512_min_ps(scaled, _mm512_set1_ps(32767.0f)));
    return _mm512_mask_blend_epi16(0xaaaaaaaa, w, _mm512_slli_epi32(w, 16));
}

inline __m512i addPart(__m512i sum, __m512i first, __m512i other, __m512i weight) {
    return _mm512_add_epi16(sum, _mm512_mulhrs_epi16(_mm512_sub_epi16(other, first), weight));
}

inline __m512i lerpColors(const ResampleRow& row, const Window& window, __m512 t) {
    const Channels a = unpack(window.read(row.leftColor, 0));
    const Channels b = unpack(window.read(row.leftColor, 1));
    const __m512i w = weightWords(t);
    return packChannels({addPart(a.redBlue, a.redBlue, b.redBlue, w), addPart(a.green, a.green, b.green, w)});
}

inline __m512i cubicColors(const ResampleRow& row, const Window& window, __m512 t) {
    const __m512 half = _mm512_set1_ps(0.5f);
    const __m512 t2 = _mm512_mul_ps(t, t), t3 = _mm512_mul_ps(t2, t);
    const __m512 halfT = _mm512_mul_ps(half, t), halfT3 = _mm512_mul_ps(half, t3);
    const __m512i before = weightWords(_mm512_sub_ps(_mm512_sub_ps(t2, halfT3), halfT));
    const __m512 two = _mm512_sub_ps(_mm512_add_ps(t2, t2), _mm512_mul_ps(_mm512_set1_ps(1.5f), t3));
    const __m512i second = weightWords(_mm512_add_ps(two, halfT));
    const __m512i after = weightWords(_mm512_sub_ps(halfT3, _mm512_mul_ps(half, t2)));
    const Channels c0 = unpack(window.read(row.leftColor, -1));
    const Channels c1 = unpack(window.read(row.leftColor, 0));
    const Channels c2 = unpack(window.read(row.leftColor, 1));
    const Channels c3 = unpack(window.read(row.leftColor, 2));
    Channels sum = c1;
    sum.redBlue = addPart(sum.redBlue, c1.redBlue, c0.redBlue, before);
    sum.redBlue = addPart(sum.redBlue, c1.redBlue, c2.redBlue, second);
    sum.redBlue = addPart(sum.redBlue, c1.redBlue, c3.redBlue, after);
    sum.green = addPart(sum.green, c1.green, c0.green, before);
    sum.green = addPart(sum.green, c1.green, c2.green, second);
    sum.green = addPart(sum.green, c1.green, c3.green, after);
    return packChannels(sum);
}

// At t between the linked pixels, or the nearer of them.
template <bool kSurface>
inline __m512 depthOf(const ResampleRow& row, const Window& window, __m512 t) {
    const __m512 a = window.readFloats(row.leftDepth, 0), b = window.readFloats(row.leftDepth, 1);
    if (!kSurface) return _mm512_min_ps(b, a);
    const __mmask16 met = _mm512_cmp_ps_mask(a, _mm512_set1_ps(__builtin_inff()), _CMP_LT_OQ);
    return _mm512_mask_add_ps(a, met, a, _mm512_mul_ps(t, _mm512_sub_ps(b, a)));
}

// Sixteen right pixels from p on. source: of the block, spread.
template <bool kCubic, bool kSurface>
inline void resampleBlock(const ResampleRow& row, int p, __m512i source, __m512 centres) {
    const __mmask16 some = _mm512_cmpge_epi32_mask(source, _mm512_setzero_si512());
    const Window window = makeWindow(source, some, row.stride);
    const __m512 inverse = window.readFloats(row.inverse, 0);
    const __mmask16 warped = _mm512_mask_cmp_ps_mask(some, inverse, _mm512_setzero_ps(), _CMP_NEQ_OQ);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(row.holes + p),
                     _mm_movm_epi8(static_cast<__mmask16>(~warped)));
    if (warped == 0) {
        _mm512_storeu_si512(row.color + p, _mm512_setzero_si512());
        _mm512_storeu_ps(row.depth + p, _mm512_setzero_ps());
        return;
    }
    Window taps = window;
    taps.wanted = warped;
    const __m512 column = window.readFloats(row.column, 0);
    const __m512 t = _mm512_mul_ps(_mm512_sub_ps(centres, column), inverse);
    const __m512i color = kCubic ? cubicColors(row, taps, t) : lerpColors(row, taps, t);
    _mm512_storeu_si512(row.color + p, _mm512_maskz_mov_epi32(warped, color));
    _mm512_storeu_ps(row.depth + p, _mm512_maskz_mov_ps(warped, depthOf<kSurface>(row, taps, t)));
}

template <bool kCubic, bool kSurface>
inline void resampleBlocks(const ResampleRow& row) {
    const Lanes lanes = makeLanes();
    __m512i carried = _mm512_set1_epi32(-1);
    for (int p = 0; p < row.width; p += kLanes) {
        const __m512i source = _mm512_max_epi32(prefixMaximum(_mm512_loadu_si512(row.source + p)), carried);
        _mm512_storeu_si512(row.source + p, source);
        carried = _mm512_permutexvar_epi32(_mm512_set1_epi32(15), source);
        resampleBlock<kCubic, kSurface>(row, p, source,
                                        _mm512_add_ps(_mm512_set1_ps(static_cast<float>(p)), lanes.centre));
    }
}

inline void resample(const ResampleRow& row) {
    findLinks(row);
    scatterSurvivors(row);
    if (row.surface)
        row.cubic ? resampleBlocks<true, true>(row) : resampleBlocks<false, true>(row);
    else
        row.cubic ? resampleBlocks<true, false>(row) : resampleBlocks<false, false>(row);
}

}  // namespace
}  // namespace stereonav::STEREONAV_ISA
