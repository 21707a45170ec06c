// Values and central differences for a packet whose rays lie close together: the words around their cells are
// loaded once, row by row, subtracted there, and looked up in registers. Where pixels are smaller than a
// voxel, the lanes' sixteen gathers would load the same words many times. AVX-512 only: its permutes reach 64
// words. Included by kernels only.
#pragma once

#include "engine/medium/sweep/sweep_kernel_types.h"
#include "engine/volume/kernel_light.h"

namespace stereonav::STEREONAV_ISA {

#if defined(STEREONAV_ISA_avx512)

// Loads four rows of eight voxels, the first at p.
STEREONAV_INLINE __m512i rowsAt(const std::int16_t* p, std::int64_t stride, int count) {
    const auto row = [&](int n) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + n * stride)); };
    __m512i rows = _mm512_zextsi128_si512(row(0));
    if (count > 1) rows = _mm512_inserti32x4(rows, row(1), 1);
    if (count > 2) rows = _mm512_inserti32x4(rows, row(2), 2);
    if (count > 3) rows = _mm512_inserti32x4(rows, row(3), 3);
    return rows;
}

// Trilinear interpolation in three planes of four rows of eight words. words: those of the rows below and
// above a place in the first two planes, two neighbours each.
struct BlockPlace {
    I words[2], weights;
    F fy, fz;
};
STEREONAV_INLINE F inBlock(const __m512i (&planes)[3], const BlockPlace& at) {
    const auto pair = [&](int plane, int row) {
        const I both = _mm512_permutex2var_epi16(planes[plane], at.words[row].v, planes[plane + 1]);
        return toFloat(dotHalves(both, at.weights));
    };
    return lerp(lerp(pair(0, 0), pair(0, 1), at.fy), lerp(pair(1, 0), pair(1, 1), at.fy), at.fz);
}

// Returns the least value among lanes m, at most `most`.
STEREONAV_INLINE int leastOf(I a, M m, int most) {
    const int least = _mm512_mask_reduce_min_epi32(m.v, a.v);
    return least < most ? least : most;
}

// Does the same as innerDifferences() for lanes m whose cells lie within two along each axis. Returns false,
// having done nothing, where they do not. The grid's values must differ by less than 2^15.
STEREONAV_INLINE bool blockDifferences(const SweepGrid& grid, const V3& v, I x, I y, I z, M m, V3& d) {
    if (!grid.blocks) return false;
    const I one(1);
    const int x0 = leastOf(x, m, grid.lastCell[0] - 5), y0 = leastOf(y, m, grid.lastCell[1] - 2),
              z0 = leastOf(z, m, grid.lastCell[2] - 2);
    const I oy = y - I(y0), oz = z - I(z0), ox = x - I(x0);
    if (any(m & ~(within(ox, I(4)) & within(oy, one) & within(oz, one)))) return false;
    const std::int64_t down = grid.strideY, next = grid.strideZ;
    const std::int16_t* first = grid.values + z0 * next + y0 * down + x0 - 1;
    __m512i before[3], after[3], here[5];  // rows before and after, of planes 0 to 2; planes -1 to 3
    here[0] = rowsAt(first - next, down, 3);
    here[4] = rowsAt(first + 3 * next, down, 3);
    for (int plane = 0; plane < 3; ++plane) {
        before[plane] = rowsAt(first + plane * next - down, down, 4);
        const __m512i last = rowsAt(first + plane * next + 3 * down, down, 1);
        here[plane + 1] = _mm512_alignr_epi64(last, before[plane], 2);
        after[plane] = _mm512_alignr_epi64(last, before[plane], 4);
    }
    __m512i across[3], along[3], through[3];
    for (int plane = 0; plane < 3; ++plane) {
        across[plane] = _mm512_sub_epi16(_mm512_bsrli_epi128(here[plane + 1], 4), here[plane + 1]);
        along[plane] = _mm512_sub_epi16(after[plane], before[plane]);
        through[plane] = _mm512_sub_epi16(here[plane + 2], here[plane]);
    }
    const I high = truncateToInt(mulAdd(v.x - toFloat(x), F(16384.0f), F(0.5f)));
    BlockPlace at;
    at.weights = shiftLeft<16>(high) + (I(16384) - high);
    at.fy = v.y - toFloat(y);
    at.fz = v.z - toFloat(z);
    const I word = shiftLeft<5>(oz) + shiftLeft<3>(oy) + ox;
    at.words[0] = shiftLeft<16>(word + I(1)) | word;
    at.words[1] = at.words[0] + I(0x00080008);
    const F unit(1.0f / 16384);
    d.x = inBlock(across, at) * unit;
    for (I& words : at.words) words = words + I(0x00010001);  // rows start a voxel before the cell
    d.y = inBlock(along, at) * unit;
    d.z = inBlock(through, at) * unit;
    return true;
}

// Finds trilinear values for lanes m whose cells lie within seven, three and two along x, y and z. Returns
// false, having done nothing, where they do not.
STEREONAV_INLINE bool blockValue(const SweepGrid& grid, const V3& v, I x, I y, I z, M m, F& value) {
    if (!grid.large) return false;
    const int x0 = leastOf(x, m, grid.lastCell[0] - 6), y0 = leastOf(y, m, grid.lastCell[1] - 2),
              z0 = leastOf(z, m, grid.lastCell[2] - 1);
    const I ox = x - I(x0), oy = y - I(y0), oz = z - I(z0);
    if (any(m & ~(within(ox, I(6)) & within(oy, I(2)) & within(oz, I(1))))) return false;
    const std::int16_t* first =
        grid.values + z0 * std::int64_t{grid.strideZ} + y0 * std::int64_t{grid.strideY} + x0;
    __m512i planes[3];
    for (int plane = 0; plane < 3; ++plane)
        planes[plane] = rowsAt(first + plane * std::int64_t{grid.strideZ}, grid.strideY, 4);
    const I high = truncateToInt(mulAdd(v.x - toFloat(x), F(16384.0f), F(0.5f)));
    BlockPlace at;
    at.weights = shiftLeft<16>(high) + (I(16384) - high);
    at.fy = v.y - toFloat(y);
    at.fz = v.z - toFloat(z);
    const I word = shiftLeft<5>(oz) + shiftLeft<3>(oy) + ox;
    at.words[0] = shiftLeft<16>(word + I(1)) | word;
    at.words[1] = at.words[0] + I(0x00080008);
    value = inBlock(planes, at) * F(1.0f / 16384);
    return true;
}

// Four rows of four words, looked up in a register.
struct WordBlock {
    I words;
    STEREONAV_INLINE I at(I index) const { return _mm512_permutexvar_epi32(index.v, words.v); }
};
STEREONAV_INLINE WordBlock wordsAt(const std::uint32_t* p, std::int64_t stride) {
    const auto row = [&](int n) { return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + n * stride)); };
    __m512i rows = _mm512_zextsi128_si512(row(0));
    rows = _mm512_inserti32x4(rows, row(1), 1);
    rows = _mm512_inserti32x4(rows, row(2), 2);
    return {_mm512_inserti32x4(rows, row(3), 3)};
}
// Finds texels (i, j) of the light that eyes read, with their neighbours to the right and below, for lanes m;
// returns false unless all lie within four by four. index: in the block.
STEREONAV_INLINE bool lightBlock(const SweepLight& light, I i, I j, M m, std::int64_t& word, I& index) {
    const int i0 = leastOf(i, m, light.width - 1), j0 = leastOf(j, m, light.height - 2);
    const I oi = i - I(i0), oj = j - I(j0), most(2);
    if (any(m & ~(within(oi, most) & within(oj, most)))) return false;
    word = (j0 + 1) * static_cast<std::int64_t>(light.packedStride) + i0 + 1;
    index = shiftLeft<2>(oj) + oi;
    return true;
}

#else

struct WordBlock {
    STEREONAV_INLINE I at(I index) const { return index; }
};
STEREONAV_INLINE WordBlock wordsAt(const std::uint32_t*, std::int64_t) {
    return {};
}
STEREONAV_INLINE bool lightBlock(const SweepLight&, I, I, M, std::int64_t&, I&) {
    return false;
}
STEREONAV_INLINE bool blockDifferences(const SweepGrid&, const V3&, I, I, I, M, V3&) {
    return false;
}
STEREONAV_INLINE bool blockValue(const SweepGrid&, const V3&, I, I, I, M, F&) {
    return false;
}

#endif

}  // namespace stereonav::STEREONAV_ISA
