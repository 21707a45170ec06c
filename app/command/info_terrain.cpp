// A terrain as `info` describes it.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/command/info_text.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_illumination.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

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

// Six digits, and whole metres where there are more.
std::string heightText(double metres) {
    return std::abs(metres) < 1e6 ? fmt::format("{:.6g}", metres) : fmt::format("{:.0f}", metres);
}

// "4151 of 153036 in the file (nodata -32767), 4151 filled"
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

}  // namespace

nlohmann::ordered_json terrainJson(const Scene& scene) {
    const TerrainScene& terrain = *scene.offered<const TerrainScene>();
    const TerrainReport& report = terrain.report;
    const Heightfield& ground = terrain.ground;
    Json json;
    json["driver"] = report.driver;
    json["size"] = {ground.width(), ground.height()};
    json["spacing_m"] = {ground.spacing().x, ground.spacing().y};
    json["extent_m"] = {ground.spacing().x * (ground.width() - 1),
                        ground.spacing().y * (ground.height() - 1)};
    json["height_range_m"] = {ground.minHeight(), ground.maxHeight()};
    json["crs"] = report.sourceCrs;
    json["projection"] = report.projection;
    json["source_offset"] = {report.sourceOffset.x, report.sourceOffset.y};
    json["placed_by"] = report.placedBy;
    json["band"] = report.band;
    json["height_unit"] = report.heightUnit;
    json["missing_value"] = report.missingValue;
    json["file_samples"] = report.sourceSamples;
    json["missing_samples"] = report.missingSamples;
    json["outside_samples"] = report.outsideSamples;
    json["filled_samples"] = report.filledSamples;
    json["open_samples"] = report.openSamples;
    json["open_holes"] = ground.hasHoles();
    json["color"] = report.colorSource;
    json["color_size"] = {terrain.color.levelCount() > 0 ? terrain.color.level(0).width() : 0,
                          terrain.color.levelCount() > 0 ? terrain.color.level(0).height() : 0};
    json["sky"] = report.skySource;
    json["baked_light"] = report.lightSource;
    json["landmark_triangles"] = terrain.landmarks ? terrain.landmarks->triangleCount() : 0;
    json["bytes"] = bytesOf(heldByTerrain(scene));
    json["held"] = heldJson(heldByTerrain(scene));
    json["flight_s"] = terrain.path.duration();
    json["clearance_m"] = terrain.clearance;
    return json;
}

std::string terrainText(const Scene& scene) {
    const TerrainScene& terrain = *scene.offered<const TerrainScene>();
    const TerrainReport& report = terrain.report;
    const Heightfield& ground = terrain.ground;
    std::string text;
    const auto line = [&](const char* name, const std::string& value) { text += infoLine(name, value); };
    line("read by", report.driver);
    line("samples", fmt::format("{} x {}", ground.width(), ground.height()));
    line("spacing", fmt::format("{:.6g} x {:.6g} m", ground.spacing().x, ground.spacing().y));
    line("extent", fmt::format("{:.6g} x {:.6g} m", ground.spacing().x * (ground.width() - 1),
                               ground.spacing().y * (ground.height() - 1)));
    line("heights",
         fmt::format("{} .. {} m", heightText(ground.minHeight()), heightText(ground.maxHeight())));
    line("crs", orNone(report.sourceCrs));
    line("projection", orNone(report.projection));
    if (!report.placedBy.empty()) line("placed by", report.placedBy);
    if (!report.band.empty()) line("band", report.band);
    if (!report.heightUnit.empty()) line("height unit", report.heightUnit);
    line("missing", missingText(report));
    line("colour", orNone(report.colorSource));
    line("sky", orNone(report.skySource));
    line("baked light", orNone(report.lightSource));
    line("landmarks",
         terrain.landmarks ? fmt::format("{} triangles", terrain.landmarks->triangleCount()) : "none");
    line("flight", fmt::format("{:.4g} s, at least {:.4g} m above the ground", terrain.path.duration(),
                               terrain.clearance));
    line("memory", heldText(heldByTerrain(scene)));
    return text;
}

}  // namespace stereonav
