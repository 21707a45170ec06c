// Tint, light, and images laid over the ground.
#include "terrain/scene/ground_color.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "terrain/light/sun_and_sky.h"
#include "terrain/scene/ground_texture.h"
#include "terrain/scene/ground_tones.h"

namespace stereonav {
namespace {

constexpr double kTextureBytes = 4 + 4 * 4.0 / 3;  // a texel: the picture, and with its mip levels

// The height at a grid position; beside a hole that of the known samples around, NaN inside one.
double knownHeightAt(const Heightfield& ground, const glm::dvec2& grid) {
    const double height = ground.heightAt(ground.worldFromGrid(grid));
    if (std::isfinite(height)) return height;
    const int i = std::clamp(static_cast<int>(grid.x), 0, ground.width() - 2);
    const int j = std::clamp(static_cast<int>(grid.y), 0, ground.height() - 2);
    double sum = 0;
    int known = 0;
    for (int k = 0; k < 4; ++k)
        if (const float h = ground.sample(i + k % 2, j + k / 2); std::isfinite(h)) {
            sum += h;
            ++known;
        }
    return known ? sum / known : std::numeric_limits<double>::quiet_NaN();
}

// The ground's palette under the sun.
class Tint {
public:
    Tint(const Heightfield& ground, const TerrainLook& look, const TintPlace& place)
        : Tint(ground, ground, look, place) {}
    Tint(const Heightfield& part, const Heightfield& whole, const TerrainLook& look, const TintPlace& place)
        : mGround(part), mLight(look), mTones(groundTones(part, place, whole)) {}

    // Linear colour of the ground at a grid position, lit.
    glm::vec3 at(const glm::dvec2& grid) const {
        const GroundTone tone = mTones->at(grid, knownHeightAt(mGround, grid));
        return mLight.at(tone.normal) * tone.color;
    }

private:
    const Heightfield& mGround;
    GroundLight mLight;
    std::unique_ptr<GroundTones> mTones;
};

// Picture and tint as one lays over the other, in a texture of that size. lit: set where the look's sun
// lights some of it.
ColorTexture laidOver(const Heightfield& ground, const PicturedGround& pictured, const Tint& tint,
                      const std::optional<LaidPicture::Pixels>& pixels, const GroundTextureSize& size,
                      std::atomic<bool>& lit, Progress& progress) {
    const TerrainLook& look = pictured.look;
    const GroundLight light(look);
    const auto color = [&](int column, int row, const glm::dvec2& grid) {
        const GroundPicture::Sample sample =
            pixels ? pixels->picture.at(pixels->map.at(column, row)) : GroundPicture::Sample();
        glm::vec3 seen = sample.color;
        if (look.shadeImage && sample.cover > 0)
            seen *= light.at(ground.normalAt(ground.worldFromGrid(grid)));
        if (sample.cover >= 1) return seen;
        lit = true;
        return glm::mix(tint.at(grid), seen, sample.cover);
    };
    return groundTexture(ground, size, color, progress);
}

}  // namespace

GroundLight::GroundLight(const TerrainLook& look) {
    const double across = std::cos(look.sunElevation), up = std::sin(look.sunElevation);
    const double level = look.ambient + (1 - look.ambient) * std::max(0.0, up);
    if (level <= 0) return;  // a sun below the horizon and no ambient light: night
    mAmbient = look.ambient / level;
    mDirect = sunUp(up) * (1 - look.ambient) / level *
              glm::dvec3(across * std::sin(look.sunAzimuth), across * std::cos(look.sunAzimuth), up);
}

float GroundLight::at(const glm::dvec3& unitNormal) const {
    return static_cast<float>(mAmbient + std::max(0.0, glm::dot(unitNormal, mDirect)));
}

double bytesOfTint(double samples) {
    return kTextureBytes * std::min(kMostGroundTexels, kLitDensity * kLitDensity * samples) +
           kBytesOfTones * samples;
}

GroundColor tintedGround(const Heightfield& ground, const TerrainLook& look, const TintPlace& place,
                         Progress& progress) {
    const Tint tint(ground, look, place);
    const GroundTextureSize size = groundTextureSize(ground, glm::dvec2(kLitDensity));
    const auto color = [&](int, int, const glm::dvec2& grid) { return tint.at(grid); };
    return {groundTexture(ground, size, color, progress), describePalette(place) + ", lit", look.ambient < 1};
}

ColorTexture tintedPart(const Heightfield& part, const Heightfield& whole, const TerrainLook& look,
                        const TintPlace& place, double density, Progress& progress) {
    const Tint tint(part, whole, look, place);
    const auto color = [&](int, int, const glm::dvec2& grid) { return tint.at(grid); };
    return groundTexture(part, groundTextureSize(part, glm::dvec2(density)), color, progress);
}

GroundColor picturedGround(const Heightfield& ground, const PicturedGround& pictured, double mostDensity,
                           Progress& progress) {
    const LaidPicture& picture = *pictured.picture;
    const TerrainLook& look = pictured.look;
    glm::dvec2 density = picture.density(ground);
    if (look.shadeImage) density = glm::max(density, glm::dvec2(kLitDensity));
    const GroundTextureSize size = groundTextureSize(ground, glm::min(density, glm::dvec2(mostDensity)));
    progress.report(0, "reading the picture of the ground");
    const std::optional<LaidPicture::Pixels> pixels = picture.over(ground, size);
    if (!pixels) picture.throwNoOverlap();
    std::atomic<bool> lit{look.shadeImage};
    ColorTexture laid =
        laidOver(ground, pictured, Tint(ground, look, pictured.tint), pixels, size, lit, progress);
    return {std::move(laid), picture.describe() + (look.shadeImage ? ", lit" : ""), lit && look.ambient < 1};
}

ColorTexture picturedPart(const Heightfield& part, const Heightfield& whole, const PicturedGround& pictured,
                          double mostTexels) {
    const double samples = double(part.width()) * part.height();
    glm::dvec2 density = pictured.picture->density(part);
    if (pictured.perSample) density = glm::max(density, glm::dvec2(1.0));
    const double texels = samples * density.x * density.y, most = std::max(samples, mostTexels);
    if (texels > most) density *= std::sqrt(most / texels);
    const GroundTextureSize size = groundTextureSize(part, density);
    const std::optional<LaidPicture::Pixels> pixels = pictured.picture->over(part, size);
    std::atomic<bool> lit{false};
    Progress quiet;
    return laidOver(part, pictured, Tint(part, whole, pictured.look, pictured.tint), pixels, size, lit,
                    quiet);
}

}  // namespace stereonav
