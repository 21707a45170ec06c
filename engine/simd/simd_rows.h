// Operations for kernels over rows of pixels, beside simd.h: across the lanes of neighbouring vectors, and on
// the two sixteen-bit halves of each lane. The plain form is the meaning of the others.
#pragma once

#include "engine/simd/simd.h"

namespace stereonav::STEREONAV_ISA {

// lanesFrom<n>(low, high): of low's lanes and then high's, those from the n-th on; 0 < n < kLanes.
// everyLane<n>(a): lane n in all lanes. firstLane, lastLane: as a number.
// roundToInt(a): the nearest integer, ties to even, for |a| < 2^22.
// ceilToInt(a): the smallest integer >= a, for |a| < 2^31.
// storeBytes(p, m): 255 for lanes of m, 0 for the others, to kLanes bytes.
// scatterNumbers(base, index, first, m, spare): first + k to base[index] for each lane k of m, whose indices
//   differ; base[spare] may be overwritten.
// addHalves, subtractHalves: of the sixteen-bit halves of each lane; they wrap.
// scaledHalves: (a * b + 2^14) >> 15 of halves, for |a|, |b| < 2^15. clampHalves: signed.
// loadEach(base, index): base[index] of every lane; loadEachPair: base[index] and base[index + 1].
// permuted(low, high, index), where the processor has it: lane index % (2 kLanes) of low's and then high's.

#if defined(STEREONAV_ISA_avx512)

template <int n>
STEREONAV_INLINE I lanesFrom(I low, I high) {
    return _mm512_alignr_epi32(high.v, low.v, n);
}
template <int n>
STEREONAV_INLINE M lanesFrom(M low, M high) {
    return {static_cast<__mmask16>(unsigned{low.v} >> n | unsigned{high.v} << (kLanes - n))};
}
template <int n>
STEREONAV_INLINE I everyLane(I a) {
    if constexpr (n == 0)
        return _mm512_broadcastd_epi32(_mm512_castsi512_si128(a.v));
    else
        return _mm512_permutexvar_epi32(_mm512_set1_epi32(n), a.v);
}
STEREONAV_INLINE int firstLane(I a) {
    return _mm_cvtsi128_si32(_mm512_castsi512_si128(a.v));
}
STEREONAV_INLINE I roundToInt(F a) {
    return _mm512_cvtps_epi32(a.v);
}
STEREONAV_INLINE I ceilToInt(F a) {
    return _mm512_cvt_roundps_epi32(a.v, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC);
}
STEREONAV_INLINE void storeBytes(std::uint8_t* p, M m) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(p), _mm_movm_epi8(m.v));
}
STEREONAV_INLINE I addHalves(I a, I b) {
    return _mm512_add_epi16(a.v, b.v);
}
STEREONAV_INLINE I subtractHalves(I a, I b) {
    return _mm512_sub_epi16(a.v, b.v);
}
STEREONAV_INLINE I scaledHalves(I a, I b) {
    return _mm512_mulhrs_epi16(a.v, b.v);
}
STEREONAV_INLINE I clampHalves(I a, I low, I high) {
    return _mm512_min_epi16(_mm512_max_epi16(a.v, low.v), high.v);
}
STEREONAV_INLINE I loadEach(const void* base, I index) {
    return _mm512_i32gather_epi32(index.v, base, 4);
}
STEREONAV_INLINE IPair loadEachPair(const void* base, I index) {
    return {loadEach(base, index), loadEach(static_cast<const std::int32_t*>(base) + 1, index)};
}
STEREONAV_INLINE void scatterNumbers(std::int32_t* base, I index, int first, M m, int) {
    scatter(base, index, laneIndex() + I(first), m);
}
#define STEREONAV_PERMUTES 1
STEREONAV_INLINE I permuted(I low, I high, I index) {
    return _mm512_permutex2var_epi32(low.v, index.v, high.v);
}

#elif defined(STEREONAV_ISA_avx2)

template <int n>
STEREONAV_INLINE I lanesFrom(I low, I high) {
    const __m256i middle = _mm256_permute2x128_si256(low.v, high.v, 0x21);
    if constexpr (n < 4)
        return _mm256_alignr_epi8(middle, low.v, 4 * n);
    else
        return _mm256_alignr_epi8(high.v, middle, 4 * (n - 4));
}
template <int n>
STEREONAV_INLINE M lanesFrom(M low, M high) {
    return {
        _mm256_castsi256_ps(lanesFrom<n>(I(_mm256_castps_si256(low.v)), I(_mm256_castps_si256(high.v))).v)};
}
template <int n>
STEREONAV_INLINE I everyLane(I a) {
    if constexpr (n == 0)
        return _mm256_broadcastd_epi32(_mm256_castsi256_si128(a.v));
    else
        return _mm256_permutevar8x32_epi32(a.v, _mm256_set1_epi32(n));
}
STEREONAV_INLINE int firstLane(I a) {
    return _mm_cvtsi128_si32(_mm256_castsi256_si128(a.v));
}
STEREONAV_INLINE I roundToInt(F a) {
    return _mm256_cvtps_epi32(a.v);
}
STEREONAV_INLINE I ceilToInt(F a) {
    return _mm256_cvtps_epi32(_mm256_ceil_ps(a.v));
}
STEREONAV_INLINE void storeBytes(std::uint8_t* p, M m) {
    const __m256i lanes = _mm256_castps_si256(m.v);
    const __m128i halves = _mm_packs_epi32(_mm256_castsi256_si128(lanes), _mm256_extracti128_si256(lanes, 1));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_packs_epi16(halves, halves));
}
STEREONAV_INLINE I addHalves(I a, I b) {
    return _mm256_add_epi16(a.v, b.v);
}
STEREONAV_INLINE I subtractHalves(I a, I b) {
    return _mm256_sub_epi16(a.v, b.v);
}
STEREONAV_INLINE I scaledHalves(I a, I b) {
    return _mm256_mulhrs_epi16(a.v, b.v);
}
STEREONAV_INLINE I clampHalves(I a, I low, I high) {
    return _mm256_min_epi16(_mm256_max_epi16(a.v, low.v), high.v);
}
STEREONAV_INLINE I loadEach(const void* base, I index) {
    return _mm256_i32gather_epi32(static_cast<const int*>(base), index.v, 4);
}
STEREONAV_INLINE IPair loadEachPair(const void* base, I index) {
    return {loadEach(base, index), loadEach(static_cast<const std::int32_t*>(base) + 1, index)};
}
STEREONAV_INLINE void scatterNumbers(std::int32_t* base, I index, int first, M m, int spare) {
    alignas(32) std::int32_t places[kLanes];
    store(places, select(m, index, I(spare)));
    // Through memory: to take each lane out of a register costs more.
    __asm__("" : "+m"(places));
#pragma GCC unroll 8
    for (int k = 0; k < kLanes; ++k) base[places[k]] = first + k;
}
#define STEREONAV_PERMUTES 1
STEREONAV_INLINE I permuted(I low, I high, I index) {
    const __m256 a = _mm256_castsi256_ps(_mm256_permutevar8x32_epi32(low.v, index.v));
    const __m256 b = _mm256_castsi256_ps(_mm256_permutevar8x32_epi32(high.v, index.v));
    return _mm256_castps_si256(_mm256_blendv_ps(a, b, _mm256_castsi256_ps(_mm256_slli_epi32(index.v, 28))));
}

#else

using HalfLanes = std::int16_t __attribute__((vector_size(16)));
using HalfWordLanes = std::uint16_t __attribute__((vector_size(16)));  // halves that wrap

template <int n>
STEREONAV_INLINE I lanesFrom(I low, I high) {
    return __builtin_shufflevector(low.v, high.v, n, n + 1, n + 2, n + 3);
}
template <int n>
STEREONAV_INLINE M lanesFrom(M low, M high) {
    return {lanesFrom<n>(I(low.v), I(high.v)).v};
}
template <int n>
STEREONAV_INLINE I everyLane(I a) {
    return __builtin_shufflevector(a.v, a.v, n, n, n, n);
}
STEREONAV_INLINE int firstLane(I a) {
    return a.v[0];
}
STEREONAV_INLINE I roundToInt(F a) {
#if defined(__SSE2__)
    return reinterpret_cast<IntLanes>(_mm_cvtps_epi32(a.v));
#else
    const F whole(0x1.8p23f);  // the sum's last bit is worth one
    return asInt(a + whole) - asInt(whole);
#endif
}
STEREONAV_INLINE I ceilToInt(F a) {
    const I t = truncateToInt(a);
    return t - I((toFloat(t) < a).v);  // a mask is -1
}
STEREONAV_INLINE void storeBytes(std::uint8_t* p, M m) {
#if defined(__SSE2__)
    const auto lanes = reinterpret_cast<__m128i>(m.v);
    const __m128i halves = _mm_packs_epi32(lanes, lanes), bytes = _mm_packs_epi16(halves, halves);
    std::memcpy(p, &bytes, kLanes);
#else
    for (int k = 0; k < kLanes; ++k) p[k] = static_cast<std::uint8_t>(m.v[k]);
#endif
}
STEREONAV_INLINE I addHalves(I a, I b) {
    return reinterpret_cast<IntLanes>(reinterpret_cast<HalfWordLanes>(a.v) +
                                      reinterpret_cast<HalfWordLanes>(b.v));
}
STEREONAV_INLINE I subtractHalves(I a, I b) {
    return reinterpret_cast<IntLanes>(reinterpret_cast<HalfWordLanes>(a.v) -
                                      reinterpret_cast<HalfWordLanes>(b.v));
}
STEREONAV_INLINE I scaledHalves(I a, I b) {
    return lerpHalves(I(0), a, b);
}
STEREONAV_INLINE I clampHalves(I a, I low, I high) {
#if defined(__SSE2__)
    return reinterpret_cast<IntLanes>(
        _mm_min_epi16(_mm_max_epi16(reinterpret_cast<__m128i>(a.v), reinterpret_cast<__m128i>(low.v)),
                      reinterpret_cast<__m128i>(high.v)));
#else
    const auto value = reinterpret_cast<HalfLanes>(a.v);
    const auto least = reinterpret_cast<HalfLanes>(low.v), most = reinterpret_cast<HalfLanes>(high.v);
    const HalfLanes raised = value < least ? least : value;
    return reinterpret_cast<IntLanes>(raised > most ? most : raised);
#endif
}

STEREONAV_INLINE I loadEach(const void* base, I index) {
    const auto* from = static_cast<const std::int32_t*>(base);
    return IntLanes{from[index.v[0]], from[index.v[1]], from[index.v[2]], from[index.v[3]]};
}
#if defined(__SSE2__)
STEREONAV_INLINE IPair loadEachPair(const void* base, I index) {
    const auto pair = [&](int k) {
        return _mm_loadl_epi64(
            reinterpret_cast<const __m128i*>(static_cast<const std::int32_t*>(base) + index.v[k]));
    };
    const __m128i low = _mm_unpacklo_epi32(pair(0), pair(1)), high = _mm_unpacklo_epi32(pair(2), pair(3));
    return {reinterpret_cast<IntLanes>(_mm_unpacklo_epi64(low, high)),
            reinterpret_cast<IntLanes>(_mm_unpackhi_epi64(low, high))};
}
#else
STEREONAV_INLINE IPair loadEachPair(const void* base, I index) {
    return {loadEach(base, index), loadEach(static_cast<const std::int32_t*>(base) + 1, index)};
}
#endif
STEREONAV_INLINE void scatterNumbers(std::int32_t* base, I index, int first, M m, int spare) {
    alignas(32) std::int32_t places[kLanes];
    store(places, select(m, index, I(spare)));
    // Through memory: to take each lane out of a register costs more.
    __asm__("" : "+m"(places));
#pragma GCC unroll 8
    for (int k = 0; k < kLanes; ++k) base[places[k]] = first + k;
}

#endif

template <int n>
STEREONAV_INLINE F lanesFrom(F low, F high) {
    return asFloat(lanesFrom<n>(asInt(low), asInt(high)));
}
template <int n>
STEREONAV_INLINE F everyLane(F a) {
    return asFloat(everyLane<n>(asInt(a)));
}
STEREONAV_INLINE int lastLane(I a) {
    return firstLane(everyLane<kLanes - 1>(a));
}

// Returns the minimum of each lane and all above it; beyond the last there is only `most`, the largest there
// is.
template <int step = 1>
STEREONAV_INLINE F suffixMinimum(F a, F most) {
    const F wider = min(a, lanesFrom<step>(a, most));
    if constexpr (2 * step < kLanes)
        return suffixMinimum<2 * step>(wider, most);
    else
        return wider;
}
// Returns the maximum of each lane and all below it; before the first there is only `least`.
template <int step = 1>
STEREONAV_INLINE I prefixMaximum(I a, I least) {
    const I wider = max(a, lanesFrom<kLanes - step>(least, a));
    if constexpr (2 * step < kLanes)
        return prefixMaximum<2 * step>(wider, least);
    else
        return wider;
}

}  // namespace stereonav::STEREONAV_ISA
