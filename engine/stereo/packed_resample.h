// Interpolation of packed colours in 16-bit fixed point: the arithmetic that the vector kernels do,
// one value at a time. Channels (gamma 2, 10 bits) are held times 16; weights have 15 fraction bits.
#pragma once

#include <cmath>
#include <cstdint>

namespace stereonav {

constexpr float kWeightOne = 32768.0f;  // the weight 1
constexpr float kWeightMax = 32767.0f;  // what a 16-bit weight can hold

// Returns the nearest whole number, ties to even, as the vector conversion does.
inline int roundedWeight(float weight) {
    return static_cast<int>(std::lrintf(weight));
}

// (a * b + half) >> 15, the "multiply high, rounded and scaled" of the vector units.
inline int scaledProduct(int difference, int weight) {
    return (difference * weight + 16384) >> 15;
}

// Weights of four taps, in units of 1 / kWeightOne.
struct CubicWeights {
    int before, second, after;  // weights of taps 0, 2 and 3; tap 1 has the rest
};

// Returns Catmull-Rom's weights at t in [0, 1] between taps 1 and 2.
inline CubicWeights cubicWeights(float t) {
    const float t2 = t * t;
    const float t3 = t2 * t;
    const float before = (t2 - 0.5f * t3) - 0.5f * t;
    const float second = (2.0f * t2 - 1.5f * t3) + 0.5f * t;
    const float after = 0.5f * t3 - 0.5f * t2;
    const float limited = second * kWeightOne;
    return {roundedWeight(before * kWeightOne), roundedWeight(limited < kWeightMax ? limited : kWeightMax),
            roundedWeight(after * kWeightOne)};
}

// Returns the weight of the second of two taps at t in [0, 1] between them.
inline int linearWeight(float t) {
    const float weight = t * kWeightOne;
    return roundedWeight(weight < kWeightMax ? weight : kWeightMax);
}

// Returns a channel's fixed-point value, rounded and clamped, in its place in a packed colour.
inline std::uint32_t fromFixed(int value, int shift) {
    const int limited = value < 0 ? 0 : value > 1023 * 16 ? 1023 * 16 : value;
    return static_cast<std::uint32_t>((limited + 8) >> 4) << shift;
}

// Returns the fixed-point value of the channel that begins at bit `shift`.
inline int toFixed(std::uint32_t color, int shift) {
    return static_cast<int>(color >> shift & 1023u) << 4;
}

// Returns the colour between two packed ones, t in [0, 1].
inline std::uint32_t lerpPacked(std::uint32_t a, std::uint32_t b, float t) {
    const int weight = linearWeight(t);
    std::uint32_t result = 0;
    for (int shift = 0; shift < 30; shift += 10) {
        const int first = toFixed(a, shift);
        result |= fromFixed(first + scaledProduct(toFixed(b, shift) - first, weight), shift);
    }
    return result;
}

// Returns the colour from taps[0 .. 3], t in [0, 1] between taps 1 and 2.
inline std::uint32_t cubicPacked(const std::uint32_t* taps, float t) {
    const CubicWeights w = cubicWeights(t);
    std::uint32_t result = 0;
    for (int shift = 0; shift < 30; shift += 10) {
        const int first = toFixed(taps[1], shift);
        const int sum = first + scaledProduct(toFixed(taps[0], shift) - first, w.before) +
                        scaledProduct(toFixed(taps[2], shift) - first, w.second) +
                        scaledProduct(toFixed(taps[3], shift) - first, w.after);
        result |= fromFixed(sum, shift);
    }
    return result;
}

}  // namespace stereonav
