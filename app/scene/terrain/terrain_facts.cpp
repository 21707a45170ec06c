#include "app/scene/terrain/terrain_facts.h"

#include <fmt/format.h>

#include <cmath>

#include "app/scene/type/held_facts.h"
#include "engine/math/earth_bend.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_illumination.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

std::vector<Held> heldByTerrain(const Scene& scene) {
    const TerrainScene& terrain = *scene.offered<const TerrainScene>();
    std::vector<Held> held = {{"heights", sizeof(float) * static_cast<std::size_t>(terrain.ground.width()) *
                                              terrain.ground.height()},
                              {"colour", terrain.color.byteCount()},
                              {"sky", terrain.sky.map().byteCount()}};
    if (const auto* renderer = scene.offered<const TerrainRenderer>())
        held.push_back({"height pyramid", renderer->byteCount()});
    if (terrain.illumination) held.push_back({"illumination", terrain.illumination->byteCount()});
    return held;
}

std::string orNone(const std::string& text) {
    return text.empty() ? "none" : text;
}

// Returns a height with six digits, in whole metres where it has more.
std::string heightText(double metres) {
    return std::abs(metres) < 1e6 ? fmt::format("{:.6g}", metres) : fmt::format("{:.0f}", metres);
}

// Returns "4151 of 153036 in the file (nodata -32767), 4151 filled".
std::string missingText(const TerrainReport& report) {
    std::string text =
        report.sourceSamples == 0
            ? "none"
            : fmt::format("{} of {} in the file{}", report.missingSamples, report.sourceSamples,
                          report.missingValue.empty() ? "" : " (nodata " + report.missingValue + ")");
    if (report.filledSamples > 0) text += fmt::format(", {} filled", report.filledSamples);
    if (report.openSamples > 0) text += fmt::format(", {} left open", report.openSamples);
    if (report.outsideSamples > 0)
        text += fmt::format(", {} of these beyond the file's edges", report.outsideSamples);
    return text;
}

// Returns "EGM96 height, EGM96 geoid; heights in metres". The length of a unit other than the metre has a
// line of its own.
std::string verticalText(const TerrainReport& report) {
    const std::string& unit = report.heightUnit;
    const bool named = unit.find(" m each") != std::string::npos;
    return fmt::format("{}; heights in {}",
                       report.verticalDatum.empty() ? "no vertical one named" : report.verticalDatum,
                       named ? unit.substr(0, unit.find(", ")) : "metres");
}

}  // namespace

std::optional<Fact> factOfCurvature(const Scene& scene) {
    const auto* terrain = scene.offered<const TerrainScene>();
    if (!terrain || !terrain->refraction) return std::nullopt;
    FactList list;
    list.json("sinks_by", "distance^2 (1 - refraction) / (2 radius)");
    list.json("radius_m", terrain->body.radius(), "m");
    list.json("refraction", *terrain->refraction);
    return factForJson("curvature", std::move(list.facts()));
}

Facts factsOfTerrain(const Scene& scene) {
    const TerrainScene& terrain = *scene.offered<const TerrainScene>();
    const TerrainReport& report = terrain.report;
    const Heightfield& ground = terrain.ground;
    const glm::dvec2 spacing = ground.spacing();
    const glm::dvec2 extent(spacing.x * (ground.width() - 1), spacing.y * (ground.height() - 1));
    const auto inMetres = [](const glm::dvec2& size) {
        return fmt::format("{:.6g} x {:.6g} m", size.x, size.y);
    };
    FactList list;
    // Adds empty values for JSON only: people need not read of what the file did not need.
    const auto wherePresent = [&](const char* key, const std::string& value, const char* label) {
        if (value.empty())
            list.json(key, value);
        else
            list.both(key, value, label);
    };
    list.both("driver", report.driver, "read by");
    list.both("size", FactIntegers{ground.width(), ground.height()}, "samples");
    list.both("spacing_m", FactNumbers{spacing.x, spacing.y}, "spacing", inMetres(spacing), "m");
    list.both("extent_m", FactNumbers{extent.x, extent.y}, "extent", inMetres(extent), "m");
    list.both("height_range_m", FactNumbers{ground.minHeight(), ground.maxHeight()}, "heights",
              fmt::format("{} .. {} m", heightText(ground.minHeight()), heightText(ground.maxHeight())), "m");
    list.both("crs", report.sourceCrs, "crs", orNone(report.sourceCrs));
    list.both("projection", report.projection, "projection", orNone(report.projection));
    list.both("vertical_datum", report.verticalDatum, "datum", verticalText(report));
    list.json("vertical_scale", terrain.verticalScale);
    if (terrain.verticalScale != 1)
        list.text("exaggerated", fmt::format("{:.6g} times", terrain.verticalScale));
    if (std::optional<Fact> curvature = factOfCurvature(scene)) {
        list.facts().push_back(std::move(*curvature));
        list.text(terrain.body.isEarth() ? "round Earth" : "round body",
                  fmt::format("radius {:.0f} km, refraction {:.6g}", terrain.body.radius() / 1000,
                              *terrain.refraction));
    }
    list.json("source_offset", FactNumbers{report.sourceOffset.x, report.sourceOffset.y});
    wherePresent("placed_by", report.placedBy, "placed by");
    wherePresent("band", report.band, "band");
    wherePresent("height_unit", report.heightUnit, "height unit");
    list.json("notes", report.notes);
    for (const std::string& note : report.notes) list.text("note", note);
    list.json("missing_value", report.missingValue);
    list.json("file_samples", std::int64_t{report.sourceSamples});
    list.json("missing_samples", std::int64_t{report.missingSamples});
    list.json("outside_samples", std::int64_t{report.outsideSamples});
    list.json("filled_samples", std::int64_t{report.filledSamples});
    list.json("open_samples", std::int64_t{report.openSamples});
    list.text("missing", missingText(report));
    list.json("open_holes", ground.hasHoles());
    wherePresent("tiles", report.tiles, "tiles");
    list.both("color", report.colorSource, "colour", orNone(report.colorSource));
    const bool colored = terrain.color.levelCount() > 0;
    list.json("color_size", FactIntegers{colored ? terrain.color.level(0).width() : 0,
                                         colored ? terrain.color.level(0).height() : 0});
    list.both("sky", report.skySource, "sky", orNone(report.skySource));
    list.both("baked_light", report.lightSource, "baked light", orNone(report.lightSource));
    const std::int64_t triangles = terrain.landmarks ? countOf(terrain.landmarks->triangleCount()) : 0;
    list.both("landmark_triangles", triangles, "landmarks",
              terrain.landmarks ? fmt::format("{} triangles", triangles) : "none");
    const std::string memory = addHeld(list.facts(), heldByTerrain(scene));
    const double flight = terrain.path.duration();
    list.json("flight_s", flight, "s");
    list.json("clearance_m", terrain.clearance, "m");
    list.text("flight",
              fmt::format("{:.4g} s, at least {:.4g} m above the ground", flight, terrain.clearance));
    list.text("memory", memory);
    return std::move(list.facts());
}

}  // namespace stereonav
