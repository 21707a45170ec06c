// The numbers that choose paths, as pure functions of (key, sample, dimension), so that a path never depends
// on what was traced before it: hashes, or the first two dimensions of Sobol's sequence under nested uniform
// (Owen) scrambling by hashing (Burley 2020, with Vegdahl's constants), a scrambling and a shuffle of its own
// for each pair of dimensions. The kernels have the same functions in vectors (path_vector_numbers.h).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace stereonav {

// Pairs of dimensions of one vertex of a path.
constexpr int kPairsPerVertex = 3;
enum class PathPair { Direction = 0, Probe = 1, Roulette = 2 };
constexpr std::uint32_t pairNumber(int vertex, PathPair pair) {
    return static_cast<std::uint32_t>(vertex * kPairsPerVertex + static_cast<int>(pair));
}

constexpr std::uint32_t kGolden = 0x9e3779b9u;  // 2^32 / golden ratio, odd: keeps counters apart

// A bijective mix of 32 bits (lowbias32 by Wellons).
constexpr std::uint32_t mixBits(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ x >> 16;
}

// Returns the key of a texel by its place in the grid and the seed.
constexpr std::uint32_t pathKey(std::uint64_t seed, std::uint64_t texel) {
    std::uint32_t key = mixBits(static_cast<std::uint32_t>(seed) + kGolden);
    key = mixBits(key ^ static_cast<std::uint32_t>(seed >> 32));
    key = mixBits(key ^ static_cast<std::uint32_t>(texel));
    return mixBits(key + static_cast<std::uint32_t>(texel >> 32));
}

constexpr std::uint32_t pairKey(std::uint32_t key, std::uint32_t pair) {
    return mixBits(key + (pair + 1) * kGolden);
}

constexpr std::uint32_t reverseBits(std::uint32_t x) {
    x = x << 16 | x >> 16;
    x = (x & 0x00ff00ffu) << 8 | (x & 0xff00ff00u) >> 8;
    x = (x & 0x0f0f0f0fu) << 4 | (x & 0xf0f0f0f0u) >> 4;
    x = (x & 0x33333333u) << 2 | (x & 0xccccccccu) >> 2;
    return (x & 0x55555555u) << 1 | (x & 0xaaaaaaaau) >> 1;
}

// Owen scrambling of a number whose bits are reversed.
constexpr std::uint32_t scrambleReversed(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1u;
    x ^= x * 0x05526c56u;
    return x ^ x * 0x53a22864u;
}

// Sobol's second dimension of an index, bits reversed: its matrix is Pascal's triangle modulo 2, which is
// the shift p(x) -> p(x + 1) of polynomials over bits.
constexpr std::uint32_t secondDimensionReversed(std::uint32_t x) {
    x ^= x >> 16;
    x ^= (x & 0xff00ff00u) >> 8;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xccccccccu) >> 2;
    return x ^ (x & 0xaaaaaaaau) >> 1;
}

// Returns a number in [0, 1), a multiple of 2^-24: the same in single and double precision.
constexpr float unitNumber(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

constexpr std::uint32_t kSecondKey = 0x68bc21ebu, kThirdKey = 0x02e5be93u;  // tell streams of a pair apart

// Returns two numbers in [0, 1), independent of those of other samples.
inline glm::vec2 independentPair(std::uint32_t key, std::uint32_t pair, std::uint32_t sample) {
    const std::uint32_t bits = mixBits(sample ^ pairKey(key, pair));
    return {unitNumber(bits), unitNumber(mixBits(bits ^ kSecondKey))};
}

// Returns two numbers in [0, 1), which samples of one key spread evenly.
inline glm::vec2 sobolPair(std::uint32_t key, std::uint32_t pair, std::uint32_t sample) {
    const std::uint32_t seed = pairKey(key, pair);
    const std::uint32_t index = reverseBits(scrambleReversed(reverseBits(sample), seed));
    const std::uint32_t x = scrambleReversed(index, mixBits(seed ^ kSecondKey));
    const std::uint32_t y = scrambleReversed(secondDimensionReversed(index), mixBits(seed ^ kThirdKey));
    return {unitNumber(reverseBits(x)), unitNumber(reverseBits(y))};
}

}  // namespace stereonav
