// The plain backend of simd.h: four lanes as arrays, for processors without AVX2 (and as the readable
// meaning of the other two). The compiler turns the loops into what the baseline has.
#pragma once

#include <cstdint>
#include <cstring>

namespace stereonav::STEREONAV_ISA {

constexpr int kLanes = 4;
constexpr const char* kName = "plain";

struct M {
    std::uint32_t v;  // bit k is lane k
};
STEREONAV_INLINE M operator&(M a, M b) {
    return {a.v & b.v};
}
STEREONAV_INLINE M operator|(M a, M b) {
    return {a.v | b.v};
}
STEREONAV_INLINE M operator~(M a) {
    return {~a.v & 15u};
}
STEREONAV_INLINE M andNot(M a, M b) {
    return {a.v & ~b.v};
}  // a and not b
STEREONAV_INLINE bool any(M a) {
    return a.v != 0;
}
STEREONAV_INLINE bool all(M a) {
    return a.v == 15u;
}
STEREONAV_INLINE std::uint32_t bits(M a) {
    return a.v;
}
STEREONAV_INLINE M maskFromBits(std::uint32_t b) {
    return {b & 15u};
}
STEREONAV_INLINE M firstLanes(int count) {
    return {count >= 4 ? 15u : (1u << count) - 1u};
}

template <typename T>
struct Lanes {
    T v[kLanes];
};
template <typename T, typename Op>
STEREONAV_INLINE Lanes<T> mapLanes(Op op) {
    Lanes<T> r;
    for (int k = 0; k < kLanes; ++k) r.v[k] = op(k);
    return r;
}
template <typename Op>
STEREONAV_INLINE M testLanes(Op op) {
    std::uint32_t b = 0;
    for (int k = 0; k < kLanes; ++k) b |= (op(k) ? 1u : 0u) << k;
    return {b};
}

struct F : Lanes<float> {
    F() = default;
    STEREONAV_INLINE F(Lanes<float> x) : Lanes<float>(x) {}
    STEREONAV_INLINE F(float x) : Lanes<float>{{x, x, x, x}} {}
};
struct I : Lanes<std::int32_t> {
    I() = default;
    STEREONAV_INLINE I(Lanes<std::int32_t> x) : Lanes<std::int32_t>(x) {}
    STEREONAV_INLINE I(int x) : Lanes<std::int32_t>{{x, x, x, x}} {}
};
struct D : Lanes<double> {
    D() = default;
    STEREONAV_INLINE D(Lanes<double> x) : Lanes<double>(x) {}
    STEREONAV_INLINE D(double x) : Lanes<double>{{x, x, x, x}} {}
};

STEREONAV_INLINE F operator+(F a, F b) {
    return mapLanes<float>([&](int k) { return a.v[k] + b.v[k]; });
}
STEREONAV_INLINE F operator-(F a, F b) {
    return mapLanes<float>([&](int k) { return a.v[k] - b.v[k]; });
}
STEREONAV_INLINE F operator*(F a, F b) {
    return mapLanes<float>([&](int k) { return a.v[k] * b.v[k]; });
}
STEREONAV_INLINE F operator/(F a, F b) {
    return mapLanes<float>([&](int k) { return a.v[k] / b.v[k]; });
}
STEREONAV_INLINE F mulAdd(F a, F b, F c) {
    return a * b + c;
}
// As the processors do: the second where either is NaN.
STEREONAV_INLINE F min(F a, F b) {
    return mapLanes<float>([&](int k) { return a.v[k] < b.v[k] ? a.v[k] : b.v[k]; });
}
STEREONAV_INLINE F max(F a, F b) {
    return mapLanes<float>([&](int k) { return a.v[k] > b.v[k] ? a.v[k] : b.v[k]; });
}
STEREONAV_INLINE F sqrt(F a) {
    return mapLanes<float>([&](int k) { return __builtin_sqrtf(a.v[k]); });
}
STEREONAV_INLINE F approxReciprocal(F a) {
    return F(1.0f) / a;
}
STEREONAV_INLINE F approxRsqrt(F a) {
    return F(1.0f) / sqrt(a);
}
STEREONAV_INLINE M operator<(F a, F b) {
    return testLanes([&](int k) { return a.v[k] < b.v[k]; });
}
STEREONAV_INLINE M operator<=(F a, F b) {
    return testLanes([&](int k) { return a.v[k] <= b.v[k]; });
}
STEREONAV_INLINE M operator>(F a, F b) {
    return b < a;
}
STEREONAV_INLINE M operator>=(F a, F b) {
    return b <= a;
}
STEREONAV_INLINE F select(M m, F yes, F no) {
    return mapLanes<float>([&](int k) { return (m.v >> k & 1u) != 0 ? yes.v[k] : no.v[k]; });
}
STEREONAV_INLINE F loadF(const float* p) {
    return mapLanes<float>([&](int k) { return p[k]; });
}
STEREONAV_INLINE void store(float* p, F a) {
    std::memcpy(p, a.v, sizeof a.v);
}
STEREONAV_INLINE void store(float* p, F a, M m) {
    for (int k = 0; k < kLanes; ++k)
        if ((m.v >> k & 1u) != 0) p[k] = a.v[k];
}
STEREONAV_INLINE F laneIndexF() {
    return Lanes<float>{{0, 1, 2, 3}};
}

// Integer arithmetic wraps, as the processors' does.
template <typename Op>
STEREONAV_INLINE I wrapLanes(I a, I b, Op op) {
    return mapLanes<std::int32_t>([&](int k) {
        return static_cast<std::int32_t>(
            op(static_cast<std::uint32_t>(a.v[k]), static_cast<std::uint32_t>(b.v[k])));
    });
}
STEREONAV_INLINE I operator+(I a, I b) {
    return wrapLanes(a, b, [](std::uint32_t x, std::uint32_t y) { return x + y; });
}
STEREONAV_INLINE I operator-(I a, I b) {
    return wrapLanes(a, b, [](std::uint32_t x, std::uint32_t y) { return x - y; });
}
STEREONAV_INLINE I operator*(I a, I b) {
    return wrapLanes(a, b, [](std::uint32_t x, std::uint32_t y) { return x * y; });
}
STEREONAV_INLINE I operator&(I a, I b) {
    return wrapLanes(a, b, [](std::uint32_t x, std::uint32_t y) { return x & y; });
}
STEREONAV_INLINE I operator|(I a, I b) {
    return wrapLanes(a, b, [](std::uint32_t x, std::uint32_t y) { return x | y; });
}
STEREONAV_INLINE I operator^(I a, I b) {
    return wrapLanes(a, b, [](std::uint32_t x, std::uint32_t y) { return x ^ y; });
}
STEREONAV_INLINE I shiftLeft(I a, I n) {
    return wrapLanes(a, n, [](std::uint32_t x, std::uint32_t s) { return s < 32 ? x << s : 0u; });
}
STEREONAV_INLINE I shiftRight(I a, I n) {  // arithmetic
    return mapLanes<std::int32_t>([&](int k) { return a.v[k] >> (n.v[k] < 32 ? n.v[k] : 31); });
}
template <int n>
STEREONAV_INLINE I shiftLeft(I a) {
    return shiftLeft(a, I(n));
}
template <int n>
STEREONAV_INLINE I shiftRight(I a) {
    return shiftRight(a, I(n));
}
STEREONAV_INLINE I min(I a, I b) {
    return mapLanes<std::int32_t>([&](int k) { return a.v[k] < b.v[k] ? a.v[k] : b.v[k]; });
}
STEREONAV_INLINE I max(I a, I b) {
    return mapLanes<std::int32_t>([&](int k) { return a.v[k] > b.v[k] ? a.v[k] : b.v[k]; });
}
STEREONAV_INLINE M operator<(I a, I b) {
    return testLanes([&](int k) { return a.v[k] < b.v[k]; });
}
// 0 <= a <= last
STEREONAV_INLINE M within(I a, I last) {
    return andNot(maskFromBits(0xFu), (a < I(0)) | (last < a));
}
STEREONAV_INLINE M operator>(I a, I b) {
    return b < a;
}
STEREONAV_INLINE M operator==(I a, I b) {
    return testLanes([&](int k) { return a.v[k] == b.v[k]; });
}
STEREONAV_INLINE I select(M m, I yes, I no) {
    return mapLanes<std::int32_t>([&](int k) { return (m.v >> k & 1u) != 0 ? yes.v[k] : no.v[k]; });
}
STEREONAV_INLINE F toFloat(I a) {
    return mapLanes<float>([&](int k) { return static_cast<float>(a.v[k]); });
}
// Out of range and NaN become the smallest integer, as the processors do.
STEREONAV_INLINE I truncateToInt(F a) {
    return mapLanes<std::int32_t>([&](int k) {
        return a.v[k] > -2147483648.0f && a.v[k] < 2147483648.0f ? static_cast<std::int32_t>(a.v[k])
                                                                 : INT32_MIN;
    });
}
// Largest integer <= a, for |a| < 2^31.
STEREONAV_INLINE I floorToInt(F a) {
    const I t = truncateToInt(a);
    return t - select(a < toFloat(t), I(1), I(0));
}
STEREONAV_INLINE I asInt(F a) {
    I r;
    std::memcpy(r.v, a.v, sizeof r.v);
    return r;
}
STEREONAV_INLINE F asFloat(I a) {
    F r;
    std::memcpy(r.v, a.v, sizeof r.v);
    return r;
}
STEREONAV_INLINE I laneIndex() {
    return Lanes<std::int32_t>{{0, 1, 2, 3}};
}
STEREONAV_INLINE I loadI(const void* p) {
    I r;
    std::memcpy(r.v, p, sizeof r.v);
    return r;
}
STEREONAV_INLINE void store(void* p, I a) {
    std::memcpy(p, a.v, sizeof a.v);
}
STEREONAV_INLINE void store(void* p, I a, M m) {
    for (int k = 0; k < kLanes; ++k)
        if ((m.v >> k & 1u) != 0) static_cast<std::int32_t*>(p)[k] = a.v[k];
}
// Lanes outside m keep `otherwise` and touch no memory.
STEREONAV_INLINE F gather(const float* base, I index, M m, F otherwise) {
    return mapLanes<float>([&](int k) { return (m.v >> k & 1u) != 0 ? base[index.v[k]] : otherwise.v[k]; });
}
STEREONAV_INLINE I gather(const std::uint32_t* base, I index, M m) {
    return mapLanes<std::int32_t>(
        [&](int k) { return (m.v >> k & 1u) != 0 ? static_cast<std::int32_t>(base[index.v[k]]) : 0; });
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
// base[index] of bytes.
STEREONAV_INLINE I gatherByte(const std::uint8_t* base, I index, M m) {
    return mapLanes<std::int32_t>([&](int k) { return (m.v >> k & 1) ? std::int32_t{base[index.v[k]]} : 0; });
}
// base[index] and base[index + 1] of 16-bit numbers, the first in the low half.
STEREONAV_INLINE I gatherHalves(const void* base, I index, M m) {
    return mapLanes<std::int32_t>([&](int k) {
        std::int32_t two = 0;
        if (m.v >> k & 1) std::memcpy(&two, static_cast<const char*>(base) + 2 * std::int64_t{index.v[k]}, 4);
        return two;
    });
}
// Lanes of m to base[index]; indices differ.
STEREONAV_INLINE void scatter(float* base, I index, F a, M m) {
    for (int k = 0; k < kLanes; ++k)
        if (m.v >> k & 1) base[index.v[k]] = a.v[k];
}
STEREONAV_INLINE void scatter(std::int32_t* base, I index, I a, M m) {
    for (int k = 0; k < kLanes; ++k)
        if (m.v >> k & 1) base[index.v[k]] = a.v[k];
}
// table[index] for a table of sixteen entries; index in [0, 16).
STEREONAV_INLINE I lookup16(const std::int32_t* table, I index) {
    return mapLanes<std::int32_t>([&](int k) { return table[index.v[k]]; });
}
// Sixteen-bit halves of each lane: a + (b - a) * t / 2^15, rounded; t in [0, 2^15), |b - a| < 2^15.
STEREONAV_INLINE std::int32_t lerpHalf(std::int32_t a, std::int32_t b, std::int32_t t) {
    const std::int32_t d = static_cast<std::int16_t>(b - a);
    return static_cast<std::int16_t>(a + (((d * t >> 14) + 1) >> 1));
}
STEREONAV_INLINE I lerpHalves(I a, I b, I t) {
    return mapLanes<std::int32_t>([&](int k) {
        const std::int32_t low =
            lerpHalf(static_cast<std::int16_t>(a.v[k]), static_cast<std::int16_t>(b.v[k]),
                     static_cast<std::int16_t>(t.v[k]));
        const std::int32_t high = lerpHalf(a.v[k] >> 16, b.v[k] >> 16, t.v[k] >> 16);
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(high) << 16 |
                                         (static_cast<std::uint32_t>(low) & 0xffffu));
    });
}
// Sums of the products of sixteen-bit halves.
STEREONAV_INLINE I dotHalves(I a, I b) {
    return mapLanes<std::int32_t>([&](int k) {
        return static_cast<std::int16_t>(a.v[k]) * static_cast<std::int16_t>(b.v[k]) +
               (a.v[k] >> 16) * (b.v[k] >> 16);
    });
}

STEREONAV_INLINE D operator+(D a, D b) {
    return mapLanes<double>([&](int k) { return a.v[k] + b.v[k]; });
}
STEREONAV_INLINE D operator-(D a, D b) {
    return mapLanes<double>([&](int k) { return a.v[k] - b.v[k]; });
}
STEREONAV_INLINE D operator*(D a, D b) {
    return mapLanes<double>([&](int k) { return a.v[k] * b.v[k]; });
}
STEREONAV_INLINE M operator<(D a, D b) {
    return testLanes([&](int k) { return a.v[k] < b.v[k]; });
}
STEREONAV_INLINE D toDouble(F a) {
    return mapLanes<double>([&](int k) { return static_cast<double>(a.v[k]); });
}
STEREONAV_INLINE D toDouble(I a) {
    return mapLanes<double>([&](int k) { return static_cast<double>(a.v[k]); });
}
STEREONAV_INLINE F toFloat(D a) {
    return mapLanes<float>([&](int k) { return static_cast<float>(a.v[k]); });
}

}  // namespace stereonav::STEREONAV_ISA
