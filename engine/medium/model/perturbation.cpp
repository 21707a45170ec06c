// The noise volume and where it is read. Whole numbers all the way, so that every machine makes the same
// bytes.
#include "engine/medium/model/perturbation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr int kNoiseSize = NoiseVolume::kSize;
constexpr int kTexels = kNoiseSize * kNoiseSize * kNoiseSize;
using Channel = std::vector<int>;

// Steele, Lea and Flood 2014: splitmix64's finishing step, of a counter.
std::uint64_t hashOf(std::uint64_t counter) {
    std::uint64_t z = counter * 0x9e3779b97f4a7c15ull;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ z >> 27) * 0x94d049bb133111ebull;
    return z ^ z >> 31;
}

// Returns values uniform in -32767..32767.
Channel whiteNoise(std::uint32_t seed, int channel) {
    Channel values(kTexels);
    for (int n = 0; n < kTexels; ++n) {
        const std::uint64_t counter = (static_cast<std::uint64_t>(seed) << 32) + 4ull * n + channel + 1;
        values[n] = static_cast<int>(hashOf(counter) >> 32) % 32768;
    }
    return values;
}

// Sums with weights 1 2 1 along the axis of that stride, around the corner at the end.
Channel blurred(const Channel& values, int stride) {
    Channel sums(kTexels);
    for (int n = 0; n < kTexels; ++n) {
        const int at = n / stride % kNoiseSize, start = n - at * stride;
        const int before = start + (at + kNoiseSize - 1) % kNoiseSize * stride,
                  after = start + (at + 1) % kNoiseSize * stride;
        sums[n] = values[before] + 2 * values[n] + values[after];
    }
    return sums;
}

// Returns the values shifted to the mean 0 and stretched so that the farthest reaches the last byte.
std::vector<std::uint8_t> stretched(const Channel& values) {
    long long sum = 0;
    for (const int v : values) sum += v;
    const long long mean = sum / kTexels;
    long long farthest = 1;
    for (const int v : values) farthest = std::max(farthest, std::llabs(v - mean));
    std::vector<std::uint8_t> bytes;
    for (const int v : values)  // 0..255, the mean between 127 and 128
        bytes.push_back(static_cast<std::uint8_t>((255 * (v - mean + farthest) + farthest) / (2 * farthest)));
    return bytes;
}

int wrapped(double texel) {
    return static_cast<int>(texel - kNoiseSize * std::floor(texel / kNoiseSize)) & (kNoiseSize - 1);
}

}  // namespace

NoiseVolume::NoiseVolume(std::uint32_t seed) : mBytes(4 * static_cast<std::size_t>(kTexels)) {
    for (int c = 0; c < 4; ++c) {
        const Channel smooth =
            blurred(blurred(blurred(whiteNoise(seed, c), 1), kNoiseSize), kNoiseSize * kNoiseSize);
        const std::vector<std::uint8_t> bytes = stretched(smooth);
        for (int n = 0; n < kTexels; ++n) mBytes[4 * static_cast<std::size_t>(n) + c] = bytes[n];
    }
}

glm::vec4 NoiseVolume::at(const glm::dvec3& texel) const {
    glm::dvec4 sum(0.0);
    int low[3];
    double share[3];
    for (int a = 0; a < 3; ++a) {
        const double below = std::floor(texel[a]);
        low[a] = wrapped(below);
        share[a] = texel[a] - below;
    }
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        int index = 0;
        for (int a = 2; a >= 0; --a) {
            const int up = corner >> a & 1;
            weight *= up ? share[a] : 1 - share[a];
            index = index * kNoiseSize + ((low[a] + up) & (kNoiseSize - 1));
        }
        for (int c = 0; c < 4; ++c) sum[c] += weight * mBytes[4 * static_cast<std::size_t>(index) + c];
    }
    return glm::vec4(sum / 127.5 - 1.0);
}

glm::dvec3 noiseOffset(const NoiseScale& scale, double time) {
    glm::dvec3 offset(0.0);
    for (int a = 0; a < 3; ++a) {
        const double way = scale.velocity[a] * time;
        // The product's rounding is kept too: it is up to a micrometre after a year at 10 m/s.
        const double rounding = std::fma(scale.velocity[a], time, -way);
        offset[a] = std::fmod(way, scale.size) + rounding;
        if (!std::isfinite(offset[a])) offset[a] = 0;
    }
    return offset;
}

glm::dvec3 noiseTexel(const NoiseScale& scale, const glm::dvec3& world, double time) {
    return (world - noiseOffset(scale, time)) * (NoiseVolume::kSize / scale.size);
}

glm::dvec3 displacementAt(const Perturbation& perturbation, const NoiseVolume& noise, const glm::dvec3& world,
                          double time) {
    glm::dvec3 sum(0.0);
    for (const NoiseScale& scale : perturbation.scales)
        if (scale.displacement != 0)
            sum += scale.displacement * glm::dvec3(glm::vec3(noise.at(noiseTexel(scale, world, time))));
    return sum;
}

void perturb(const Perturbation& perturbation, const NoiseVolume& noise, const glm::dvec3& world, double time,
             OpticalProperties& properties) {
    float extinction = 1;
    glm::vec3 color(1.0f), indirect(1.0f);
    for (const NoiseScale& scale : perturbation.scales) {
        const glm::vec4 n = noise.at(noiseTexel(scale, world, time));
        extinction += scale.extinction * n.w;
        color += scale.color * n.x;
        indirect += scale.indirect * n.y;
    }
    properties.extinction *= std::max(extinction, 0.0f);
    properties.color = glm::clamp(properties.color * color, 0.0f, 1.0f);
    properties.indirectExtinction *= glm::max(indirect, 0.0f);
}

double Perturbation::largestDisplacement() const {
    double sum = 0;
    for (const NoiseScale& scale : scales) sum += std::abs(scale.displacement);
    return sum;
}

double Perturbation::largestExtinctionFactor() const {
    double factor = 1;
    for (const NoiseScale& scale : scales) factor += std::abs(scale.extinction);
    return factor;
}

void checkPerturbation(const Perturbation& perturbation, const std::string& source) {
    if (perturbation.scales.size() > Perturbation::kMostScales)
        throw Error(source, "",
                    fmt::format("expected up to {} scales of noise, got {}", Perturbation::kMostScales,
                                perturbation.scales.size()),
                    "leave the weakest out");
    const auto finite = [](const auto& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    for (std::size_t n = 0; n < perturbation.scales.size(); ++n) {
        const NoiseScale& s = perturbation.scales[n];
        const std::string place = "scale " + std::to_string(n + 1);
        if (!(s.size > 0 && std::isfinite(s.size)))
            throw Error(source, place, fmt::format("expected a size above 0 m, got {}", s.size),
                        "give the metres that the noise repeats after");
        if (!(std::isfinite(s.displacement) && std::isfinite(s.extinction) && finite(s.color) &&
              finite(s.indirect) && finite(s.velocity)))
            throw Error(source, place, "expected finite numbers, got one that is not",
                        "check displacement, extinction, colour, indirect and velocity");
    }
}

}  // namespace stereonav
