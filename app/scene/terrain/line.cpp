#include "app/scene/terrain/line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <memory>

#include "app/scene/terrain/ground_figures.h"
#include "engine/base/error.h"
#include "engine/text/length_text.h"
#include "terrain/scene/tiled_ground.h"
#include "terrain/survey/ground_line.h"
#include "terrain/survey/ground_samples.h"
#include "terrain/survey/sight_line.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostPlaces = 4000;  // largest number of places of a drawn line

// Returns an evenly thinned list with the same first and last elements.
template <typename T>
std::vector<T> thinned(const std::vector<T>& all) {
    if (all.size() <= kMostPlaces) return all;
    std::vector<T> some;
    for (std::size_t n = 0; n < kMostPlaces; ++n)
        some.push_back(all[n * (all.size() - 1) / (kMostPlaces - 1)]);
    return some;
}

void checkOnGround(const TerrainScene& terrain, const glm::dvec2& world) {
    if (terrain.tiled ? terrain.tiled->levels->contains(world) : terrain.ground.contains(world)) return;
    throw Error("", "a place of the line", "lies beside the ground", "choose another one");
}

}  // namespace

GroundSamples TerrainLine::samplesFor(double count) const {
    if (!mTerrain.tiled) return GroundSamples(mTerrain.ground).dividedBy(mTerrain.verticalScale);
    const GroundLevels& levels = *mTerrain.tiled->levels;
    int level = 0;
    for (; count > kMostCoarseSamples && level + 1 < levels.count(); ++level) count /= 4;
    return GroundSamples(std::make_shared<SurveyTiles>(mTerrain.tiled->levels, level))
        .dividedBy(mTerrain.verticalScale);
}

// Adds the sample spacing where the ground has other samples, finer or coarser.
void TerrainLine::addSpacing(const GroundSamples& samples, Facts& facts) const {
    if (!mTerrain.tiled && !mTerrain.standIn) return;
    const glm::dvec2 finest = mTerrain.tiled ? mTerrain.tiled->levels->spacing(0) : mTerrain.standIn->spacing;
    const double spacing = samples.spacing().x;
    facts.push_back(factForAll(
        "sample_spacing_m", spacing, "measured on",
        fmt::format("samples {} apart{}", lengthText(spacing),
                    spacing > finest.x ? ", the finest are " + lengthText(finest.x) : ", the finest"),
        "m"));
}

MeasuredSurface TerrainLine::measure(const std::vector<glm::dvec3>& places, bool closed,
                                     Progress& progress) const {
    constexpr const char* kMeasuring = "measuring";
    progress.report(0, kMeasuring);
    std::vector<glm::dvec2> world;
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec3& place : places) {
        world.emplace_back(place);
        checkOnGround(mTerrain, world.back());
        low = glm::min(low, world.back()), high = glm::max(high, world.back());
    }
    const glm::dvec2 finest = mTerrain.tiled ? mTerrain.tiled->levels->spacing(0) : mTerrain.ground.spacing();
    const glm::dvec2 sides = (high - low) / finest;
    const GroundSamples ground = samplesFor(closed ? sides.x * sides.y : 0);
    MeasuredSurface measured;
    FactList list;
    for (const GroundFigure& figure :
         closed ? figuresOfArea(ground, world, std::nullopt,
                                [&](double share) { progress.report(share, kMeasuring); })
                : figuresOfLine(ground, world))
        list.both(figure.key, figure.value, figure.label, figureText(figure), figure.unit);
    measured.facts = std::move(list.facts());
    addSpacing(ground, measured.facts);
    if (closed) world.push_back(world.front());
    bool known = false;
    for (const LinePoint& point : thinned(groundLine(ground, world))) {
        measured.places.emplace_back(point.world, mTerrain.verticalScale * point.height);
        measured.profile.emplace_back(point.distance, point.height);
        known = known || std::isfinite(point.height);
    }
    if (!known) throw Error("", "the ground there", "no height is known", "choose another place");
    progress.report(1, kMeasuring);
    return measured;
}

// Returns the line of sight as `viewshed --to` does, over a round Earth where pictures have one
// (--curvature).
Facts TerrainLine::sight(const glm::dvec3& from, const glm::dvec3& to, double height) const {
    const GroundSamples ground = samplesFor(0);
    const auto above = [&](const glm::dvec3& place) {
        const glm::dvec2 world(place);
        checkOnGround(mTerrain, world);
        return glm::dvec3(ground.gridFromWorld(world), ground.heightAt(world) + height);
    };
    const glm::dvec3 eye = above(from), target = above(to);
    if (!std::isfinite(eye.z) || !std::isfinite(target.z)) return {};
    const Sight sight = sightOver(ground, mTerrain.lens.fall / mTerrain.verticalScale, eye, target);
    FactList list;
    list.both(
        "sees", sight.seen, fmt::format("line of sight, {:.4g} m up", height),
        fmt::format("{}: {} {} the ground, {} from the first", sight.seen ? "they see each other" : "hidden",
                    lengthText(std::abs(sight.clearance)), sight.clearance < 0 ? "under" : "over",
                    lengthText(sight.at)));
    return std::move(list.facts());
}

}  // namespace stereonav
