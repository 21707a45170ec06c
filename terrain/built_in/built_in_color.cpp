// Two passes: light on the samples (it is smooth), then cover and small-scale relief on the texels.
#include "terrain/built_in/built_in_color.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/parallel.h"
#include "terrain/built_in/noise.h"
#include "terrain/read/scene_file.h"

namespace stereonav {
namespace {

using glm::mix;
using glm::vec3;

// Albedos, linear RGB, after photographs of the Alps in summer.
constexpr vec3 kMeadow{0.125f, 0.165f, 0.045f}, kField{0.235f, 0.215f, 0.085f},
    kForest{0.034f, 0.060f, 0.022f};
constexpr vec3 kHeath{0.150f, 0.140f, 0.058f}, kRock{0.200f, 0.180f, 0.160f},
    kDarkRock{0.125f, 0.112f, 0.102f};
constexpr vec3 kScree{0.290f, 0.270f, 0.245f}, kSnow{0.80f, 0.83f, 0.88f}, kGravel{0.330f, 0.315f, 0.290f};
constexpr vec3 kWater{0.030f, 0.075f, 0.085f};

// Light on a level white surface: about 0.9 together, so that snow in the sun stays below 1.
constexpr vec3 kSunLight{1.15f, 1.07f, 0.92f}, kSkyLight{0.30f, 0.35f, 0.43f};

// A plane of the relief by continuous sample coordinates, clamped.
class Sampler {
public:
    Sampler(const std::vector<float>& plane, int size) : mPlane(plane), mSize(size) {}
    float at(float x, float y) const {
        const float top = static_cast<float>(mSize - 1);
        const float cx = std::clamp(x, 0.0f, top), cy = std::clamp(y, 0.0f, top);
        const int i = std::min(static_cast<int>(cx), mSize - 2),
                  j = std::min(static_cast<int>(cy), mSize - 2);
        const float u = cx - static_cast<float>(i), v = cy - static_cast<float>(j);
        const float* south = &mPlane[static_cast<std::size_t>(j) * mSize + i];
        const float* north = south + mSize;
        return (south[0] * (1 - u) + south[1] * u) * (1 - v) + (north[0] * (1 - u) + north[1] * u) * v;
    }

private:
    const std::vector<float>& mPlane;
    int mSize;
};

vec3 directionToSun(const TerrainLook& look) {
    const auto azimuth = static_cast<float>(look.sunAzimuth), up = static_cast<float>(look.sunElevation);
    return {std::cos(up) * std::sin(azimuth), std::cos(up) * std::cos(azimuth), std::sin(up)};
}

// Share of the sun seen from a sample: marches towards it; the closest approach of the ground to the
// ray, over the distance, against the sun's (widened) radius gives a soft edge.
float sunSeen(const Relief& relief, const Sampler& height, int i, int j, const vec3& sun) {
    constexpr float kSunRadius = 0.05f;  // radians; the true one is 0.005
    const float level = std::hypot(sun.x, sun.y), rise = sun.z / level;
    const float start = relief.heights[static_cast<std::size_t>(j) * relief.size + i];
    float seen = 1;
    for (float d = 1.5f; d < static_cast<float>(relief.size); d *= 1.07f, d += 0.5f) {
        const float metres = d * relief.spacing, ray = start + metres * rise;
        if (ray > 2600.0f) break;
        const float ground = height.at(i + d * sun.x / level, j + d * sun.y / level);
        seen = std::min(seen, 0.5f + (ray - ground) / (2 * kSunRadius * metres));
        if (seen <= 0) return 0;
    }
    return std::clamp(seen, 0.0f, 1.0f);
}

// Share of the sky seen: the mean height of the surrounding horizon, in eight directions.
float skySeen(const Relief& relief, const Sampler& height, int i, int j) {
    constexpr float kSlant = 0.70710678f;  // sqrt(1/2)
    constexpr float kX[8] = {1, kSlant, 0, -kSlant, -1, -kSlant, 0, kSlant};
    constexpr float kY[8] = {0, kSlant, 1, kSlant, 0, -kSlant, -1, -kSlant};
    const float start = relief.heights[static_cast<std::size_t>(j) * relief.size + i];
    float blocked = 0;
    for (int k = 0; k < 8; ++k) {
        float steepest = 0;
        for (float d = 1; d < 30; d *= 2.1f)
            steepest =
                std::max(steepest, (height.at(i + d * kX[k], j + d * kY[k]) - start) / (d * relief.spacing));
        blocked += steepest * steepest / (1 + steepest * steepest);  // sin^2 of the horizon's height
    }
    return 1 - blocked / 8;
}

struct Light {
    std::vector<float> sun, sky;  // shares at the samples, 0 to 1
};

Light bakeLight(const Relief& relief, const vec3& sun) {
    Light light{std::vector<float>(relief.heights.size()), std::vector<float>(relief.heights.size())};
    const Sampler height(relief.heights, relief.size);
    parallelFor(relief.size, [&](int j) {
        for (int i = 0; i < relief.size; ++i) {
            const std::size_t k = static_cast<std::size_t>(j) * relief.size + i;
            light.sun[k] = sunSeen(relief, height, i, j, sun);
            light.sky[k] = skySeen(relief, height, i, j);
        }
    });
    return light;
}

// Properties that are smooth enough to be kept at the samples and interpolated between them.
struct Site {
    float height = 0, river = 0, drainage = 0;  // metres, half valley floors, square metres
    float east = 0, north = 0;                  // gradient, metres a metre
    float sun = 0, sky = 0;                     // shares seen
    float broad = 0, patch = 0;                 // noise, -1 to 1: kilometres and hundreds of metres
};

// Detail of a texel within its cell: finer noise, -1 to 1.
struct Detail {
    float mx, my;  // metres from the south-west corner
    float grain;
    vec3 normal;  // with small-scale relief
};

glm::vec2 gradientAt(const Sampler& height, int i, int j, float spacing) {
    const auto x = static_cast<float>(i), y = static_cast<float>(j);
    return glm::vec2(height.at(x + 1, y) - height.at(x - 1, y), height.at(x, y + 1) - height.at(x, y - 1)) /
           (2 * spacing);
}

std::vector<Site> surveyed(const Relief& relief, const Light& light, const Noise& noise) {
    std::vector<Site> sites(relief.heights.size());
    const Sampler height(relief.heights, relief.size);
    parallelFor(relief.size, [&](int j) {
        for (int i = 0; i < relief.size; ++i) {
            const std::size_t k = static_cast<std::size_t>(j) * relief.size + i;
            const float mx = static_cast<float>(i) * relief.spacing;
            const float my = static_cast<float>(j) * relief.spacing;
            const glm::vec2 gradient = gradientAt(height, i, j, relief.spacing);
            sites[k] = {relief.heights[k],
                        relief.riverDistance[k],
                        relief.drainage[k],
                        gradient.x,
                        gradient.y,
                        light.sun[k],
                        light.sky[k],
                        noise.fractal(mx / 900, my / 900, 4),
                        noise.fractal(mx / 260 + 40, my / 260, 3)};
        }
    });
    return sites;
}

Site between(const Site& a, const Site& b, float t) {
    const auto mixed = [t](float p, float q) { return p + t * (q - p); };
    return {mixed(a.height, b.height), mixed(a.river, b.river), mixed(a.drainage, b.drainage),
            mixed(a.east, b.east),     mixed(a.north, b.north), mixed(a.sun, b.sun),
            mixed(a.sky, b.sky),       mixed(a.broad, b.broad), mixed(a.patch, b.patch)};
}

Site siteAt(const std::vector<Site>& sites, int size, float x, float y) {
    const int i = std::min(static_cast<int>(x), size - 2), j = std::min(static_cast<int>(y), size - 2);
    const Site* south = &sites[static_cast<std::size_t>(j) * size + i];
    const Site* north = south + size;
    const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
    return between(between(south[0], south[1], u), between(north[0], north[1], u), v);
}

// Meadows, fields and forests.
vec3 greenCover(const Site& s, const Detail& d, float slope, const Noise& noise) {
    const float plot = noise.at(d.mx / 170 + 900, d.my / 170);
    vec3 color = mix(kMeadow, kField, smoothStep(0.05f, 0.25f, plot + 0.5f * s.broad) * 0.8f);
    color = mix(color, kHeath, smoothStep(1250.0f, 1700.0f, s.height + 320 * s.patch));
    const float dense = smoothStep(-0.12f, 0.10f, s.patch + 0.8f * s.broad + 1.1f * slope - 0.16f);
    const float line = 1 - smoothStep(1350.0f, 1560.0f, s.height + 380 * s.broad + 160 * s.patch);
    const float hold = 1 - smoothStep(0.85f, 1.15f, slope);
    const float dry = smoothStep(0.7f, 1.2f, s.river + 0.6f * s.patch);
    return mix(color, kForest * (1 + 0.75f * d.grain), dense * line * hold * dry);
}

// Scree where it is steep and high, rock where it is steeper, in bands of strata.
vec3 bareCover(const vec3& green, const Site& s, const Detail& d, float slope, const Noise& noise) {
    const float bare = slope + 0.22f * s.patch + 0.18f * d.grain + 0.00016f * (s.height - 1200);
    const float high = smoothStep(1250.0f, 1650.0f, s.height + 300 * s.broad);
    const vec3 color = mix(green, kScree * (1 + 0.2f * d.grain), smoothStep(0.62f, 0.80f, bare) * high);
    const float strata = noise.at(0.0035f * d.mx, 0.013f * (s.height + 0.12f * d.mx + 90 * s.patch));
    const vec3 rock = mix(kRock, kDarkRock, smoothStep(-0.35f, 0.45f, strata + 0.5f * s.patch));
    return mix(color, rock * (1 + 0.35f * d.grain), smoothStep(0.80f, 1.05f, bare));
}

// Snow lies high, longer on northern slopes and in hollows, and slides off walls.
float snowCover(const Site& s, const Detail& d, float slope) {
    const float line = 1800 - 260 * d.normal.y + 330 * s.patch + 120 * d.grain;
    return smoothStep(line, line + 180, s.height) * (1 - smoothStep(0.95f, 1.35f, slope + 0.2f * d.grain));
}

vec3 groundCover(const Site& s, const Detail& d, const Noise& noise) {
    const float slope = std::hypot(s.east, s.north);
    vec3 color = bareCover(greenCover(s, d, slope, noise), s, d, slope, noise);
    color = mix(color, kSnow, snowCover(s, d, slope));
    // Rivers: gravel banks and water, wider with the drainage.
    const float gravel = (1 - smoothStep(0.16f, 0.34f, s.river + 0.16f * s.patch)) *
                         (1 - smoothStep(1400.0f, 1800.0f, s.height));
    color = mix(color, kGravel * (1 + 0.2f * d.grain), 0.8f * gravel);
    const float water =
        (1 - smoothStep(0.10f, 0.16f, s.river + 0.03f * s.patch)) * smoothStep(3e6f, 6e6f, s.drainage);
    return mix(color, kWater, water);
}

// Normal with a small-scale relief added, rougher where it is steep.
vec3 texelNormal(const Site& s, const Noise& noise, float mx, float my) {
    const float rough = 0.10f + 0.35f * smoothStep(0.3f, 1.0f, std::hypot(s.east, s.north));
    const float east = rough * noise.fractal(mx / 75, my / 75, 2);
    const float north = rough * noise.fractal(mx / 75 + 33, my / 75 + 71, 2);
    return glm::normalize(vec3(-s.east + east, -s.north + north, 1.0f));
}

vec3 litBy(const Site& s, const vec3& normal, const vec3& toSun) {
    const float direct = std::max(0.0f, glm::dot(normal, toSun)) * s.sun;
    return kSunLight * direct + kSkyLight * s.sky * (0.5f + 0.5f * normal.z);
}

}  // namespace

Plane<PackedColor> makeBuiltInColor(const Relief& relief, std::uint64_t seed, const TerrainLook* look,
                                    Progress& progress) {
    progress.report(0, "lighting the ground");
    const Noise cover(seed * 31 + 11), bumps(seed * 31 + 12), grain(seed * 31 + 13);
    const vec3 toSun = directionToSun(look ? *look : TerrainLook());
    const std::vector<Site> sites = surveyed(relief, bakeLight(relief, toSun), cover);
    progress.report(0.4, "painting the ground");
    const int n = kBuiltInTexels * relief.size;
    Plane<PackedColor> color(n, n);
    const float scale = static_cast<float>(relief.size - 1) / static_cast<float>(n);
    parallelFor(n, [&](int row) {
        const float y = (static_cast<float>(n - 1 - row) + 0.5f) * scale;
        for (int column = 0; column < n; ++column) {
            const float x = (static_cast<float>(column) + 0.5f) * scale;
            const float mx = x * relief.spacing, my = y * relief.spacing;
            Site site = siteAt(sites, relief.size, x, y);
            site.patch += 0.0625f * cover.at(mx / 32, my / 32);
            const Detail detail{mx, my, 1.4f * grain.fractal(mx / 34, my / 34, 2),
                                texelNormal(site, bumps, mx, my)};
            const vec3 ground = groundCover(site, detail, cover);
            color.at(column, row) = packColor(look ? ground * litBy(site, detail.normal, toSun) : ground);
        }
    });
    progress.report(1.0, "painting the ground");
    return color;
}

}  // namespace stereonav
