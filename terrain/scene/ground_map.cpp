#include "terrain/scene/ground_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "engine/base/parallel.h"
#include "terrain/scene/terrain_illumination.h"

namespace stereonav {
namespace {

constexpr int kReads = 4;             // heights a pixel, each way
constexpr double kUsualSlope = 0.35;  // slope of a relief that is well seen
constexpr double kMostRaised = 6;     // times that flatter ground is raised by for its shades
constexpr double kShadeShare = 0.8;   // share of the light's variation that is laid over colours
constexpr int kHatch = 3;             // pixels of a hatch's stripe
constexpr float kHatchDark = 0.02f, kHatchLight = 0.16f;  // linear
constexpr const char* kDrawing = "drawing the map";

// Returns a direction to the north-west, half way up: relief maps are lit from there.
glm::dvec3 mapSun() {
    return glm::normalize(glm::dvec3(-1, 1, std::numbers::sqrt2));
}

glm::dvec2 worldOf(const GroundMap& map, double x, double y) {
    return map.northWest + map.metresPerPixel * glm::dvec2(x, -y);
}

// Mean heights; NaN where most of the pixel is open.
Plane<float> coarseHeights(const Heightfield& ground, const GroundMap& map, Progress& progress) {
    Plane<float> heights(map.picture.width(), map.picture.height());
    ProgressSteps rows(progress, heights.height(), kDrawing);
    parallelFor(heights.height(), [&](int y) {
        if (progress.cancelled()) throw Cancelled();
        for (int x = 0; x < heights.width(); ++x) {
            double sum = 0;
            int count = 0;
            for (int k = 0; k < kReads * kReads; ++k) {
                const int column = k % kReads, row = k / kReads;
                const double height =
                    ground.heightAt(worldOf(map, x + (column + 0.5) / kReads, y + (row + 0.5) / kReads));
                if (!std::isfinite(height)) continue;
                sum += height;
                ++count;
            }
            heights.at(x, y) = 2 * count > kReads * kReads ? static_cast<float>(sum / count)
                                                           : std::numeric_limits<float>::quiet_NaN();
        }
        rows.done();
    });
    return heights;
}

// Metres a pixel, one-sided beside holes and borders.
double stepOf(float before, float here, float after) {
    if (std::isfinite(before) && std::isfinite(after)) return 0.5 * (double(after) - before);
    if (std::isfinite(after)) return double(after) - here;
    if (std::isfinite(before)) return double(here) - before;
    return 0;
}

// Eastwards and northwards, metres a metre.
glm::dvec2 slopeAt(const Plane<float>& heights, int x, int y, double metresPerPixel) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    const auto at = [&](int i, int j) {
        return i < 0 || j < 0 || i >= heights.width() || j >= heights.height() ? kNone : heights.at(i, j);
    };
    const float here = heights.at(x, y);
    return glm::dvec2(stepOf(at(x - 1, y), here, at(x + 1, y)), stepOf(at(x, y + 1), here, at(x, y - 1))) /
           metresPerPixel;
}

// How much the heights are raised for their shades: flat ground more.
double raiseOf(const Plane<float>& heights, double metresPerPixel) {
    double sum = 0, count = 0;
    for (int y = 0; y < heights.height(); ++y)
        for (int x = 0; x < heights.width(); ++x) {
            if (!std::isfinite(heights.at(x, y))) continue;
            const glm::dvec2 slope = slopeAt(heights, x, y, metresPerPixel);
            sum += glm::dot(slope, slope);
            ++count;
        }
    const double usual = count > 0 ? std::sqrt(sum / count) : 0;
    return std::clamp(kUsualSlope / std::max(usual, 1e-9), 1.0, kMostRaised);
}

// 1 on level ground.
double shadeOf(const glm::dvec2& slope) {
    const glm::dvec3 sun = mapSun(), normal = glm::normalize(glm::dvec3(-slope, 1));
    return 1 + kShadeShare * (std::max(0.0, glm::dot(normal, sun)) / sun.z - 1);
}

struct MapColors {
    const ColorTexture& texture;
    bool shaded = false;  // by the relief: there is no sun in them
    double level = 0;     // level of the texture
};

// Under baked light the shown colours change with the sun; those without light stay.
MapColors colorsOf(const TerrainScene& terrain, double metresPerPixel) {
    const bool baked = terrain.illumination != nullptr;
    const ColorTexture& texture = baked ? terrain.illumination->albedo() : terrain.color;
    const glm::dvec2 texel = texture.gridPerTexel() * terrain.ground.spacing();
    const double level = std::log2(metresPerPixel / std::sqrt(texel.x * texel.y));
    return {texture, baked || !terrain.report.colorHoldsSun, std::max(level, 0.0)};
}

PackedColor hatchAt(int x, int y) {
    return packColor(glm::vec3((x + y) / kHatch % 2 == 0 ? kHatchDark : kHatchLight));
}

}  // namespace

GroundMap mapOfGround(const TerrainScene& terrain, int most, Progress& progress) {
    const Heightfield& ground = terrain.ground;
    const glm::dvec2 extent = ground.spacing() * glm::dvec2(ground.width() - 1, ground.height() - 1);
    most = std::clamp(most, 1, kMostMapPixels);
    GroundMap map;
    map.metresPerPixel = std::max(extent.x, extent.y) / most;
    map.northWest = ground.originWorld() + glm::dvec2(0, extent.y);
    const auto side = [&](double length) {
        return std::clamp(static_cast<int>(std::lround(length / map.metresPerPixel)), 1, most);
    };
    map.picture.resize(side(extent.x), side(extent.y));
    Progress reading(progress, 0, 0.7), drawing(progress, 0.7, 1);
    const Plane<float> heights = coarseHeights(ground, map, reading);
    const MapColors colors = colorsOf(terrain, map.metresPerPixel);
    const double raise = raiseOf(heights, map.metresPerPixel);
    ProgressSteps rows(drawing, map.picture.height(), kDrawing);
    parallelFor(map.picture.height(), [&](int y) {
        if (progress.cancelled()) throw Cancelled();
        for (int x = 0; x < map.picture.width(); ++x) {
            if (!std::isfinite(heights.at(x, y))) {
                map.picture.at(x, y) = hatchAt(x, y);
                continue;
            }
            glm::vec3 color =
                colors.texture.at(ground.gridFromWorld(worldOf(map, x + 0.5, y + 0.5)), colors.level);
            if (colors.shaded)
                color *= static_cast<float>(shadeOf(raise * slopeAt(heights, x, y, map.metresPerPixel)));
            map.picture.at(x, y) = packColor(color);
        }
        rows.done();
    });
    return map;
}

}  // namespace stereonav
