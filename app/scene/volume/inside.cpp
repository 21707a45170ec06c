#include "app/scene/volume/inside.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "colon/built_in/built_in_colon.h"
#include "colon/flight/colon_flight.h"
#include "colon/study/study.h"
#include "engine/base/error.h"
#include "engine/light/bake/bake_file.h"
#include "engine/light/transfer/bake_texels.h"

namespace stereonav {
namespace {

constexpr double kInsideSeconds = 20;
constexpr double kLightSpacing = 0.05;     // metres along the centreline
constexpr std::size_t kMostLights = 4096;  // each costs a shadow ray at every vertex of every path

void refuseUnless(bool holds, const char* option, const std::string& problem, const std::string& advice) {
    if (!holds) throw Error(option, "", problem, advice);
}

}  // namespace

ColonInterior::ColonInterior(const ColonScene& colon) : mColon(colon) {
    double along = 0;
    for (const CentrelinePoint& point : colon.centreline.points) {
        if (!mLine.places.empty()) along += glm::length(point.position - mLine.places.back().world);
        mLine.places.push_back({point.position, along, point.segment});
    }
}

void ColonInterior::expectOutside(const char* option, const std::string& problem,
                                  const std::string& advice) const {
    throw Error(option, "", problem, advice);
}

// Hashes the study near the wall only: a colon from the cache is not known elsewhere.
std::uint64_t ColonInterior::content(Progress& progress) const {
    const GreyVolume& field = mColon.volume.field;
    TexelChoice wall;
    wall.lowest = wall.highest = mColon.volume.cells.isovalue;
    wall.region = region();
    return contentHashNear(field, *region(), wantedBricks(field, field.frame, wall, progress));
}

// Everything is permitted with --reach: rays of limited length meet light from outside again.
void ColonInterior::checkLight(const BakeOptions& options, BakeKind kind) const {
    if (options.reach_mm) return;
    const std::string advice =
        fmt::format("{}{} centreline, or --reach",
                    kind == BakeKind::Irradiance ? "add " : "bake irradiance with ", options.words.light);
    refuseUnless(kind != BakeKind::Transfer, "--what",
                 fmt::format("{} is 0 everywhere inside a colon, which is closed", nameOf(kind)), advice);
    refuseUnless(
        kind == BakeKind::Openness || !options.lights.empty() || (options.probe.empty() && !options.sky),
        options.probe.empty() ? "--sky" : options.words.probe,
        "nothing of it is seen inside a colon, which is closed", advice);
}

void ColonInterior::checkLazyLight(bool transfer, bool sky) const {
    refuseUnless(!transfer, "--light", "lazy-transfer is 0 everywhere inside a colon, which is closed",
                 "use lazy, which lights it along its centreline");
    refuseUnless(!sky, "--sky", "nothing of it is seen inside a colon, which is closed",
                 "leave it out: lazy lights a colon along its centreline");
}

// Adds lamps along the centreline. Their intensity lights a wall at the lumen's mean radius like a sky of 1.
void ColonInterior::addLine(const std::optional<double>& asked, const char* option, LightSetup& setup) const {
    const std::vector<CentrelinePoint>& points = mColon.centreline.points;
    const double radius = meanRadius();
    const auto intensity = static_cast<float>(std::numbers::pi * radius * radius);
    double spacing = asked.value_or(kLightSpacing);
    if (spacing == kLightSpacing) spacing = std::min(spacing, mColon.centreline.length());  // at least one
    double along = 0.5 * spacing;  // distance since the last lamp
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (n > 0) along += glm::length(points[n].position - points[n - 1].position);
        // Lamps are left out where the centreline crosses tissue.
        if (along < spacing || !(mColon.freeDistanceAt(points[n].position, 1e-3) > 0)) continue;
        refuseUnless(setup.lights.size() < kMostLights, option,
                     fmt::format("the centreline would get more than {} lights", kMostLights),
                     "choose a larger distance");
        PointLight light;
        light.position = points[n].position;
        light.intensity = glm::vec3(intensity);
        setup.lights.push_back(light);
        along = 0;
    }
    refuseUnless(!setup.lights.empty(), option, "the centreline is shorter than the lights' distance",
                 "choose a smaller distance");
}

void ColonInterior::addUsualLight(const char* option, LightSetup& setup,
                                  std::vector<std::string>& notes) const {
    addLine(std::nullopt, option, setup);
    notes.push_back(fmt::format("lit by {} lights along the centreline, {:g} mm apart", setup.lights.size(),
                                1e3 * kLightSpacing));
}

// Returns the lumen's mean radius: a plain tube then counts as open, folds and the foot of a polyp do not.
double ColonInterior::usualReach(std::vector<std::string>& notes) const {
    const double reach = meanRadius();
    notes.push_back(fmt::format("open is what meets no wall within {:.1f} mm, the mean radius", 1e3 * reach));
    return reach;
}

double ColonInterior::meanRadius() const {
    const std::vector<CentrelinePoint>& points = mColon.centreline.points;
    double radius = 0;
    for (const CentrelinePoint& point : points) radius += point.radius / static_cast<double>(points.size());
    return radius;
}

// A larger separation would need more room than the flight keeps from the wall.
double ColonInterior::largestSeparation() const {
    return SeparationControl::Setting{}.largest;
}

double ColonInterior::crossingSeconds() const {
    return kInsideSeconds;
}

void ColonInterior::check(const RecordedPath& path, const std::string& file) const {
    for (std::size_t n = 0; n < path.samples().size(); ++n) {
        const glm::dvec3& p = path.samples()[n].pose.position;
        if (!(mColon.freeDistanceAt(p, mColon.clearance) > 0))
            throw Error(file, fmt::format("pose {}", n + 1),
                        fmt::format("expected a place inside the colon, got {:.1f}, {:.1f}, {:.1f} mm",
                                    1000 * p.x, 1000 * p.y, 1000 * p.z),
                        "play flights that were recorded in this study");
    }
}

// Returns the nearest point of the centreline, by its distance in metres from the start.
PlaceOnLine ColonInterior::placeOnLine(const glm::dvec3& world) const {
    PlaceOnLine found;
    double nearest = std::numeric_limits<double>::infinity();
    for (const LinePlace& place : mLine.places) {
        found.length = place.along;
        const double away = glm::length(place.world - world);
        if (away >= nearest) continue;
        nearest = away;
        found.along = place.along;
    }
    return found;
}

}  // namespace stereonav
