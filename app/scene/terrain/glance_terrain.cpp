// Facts of a terrain from the headers of an elevation model, or of the one that a scene file names.
#include <fmt/format.h>

#include <filesystem>

#include "app/scene/terrain/terrain_facts.h"
#include "engine/base/error.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/scene_file.h"

namespace stereonav {

Facts glanceAtTerrain(const std::string& file, Progress& progress) {
    constexpr const char* kLooking = "looking at the header";
    progress.report(0, kLooking);
    const SceneFile scene = sceneFileFromName(file);
    FactList list;
    if (std::filesystem::path(file).extension() == ".toml") {
        std::string words = scene.builtIn ? "the built-in terrain" : scene.dem.filename().string();
        if (!scene.image.empty()) words += ", picture " + scene.image.filename().string();
        if (!scene.landmarks.empty()) words += fmt::format(", {} landmarks", scene.landmarks.size());
        list.text("scene of", words);
    }
    progress.report(scene.builtIn ? 1 : 0.5, kLooking);
    if (scene.builtIn) return std::move(list.facts());
    const DemGlance glance = glanceAtDem(scene.dem);
    list.both("driver", glance.driver, "read by");
    list.both(
        "samples", FactIntegers{glance.width, glance.height}, "samples",
        fmt::format("{} x {}{}", glance.width, glance.height, glance.type.empty() ? "" : ", " + glance.type));
    list.both("spacing", FactNumbers{glance.step.x, glance.step.y}, "spacing",
              fmt::format("{:.6g} x {:.6g} {}", glance.step.x, glance.step.y, glance.unit));
    if (!glance.crs.empty()) list.both("crs", glance.crs, "crs");
    if (!glance.band.empty()) list.both("band", glance.band, "band");
    if (!glance.heightUnit.empty()) list.both("height_unit", glance.heightUnit, "height unit");
    if (!glance.missingValue.empty()) list.both("missing_value", glance.missingValue, "missing");
    progress.report(1, kLooking);
    return std::move(list.facts());
}

}  // namespace stereonav
