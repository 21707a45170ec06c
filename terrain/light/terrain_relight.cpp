#include "terrain/light/terrain_relight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/parallel.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/math/constants.h"
#include "terrain/light/terrain_horizon.h"

namespace stereonav {
namespace {

const RelightKernels& relightKernels(SimdTarget target) {
    return kernelsOf(target, plain::kRelightKernels, avx2::kRelightKernels, avx512::kRelightKernels);
}

// Light of all rows: what does not depend on the row.
RelightRow lightOf(const SunAndSky& now, const TerrainLight& light) {
    RelightRow row;
    row.width = light.grid.width;
    row.planeSize = row.lightPlane = light.grid.count();
    for (int c = 0; c < 3; ++c) {
        row.level[c] = now.sky.level[c];
        row.sun[c] = now.sun[c];
        row.toSun[c] = static_cast<float>(now.toSun[c]);
    }
    const double across = std::sqrt(std::max(0.0, 1 - now.toSun.z * now.toSun.z));
    const double softness = std::max(2 * std::sin(now.sunRadius) * across, 1.0 / 255);
    row.inverseSoftness = static_cast<float>(1 / softness);
    row.sunUp = static_cast<float>(sunUp(now.toSun.z, now.sunRadius));
    if (light.settings.kind != TerrainLightKind::Transfer) return row;
    row.harmonics = lightHarmonics(light.settings.order);
    double towards[kMaxHarmonics];
    evaluateHarmonics(now.toSun, light.settings.order, towards);
    for (int n = 0; n < row.harmonics; ++n) {
        const double unit = transferUnit(n);
        // The sun is a radiance of pi * row.sun in all, from one direction; twice, as its mirror image below
        // the horizontal adds the same to the coefficients.
        row.sunHarmonics[n] = static_cast<float>(2 * kPi * unit * towards[lightHarmonic(n)] * row.sunUp);
        for (int c = 0; c < 3; ++c) row.sky[n][c] = static_cast<float>(unit * now.sky.harmonics[n][c]);
    }
    return row;
}

// Makes bytes in the place of horizons mean how much of the sun is hidden: the kernel's (sine - horizon) *
// softness + 1/2 becomes 1 - byte / 255.
void hideBy(RelightRow& row) {
    row.inverseSoftness = 0.5f / row.toSun[2];
    row.horizonWeight[0] = 2 * row.toSun[2] / 255;
    row.horizonWeight[1] = 0;
}

// The planes of horizons beside the sun's azimuth.
struct Azimuths {
    int before, after;
    double next;  // share of the second
};
Azimuths azimuthsOf(const glm::dvec3& toSun, int azimuths) {
    const double turn = std::atan2(toSun.y, toSun.x) / (2 * kPi);
    const double at = (turn - std::floor(turn)) * azimuths;
    const int before = static_cast<int>(at) % azimuths;
    return {before, (before + 1) % azimuths, at - std::floor(at)};
}

}  // namespace

TerrainRelight::TerrainRelight(const Heightfield& ground, TerrainLight light, SimdTarget target)
    : mLight(std::move(light)), mKernels(&relightKernels(availableTarget(target))) {
    const LightGrid& grid = mLight.grid;
    mNormals.resize(3 * grid.count());
    parallelFor(grid.height, [&](int j) {
        for (int i = 0; i < grid.width; ++i) {
            const glm::dvec3 n = sampleNormal(ground, grid.column(i), grid.row(j));
            for (int c = 0; c < 3; ++c)
                mNormals[c * grid.count() + static_cast<std::size_t>(j) * grid.width + i] =
                    static_cast<float>(n[c]);
        }
    });
    if (!ground.hasHoles()) return;
    for (int j = 0; j < grid.height; ++j)
        for (int i = 0; i < grid.width; ++i)
            if (!std::isfinite(ground.sample(grid.column(i), grid.row(j))))
                mHoles.push_back(static_cast<std::uint32_t>(j) * grid.width + i);
}

void TerrainRelight::relight(const SunAndSky& now, GroundBrightness& brightness, bool withSunShown,
                             const std::vector<std::uint8_t>* hidden) const {
    const LightGrid& grid = mLight.grid;
    brightness.width = grid.width;
    brightness.height = grid.height;
    brightness.planes.resize(3 * grid.count());
    const bool horizons = mLight.settings.kind == TerrainLightKind::Transfer;
    const bool shadow = hidden && now.toSun.z > 0;
    brightness.sunShown.resize(withSunShown && (horizons || shadow) ? grid.count() : 0);
    RelightRow all = lightOf(now, mLight);
    if (shadow) hideBy(all);
    const Azimuths azimuths = azimuthsOf(now.toSun, mLight.settings.azimuths);
    parallelFor(grid.height, [&](int j) {
        const std::size_t first = static_cast<std::size_t>(j) * grid.width;
        RelightRow row = all;
        row.openness = mLight.openness.data() + first;
        if (row.harmonics > 0) {
            row.full = mLight.full.data() + first;
            row.bounced = mLight.bounced.data() + first;
            row.horizon[0] = mLight.horizon.data() + azimuths.before * grid.count() + first;
            row.horizon[1] = mLight.horizon.data() + azimuths.after * grid.count() + first;
            row.horizonWeight[0] = static_cast<float>((1 - azimuths.next) / 255);
            row.horizonWeight[1] = static_cast<float>(azimuths.next / 255);
        }
        if (shadow) row.horizon[0] = row.horizon[1] = hidden->data() + first;
        for (int c = 0; c < 3; ++c) row.normal[c] = mNormals.data() + c * grid.count() + first;
        row.light = brightness.planes.data() + first;
        if (!brightness.sunShown.empty()) row.sunShown = brightness.sunShown.data() + first;
        mKernels->relight(row);
    });
    closeHoles(brightness);
}

void TerrainRelight::closeHoles(GroundBrightness& brightness) const {
    const LightGrid& grid = mLight.grid;
    const auto hole = [&](int i, int j) {
        return std::binary_search(mHoles.begin(), mHoles.end(),
                                  static_cast<std::uint32_t>(j) * grid.width + i);
    };
    for (const std::uint32_t at : mHoles) {
        const int i0 = static_cast<int>(at % grid.width), j0 = static_cast<int>(at / grid.width);
        glm::vec3 sum(0.0f);
        float shown = 0;
        int known = 0;
        for (int j = std::max(0, j0 - 1); j <= std::min(grid.height - 1, j0 + 1); ++j)
            for (int i = std::max(0, i0 - 1); i <= std::min(grid.width - 1, i0 + 1); ++i) {
                if (hole(i, j)) continue;
                sum += brightness.at(i, j);
                if (!brightness.sunShown.empty())
                    shown += brightness.sunShown[static_cast<std::size_t>(j) * grid.width + i];
                ++known;
            }
        for (int c = 0; c < 3; ++c)
            brightness.planes[c * grid.count() + at] = known ? sum[c] / static_cast<float>(known) : 0.0f;
        if (!brightness.sunShown.empty())
            brightness.sunShown[at] = known ? shown / static_cast<float>(known) : 0.0f;
    }
}

float TerrainRelight::sunShownAt(const GroundBrightness& brightness, const glm::dvec2& at) const {
    if (brightness.sunShown.empty()) return 1;
    const LightGrid& grid = mLight.grid;
    const LightGrid::Place x = grid.placeX(at.x), y = grid.placeY(at.y);
    const float* south =
        brightness.sunShown.data() + static_cast<std::size_t>(y.index) * grid.width + x.index;
    const float* north = south + grid.width;
    const float a = south[0] + x.next * (south[1] - south[0]), b = north[0] + x.next * (north[1] - north[0]);
    return a + y.next * (b - a);
}

void TerrainRelight::lightTexture(const ColorTexture& albedo, const GroundBrightness& brightness,
                                  const Display& display, ColorTexture& lit) const {
    const LightGrid& grid = mLight.grid;
    const ColorTexture::Level texels = albedo.level(0);
    const glm::dvec2 origin = albedo.gridOrigin(), perTexel = albedo.gridPerTexel();
    std::vector<std::int32_t> sample(texels.width());
    std::vector<float> next(texels.width());
    for (int x = 0; x < texels.width(); ++x) {
        const LightGrid::Place place = grid.placeX(origin.x + (x + 0.5) * perTexel.x);
        sample[x] = place.index;
        next[x] = place.next;
    }
    lit.refill([&](int y, PackedColor* out) {
        thread_local std::vector<float> roots;
        roots.resize(3 * static_cast<std::size_t>(grid.width));
        const LightGrid::Place place = grid.placeY(origin.y + (y + 0.5) * perTexel.y);
        const float *south[3], *north[3];
        float* root[3];
        for (int c = 0; c < 3; ++c) {
            south[c] = brightness.row(c, place.index);
            north[c] = brightness.row(c, place.index + 1);
            root[c] = roots.data() + static_cast<std::size_t>(c) * grid.width;
        }
        mKernels->mixRows(south, north, place.next, grid.width, display.exposure, display.share, root);
        mKernels->lightTexels(
            {texels.width(), texels.row(y), {root[0], root[1], root[2]}, sample.data(), next.data(), out});
    });
}

}  // namespace stereonav
