#include "terrain/scene/map_tones.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "engine/image/packed_color.h"

namespace stereonav {
namespace {

using glm::vec3;

// A colour in sRGB at a share of the range.
struct MapStop {
    float share;
    std::uint32_t srgb;
};
constexpr std::array<MapStop, 7> kHypsometric{{{0.00f, 0x7b9c80},
                                               {0.15f, 0x9ab18b},
                                               {0.32f, 0xbec09b},
                                               {0.50f, 0xc5b497},
                                               {0.68f, 0xb39d86},
                                               {0.85f, 0xb9ada4},
                                               {1.00f, 0xeceae8}}};
constexpr std::array<MapStop, 5> kSwiss{
    {{0.00f, 0x93aaa8}, {0.25f, 0xa0b09b}, {0.50f, 0xb0b394}, {0.75f, 0xc2b99b}, {1.00f, 0xd8cfbd}}};
// Half as dark as on paper: light falls on it.
constexpr float kUnderLight = 0.55f;
const vec3 kGrey(0.27f);

vec3 linearOfStop(std::uint32_t srgb) {
    const auto channel = [&](int shift) {
        return linearFromSrgb(static_cast<float>(srgb >> shift & 255u) / 255.0f);
    };
    return {channel(16), channel(8), channel(0)};
}

// Linear light between stops, without kinks at them.
vec3 between(std::span<const MapStop> stops, float share) {
    std::size_t k = 1;
    while (k + 1 < stops.size() && share > stops[k].share) ++k;
    const float t =
        std::clamp((share - stops[k - 1].share) / (stops[k].share - stops[k - 1].share), 0.0f, 1.0f);
    return glm::mix(linearOfStop(stops[k - 1].srgb), linearOfStop(stops[k].srgb), t);
}

constexpr int kTable = 256;
using Table = std::array<vec3, kTable + 1>;

Table tableOfStops(std::span<const MapStop> stops) {
    Table table;
    for (int k = 0; k <= kTable; ++k) {
        vec3 sum(0.0f);
        // Averaged over a twentieth of the range: bands have no edges.
        constexpr int kAround = 6;
        for (int d = -kAround; d <= kAround; ++d)
            sum += between(stops, std::clamp(static_cast<float>(k + d) / kTable, 0.0f, 1.0f));
        table[k] = kUnderLight * sum / (2.0f * kAround + 1);
    }
    return table;
}

vec3 fromStops(const Table& table, float share) {
    const float x = std::clamp(share, 0.0f, 1.0f) * kTable;
    const int k = std::min(static_cast<int>(x), kTable - 1);
    return glm::mix(table[k], table[k + 1], x - static_cast<float>(k));
}

}  // namespace

vec3 hypsometricColor(float share) {
    static const Table table = tableOfStops(kHypsometric);
    return fromStops(table, share);
}

vec3 swissColor(float share, const glm::dvec3& normal) {
    static const Table table = tableOfStops(kSwiss);
    // Towards the north-west, 45 degrees high. Level ground counts as 0.
    const glm::dvec3 light(-0.5, 0.5, 0.70710678);
    const auto turned = static_cast<float>(glm::dot(normal, light) / light.z - 1);
    const float contrast = 0.35f + 0.65f * share;
    const float lit = contrast * std::clamp(turned, 0.0f, 1.0f),
                dark = contrast * std::clamp(-turned, 0.0f, 1.0f);
    vec3 color = fromStops(table, share) * (1.0f + lit * vec3(0.42f, 0.34f, 0.10f)) *
                 (1.0f - dark * vec3(0.62f, 0.52f, 0.30f));
    const vec3 air(0.36f, 0.43f, 0.49f);
    const float far = (1 - share) * (1 - share);
    return glm::mix(color, air, 0.38f * far);
}

Legend legendOfPalette(GroundPalette palette, double low, double high) {
    if (palette != GroundPalette::Hypsometric || !(high > low)) return {};
    Legend legend{"height", {}};
    constexpr int kEntries = 5;
    for (int k = kEntries - 1; k >= 0; --k) {
        const float share = static_cast<float>(k) / (kEntries - 1);
        legend.entries.push_back({hypsometricColor(share) / kUnderLight,
                                  fmt::format("{:.4g} m", std::lerp(low, high, double(share)))});
    }
    return legend;
}

MapTones::MapTones(const Heightfield& part, const TintPlace& place, const Heightfield& whole)
    : mPalette(place.palette), mShape(part, whole, 1 / place.verticalScale), mLow(whole.minHeight()) {
    const double range = double(whole.maxHeight()) - mLow;
    mPerMetre = range > 0 ? 1 / range : 0;
}

GroundTone MapTones::at(const glm::dvec2& grid, double height) const {
    const GroundShape::Site site = mShape.siteAt(grid);
    const glm::dvec3 normal = site.normal();
    if (mPalette == GroundPalette::Grey) return {kGrey, normal};
    const double above = std::isfinite(height) ? (height - mLow) * mPerMetre : 0.0;
    // Ridges are higher than their height, hollows lower: a little, as Imhof draws them.
    const auto share = static_cast<float>(std::clamp(above - 0.03 * site.hollow, 0.0, 1.0));
    return {mPalette == GroundPalette::Swiss ? swissColor(share, normal) : hypsometricColor(share), normal};
}

}  // namespace stereonav
