// Lines and areas on a terrain that is flown over.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/output/length_text.h"
#include "app/scene/ground_figures.h"
#include "app/scene/shown_terrain.h"
#include "terrain/ground/height_pyramid.h"
#include "terrain/survey/ground_line.h"
#include "terrain/survey/sight_line.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostPlaces = 4000;  // of a line as it is drawn

// Evenly thinned, first and last kept.
template <typename T>
std::vector<T> thinned(const std::vector<T>& all) {
    if (all.size() <= kMostPlaces) return all;
    std::vector<T> some;
    for (std::size_t n = 0; n < kMostPlaces; ++n)
        some.push_back(all[n * (all.size() - 1) / (kMostPlaces - 1)]);
    return some;
}

}  // namespace

MeasuredSurface TerrainSurvey::measure(const std::vector<glm::dvec3>& places, bool closed) const {
    const double scale = mTerrain.verticalScale;
    std::vector<glm::dvec2> world;
    for (const glm::dvec3& place : places) world.emplace_back(place);
    glm::dvec2 shift;
    const Heightfield cut = cutGround(mTerrain.ground, world, scale, shift);
    for (glm::dvec2& place : world) place -= shift;
    MeasuredSurface measured;
    FactList list;
    for (const GroundFigure& figure :
         closed ? figuresOfArea(cut, world, std::nullopt) : figuresOfLine(cut, world))
        list.both(figure.key, figure.value, figure.label,
                  fmt::format("{:.1f} {}{}", figure.value, figure.unit, errorText(figure)), figure.unit);
    measured.facts = std::move(list.facts());
    if (closed) world.push_back(world.front());
    for (const LinePoint& point : thinned(groundLine(cut, world))) {
        measured.places.emplace_back(point.world + shift, scale * point.height);
        measured.profile.emplace_back(point.distance, point.height);
    }
    return measured;
}

// As `viewshed --to` has it; over a round Earth where pictures are (--curvature).
Facts TerrainSurvey::sight(const glm::dvec3& from, const glm::dvec3& to, double height) const {
    glm::dvec2 shift;
    const Heightfield cut =
        cutGround(mTerrain.ground, {glm::dvec2(from), glm::dvec2(to)}, mTerrain.verticalScale, shift);
    const auto above = [&](const glm::dvec3& place) {
        const glm::dvec2 world = glm::dvec2(place) - shift;
        return glm::dvec3(cut.gridFromWorld(world), cut.heightAt(world) + height);
    };
    const glm::dvec3 eye = above(from), target = above(to);
    if (!std::isfinite(eye.z) || !std::isfinite(target.z)) return {};
    const HeightPyramid maxima(cut);
    const Sight sight =
        SightLines(cut, maxima, mTerrain.lens.fall / mTerrain.verticalScale).measure(eye, target);
    FactList list;
    list.both(
        "sees", sight.seen, fmt::format("line of sight, {:.4g} m up", height),
        fmt::format("{}: {} {} the ground, {} from the first", sight.seen ? "they see each other" : "hidden",
                    lengthText(std::abs(sight.clearance)), sight.clearance < 0 ? "under" : "over",
                    lengthText(sight.at)));
    return std::move(list.facts());
}

}  // namespace stereonav
