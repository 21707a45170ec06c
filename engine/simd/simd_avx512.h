// The AVX-512 backend of simd.h: sixteen lanes.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace stereonav::STEREONAV_ISA {

constexpr int kLanes = 16;
constexpr const char* kName = "avx512";

struct M {
    __mmask16 v;
};
STEREONAV_INLINE M operator&(M a, M b) {
    return {static_cast<__mmask16>(a.v & b.v)};
}
STEREONAV_INLINE M operator|(M a, M b) {
    return {static_cast<__mmask16>(a.v | b.v)};
}
STEREONAV_INLINE M operator~(M a) {
    return {static_cast<__mmask16>(~a.v)};
}
STEREONAV_INLINE M andNot(M a, M b) {
    return {static_cast<__mmask16>(a.v & ~b.v)};
}  // a and not b
STEREONAV_INLINE bool any(M a) {
    return a.v != 0;
}
STEREONAV_INLINE bool all(M a) {
    return a.v == 0xffff;
}
STEREONAV_INLINE std::uint32_t bits(M a) {
    return a.v;
}
STEREONAV_INLINE M maskFromBits(std::uint32_t b) {
    return {static_cast<__mmask16>(b)};
}
STEREONAV_INLINE M firstLanes(int count) {
    return {static_cast<__mmask16>(count >= 16 ? 0xffffu : (1u << count) - 1u)};
}

struct F {
    __m512 v;
    F() = default;
    STEREONAV_INLINE F(__m512 x) : v(x) {}
    STEREONAV_INLINE F(float x) : v(_mm512_set1_ps(x)) {}
};
STEREONAV_INLINE F operator+(F a, F b) {
    return _mm512_add_ps(a.v, b.v);
}
STEREONAV_INLINE F operator-(F a, F b) {
    return _mm512_sub_ps(a.v, b.v);
}
STEREONAV_INLINE F operator*(F a, F b) {
    return _mm512_mul_ps(a.v, b.v);
}
STEREONAV_INLINE F operator/(F a, F b) {
    return _mm512_div_ps(a.v, b.v);
}
STEREONAV_INLINE F mulAdd(F a, F b, F c) {
    return _mm512_fmadd_ps(a.v, b.v, c.v);
}
STEREONAV_INLINE F min(F a, F b) {
    return _mm512_min_ps(a.v, b.v);
}
STEREONAV_INLINE F max(F a, F b) {
    return _mm512_max_ps(a.v, b.v);
}
STEREONAV_INLINE F sqrt(F a) {
    return _mm512_sqrt_ps(a.v);
}
// Relative errors below 2^-21.
STEREONAV_INLINE F approxReciprocal(F a) {
    const __m512 r = _mm512_rcp14_ps(a.v);
    return _mm512_mul_ps(r, _mm512_fnmadd_ps(a.v, r, _mm512_set1_ps(2.0f)));
}
STEREONAV_INLINE F approxRsqrt(F a) {
    const __m512 r = _mm512_rsqrt14_ps(a.v);
    const __m512 half = _mm512_mul_ps(_mm512_set1_ps(0.5f), a.v);
    return _mm512_mul_ps(r, _mm512_fnmadd_ps(_mm512_mul_ps(half, r), r, _mm512_set1_ps(1.5f)));
}
STEREONAV_INLINE M operator<(F a, F b) {
    return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)};
}
STEREONAV_INLINE M operator<=(F a, F b) {
    return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)};
}
STEREONAV_INLINE M operator>(F a, F b) {
    return b < a;
}
STEREONAV_INLINE M operator>=(F a, F b) {
    return b <= a;
}
STEREONAV_INLINE F select(M m, F yes, F no) {
    return _mm512_mask_blend_ps(m.v, no.v, yes.v);
}
// 0 where m is clear.
STEREONAV_INLINE F keep(M m, F a) {
    return _mm512_maskz_mov_ps(m.v, a.v);
}
STEREONAV_INLINE F loadF(const float* p) {
    return _mm512_loadu_ps(p);
}
STEREONAV_INLINE void store(float* p, F a) {
    _mm512_storeu_ps(p, a.v);
}
STEREONAV_INLINE void store(float* p, F a, M m) {
    _mm512_mask_storeu_ps(p, m.v, a.v);
}
STEREONAV_INLINE F laneIndexF() {
    return _mm512_setr_ps(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

struct I {
    __m512i v;
    I() = default;
    STEREONAV_INLINE I(__m512i x) : v(x) {}
    STEREONAV_INLINE I(int x) : v(_mm512_set1_epi32(x)) {}
};
STEREONAV_INLINE I operator+(I a, I b) {
    return _mm512_add_epi32(a.v, b.v);
}
STEREONAV_INLINE I operator-(I a, I b) {
    return _mm512_sub_epi32(a.v, b.v);
}
STEREONAV_INLINE I operator*(I a, I b) {
    return _mm512_mullo_epi32(a.v, b.v);
}
STEREONAV_INLINE I operator&(I a, I b) {
    return _mm512_and_si512(a.v, b.v);
}
STEREONAV_INLINE I operator|(I a, I b) {
    return _mm512_or_si512(a.v, b.v);
}
STEREONAV_INLINE I operator^(I a, I b) {
    return _mm512_xor_si512(a.v, b.v);
}
STEREONAV_INLINE I shiftLeft(I a, I n) {
    return _mm512_sllv_epi32(a.v, n.v);
}
STEREONAV_INLINE I shiftRight(I a, I n) {
    return _mm512_srav_epi32(a.v, n.v);
}  // arithmetic
template <int n>
STEREONAV_INLINE I shiftLeft(I a) {
    return _mm512_slli_epi32(a.v, n);
}
template <int n>
STEREONAV_INLINE I shiftRight(I a) {  // arithmetic
    return _mm512_srai_epi32(a.v, n);
}
STEREONAV_INLINE I min(I a, I b) {
    return _mm512_min_epi32(a.v, b.v);
}
STEREONAV_INLINE I max(I a, I b) {
    return _mm512_max_epi32(a.v, b.v);
}
STEREONAV_INLINE M operator<(I a, I b) {
    return {_mm512_cmp_epi32_mask(a.v, b.v, _MM_CMPINT_LT)};
}
// 0 <= a <= last
STEREONAV_INLINE M within(I a, I last) {
    return {_mm512_cmp_epu32_mask(a.v, last.v, _MM_CMPINT_LE)};
}
STEREONAV_INLINE M operator>(I a, I b) {
    return b < a;
}
STEREONAV_INLINE M operator==(I a, I b) {
    return {_mm512_cmp_epi32_mask(a.v, b.v, _MM_CMPINT_EQ)};
}
STEREONAV_INLINE I select(M m, I yes, I no) {
    return _mm512_mask_blend_epi32(m.v, no.v, yes.v);
}
STEREONAV_INLINE I keep(M m, I a) {
    return _mm512_maskz_mov_epi32(m.v, a.v);
}
STEREONAV_INLINE F toFloat(I a) {
    return _mm512_cvtepi32_ps(a.v);
}
STEREONAV_INLINE I truncateToInt(F a) {
    return _mm512_cvttps_epi32(a.v);
}
// Largest integer <= a, for |a| < 2^31.
STEREONAV_INLINE I floorToInt(F a) {
    return _mm512_cvt_roundps_epi32(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}
STEREONAV_INLINE I asInt(F a) {
    return _mm512_castps_si512(a.v);
}
STEREONAV_INLINE F asFloat(I a) {
    return _mm512_castsi512_ps(a.v);
}
STEREONAV_INLINE I laneIndex() {
    return _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
STEREONAV_INLINE I loadI(const void* p) {
    return _mm512_loadu_si512(p);
}
STEREONAV_INLINE void store(void* p, I a) {
    _mm512_storeu_si512(p, a.v);
}
STEREONAV_INLINE void store(void* p, I a, M m) {
    _mm512_mask_storeu_epi32(p, m.v, a.v);
}
// Lanes outside m keep `otherwise` and touch no memory.
STEREONAV_INLINE F gather(const float* base, I index, M m, F otherwise) {
    return _mm512_mask_i32gather_ps(otherwise.v, m.v, index.v, base, 4);
}
STEREONAV_INLINE I gather(const std::uint32_t* base, I index, M m) {
    return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m.v, index.v, base, 4);
}
struct FPair {
    F first, second;
};
// base[index] and base[index + 1], with one load for both.
STEREONAV_INLINE FPair gatherPair(const float* base, I index, M m) {
    const __m512i zero = _mm512_setzero_si512();
    const __m256i low = _mm512_castsi512_si256(index.v), high = _mm512_extracti64x4_epi64(index.v, 1);
    const __m512 a =
        _mm512_castsi512_ps(_mm512_mask_i32gather_epi64(zero, static_cast<__mmask8>(m.v), low, base, 4));
    const __m512 b = _mm512_castsi512_ps(
        _mm512_mask_i32gather_epi64(zero, static_cast<__mmask8>(m.v >> 8), high, base, 4));
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
    return {_mm512_permutex2var_ps(a, even, b), _mm512_permutex2var_ps(a, odd, b)};
}
struct IPair {
    I first, second;
};
STEREONAV_INLINE IPair gatherPair(const std::uint32_t* base, I index, M m) {
    const __m512i zero = _mm512_setzero_si512();
    const __m256i low = _mm512_castsi512_si256(index.v), high = _mm512_extracti64x4_epi64(index.v, 1);
    const __m512i a = _mm512_mask_i32gather_epi64(zero, static_cast<__mmask8>(m.v), low, base, 4);
    const __m512i b = _mm512_mask_i32gather_epi64(zero, static_cast<__mmask8>(m.v >> 8), high, base, 4);
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
    return {_mm512_permutex2var_epi32(a, even, b), _mm512_permutex2var_epi32(a, odd, b)};
}
// base[index] of bytes; three more bytes behind each are read.
STEREONAV_INLINE I gatherByte(const std::uint8_t* base, I index, M m) {
    const __m512i four = _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m.v, index.v, base, 1);
    return _mm512_and_si512(four, _mm512_set1_epi32(255));
}
// base[index] and base[index + 1] of 16-bit numbers, the first in the low half.
STEREONAV_INLINE I gatherHalves(const void* base, I index, M m) {
    return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m.v, index.v, base, 2);
}
// Lanes of m to base[index]; indices differ.
STEREONAV_INLINE void scatter(float* base, I index, F a, M m) {
    _mm512_mask_i32scatter_ps(base, m.v, index.v, a.v, 4);
}
STEREONAV_INLINE void scatter(std::int32_t* base, I index, I a, M m) {
    _mm512_mask_i32scatter_epi32(base, m.v, index.v, a.v, 4);
}
// Brings the lanes of m to the front, in their order; what is behind them is any number.
struct ToFront {
    __mmask16 lanes;
    STEREONAV_INLINE explicit ToFront(M m) : lanes(m.v) {}
    STEREONAV_INLINE F operator()(F a) const { return _mm512_maskz_compress_ps(lanes, a.v); }
    STEREONAV_INLINE I operator()(I a) const { return _mm512_maskz_compress_epi32(lanes, a.v); }
};
// The reverse of ToFront: the lanes of m get a's first numbers, in their order; the others any number.
STEREONAV_INLINE I fromFront(I a, M m) {
    return _mm512_maskz_expand_epi32(m.v, a.v);
}
// table[index] for a table of sixteen entries; index in [0, 16).
STEREONAV_INLINE I lookup16(const std::int32_t* table, I index) {
    return _mm512_permutexvar_epi32(index.v, _mm512_loadu_si512(table));
}
// Sixteen-bit halves of each lane: a + (b - a) * t / 2^15, rounded; t in [0, 2^15), |b - a| < 2^15.
STEREONAV_INLINE I lerpHalves(I a, I b, I t) {
    return _mm512_add_epi16(a.v, _mm512_mulhrs_epi16(_mm512_sub_epi16(b.v, a.v), t.v));
}
// Sums of the products of sixteen-bit halves.
STEREONAV_INLINE I dotHalves(I a, I b) {
    return _mm512_madd_epi16(a.v, b.v);
}

struct D {
    __m512d low, high;
    D() = default;
    STEREONAV_INLINE D(__m512d l, __m512d h) : low(l), high(h) {}
    STEREONAV_INLINE D(double x) : low(_mm512_set1_pd(x)), high(low) {}
};
STEREONAV_INLINE D loadD(const double* p) {
    return {_mm512_loadu_pd(p), _mm512_loadu_pd(p + 8)};
}
STEREONAV_INLINE void store(double* p, D a) {
    _mm512_storeu_pd(p, a.low);
    _mm512_storeu_pd(p + 8, a.high);
}
STEREONAV_INLINE D operator+(D a, D b) {
    return {_mm512_add_pd(a.low, b.low), _mm512_add_pd(a.high, b.high)};
}
STEREONAV_INLINE D operator-(D a, D b) {
    return {_mm512_sub_pd(a.low, b.low), _mm512_sub_pd(a.high, b.high)};
}
STEREONAV_INLINE D operator*(D a, D b) {
    return {_mm512_mul_pd(a.low, b.low), _mm512_mul_pd(a.high, b.high)};
}
STEREONAV_INLINE M operator<(D a, D b) {
    const unsigned low = _mm512_cmp_pd_mask(a.low, b.low, _CMP_LT_OQ);
    const unsigned high = _mm512_cmp_pd_mask(a.high, b.high, _CMP_LT_OQ);
    return {static_cast<__mmask16>(low | high << 8)};
}
STEREONAV_INLINE D toDouble(F a) {
    return {_mm512_cvtps_pd(_mm512_castps512_ps256(a.v)), _mm512_cvtps_pd(_mm512_extractf32x8_ps(a.v, 1))};
}
STEREONAV_INLINE D toDouble(I a) {
    return {_mm512_cvtepi32_pd(_mm512_castsi512_si256(a.v)),
            _mm512_cvtepi32_pd(_mm512_extracti64x4_epi64(a.v, 1))};
}
STEREONAV_INLINE F toFloat(D a) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(a.low)), _mm512_cvtpd_ps(a.high), 1);
}

}  // namespace stereonav::STEREONAV_ISA
