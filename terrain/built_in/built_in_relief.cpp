// Builds the relief from coarse to fine: rivers find their network on a small grid and refine it.
#include "terrain/built_in/built_in_relief.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "terrain/built_in/erosion.h"
#include "terrain/built_in/noise.h"

namespace stereonav {
namespace {

// Highest summit, metres.
constexpr float kSummit = 2500.0f;
// Slope of a river that drains a square kilometre under full uplift: sets the relief of the valleys.
constexpr float kRiverSlope = 0.75f;
constexpr float kErodibility = 1.0f / (kRiverSlope * 1000.0f);
// Drainage from which a channel counts as a river, square metres.
constexpr float kRiverDrainage = 1.2e6f;
constexpr float kFarFromRiver = 4.0f;

// Seeds of the many noises, unrelated to each other for neighbouring seeds (SplitMix64's final mix).
std::uint64_t mixedSeed(std::uint64_t seed, std::uint64_t purpose) {
    std::uint64_t x = seed * 0x9e3779b97f4a7c15ull + purpose * 0xd1b54a32d192ed03ull;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ x >> 27) * 0x94d049bb133111ebull;
    return x ^ x >> 31;
}

// Place of a sample in [0, 1]^2, bent by noise so that nothing follows the grid.
struct Place {
    float x, y;
};

float upliftAt(const Noise& noise, const Noise& bend, Place p) {
    const float edge = std::min({p.x, p.y, 1 - p.x, 1 - p.y});
    const float wx = p.x + 0.16f * bend.fractal(2.1f * p.x, 2.1f * p.y, 3);
    const float wy = p.y + 0.16f * bend.fractal(2.1f * p.x + 31, 2.1f * p.y + 7, 3);
    const float angle = 3.14159265f * noise.white(3, 5);
    const float across = (wx - 0.5f) * std::sin(angle) - (wy - 0.5f) * std::cos(angle);
    const auto belt = [&](float centre, float width) {
        const float t = (across - centre) / width;
        return std::exp(-t * t);
    };
    const float range = std::max(belt(0.06f, 0.20f), 0.55f * belt(-0.36f, 0.13f));
    const float blocks = 0.75f + 0.5f * noise.fractal(4.3f * wx, 4.3f * wy, 3);
    const float fade = smoothStep(0.0f, 0.16f, edge + 0.12f * bend.fractal(3 * p.x, 3 * p.y + 50, 3));
    return std::max(0.0f, fade * (0.10f + range * blocks));
}

Landscape emptyLandscape(std::uint64_t seed, int size) {
    Landscape land;
    land.size = size;
    land.spacing = kBuiltInExtent / static_cast<float>(size - 1);
    const std::size_t count = static_cast<std::size_t>(size) * size;
    land.height.assign(count, 0.0f);
    land.uplift.resize(count);
    land.talus.resize(count);
    const Noise blocks(mixedSeed(seed, 1)), bend(mixedSeed(seed, 2)), rock(mixedSeed(seed, 3));
    parallelFor(size, [&](int j) {
        for (int i = 0; i < size; ++i) {
            const Place p{static_cast<float>(i) / static_cast<float>(size - 1),
                          static_cast<float>(j) / static_cast<float>(size - 1)};
            const std::size_t k = static_cast<std::size_t>(j) * size + i;
            land.uplift[k] = upliftAt(blocks, bend, p);
            land.talus[k] = 0.72f + 0.50f * rock.fractal(7 * p.x, 7 * p.y, 4);
        }
    });
    return land;
}

// The level of the plains around the mountains, to which all rivers fall.
float baseLevel(const Noise& noise, Place p) {
    return std::max(0.0f, 15.0f + 30.0f * noise.fractal(3 * p.x, 3 * p.y, 4));
}

float bilinear(const std::vector<float>& plane, int size, float x, float y) {
    const float cx = std::clamp(x, 0.0f, static_cast<float>(size - 1));
    const float cy = std::clamp(y, 0.0f, static_cast<float>(size - 1));
    const int i = std::min(static_cast<int>(cx), size - 2), j = std::min(static_cast<int>(cy), size - 2);
    const float u = cx - static_cast<float>(i), v = cy - static_cast<float>(j);
    const float* south = &plane[static_cast<std::size_t>(j) * size + i];
    const float* north = south + size;
    return (south[0] * (1 - u) + south[1] * u) * (1 - v) + (north[0] * (1 - u) + north[1] * u) * v;
}

// Sets heights before the first level: the base level everywhere.
void startHeights(Landscape& land, std::uint64_t seed) {
    const Noise base(mixedSeed(seed, 4));
    const float step = 1.0f / static_cast<float>(land.size - 1);
    for (int j = 0; j < land.size; ++j)
        for (int i = 0; i < land.size; ++i)
            land.height[static_cast<std::size_t>(j) * land.size + i] =
                baseLevel(base, {static_cast<float>(i) * step, static_cast<float>(j) * step});
}

// The coarse ground on the fine grid. Its straight valleys, which follow the coarse grid, are bent,
// and unevenness below the coarse spacing is added for new streams to find. The border stays.
void refine(const Landscape& coarse, Landscape& fine, std::uint64_t seed) {
    const Noise base(mixedSeed(seed, 4)), noise(mixedSeed(seed, 100 + fine.size));
    const float scale = static_cast<float>(coarse.size - 1) / static_cast<float>(fine.size - 1);
    const float step = 1.0f / static_cast<float>(fine.size - 1);
    parallelFor(fine.size, [&](int j) {
        for (int i = 0; i < fine.size; ++i) {
            const float x = static_cast<float>(i) * scale, y = static_cast<float>(j) * scale;
            const float bent = 1.6f, wave = 0.21f;  // coarse samples, and 1 / coarse samples
            const float bx = x + bent * noise.fractal(wave * x, wave * y, 3);
            const float by = y + bent * noise.fractal(wave * x + 57, wave * y + 29, 3);
            const float rough = 0.12f * coarse.spacing * noise.fractal(0.7f * x, 0.7f * y + 80, 3);
            const bool border = i == 0 || j == 0 || i == fine.size - 1 || j == fine.size - 1;
            fine.height[static_cast<std::size_t>(j) * fine.size + i] =
                border ? baseLevel(base, {static_cast<float>(i) * step, static_cast<float>(j) * step})
                       : std::max(0.0f, bilinear(coarse.height, coarse.size, bx, by) + rough);
        }
    });
}

// Grid sizes from coarse to fine; each has about twice the samples a side of the one before.
std::vector<int> levelSizes(int size) {
    std::vector<int> sizes{size};
    while (sizes.back() > 96) sizes.push_back((sizes.back() - 1) / 2 + 1);
    std::reverse(sizes.begin(), sizes.end());
    return sizes;
}

// Rivers along the border may have cut below it: the rim left standing is taken away.
void lowerBorder(Landscape& land) {
    const int n = land.size;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const int ix = std::clamp(x, 1, n - 2), iy = std::clamp(y, 1, n - 2);
            land.height[static_cast<std::size_t>(y) * n + x] =
                land.height[static_cast<std::size_t>(iy) * n + ix];
        }
}

Landscape evolve(std::uint64_t seed, int size, Progress& progress) {
    Landscape land;
    const auto sizes = levelSizes(size);
    for (std::size_t level = 0; level < sizes.size(); ++level) {
        Landscape next = emptyLandscape(seed, sizes[level]);
        if (level == 0)
            startHeights(next, seed);
        else
            refine(land, next, seed);
        land = std::move(next);
        fillDepressions(land);
        // The network is found while the grid is small; later levels only refine it.
        const int rounds = level == 0 ? 90 : level == 1 ? 30 : level == 2 ? 14 : 9;
        for (int k = 0; k < rounds; ++k) {
            erode(land, level == 0 ? 160.0f : 80.0f, kErodibility, seed);
            progress.report(0.8 * (static_cast<double>(level) + double(k) / rounds) / double(sizes.size()),
                            "raising mountains");
        }
    }
    lowerBorder(land);
    return land;
}

// Distance to the nearest river in half widths of its valley floor, and that river's height.
struct Valleys {
    std::vector<float> distance, floorHeight;
};

Valleys findValleys(const Landscape& land) {
    const int n = land.size;
    Valleys valleys{std::vector<float>(land.height.size(), kFarFromRiver),
                    std::vector<float>(land.height.size(), 0.0f)};
    for (int y = 1; y < n - 1; ++y)
        for (int x = 1; x < n - 1; ++x) {
            const std::size_t river = static_cast<std::size_t>(y) * n + x;
            if (land.drainage[river] < kRiverDrainage) continue;
            // Floors widen with the root of the drainage: 45 m at a square kilometre.
            const float halfWidth = 45.0f * std::sqrt(land.drainage[river] * 1e-6f);
            const int reach = std::min(n, static_cast<int>(kFarFromRiver * halfWidth / land.spacing));
            for (int ny = std::max(0, y - reach); ny <= std::min(n - 1, y + reach); ++ny)
                for (int nx = std::max(0, x - reach); nx <= std::min(n - 1, x + reach); ++nx) {
                    const float d = land.spacing * std::hypot(float(nx - x), float(ny - y)) / halfWidth;
                    const std::size_t k = static_cast<std::size_t>(ny) * n + nx;
                    if (d >= valleys.distance[k]) continue;
                    valleys.distance[k] = d;
                    valleys.floorHeight[k] = land.height[river];
                }
        }
    return valleys;
}

// Rivers wander over their valley floors and make them flat.
void widenValleys(Landscape& land, const Valleys& valleys) {
    for (std::size_t k = 0; k < land.height.size(); ++k) {
        const float inside = 1 - smoothStep(0.5f, 1.8f, valleys.distance[k]);
        const float floorHeight = valleys.floorHeight[k] + 3.0f * valleys.distance[k];
        land.height[k] += inside * (std::min(land.height[k], floorHeight) - land.height[k]);
    }
}

// Final shape: the grid's directions bent away, and detail below the scale of the rivers, rougher
// where it is steep.
Relief finished(const Landscape& land, const Valleys& valleys, std::uint64_t seed) {
    const int n = land.size;
    const std::size_t count = land.height.size();
    Relief relief{n, land.spacing, std::vector<float>(count), std::vector<float>(count),
                  std::vector<float>(count)};
    const Noise bend(mixedSeed(seed, 6)), detail(mixedSeed(seed, 7));
    parallelFor(n, [&](int j) {
        for (int i = 0; i < n; ++i) {
            const float mx = static_cast<float>(i) * land.spacing, my = static_cast<float>(j) * land.spacing;
            const float x = i + 70.0f / land.spacing * bend.fractal(mx / 520, my / 520, 3);
            const float y = j + 70.0f / land.spacing * bend.fractal(mx / 520 + 91, my / 520 + 13, 3);
            const std::size_t k = static_cast<std::size_t>(j) * n + i;
            const float h = bilinear(land.height, n, x, y);
            const float east = bilinear(land.height, n, x + 1, y) - bilinear(land.height, n, x - 1, y);
            const float north = bilinear(land.height, n, x, y + 1) - bilinear(land.height, n, x, y - 1);
            const float slope = std::hypot(east, north) / (2 * land.spacing);
            const float crags = detail.ridged(mx / 310, my / 310, 4) - 0.45f;
            const float rough = 4.0f + 75.0f * smoothStep(0.15f, 0.9f, slope);
            relief.drainage[k] = bilinear(land.drainage, n, x, y);
            relief.riverDistance[k] = bilinear(valleys.distance, n, x, y);
            relief.heights[k] = h + rough * crags * smoothStep(0.8f, 3.0f, relief.riverDistance[k]);
        }
    });
    return relief;
}

}  // namespace

Relief makeRelief(std::uint64_t seed, int size, Progress& progress) {
    Landscape land = evolve(seed, size, progress);
    const Valleys valleys = findValleys(land);
    widenValleys(land, valleys);
    progress.report(0.85, "shaping valleys");
    Relief relief = finished(land, valleys, seed);
    const auto [low, high] = std::minmax_element(relief.heights.begin(), relief.heights.end());

    const float base = *low, scale = kSummit / std::max(1.0f, *high - base);
    for (float& h : relief.heights) h = (h - base) * scale;
    progress.report(1, "shaping valleys");
    return relief;
}

}  // namespace stereonav
