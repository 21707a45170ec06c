// The AVX2 backend of simd.h: eight lanes.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace stereonav::STEREONAV_ISA {

constexpr int kLanes = 8;
constexpr const char* kName = "avx2";

struct M {
    __m256 v;  // all bits of a lane set or clear
};
STEREONAV_INLINE M operator&(M a, M b) {
    return {_mm256_and_ps(a.v, b.v)};
}
STEREONAV_INLINE M operator|(M a, M b) {
    return {_mm256_or_ps(a.v, b.v)};
}
STEREONAV_INLINE M operator~(M a) {
    return {_mm256_xor_ps(a.v, _mm256_castsi256_ps(_mm256_set1_epi32(-1)))};
}
STEREONAV_INLINE M andNot(M a, M b) {
    return {_mm256_andnot_ps(b.v, a.v)};
}  // a and not b
STEREONAV_INLINE std::uint32_t bits(M a) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(a.v));
}
STEREONAV_INLINE bool any(M a) {
    return bits(a) != 0;
}
STEREONAV_INLINE bool all(M a) {
    return bits(a) == 0xff;
}
STEREONAV_INLINE M maskFromBits(std::uint32_t b) {
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(b)), lane);
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(set, lane))};
}
STEREONAV_INLINE M firstLanes(int count) {
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_set1_epi32(count), lane))};
}

struct F {
    __m256 v;
    F() = default;
    STEREONAV_INLINE F(__m256 x) : v(x) {}
    STEREONAV_INLINE F(float x) : v(_mm256_set1_ps(x)) {}
};
STEREONAV_INLINE F operator+(F a, F b) {
    return _mm256_add_ps(a.v, b.v);
}
STEREONAV_INLINE F operator-(F a, F b) {
    return _mm256_sub_ps(a.v, b.v);
}
STEREONAV_INLINE F operator*(F a, F b) {
    return _mm256_mul_ps(a.v, b.v);
}
STEREONAV_INLINE F operator/(F a, F b) {
    return _mm256_div_ps(a.v, b.v);
}
STEREONAV_INLINE F mulAdd(F a, F b, F c) {
    return _mm256_fmadd_ps(a.v, b.v, c.v);
}
STEREONAV_INLINE F min(F a, F b) {
    return _mm256_min_ps(a.v, b.v);
}
STEREONAV_INLINE F max(F a, F b) {
    return _mm256_max_ps(a.v, b.v);
}
STEREONAV_INLINE F sqrt(F a) {
    return _mm256_sqrt_ps(a.v);
}
// Relative errors below 2^-21.
STEREONAV_INLINE F approxReciprocal(F a) {
    const __m256 r = _mm256_rcp_ps(a.v);
    return _mm256_mul_ps(r, _mm256_fnmadd_ps(a.v, r, _mm256_set1_ps(2.0f)));
}
STEREONAV_INLINE F approxRsqrt(F a) {
    const __m256 r = _mm256_rsqrt_ps(a.v);
    const __m256 half = _mm256_mul_ps(_mm256_set1_ps(0.5f), a.v);
    return _mm256_mul_ps(r, _mm256_fnmadd_ps(_mm256_mul_ps(half, r), r, _mm256_set1_ps(1.5f)));
}
STEREONAV_INLINE M operator<(F a, F b) {
    return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)};
}
STEREONAV_INLINE M operator<=(F a, F b) {
    return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)};
}
STEREONAV_INLINE M operator>(F a, F b) {
    return b < a;
}
STEREONAV_INLINE M operator>=(F a, F b) {
    return b <= a;
}
STEREONAV_INLINE F select(M m, F yes, F no) {
    return _mm256_blendv_ps(no.v, yes.v, m.v);
}
// 0 where m is clear; cheaper than select.
STEREONAV_INLINE F keep(M m, F a) {
    return _mm256_and_ps(m.v, a.v);
}
STEREONAV_INLINE F loadF(const float* p) {
    return _mm256_loadu_ps(p);
}
STEREONAV_INLINE void store(float* p, F a) {
    _mm256_storeu_ps(p, a.v);
}
STEREONAV_INLINE void store(float* p, F a, M m) {
    _mm256_maskstore_ps(p, _mm256_castps_si256(m.v), a.v);
}
STEREONAV_INLINE F laneIndexF() {
    return _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7);
}

struct I {
    __m256i v;
    I() = default;
    STEREONAV_INLINE I(__m256i x) : v(x) {}
    STEREONAV_INLINE I(int x) : v(_mm256_set1_epi32(x)) {}
};
STEREONAV_INLINE I operator+(I a, I b) {
    return _mm256_add_epi32(a.v, b.v);
}
STEREONAV_INLINE I operator-(I a, I b) {
    return _mm256_sub_epi32(a.v, b.v);
}
STEREONAV_INLINE I operator*(I a, I b) {
    return _mm256_mullo_epi32(a.v, b.v);
}
STEREONAV_INLINE I operator&(I a, I b) {
    return _mm256_and_si256(a.v, b.v);
}
STEREONAV_INLINE I operator|(I a, I b) {
    return _mm256_or_si256(a.v, b.v);
}
STEREONAV_INLINE I operator^(I a, I b) {
    return _mm256_xor_si256(a.v, b.v);
}
STEREONAV_INLINE I shiftLeft(I a, I n) {
    return _mm256_sllv_epi32(a.v, n.v);
}
STEREONAV_INLINE I shiftRight(I a, I n) {
    return _mm256_srav_epi32(a.v, n.v);
}  // arithmetic
template <int n>
STEREONAV_INLINE I shiftLeft(I a) {
    return _mm256_slli_epi32(a.v, n);
}
template <int n>
STEREONAV_INLINE I shiftRight(I a) {  // arithmetic
    return _mm256_srai_epi32(a.v, n);
}
STEREONAV_INLINE I min(I a, I b) {
    return _mm256_min_epi32(a.v, b.v);
}
STEREONAV_INLINE I max(I a, I b) {
    return _mm256_max_epi32(a.v, b.v);
}
STEREONAV_INLINE M operator<(I a, I b) {
    return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(b.v, a.v))};
}
// 0 <= a <= last
STEREONAV_INLINE M within(I a, I last) {
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_min_epu32(a.v, last.v), a.v))};
}
STEREONAV_INLINE M operator>(I a, I b) {
    return b < a;
}
STEREONAV_INLINE M operator==(I a, I b) {
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.v, b.v))};
}
STEREONAV_INLINE I select(M m, I yes, I no) {
    return _mm256_blendv_epi8(no.v, yes.v, _mm256_castps_si256(m.v));
}
STEREONAV_INLINE I keep(M m, I a) {
    return _mm256_and_si256(_mm256_castps_si256(m.v), a.v);
}
STEREONAV_INLINE F toFloat(I a) {
    return _mm256_cvtepi32_ps(a.v);
}
STEREONAV_INLINE I truncateToInt(F a) {
    return _mm256_cvttps_epi32(a.v);
}
// Largest integer <= a, for |a| < 2^31.
STEREONAV_INLINE I floorToInt(F a) {
    return _mm256_cvtps_epi32(_mm256_floor_ps(a.v));
}
STEREONAV_INLINE I asInt(F a) {
    return _mm256_castps_si256(a.v);
}
STEREONAV_INLINE F asFloat(I a) {
    return _mm256_castsi256_ps(a.v);
}
STEREONAV_INLINE I laneIndex() {
    return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
}
STEREONAV_INLINE I loadI(const void* p) {
    return _mm256_loadu_si256(static_cast<const __m256i*>(p));
}
STEREONAV_INLINE void store(void* p, I a) {
    _mm256_storeu_si256(static_cast<__m256i*>(p), a.v);
}
STEREONAV_INLINE void store(void* p, I a, M m) {
    _mm256_maskstore_epi32(static_cast<int*>(p), _mm256_castps_si256(m.v), a.v);
}
// Lanes outside m keep `otherwise` and touch no memory.
STEREONAV_INLINE F gather(const float* base, I index, M m, F otherwise) {
    return _mm256_mask_i32gather_ps(otherwise.v, base, index.v, m.v, 4);
}
STEREONAV_INLINE I gather(const std::uint32_t* base, I index, M m) {
    return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), reinterpret_cast<const int*>(base), index.v,
                                       _mm256_castps_si256(m.v), 4);
}
struct FPair {
    F first, second;
};
// base[index] and base[index + 1], each two at once: half as many reads.
STEREONAV_INLINE FPair gatherPair(const float* base, I index, M m) {
    const auto half = [&](__m128i at, __m128i lanes) {
        return _mm256_castpd_ps(
            _mm256_mask_i32gather_pd(_mm256_setzero_pd(), reinterpret_cast<const double*>(base), at,
                                     _mm256_castsi256_pd(_mm256_cvtepi32_epi64(lanes)), 4));
    };
    const __m256i lanes = _mm256_castps_si256(m.v);
    const __m256 low = half(_mm256_castsi256_si128(index.v), _mm256_castsi256_si128(lanes));
    const __m256 high = half(_mm256_extracti128_si256(index.v, 1), _mm256_extracti128_si256(lanes, 1));
    const auto ordered = [](__m256 a) {
        return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(a), 0xD8));
    };
    return {ordered(_mm256_shuffle_ps(low, high, 0x88)), ordered(_mm256_shuffle_ps(low, high, 0xDD))};
}
struct IPair {
    I first, second;
};
STEREONAV_INLINE IPair gatherPair(const std::uint32_t* base, I index, M m) {
    const FPair pair = gatherPair(reinterpret_cast<const float*>(base), index, m);
    return {_mm256_castps_si256(pair.first.v), _mm256_castps_si256(pair.second.v)};
}
// base[index] of bytes; three more bytes behind each are read.
STEREONAV_INLINE I gatherByte(const std::uint8_t* base, I index, M m) {
    const __m256i four = _mm256_mask_i32gather_epi32(
        _mm256_setzero_si256(), reinterpret_cast<const int*>(base), index.v, _mm256_castps_si256(m.v), 1);
    return _mm256_and_si256(four, _mm256_set1_epi32(255));
}
// base[index] and base[index + 1] of 16-bit numbers, the first in the low half.
STEREONAV_INLINE I gatherHalves(const void* base, I index, M m) {
    return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), static_cast<const int*>(base), index.v,
                                       _mm256_castps_si256(m.v), 2);
}
template <typename T>
STEREONAV_INLINE void scatterStored(T* base, const std::int32_t* places, const T* values, M m) {
    std::uint32_t left = bits(m);
    if (left == 0xff) {  // mostly so, and then without a loop to guess the end of
        for (int k = 0; k < kLanes; ++k) base[places[k]] = values[k];
        return;
    }
    for (; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        base[places[k]] = values[k];
    }
}
// Lanes of m to base[index]; indices differ.
STEREONAV_INLINE void scatter(std::int32_t* base, I index, I a, M m) {
    alignas(32) std::int32_t values[kLanes], places[kLanes];
    store(values, a);
    store(places, index);
    scatterStored(base, places, values, m);
}
STEREONAV_INLINE void scatter(float* base, I index, F a, M m) {
    alignas(32) float values[kLanes];
    alignas(32) std::int32_t places[kLanes];
    store(values, a);
    store(places, index);
    scatterStored(base, places, values, m);
}
// By mask: of eight lanes in a byte each, those of the mask first, and where in the mask's order each is.
struct LaneOrders {
    std::uint64_t front[256] = {}, rank[256] = {};
    constexpr LaneOrders() {
        for (unsigned mask = 0; mask < 256; ++mask)
            for (unsigned lane = 0, n = 0; lane < 8; ++lane) {
                rank[mask] |= std::uint64_t{n < 7 ? n : 7} << 8 * lane;
                if (mask >> lane & 1) front[mask] |= std::uint64_t{lane} << 8 * n++;
            }
    }
};
inline constexpr LaneOrders kLaneOrders;
STEREONAV_INLINE __m256i lanesOfBytes(const std::uint64_t& bytes) {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&bytes)));
}
// Brings the lanes of m to the front, in their order; what is behind them is any of a's numbers.
struct ToFront {
    __m256i order;
    STEREONAV_INLINE explicit ToFront(M m) : order(lanesOfBytes(kLaneOrders.front[bits(m)])) {}
    STEREONAV_INLINE F operator()(F a) const { return _mm256_permutevar8x32_ps(a.v, order); }
    STEREONAV_INLINE I operator()(I a) const { return _mm256_permutevar8x32_epi32(a.v, order); }
};
// The reverse of ToFront: the lanes of m get a's first numbers, in their order; the others any of a's
// numbers.
STEREONAV_INLINE I fromFront(I a, M m) {
    return _mm256_permutevar8x32_epi32(a.v, lanesOfBytes(kLaneOrders.rank[bits(m)]));
}
// table[index] for a table of sixteen entries; index in [0, 16).
STEREONAV_INLINE I lookup16(const std::int32_t* table, I index) {
    return _mm256_i32gather_epi32(table, index.v, 4);
}
// Sixteen-bit halves of each lane: a + (b - a) * t / 2^15, rounded; t in [0, 2^15), |b - a| < 2^15.
STEREONAV_INLINE I lerpHalves(I a, I b, I t) {
    return _mm256_add_epi16(a.v, _mm256_mulhrs_epi16(_mm256_sub_epi16(b.v, a.v), t.v));
}
// Sums of the products of sixteen-bit halves.
STEREONAV_INLINE I dotHalves(I a, I b) {
    return _mm256_madd_epi16(a.v, b.v);
}

struct D {
    __m256d low, high;
    D() = default;
    STEREONAV_INLINE D(__m256d l, __m256d h) : low(l), high(h) {}
    STEREONAV_INLINE D(double x) : low(_mm256_set1_pd(x)), high(low) {}
};
STEREONAV_INLINE D loadD(const double* p) {
    return {_mm256_loadu_pd(p), _mm256_loadu_pd(p + 4)};
}
STEREONAV_INLINE void store(double* p, D a) {
    _mm256_storeu_pd(p, a.low);
    _mm256_storeu_pd(p + 4, a.high);
}
STEREONAV_INLINE D operator+(D a, D b) {
    return {_mm256_add_pd(a.low, b.low), _mm256_add_pd(a.high, b.high)};
}
STEREONAV_INLINE D operator-(D a, D b) {
    return {_mm256_sub_pd(a.low, b.low), _mm256_sub_pd(a.high, b.high)};
}
STEREONAV_INLINE D operator*(D a, D b) {
    return {_mm256_mul_pd(a.low, b.low), _mm256_mul_pd(a.high, b.high)};
}
STEREONAV_INLINE M operator<(D a, D b) {
    const int low = _mm256_movemask_pd(_mm256_cmp_pd(a.low, b.low, _CMP_LT_OQ));
    const int high = _mm256_movemask_pd(_mm256_cmp_pd(a.high, b.high, _CMP_LT_OQ));
    return maskFromBits(static_cast<std::uint32_t>(low | high << 4));
}
STEREONAV_INLINE D toDouble(F a) {
    return {_mm256_cvtps_pd(_mm256_castps256_ps128(a.v)), _mm256_cvtps_pd(_mm256_extractf128_ps(a.v, 1))};
}
STEREONAV_INLINE D toDouble(I a) {
    return {_mm256_cvtepi32_pd(_mm256_castsi256_si128(a.v)),
            _mm256_cvtepi32_pd(_mm256_extracti128_si256(a.v, 1))};
}
STEREONAV_INLINE F toFloat(D a) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm256_cvtpd_ps(a.low)), _mm256_cvtpd_ps(a.high), 1);
}

}  // namespace stereonav::STEREONAV_ISA
