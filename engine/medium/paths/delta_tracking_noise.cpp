// Bounds the noise: an interpolated value lies between the least and the greatest of the texels around it.
#include "engine/medium/paths/delta_tracking_noise.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace stereonav {
namespace {

constexpr int kSize = NoiseVolume::kSize;
// Texels along an axis; for larger boxes the full range is a bound that is hardly wider.
constexpr int kMostTexels = 10;

struct TexelRange {
    glm::dvec4 low{1.0}, high{-1.0};
    void add(const std::uint8_t* texel) {
        for (int c = 0; c < 4; ++c) {
            const double value = texel[c] / 127.5 - 1;
            low[c] = std::min(low[c], value);
            high[c] = std::max(high[c], value);
        }
    }
};

TexelRange rangeBetween(const NoiseVolume& noise, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 first = glm::floor(low), count = glm::floor(high) + 2.0 - first;
    TexelRange range;
    if (!(count.x <= kMostTexels && count.y <= kMostTexels && count.z <= kMostTexels)) {
        std::swap(range.low, range.high);  // the full range: -1 to 1
        return range;
    }
    constexpr double kPeriod = kSize;
    const glm::ivec3 start(first - kPeriod * glm::floor(first / kPeriod));
    const glm::ivec3 end = start + glm::ivec3(count);
    constexpr int kMask = kSize - 1;
    for (int z = start.z; z < end.z; ++z)
        for (int y = start.y; y < end.y; ++y)
            for (int x = start.x; x < end.x; ++x)
                range.add(&noise.bytes()[4 * static_cast<std::size_t>(
                                                 ((z & kMask) * kSize + (y & kMask)) * kSize + (x & kMask))]);
    return range;
}

}  // namespace

NoiseBounds boundNoise(const Perturbation& perturbation, const NoiseVolume* noise, const WorldBox& box,
                       double time) {
    NoiseBounds bounds;
    if (!noise) return bounds;
    for (const NoiseScale& scale : perturbation.scales) {
        const TexelRange range =
            rangeBetween(*noise, noiseTexel(scale, box.low, time), noiseTexel(scale, box.high, time));
        const glm::dvec3 a = scale.displacement * glm::dvec3(range.low);
        const glm::dvec3 b = scale.displacement * glm::dvec3(range.high);
        bounds.low += glm::min(a, b);
        bounds.high += glm::max(a, b);
        const double share = scale.extinction;
        bounds.leastFactor += std::min(share * range.low.w, share * range.high.w);
        bounds.mostFactor += std::max(share * range.low.w, share * range.high.w);
    }
    bounds.leastFactor = std::max(bounds.leastFactor, 0.0);
    bounds.mostFactor = std::max(bounds.mostFactor, 0.0);
    return bounds;
}

}  // namespace stereonav
