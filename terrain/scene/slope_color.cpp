#include "terrain/scene/slope_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/base/parallel.h"
#include "engine/image/packed_color.h"
#include "engine/math/constants.h"
#include "terrain/light/sun_and_sky.h"

namespace stereonav {
namespace {

// Where each class ends, degrees; and its colour in sRGB.
constexpr std::array<double, 8> kSlopeEnds{5, 10, 15, 20, 25, 30, 35, 45};
constexpr std::array<std::uint32_t, 9> kSlopeColors{0xffffcc, 0xffeda0, 0xfed976, 0xfeb24c, 0xfd8d3c,
                                                    0xfc4e2a, 0xe31a1c, 0xbd0026, 0x800026};

// Percent.
constexpr std::array<double, 3> kAspectFrom{5, 20, 40};
// By steepness, then clockwise from north.
constexpr std::uint32_t kAspectColors[3][8] = {
    {0x98b581, 0x72a890, 0x7c8ead, 0x8c75a0, 0xb47ba1, 0xcb8b8f, 0xc5a58a, 0xbdbf89},
    {0x8dc458, 0x3dab71, 0x5078b6, 0x77479d, 0xc04d9c, 0xe76f7a, 0xe2a66c, 0xd6db5e},
    {0x84d600, 0x00ab44, 0x0068c0, 0x6c00a3, 0xca009c, 0xff5568, 0xffab47, 0xf4fa00}};
constexpr std::uint32_t kLevelColor = 0xa1a1a1;
constexpr const char* kCompass[8] = {"north", "north-east", "east", "south-east",
                                     "south", "south-west", "west", "north-west"};

glm::vec3 linearOf(std::uint32_t srgb) {
    const auto channel = [&](int shift) {
        return linearFromSrgb(static_cast<float>(srgb >> shift & 255u) / 255.0f);
    };
    return {channel(16), channel(8), channel(0)};
}

// Gradients, bilinear between those of the samples, as normals are.
class Gradients {
public:
    Gradients(const Heightfield& ground, bool horn) : mGradients(ground.width(), ground.height()) {
        parallelFor(ground.height(), [&](int j) {
            for (int i = 0; i < ground.width(); ++i)
                mGradients.at(i, j) =
                    glm::vec2(horn ? hornGradient(ground, i, j) : ground.gradientAtSample(i, j));
        });
    }
    glm::dvec2 at(const glm::dvec2& grid) const {
        const double x = std::clamp(grid.x, 0.0, mGradients.width() - 1.0),
                     y = std::clamp(grid.y, 0.0, mGradients.height() - 1.0);
        const int i = std::min(static_cast<int>(x), mGradients.width() - 2),
                  j = std::min(static_cast<int>(y), mGradients.height() - 2);
        const double u = x - i, v = y - j;
        const auto sample = [&](int a, int b) { return glm::dvec2(mGradients.at(i + a, j + b)); };
        return (1 - v) * ((1 - u) * sample(0, 0) + u * sample(1, 0)) +
               v * ((1 - u) * sample(0, 1) + u * sample(1, 1));
    }

private:
    Plane<glm::vec2> mGradients;
};

glm::dvec3 normalOf(const glm::dvec2& gradient) {
    return glm::normalize(glm::dvec3(-gradient, 1.0));
}

glm::dvec3 towardsSun(const TerrainLook& look) {
    const double across = std::cos(look.sunElevation);
    return {across * std::sin(look.sunAzimuth), across * std::cos(look.sunAzimuth),
            std::sin(look.sunElevation)};
}

std::vector<LegendEntry> slopeEntries() {
    std::vector<LegendEntry> entries;
    for (std::size_t n = 0; n < kSlopeColors.size(); ++n)
        entries.push_back(
            {linearOf(kSlopeColors[n]), n == 0 ? fmt::format("under {:g} degrees", kSlopeEnds[0])
                                        : n == kSlopeEnds.size()
                                            ? fmt::format("{:g} and steeper", kSlopeEnds[n - 1])
                                            : fmt::format("{:g} to {:g}", kSlopeEnds[n - 1], kSlopeEnds[n])});
    return entries;
}

std::vector<LegendEntry> aspectEntries() {
    std::vector<LegendEntry> entries{
        {linearOf(kLevelColor), fmt::format("nearly level, under {:g} %", kAspectFrom[0])}};
    for (int n = 0; n < 8; ++n)
        entries.push_back({linearOf(kAspectColors[2][n]), std::string("falls to the ") + kCompass[n]});
    return entries;
}

}  // namespace

std::optional<GroundPaint> groundPaintNamed(const std::string& word) {
    if (word == "slope") return GroundPaint::Slope;
    if (word == "aspect") return GroundPaint::Aspect;
    if (word == "hillshade") return GroundPaint::Hillshade;
    if (word == "natural") return GroundPaint::Natural;
    if (word == "hypsometric") return GroundPaint::Hypsometric;
    if (word == "swiss") return GroundPaint::Swiss;
    if (word == "grey") return GroundPaint::Grey;
    return std::nullopt;
}

glm::dvec2 hornGradient(const Heightfield& ground, int i, int j) {
    const double centre = ground.sample(i, j);
    if (!std::isfinite(centre)) return glm::dvec2(0.0);
    const auto at = [&](int di, int dj) {
        const int x = i + di, y = j + dj;
        if (x < 0 || y < 0 || x >= ground.width() || y >= ground.height()) return centre;
        const double height = ground.sample(x, y);
        return std::isfinite(height) ? height : centre;
    };
    const double east = at(1, 1) + 2 * at(1, 0) + at(1, -1), west = at(-1, 1) + 2 * at(-1, 0) + at(-1, -1),
                 north = at(-1, 1) + 2 * at(0, 1) + at(1, 1), south = at(-1, -1) + 2 * at(0, -1) + at(1, -1);
    return glm::dvec2(east - west, north - south) / (8.0 * ground.spacing());
}

glm::vec3 slopeColor(const glm::dvec2& gradient) {
    const double degrees = std::atan(glm::length(gradient)) / kRadians;
    const auto end = std::upper_bound(kSlopeEnds.begin(), kSlopeEnds.end(), degrees);
    return linearOf(kSlopeColors[static_cast<std::size_t>(end - kSlopeEnds.begin())]);
}

glm::vec3 aspectColor(const glm::dvec2& gradient) {
    const double percent = 100 * glm::length(gradient);
    const auto steeper = std::upper_bound(kAspectFrom.begin(), kAspectFrom.end(), percent);
    if (steeper == kAspectFrom.begin()) return linearOf(kLevelColor);
    const double eighths = std::atan2(-gradient.x, -gradient.y) / (0.25 * std::numbers::pi);
    const int eighth = (static_cast<int>(std::lround(eighths)) + 8) % 8;
    return linearOf(kAspectColors[steeper - kAspectFrom.begin() - 1][eighth]);
}

GroundColor paintedGround(const Heightfield& ground, double verticalScale, GroundPaint paint,
                          const TerrainLook& look, Progress& progress, double density) {
    const bool shade = paint == GroundPaint::Hillshade;
    const Gradients gradients(ground, shade);
    const GroundLight light(look);
    const glm::dvec3 sun = towardsSun(look);
    const double unscale = 1 / verticalScale;
    const auto color = [&](int, int, const glm::dvec2& grid) {
        const glm::dvec2 shown = gradients.at(grid), own = unscale * shown;
        if (shade)
            return glm::vec3(linearFromSrgb(static_cast<float>(std::max(0.0, glm::dot(normalOf(own), sun)))));
        return light.at(normalOf(shown)) * (paint == GroundPaint::Slope ? slopeColor(own) : aspectColor(own));
    };
    ColorTexture texture =
        groundTexture(ground, groundTextureSize(ground, glm::dvec2(density)), color, progress);
    const char* const source = shade                         ? "a hillshade"
                               : paint == GroundPaint::Slope ? "slope, lit"
                                                             : "aspect and slope, lit";
    return {std::move(texture), source, shade || look.ambient < 1};
}

Legend legendOfPaint(GroundPaint paint) {
    switch (paint) {
        case GroundPaint::Slope:
            return {"slope", slopeEntries()};
        case GroundPaint::Aspect:
            return {"aspect, paler where less steep than 40 and 20 %", aspectEntries()};
        default:
            break;
    }
    return {};
}

}  // namespace stereonav
