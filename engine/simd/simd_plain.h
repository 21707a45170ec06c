// The plain backend of simd.h: four lanes in the compiler's own vectors, which are registers of 128 bits on
// every processor that has them (SSE2, NEON) and scalars elsewhere. Also the readable meaning of the other
// two. The few steps that the compiler does not find by itself have an SSE2 form with the same bits.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace stereonav::STEREONAV_ISA {

constexpr int kLanes = 4;
constexpr const char* kName = "plain";

using FloatLanes = float __attribute__((vector_size(16)));
using IntLanes = std::int32_t __attribute__((vector_size(16)));
using WordLanes = std::uint32_t __attribute__((vector_size(16)));  // integers that wrap
using FloatPairLanes = float __attribute__((vector_size(8)));
using IntPairLanes = std::int32_t __attribute__((vector_size(8)));
using DoublePairLanes = double __attribute__((vector_size(16)));

struct M {
    IntLanes v;  // all bits of a lane set or clear
};
STEREONAV_INLINE M operator&(M a, M b) {
    return {a.v & b.v};
}
STEREONAV_INLINE M operator|(M a, M b) {
    return {a.v | b.v};
}
STEREONAV_INLINE M operator~(M a) {
    return {~a.v};
}
STEREONAV_INLINE M andNot(M a, M b) {
    return {a.v & ~b.v};
}  // a and not b
// Returns a bit for each lane, lane 0 lowest; maskFromBits() does the reverse.
STEREONAV_INLINE std::uint32_t bits(M a) {
#if defined(__SSE2__)
    return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(a.v)));
#else
    const IntLanes each = a.v & IntLanes{1, 2, 4, 8};
    return static_cast<std::uint32_t>(each[0] | each[1] | each[2] | each[3]);
#endif
}
STEREONAV_INLINE bool any(M a) {
    return bits(a) != 0;
}
STEREONAV_INLINE bool all(M a) {
    return bits(a) == 15u;
}
STEREONAV_INLINE M maskFromBits(std::uint32_t b) {
    const auto every = static_cast<std::int32_t>(b);
    return {(IntLanes{every, every, every, every} & IntLanes{1, 2, 4, 8}) != 0};
}
// Sets the first `count` lanes.
STEREONAV_INLINE M firstLanes(int count) {
    return {IntLanes{0, 1, 2, 3} < IntLanes{count, count, count, count}};
}

struct F {
    FloatLanes v;
    F() = default;
    STEREONAV_INLINE F(FloatLanes x) : v(x) {}
    STEREONAV_INLINE F(float x) : v(FloatLanes{x, x, x, x}) {}
};
struct I {
    IntLanes v;
    I() = default;
    STEREONAV_INLINE I(IntLanes x) : v(x) {}
    STEREONAV_INLINE I(WordLanes x) : v(reinterpret_cast<IntLanes>(x)) {}
    STEREONAV_INLINE I(int x) : v(IntLanes{x, x, x, x}) {}
};
STEREONAV_INLINE WordLanes words(I a) {
    return reinterpret_cast<WordLanes>(a.v);
}

STEREONAV_INLINE F operator+(F a, F b) {
    return a.v + b.v;
}
STEREONAV_INLINE F operator-(F a, F b) {
    return a.v - b.v;
}
STEREONAV_INLINE F operator*(F a, F b) {
    return a.v * b.v;
}
STEREONAV_INLINE F operator/(F a, F b) {
    return a.v / b.v;
}
STEREONAV_INLINE F mulAdd(F a, F b, F c) {
    return a * b + c;
}
STEREONAV_INLINE I asInt(F a) {
    return reinterpret_cast<IntLanes>(a.v);
}
STEREONAV_INLINE F asFloat(I a) {
    return reinterpret_cast<FloatLanes>(a.v);
}
STEREONAV_INLINE I select(M m, I yes, I no) {
    return (yes.v & m.v) | (no.v & ~m.v);
}
STEREONAV_INLINE F select(M m, F yes, F no) {
    return asFloat(select(m, asInt(yes), asInt(no)));
}
// Returns a where m is set, else 0.
STEREONAV_INLINE I keep(M m, I a) {
    return a.v & m.v;
}
STEREONAV_INLINE F keep(M m, F a) {
    return asFloat(keep(m, asInt(a)));
}
STEREONAV_INLINE M operator<(F a, F b) {
    return {a.v < b.v};
}
STEREONAV_INLINE M operator<=(F a, F b) {
    return {a.v <= b.v};
}
STEREONAV_INLINE M operator>(F a, F b) {
    return b < a;
}
STEREONAV_INLINE M operator>=(F a, F b) {
    return b <= a;
}
#if defined(__SSE2__)
STEREONAV_INLINE F min(F a, F b) {
    return _mm_min_ps(a.v, b.v);
}
STEREONAV_INLINE F max(F a, F b) {
    return _mm_max_ps(a.v, b.v);
}
STEREONAV_INLINE F sqrt(F a) {
    return _mm_sqrt_ps(a.v);
}
#else
// The result is x86's: the second where either is NaN.
STEREONAV_INLINE F min(F a, F b) {
    return select(a < b, a, b);
}
STEREONAV_INLINE F max(F a, F b) {
    return select(a > b, a, b);
}
STEREONAV_INLINE F sqrt(F a) {
    return FloatLanes{__builtin_sqrtf(a.v[0]), __builtin_sqrtf(a.v[1]), __builtin_sqrtf(a.v[2]),
                      __builtin_sqrtf(a.v[3])};
}
#endif
// Relative errors: none here, below 2^-21 in the other sets.
STEREONAV_INLINE F approxReciprocal(F a) {
    return F(1.0f) / a;
}
STEREONAV_INLINE F approxRsqrt(F a) {
    return F(1.0f) / sqrt(a);
}
// Memory need not be aligned; with a mask only its lanes are written.
STEREONAV_INLINE F loadF(const float* p) {
    F r;
    std::memcpy(&r.v, p, sizeof r.v);
    return r;
}
STEREONAV_INLINE void store(float* p, F a) {
    std::memcpy(p, &a.v, sizeof a.v);
}
STEREONAV_INLINE void store(float* p, F a, M m) {
    for (std::uint32_t k = 0, on = bits(m); k < kLanes; ++k)
        if ((on >> k & 1u) != 0) p[k] = a.v[k];
}
STEREONAV_INLINE F laneIndexF() {
    return FloatLanes{0, 1, 2, 3};
}

// Integer arithmetic wraps, as the processors' does.
STEREONAV_INLINE I operator+(I a, I b) {
    return words(a) + words(b);
}
STEREONAV_INLINE I operator-(I a, I b) {
    return words(a) - words(b);
}
STEREONAV_INLINE I operator*(I a, I b) {
    return words(a) * words(b);
}
STEREONAV_INLINE I operator&(I a, I b) {
    return a.v & b.v;
}
STEREONAV_INLINE I operator|(I a, I b) {
    return a.v | b.v;
}
STEREONAV_INLINE I operator^(I a, I b) {
    return a.v ^ b.v;
}
STEREONAV_INLINE M operator<(I a, I b) {
    return {a.v < b.v};
}
STEREONAV_INLINE M operator>(I a, I b) {
    return b < a;
}
STEREONAV_INLINE M operator==(I a, I b) {
    return {a.v == b.v};
}
// Returns whether 0 <= a <= last.
STEREONAV_INLINE M within(I a, I last) {
    return {(a.v >= 0) & (a.v <= last.v)};
}
STEREONAV_INLINE I min(I a, I b) {
    return select(a < b, a, b);
}
STEREONAV_INLINE I max(I a, I b) {
    return select(a > b, a, b);
}
// A shift by 32 and more gives 0, an arithmetic one the sign.
STEREONAV_INLINE I shiftLeft(I a, I n) {
    return select(within(n, I(31)), I(words(a) << (words(n) & 31u)), I(0));
}
STEREONAV_INLINE I shiftRight(I a, I n) {  // arithmetic
    return a.v >> select(within(n, I(31)), n, I(31)).v;
}
template <int n>
STEREONAV_INLINE I shiftLeft(I a) {
    return words(a) << n;
}
template <int n>
STEREONAV_INLINE I shiftRight(I a) {
    return a.v >> n;
}
STEREONAV_INLINE F toFloat(I a) {
    return __builtin_convertvector(a.v, FloatLanes);
}
// Out of range and NaN become the smallest integer, as x86 does.
STEREONAV_INLINE I truncateToInt(F a) {
#if defined(__SSE2__)
    return reinterpret_cast<IntLanes>(_mm_cvttps_epi32(a.v));
#else
    const M fits = (a > F(-2147483648.0f)) & (a < F(2147483648.0f));
    return select(fits, I(__builtin_convertvector(select(fits, a, F(0.0f)).v, IntLanes)), I(INT32_MIN));
#endif
}
// Returns the largest integer <= a, for |a| < 2^31.
STEREONAV_INLINE I floorToInt(F a) {
    const I t = truncateToInt(a);
    return t - select(a < toFloat(t), I(1), I(0));
}
STEREONAV_INLINE I laneIndex() {
    return IntLanes{0, 1, 2, 3};
}
STEREONAV_INLINE I loadI(const void* p) {
    I r;
    std::memcpy(&r.v, p, sizeof r.v);
    return r;
}
STEREONAV_INLINE void store(void* p, I a) {
    std::memcpy(p, &a.v, sizeof a.v);
}
STEREONAV_INLINE void store(void* p, I a, M m) {
    for (std::uint32_t k = 0, on = bits(m); k < kLanes; ++k)
        if ((on >> k & 1u) != 0) static_cast<std::int32_t*>(p)[k] = a.v[k];
}
// Lanes outside m keep `otherwise` and touch no memory.
STEREONAV_INLINE I gather(const std::int32_t* base, I index, M m, I otherwise) {
    const std::uint32_t on = bits(m);
    std::int32_t a = otherwise.v[0], b = otherwise.v[1], c = otherwise.v[2], d = otherwise.v[3];
    if ((on & 1u) != 0) a = base[index.v[0]];
    if ((on & 2u) != 0) b = base[index.v[1]];
    if ((on & 4u) != 0) c = base[index.v[2]];
    if ((on & 8u) != 0) d = base[index.v[3]];
    return IntLanes{a, b, c, d};
}
STEREONAV_INLINE F gather(const float* base, I index, M m, F otherwise) {
    const std::uint32_t on = bits(m);
    float a = otherwise.v[0], b = otherwise.v[1], c = otherwise.v[2], d = otherwise.v[3];
    if ((on & 1u) != 0) a = base[index.v[0]];
    if ((on & 2u) != 0) b = base[index.v[1]];
    if ((on & 4u) != 0) c = base[index.v[2]];
    if ((on & 8u) != 0) d = base[index.v[3]];
    return FloatLanes{a, b, c, d};
}
STEREONAV_INLINE I gather(const std::uint32_t* base, I index, M m) {
    return gather(reinterpret_cast<const std::int32_t*>(base), index, m, I(0));
}
struct FPair {
    F first, second;
};
// base[index] and base[index + 1].
STEREONAV_INLINE FPair gatherPair(const float* base, I index, M m) {
    return {gather(base, index, m, F(0.0f)), gather(base + 1, index, m, F(0.0f))};
}
struct IPair {
    I first, second;
};
STEREONAV_INLINE IPair gatherPair(const std::uint32_t* base, I index, M m) {
    return {gather(base, index, m), gather(base + 1, index, m)};
}
// Returns load(index) for each lane of m, 0 for the others.
template <typename Load>
STEREONAV_INLINE I loadLanes(I index, M m, Load load) {
    const std::uint32_t on = bits(m);
    return IntLanes{(on & 1u) != 0 ? load(index.v[0]) : 0, (on & 2u) != 0 ? load(index.v[1]) : 0,
                    (on & 4u) != 0 ? load(index.v[2]) : 0, (on & 8u) != 0 ? load(index.v[3]) : 0};
}
// base[index] of bytes.
STEREONAV_INLINE I gatherByte(const std::uint8_t* base, I index, M m) {
    return loadLanes(index, m, [&](std::int32_t at) { return std::int32_t{base[at]}; });
}
// base[index] and base[index + 1] of 16-bit numbers, the first in the low half.
STEREONAV_INLINE I gatherHalves(const void* base, I index, M m) {
    return loadLanes(index, m, [&](std::int32_t at) {
        std::int32_t two;
        std::memcpy(&two, static_cast<const char*>(base) + 2 * std::int64_t{at}, 4);
        return two;
    });
}
// Writes lanes of m to base[index]; indices differ.
STEREONAV_INLINE void scatter(float* base, I index, F a, M m) {
    for (std::uint32_t k = 0, on = bits(m); k < kLanes; ++k)
        if ((on >> k & 1u) != 0) base[index.v[k]] = a.v[k];
}
STEREONAV_INLINE void scatter(std::int32_t* base, I index, I a, M m) {
    for (std::uint32_t k = 0, on = bits(m); k < kLanes; ++k)
        if ((on >> k & 1u) != 0) base[index.v[k]] = a.v[k];
}
// Brings the lanes of m to the front, in their order; what is behind them is any of a's numbers.
struct ToFront {
    std::int32_t order[kLanes] = {};
    STEREONAV_INLINE explicit ToFront(M m) {
        const std::uint32_t set = bits(m);
        int n = 0;
        for (int lane = 0; lane < kLanes; ++lane) {
            order[n & (kLanes - 1)] = lane;
            n += static_cast<int>(set >> lane & 1);
        }
    }
    STEREONAV_INLINE F operator()(F a) const {
        return FloatLanes{a.v[order[0]], a.v[order[1]], a.v[order[2]], a.v[order[3]]};
    }
    STEREONAV_INLINE I operator()(I a) const {
        return IntLanes{a.v[order[0]], a.v[order[1]], a.v[order[2]], a.v[order[3]]};
    }
};
// Does the reverse: the lanes of m get a's first, in their order; the others any of a's numbers.
STEREONAV_INLINE I fromFront(I a, M m) {
    const std::uint32_t set = bits(m);
    return IntLanes{a.v[0], a.v[set & 1], a.v[__builtin_popcount(set & 3)], a.v[__builtin_popcount(set & 7)]};
}
// table[index] for a table of sixteen entries; index in [0, 16).
STEREONAV_INLINE I lookup16(const std::int32_t* table, I index) {
    return IntLanes{table[index.v[0]], table[index.v[1]], table[index.v[2]], table[index.v[3]]};
}
#if defined(__SSE2__)
// Returns a + (b - a) * t / 2^15 for the sixteen-bit halves of each lane, rounded; t in [0, 2^15), |b - a| <
// 2^15. With the product p = high * 2^16 + low, (p + 2^14) >> 15 is 2 high + ((low >> 14) + 1 >> 1).
STEREONAV_INLINE I lerpHalves(I a, I b, I t) {
    const auto from = reinterpret_cast<__m128i>(a.v), by = reinterpret_cast<__m128i>(t.v);
    const __m128i d = _mm_sub_epi16(reinterpret_cast<__m128i>(b.v), from);
    const __m128i high = _mm_mulhi_epi16(d, by), low = _mm_srli_epi16(_mm_mullo_epi16(d, by), 14);
    const __m128i rest = _mm_srli_epi16(_mm_add_epi16(low, _mm_set1_epi16(1)), 1);
    return reinterpret_cast<IntLanes>(_mm_add_epi16(from, _mm_add_epi16(_mm_add_epi16(high, high), rest)));
}
// Returns the sums of the products of sixteen-bit halves.
STEREONAV_INLINE I dotHalves(I a, I b) {
    return reinterpret_cast<IntLanes>(
        _mm_madd_epi16(reinterpret_cast<__m128i>(a.v), reinterpret_cast<__m128i>(b.v)));
}
#else
STEREONAV_INLINE I signedLowHalf(I a) {
    return shiftRight<16>(shiftLeft<16>(a));
}
STEREONAV_INLINE I lerpHalf(I a, I b, I t) {
    return a + shiftRight<1>(shiftRight<14>(signedLowHalf(b - a) * t) + I(1));
}
STEREONAV_INLINE I lerpHalves(I a, I b, I t) {
    const I low = lerpHalf(signedLowHalf(a), signedLowHalf(b), signedLowHalf(t));
    const I high = lerpHalf(shiftRight<16>(a), shiftRight<16>(b), shiftRight<16>(t));
    return shiftLeft<16>(high) | (low & I(0xffff));
}
STEREONAV_INLINE I dotHalves(I a, I b) {
    return signedLowHalf(a) * signedLowHalf(b) + shiftRight<16>(a) * shiftRight<16>(b);
}
#endif

struct D {
    DoublePairLanes low, high;
    D() = default;
    STEREONAV_INLINE D(DoublePairLanes l, DoublePairLanes h) : low(l), high(h) {}
    STEREONAV_INLINE D(double x) : low(DoublePairLanes{x, x}), high(low) {}
};
STEREONAV_INLINE D loadD(const double* p) {
    D r;
    std::memcpy(&r.low, p, sizeof r.low);
    std::memcpy(&r.high, p + 2, sizeof r.high);
    return r;
}
STEREONAV_INLINE void store(double* p, D a) {
    std::memcpy(p, &a.low, sizeof a.low);
    std::memcpy(p + 2, &a.high, sizeof a.high);
}
STEREONAV_INLINE D operator+(D a, D b) {
    return {a.low + b.low, a.high + b.high};
}
STEREONAV_INLINE D operator-(D a, D b) {
    return {a.low - b.low, a.high - b.high};
}
STEREONAV_INLINE D operator*(D a, D b) {
    return {a.low * b.low, a.high * b.high};
}
STEREONAV_INLINE M operator<(D a, D b) {
    return {__builtin_shufflevector(reinterpret_cast<IntLanes>(a.low < b.low),
                                    reinterpret_cast<IntLanes>(a.high < b.high), 0, 2, 4, 6)};
}
STEREONAV_INLINE D toDouble(F a) {
    const FloatPairLanes low{a.v[0], a.v[1]}, high{a.v[2], a.v[3]};
    return {__builtin_convertvector(low, DoublePairLanes), __builtin_convertvector(high, DoublePairLanes)};
}
STEREONAV_INLINE D toDouble(I a) {
    const IntPairLanes low{a.v[0], a.v[1]}, high{a.v[2], a.v[3]};
    return {__builtin_convertvector(low, DoublePairLanes), __builtin_convertvector(high, DoublePairLanes)};
}
STEREONAV_INLINE F toFloat(D a) {
    const auto low = __builtin_convertvector(a.low, FloatPairLanes);
    const auto high = __builtin_convertvector(a.high, FloatPairLanes);
    return FloatLanes{low[0], low[1], high[0], high[1]};
}

}  // namespace stereonav::STEREONAV_ISA
