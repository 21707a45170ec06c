// Gradient noise after Perlin (Improving Noise, 2002) in two dimensions, with sixteen directions and
// hashed lattice points instead of a permutation table: what the generated terrain is made of.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace stereonav {

class Noise {
public:
    explicit Noise(std::uint64_t seed) : mSeed(static_cast<std::uint32_t>(seed ^ seed >> 32)) {}

    // Returns about -1 to 1 (0 at whole numbers), twice differentiable, with features of size 1. |x|, |y| <
    // 2^30.
    float at(float x, float y) const {
        const float fx = std::floor(x), fy = std::floor(y);
        const auto i = static_cast<std::int32_t>(fx), j = static_cast<std::int32_t>(fy);
        const float u = x - fx, v = y - fy;
        const float a = slope(i, j, u, v), b = slope(i + 1, j, u - 1, v);
        const float c = slope(i, j + 1, u, v - 1), d = slope(i + 1, j + 1, u - 1, v - 1);
        const float s = fade(u), t = fade(v);
        const float south = a + s * (b - a), north = c + s * (d - c);
        return 1.5f * (south + t * (north - south));
    }

    // Sum of octaves, each twice as fine and half as strong; about -1 to 1.
    float fractal(float x, float y, int octaves) const {
        float sum = 0, strength = 0.5f;
        for (int k = 0; k < octaves; ++k) {
            sum += strength * at(x, y);
            // Turned by an angle with no whole-number slope, so that lattices do not line up.
            const float turned = 1.6f * x - 1.2f * y + 17.3f;
            y = 1.2f * x + 1.6f * y + 5.1f;
            x = turned;
            strength *= 0.5f;
        }
        return sum;
    }

    // Sum of octaves of 1 - |noise|: sharp crests; 0 to about 1.
    float ridged(float x, float y, int octaves) const {
        float sum = 0, strength = 0.5f;
        for (int k = 0; k < octaves; ++k) {
            const float crest = 1.0f - std::abs(at(x, y));
            sum += strength * crest * crest;
            const float turned = 1.6f * x - 1.2f * y + 3.7f;
            y = 1.2f * x + 1.6f * y + 11.9f;
            x = turned;
            strength *= 0.5f;
        }
        return sum;
    }

    // 0 to 1, unrelated between neighbours.
    float white(std::int32_t i, std::int32_t j) const {
        return static_cast<float>(mixed(i, j) >> 8) * (1.0f / 16777216.0f);
    }

private:
    static float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

    std::uint32_t mixed(std::int32_t i, std::int32_t j) const {
        std::uint32_t h = mSeed;
        h ^= static_cast<std::uint32_t>(i) * 0x9e3779b1u;
        h = (h ^ h >> 15) * 0x85ebca77u;
        h ^= static_cast<std::uint32_t>(j) * 0xc2b2ae3du;
        h = (h ^ h >> 13) * 0x27d4eb2fu;
        return h ^ h >> 16;
    }

    float slope(std::int32_t i, std::int32_t j, float u, float v) const {
        constexpr float c1 = 0.92387953f, s1 = 0.38268343f, c2 = 0.70710678f;
        constexpr std::array<float, 16> kX{1, c1, c2, s1, 0, -s1, -c2, -c1, -1, -c1, -c2, -s1, 0, s1, c2, c1};
        const std::uint32_t k = mixed(i, j) >> 28;
        return kX[k] * u + kX[(k + 12) & 15] * v;
    }

    std::uint32_t mSeed;
};

// Returns 0 for x up to `low`, 1 from `high` on, and a cubic without kinks between.
inline float smoothStep(float low, float high, float x) {
    const float t = x <= low ? 0.0f : x >= high ? 1.0f : (x - low) / (high - low);
    return t * t * (3 - 2 * t);
}

}  // namespace stereonav
