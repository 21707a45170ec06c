#include "app/view/go_to_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/view/typed_place.h"
#include "engine/base/error.h"
#include "engine/nav/flight_to.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/slices.h"
#include "engine/text/length_text.h"
#include "terrain/read/raster_file.h"
#include "terrain/scene/ground_place.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

constexpr double kRadian = std::numbers::pi / 180;
constexpr double kFarFromLine = 0.1;  // metres: farther away a place is in no part of the colon

const TerrainScene* terrainOf(const Scene& scene) {
    return scene.offered<const TerrainScene>();
}

// Returns the place on the Earth of UTM coordinates, by PROJ; empty where the zone has none.
std::optional<PlaceOnEarth> earthOfUtm(const TypedPlace& place) {
    constexpr double kMiddle = 500'000, kSouth = 10'000'000;  // false easting and northing
    Georeference zone;
    zone.wkt = fmt::format(
        "PROJCS[\"UTM\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
        "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
        "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",{}],"
        "PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",{}],"
        "PARAMETER[\"false_northing\",{}],UNIT[\"metre\",1]]",
        6 * place.zone - 183, kMiddle, place.south ? kSouth : 0.0);
    // A grid of one metre a pixel, whose middle is the zone's on the equator.
    zone.width = zone.height = 2;
    zone.transform = {kMiddle - 1, 1, 0, (place.south ? kSouth : 0) + 1, 0, -1};
    const std::unique_ptr<EarthPlaces> earth = earthPlaces(zone, glm::dvec2(1));
    if (!earth) return std::nullopt;
    const auto at = earth->placeAt(glm::dvec2(place.numbers) - glm::dvec2(kMiddle, place.south ? kSouth : 0));
    return at ? std::optional(PlaceOnEarth{at->latitude, at->longitude}) : std::nullopt;
}

// Returns the world x, y of a place; empty where the ground can not tell.
std::optional<glm::dvec2> worldOf(const Scene& scene, const TerrainScene& terrain, const TypedPlace& place) {
    const auto* const earth = scene.offered<OnEarth>();
    const auto onEarth = [&](const glm::dvec2& degrees) {
        return earth ? earth->worldAt({degrees.x * kRadian, degrees.y * kRadian}) : std::nullopt;
    };
    switch (place.kind) {
        case TypedPlace::Kind::Earth:
            return onEarth(glm::dvec2(place.numbers));
        case TypedPlace::Kind::Utm: {
            const auto at = earth ? earthOfUtm(place) : std::nullopt;
            return at ? earth->worldAt(*at) : std::nullopt;
        }
        case TypedPlace::Kind::Own:
            if (terrain.report.sourceUnit > 0)
                return (glm::dvec2(place.numbers) - terrain.report.sourceOffset) * terrain.report.sourceUnit;
            // A file in degrees has the longitude first.
            if (earth) return onEarth({place.numbers.y, place.numbers.x});
            return glm::dvec2(place.numbers);
        case TypedPlace::Kind::Patient:
        case TypedPlace::Kind::Along:
            break;
    }
    return std::nullopt;
}

std::string wordsOfGround(const GroundPlace& place, const glm::dvec2& world) {
    std::string words;
    if (place.earth) {
        const double north = place.earth->latitude / kRadian, east = place.earth->longitude / kRadian;
        words = fmt::format("{:.5f} {} {:.5f} {}", std::abs(north), north < 0 ? 'S' : 'N', std::abs(east),
                            east < 0 ? 'W' : 'E');
    } else {
        const glm::dvec2 at = place.reference.value_or(world);
        words = fmt::format("{:.1f} {:.1f}", at.x, at.y);
    }
    return words + fmt::format(", {} high", lengthText(place.height));
}

FoundPlace onGround(const Scene& scene, const TerrainScene& terrain, const std::vector<TypedPlace>& ways) {
    FoundPlace found;
    bool known = false;
    for (const TypedPlace& way : ways) {
        const std::optional<glm::dvec2> world = worldOf(scene, terrain, way);
        known = known || world;
        const auto place = world ? groundPlaceAt(terrain, *world) : std::nullopt;
        if (!place) continue;
        found.words = wordsOfGround(*place, *world);
        found.world = glm::dvec3(*world, place->height * terrain.verticalScale);
        return found;
    }
    found.problem = std::string(known ? "that lies beside the ground, or in a hole of it"
                                      : "this ground does not know such a place") +
                    "; expected " + expectedPlaces(scene);
    return found;
}

FoundPlace inColon(const Scene& scene, const LineThrough& line, const std::vector<TypedPlace>& ways) {
    FoundPlace found;
    const TypedPlace& way = ways.back();
    const bool along = way.kind == TypedPlace::Kind::Along;
    const bool place =
        way.kind == TypedPlace::Kind::Patient || (way.kind == TypedPlace::Kind::Own && way.count == 3);
    const glm::dvec3 world = way.numbers / 1000.0;
    const PlaceOnLine at = line.placeOnLine(world);
    if (along && way.numbers.x >= 0 && way.numbers.x <= at.length) {
        found.along = way.numbers.x;
    } else if (along) {
        found.problem = fmt::format("the line is {:.0f} mm long", 1000 * at.length);
    } else if (!place) {
        found.problem = "that is no place in a study";
    } else {
        double away = 0;
        if (const auto* const map = scene.offered<LineOnMap>(); map && !map->places.empty()) {
            away = HUGE_VAL;
            for (const LinePlace& one : map->places) away = std::min(away, glm::distance(one.world, world));
        }
        if (away <= kFarFromLine)
            found.along = at.along;
        else
            found.problem = fmt::format("that lies {} from the colon's line", lengthText(away));
    }
    if (!found.problem.empty()) found.problem += "; expected " + expectedPlaces(scene);
    if (found.along)
        found.words =
            fmt::format("{:.0f} of {:.0f} mm along the line", 1000 * *found.along, 1000 * at.length);
    return found;
}

FoundPlace inBox(const Scene& scene, const SceneBox& box, const std::vector<TypedPlace>& ways) {
    FoundPlace found;
    const TypedPlace& way = ways.back();
    const bool study = scene.offered<SliceSource>() != nullptr;
    const bool place = (way.kind == TypedPlace::Kind::Own && way.count == 3) ||
                       (study && way.kind == TypedPlace::Kind::Patient);
    const glm::dvec3 world = way.numbers * (study ? 1e-3 : 1.0);
    if (place && glm::clamp(world, box.low, box.high) == world) {
        found.world = world;
        found.words =
            study ? fmt::format("{:.1f} {:.1f} {:.1f} mm", way.numbers.x, way.numbers.y, way.numbers.z)
                  : fmt::format("{:.6g} {:.6g} {:.6g} m", world.x, world.y, world.z);
        return found;
    }
    found.problem = std::string(place ? "that lies outside" : "that is no place here") + "; expected " +
                    expectedPlaces(scene);
    return found;
}

// Returns whether the ground leaves the way from an eye to a place on it free.
bool isSeen(const TerrainScene& terrain, const glm::dvec3& eye, const glm::dvec3& place) {
    constexpr int kSteps = 64;
    for (int n = 1; n < kSteps - 1; ++n) {
        const glm::dvec3 at = glm::mix(eye, place, n / double(kSteps));
        if (terrain.ground.contains(glm::dvec2(at)) && terrain.ground.heightAt(glm::dvec2(at)) > at.z)
            return false;
    }
    return true;
}

// Returns how far from a place on the ground to look at it: as far as the eyes are over the ground, within
// limits.
double distanceOver(const TerrainScene& terrain, const Pose& now) {
    const Heightfield& ground = terrain.ground;
    const glm::dvec2 size = ground.spacing() * glm::dvec2(ground.width() - 1, ground.height() - 1);
    const double extent = std::max(size.x, size.y), least = std::max(20 * terrain.clearance, extent / 100);
    const glm::dvec2 here(now.position);
    const double below = ground.contains(here) ? ground.heightAt(here) : std::nan("");
    const double height = std::isfinite(below) ? now.position.z - below : extent / 20;
    return std::clamp(2 * height, least, std::max(least, extent / 8));
}

}  // namespace

std::string expectedPlaces(const Scene& scene) {
    if (const auto* const terrain = terrainOf(scene)) {
        std::string words;
        if (scene.offered<OnEarth>())
            words = "latitude and longitude (34.35,-118.1 or 34 21 0 N 118 6 0 W), UTM (11S 392000 3801000)";
        if (terrain->report.sourceUnit > 0 || words.empty())
            words += std::string(words.empty() ? "" : ", or ") +
                     (terrain->report.placed ? "east and north in the file's own system"
                                             : "metres from the ground's middle: east north");
        return words;
    }
    if (scene.offered<LineThrough>())
        return "left, posterior and head in mm (-12.5 80 -340), or a length along the line (250 mm)";
    if (!scene.offered<SceneBox>()) return "";
    return scene.offered<SliceSource>() ? "left, posterior and head in mm (-12.5 80 -340)"
                                        : "x, y and z in metres";
}

std::optional<FoundPlace> findPlace(const Scene& scene, const std::string& text) {
    const std::vector<TypedPlace> ways = readTypedPlace(text);
    if (ways.empty() || expectedPlaces(scene).empty()) return std::nullopt;
    try {
        if (const auto* const terrain = terrainOf(scene)) return onGround(scene, *terrain, ways);
        if (const auto* const line = scene.offered<LineThrough>()) return inColon(scene, *line, ways);
        return inBox(scene, *scene.offered<SceneBox>(), ways);
    } catch (const Error& error) {
        FoundPlace found;
        found.problem = error.what();
        return found;
    }
}

Pose viewOfPlace(const Scene& scene, const glm::dvec3& place, const Pose& now) {
    const double heading = anglesOf(now).heading;
    const auto from = [&](double away, double pitch) {
        const double plan = away * std::cos(pitch);
        const glm::dvec3 back(-plan * std::sin(heading), -plan * std::cos(heading), away * std::sin(pitch));
        return poseFromAngles(place + back, heading, -pitch, 0);
    };
    if (const auto* const terrain = terrainOf(scene)) {
        const double away = distanceOver(*terrain, now);
        for (const double pitch : {25.0, 40.0, 55.0, 70.0})
            if (const Pose pose = from(away, pitch * kRadian); isSeen(*terrain, pose.position, place))
                return pose;
        return from(away, 85 * kRadian);
    }
    const auto* const box = scene.offered<SceneBox>();
    const double size = box ? glm::distance(box->low, box->high) : 0;
    const double away = std::clamp(glm::distance(now.position, place), 0.3 * size, 1.5 * size);
    return poseLookingAt(place, std::max(away, 1e-6), now);
}

void goToPlace(ViewSession& session, const FoundPlace& place) {
    if (place.along) return session.flyAlong(*place.along);
    if (place.world) session.flyTo(viewOfPlace(*session.open().scene, *place.world, session.pose()));
}

}  // namespace stereonav
