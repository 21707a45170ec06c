// See the header: places texels on their isosurfaces and gathers the samples of their paths.
#include "engine/light/texel_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/light/isovalue_surface.h"
#include "engine/light/path_numbers.h"
#include "engine/light/path_plain.h"
#include "engine/light/spherical_harmonics.h"
#include "engine/volume/plain_volume_caster.h"

namespace stereonav {
namespace {

constexpr int kMostBounces = 8;

void require(bool holds, const std::string& place, const std::string& problem, const std::string& advice) {
    if (!holds) throw Error("", place, problem, advice);
}

bool withinChannels(const glm::vec3& v, float low, float high) {
    return v.x >= low && v.x <= high && v.y >= low && v.y <= high && v.z >= low && v.z <= high;
}

void checkSetup(const LightSetup& setup) {
    constexpr float kMost = 3.0e38f;
    require(setup.bounces >= 0 && setup.bounces <= kMostBounces, "bounces",
            fmt::format("expected 0 to {}, got {}", kMostBounces, setup.bounces), "choose fewer");
    require(withinChannels(setup.albedo, 0, 1), "albedo", "expected numbers from 0 to 1",
            "a surface that sends out more light than it gets never comes to rest");
    require(withinChannels(setup.sky, 0, kMost), "sky", "expected numbers that are not negative",
            "give linear RGB");
    for (const PointLight& light : setup.lights) {
        require(withinChannels(light.intensity, 0, kMost), "point light",
                "expected an intensity that is not negative", "give linear RGB");
        const double sum = light.position.x + light.position.y + light.position.z;
        require(std::isfinite(sum) && light.radius > 0, "point light",
                "expected a position in metres and a radius above 0", "correct the light");
    }
}

void checkVolume(const GreyVolume& volume) {
    const glm::ivec3 size = volume.frame.size;
    require(std::min({size.x, size.y, size.z}) >= 2, "volume",
            fmt::format("expected at least 2 voxels along each axis, got {}x{}x{}", size.x, size.y, size.z),
            "a single slice has no surface");
}

float luminance(const glm::dvec3& c) {
    return static_cast<float>(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z);
}

// Welford's update by one sample.
void addSample(TexelSum& sum, const glm::dvec3& light) {
    const float before = luminance(light) - luminance(sum.mean);
    sum.samples += 1;
    sum.mean += (glm::vec3(light) - sum.mean) / sum.samples;
    sum.squares += before * (luminance(light) - luminance(sum.mean));
}

}  // namespace

struct TexelLighter::State {
    const GreyVolume& volume;
    VolumeFrame texels;
    LightSetup setup;
    LightSetup grey;  // its albedo is the mean of the three
    TexelSampling sampling;
    double least;  // of the volume
    PlainPaths paths, greyPaths;

    State(const GreyVolume& v, const VolumeFrame& t, const LightSetup& s, const TexelSampling& how)
        : volume(v),
          texels(t),
          setup(s),
          grey(greyOf(s)),
          sampling(how),
          least(leastOf(v)),
          paths(volume, setup, sampling),
          greyPaths(volume, grey, sampling) {}

    static LightSetup greyOf(LightSetup setup) {
        setup.albedo = glm::vec3((setup.albedo.x + setup.albedo.y + setup.albedo.z) / 3);
        return setup;
    }

    static double leastOf(const GreyVolume& volume) {
        const std::int16_t* first = volume.values.data();
        return *std::min_element(first, first + volume.frame.count());
    }

    glm::dvec3 voxelOf(const glm::ivec3& texel) const {
        const glm::dvec3 voxel = volume.frame.voxelFromWorld(texels.worldFromVoxel(glm::dvec3(texel)));
        // Texels on voxels are on them exactly, whatever the way through the world rounded.
        const glm::dvec3 whole = glm::round(voxel);
        const glm::dvec3 near = glm::abs(voxel - whole);
        const bool on = std::max({near.x, near.y, near.z}) < 1e-6;
        return glm::clamp(on ? whole : voxel, glm::dvec3(0.0), glm::dvec3(volume.frame.size - 1));
    }

    // False where the texel lies on no surface.
    bool startOf(const glm::ivec3& texel, PlainPaths::Start& start) const {
        const glm::dvec3 voxel = voxelOf(texel);
        start.normal = surfaceNormal(volume, voxel);
        if (start.normal == glm::dvec3(0.0)) return false;
        start.isovalue = tracedIsovalue(plainValue(volume, voxel), least);
        start.voxel = liftedStart(volume, start.isovalue, voxel, start.normal);
        start.key = pathKey(sampling.seed, texels.index(texel));
        return true;
    }
};

TexelLighter::TexelLighter(const GreyVolume& volume, const VolumeFrame& texels, const LightSetup& setup,
                           const TexelSampling& sampling) {
    checkVolume(volume);
    checkSetup(setup);
    mState = std::make_unique<State>(volume, texels, setup, sampling);
}

TexelLighter::~TexelLighter() = default;

TexelLighter::TexelPlace TexelLighter::place(const glm::ivec3& texel) const {
    const glm::dvec3 voxel = mState->voxelOf(texel);
    return {static_cast<float>(plainValue(mState->volume, voxel)), surfaceNormal(mState->volume, voxel)};
}

void TexelLighter::addIrradiance(std::span<const glm::ivec3> texels, int count,
                                 std::span<TexelSum> sums) const {
    for (std::size_t n = 0; n < texels.size(); ++n) {
        TexelSum& sum = sums[n];
        if (sum.samples < 0) continue;
        PlainPaths::Start start;
        if (!mState->startOf(texels[n], start)) {
            sum = {glm::vec3(0.0f), -1, 0};
            continue;
        }
        const auto first = static_cast<std::uint32_t>(sum.samples);
        for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(count); ++s)
            addSample(sum, mState->paths.irradiance(start, first + s));
    }
}

void TexelLighter::addTransfer(std::span<const glm::ivec3> texels, int firstSample, int count, int order,
                               int channels, std::span<float> sums, std::span<std::uint8_t> alive) const {
    const int coefficients = harmonicsCount(order);
    for (std::size_t n = 0; n < texels.size(); ++n) {
        PlainPaths::Start start;
        alive[n] = mState->startOf(texels[n], start);
        if (!alive[n]) continue;
        float* sum = sums.data() + n * static_cast<std::size_t>(coefficients * channels);
        for (int s = 0; s < count; ++s) {
            const PlainPaths& paths = channels == 1 ? mState->greyPaths : mState->paths;
            const auto escape = paths.escape(start, static_cast<std::uint32_t>(firstSample + s));
            if (escape.throughput == glm::dvec3(0.0)) continue;
            double values[kMaxHarmonics];
            evaluateHarmonics(escape.direction, order, values);
            for (int c = 0; c < coefficients; ++c)
                for (int k = 0; k < channels; ++k)
                    sum[c * channels + k] += static_cast<float>(values[c] * escape.throughput[k]);
        }
    }
}

}  // namespace stereonav
