// What the keys of a scene file mean: each section into its part of SceneFile.
#include "terrain/read/scene_file.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "engine/base/error.h"
#include "engine/camera/view_ranges.h"
#include "engine/image/packed_color.h"
#include "engine/text/toml_document.h"
#include "terrain/raster/elevation_folder.h"
#include "terrain/read/scene_ranges.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr NumberRange kShare = within(0, 1);
constexpr NumberRange kDistance = within(0, 1e9, "metres");

// Values are kept where single precision holds them.
void read(TomlSection& section, const std::string& key, float& value, const NumberRange& range) {
    double number = value;
    section.read(key, number, range);
    if (section.has(key)) value = static_cast<float>(number);
}

void read(TomlSection& section, const std::string& key, std::optional<double>& value,
          const NumberRange& range) {
    double number = std::numeric_limits<double>::quiet_NaN();
    section.read(key, number, range);
    if (number == number) value = number;
}

// A file named in the scene, relative to the scene's folder.
void readFile(TomlSection& section, const std::string& key, const fs::path& folder, fs::path& value) {
    std::string name;
    section.read(key, name);
    if (!name.empty()) value = folder / name;
}

void readGenerated(TomlSection& section, SceneFile& scene) {
    section.read("builtin", scene.builtIn);
    std::int64_t seed = 1, size = scene.builtInSize;
    // The library turns larger numbers into the largest one, which is therefore not taken.
    section.read("seed", seed, 0, std::numeric_limits<std::int64_t>::max() - 1);
    section.read("size", size, kBuiltInSizeMin, kBuiltInSizeMax);
    scene.seed = static_cast<std::uint64_t>(seed);
    scene.builtInSize = static_cast<int>(size);
    for (const char* key : {"seed", "size"})
        if (section.has(key) && !scene.builtIn)
            section.note(key, "is for the built-in terrain only", "write builtin = true or remove it");
}

void readTerrain(TomlSection section, const fs::path& folder, SceneFile& scene) {
    readFile(section, "dem", folder, scene.dem);
    readGenerated(section, scene);
    section.read("vertical_scale", scene.verticalScale, kVerticalScaleRange);
    std::string nodata = "fill";
    section.read("nodata", nodata);
    scene.openHoles = nodata == "open";
    if (nodata != "fill" && nodata != "open")
        section.note("nodata", "expected \"fill\" or \"open\", got \"" + nodata.substr(0, 40) + "\"",
                     "correct the value");
    if (scene.builtIn && section.has("dem"))
        section.note("builtin", "expected either \"dem\" or builtin = true, got both", "remove one of them");
    if (!scene.builtIn && !section.has("dem"))
        section.note("", "expected a terrain, found none",
                     "write dem = \"file.tif\" or builtin = true under [terrain]");
}

void readColorAndSky(TomlSection color, TomlSection sky, const fs::path& folder, SceneFile& scene) {
    readFile(color, "image", folder, scene.image);
    color.read("shade_image", scene.look.shadeImage);
    if (color.has("shade_image") && !color.has("image") && !scene.builtIn)
        color.note("shade_image", "is for a colour image only", "add image = \"file.png\" or remove it");
    readFile(sky, "image", folder, scene.sky);
}

void readLook(TomlSection section, SceneFile& scene) {
    TerrainLook& look = scene.look;
    scene.sunGiven = section.has("sun_azimuth_deg") || section.has("sun_elevation_deg");
    scene.fogGiven = section.has("fog_distance_m");
    section.readDegrees("sun_azimuth_deg", look.sunAzimuth, kTurnRange);
    section.readDegrees("sun_elevation_deg", look.sunElevation, kUprightRange);
    read(section, "ambient", look.ambient, kShare);
    section.read("fog_distance_m", look.fogDistance, kDistance);
    double fog[3] = {srgbFromLinear(look.fogColor.x), srgbFromLinear(look.fogColor.y),
                     srgbFromLinear(look.fogColor.z)};
    section.read("fog_color", fog, kShare);
    if (section.has("fog_color"))
        for (int k = 0; k < 3; ++k) look.fogColor[k] = linearFromSrgb(static_cast<float>(fog[k]));
    read(section, "specular", look.specular, within(0, 10));
    read(section, "shininess", look.shininess, within(1, 1e4));
}

LandmarkFile readLandmark(TomlSection& section, const fs::path& folder) {
    LandmarkFile landmark;
    readFile(section, "mesh", folder, landmark.mesh);
    if (!section.has("mesh"))
        section.note("mesh", "expected a mesh for the landmark, found none", "add mesh = \"file.glb\"");
    double position[2] = {0, 0};
    section.read("position_m", position, kPlaceRange);
    landmark.positionWorld = {position[0], position[1]};
    read(section, "z_m", landmark.z, kPlaceRange);
    section.readDegrees("heading_deg", landmark.heading, kTurnRange);
    section.read("scale", landmark.scale, above(0, 1e9));
    return landmark;
}

void readStart(TomlSection section, SceneFile& scene) {
    double position[3] = {0, 0, 0};
    section.read("position_m", position, kPlaceRange);
    if (section.has("position_m")) scene.startPosition = glm::dvec3(position[0], position[1], position[2]);
    section.read("above_ground", scene.startAboveGround);
    section.readDegrees("heading_deg", scene.startHeading, kTurnRange);
    section.readDegrees("pitch_deg", scene.startPitch, kUprightRange);
    section.readDegrees("roll_deg", scene.startRoll, kTurnRange);
    if (section.has("position_m")) return;
    for (const char* key : {"above_ground", "heading_deg", "pitch_deg", "roll_deg"})
        if (section.has(key))
            section.note(key, "needs a start position", "add position_m = [x, y, z] under [start]");
}

void readFlightAndStereo(TomlSection flight, TomlSection stereo, const fs::path& folder, SceneFile& scene) {
    readFile(flight, "path", folder, scene.path);
    flight.read("clearance_m", scene.clearance, kClearanceRange);
    read(stereo, "separation_m", scene.separation, kSeparationRange);
    read(stereo, "zero_parallax_m", scene.zeroParallax, kZeroParallaxRange);
    stereo.readDegrees("fov_deg", scene.verticalFov, kFovRange);
}

// The same as data/scenes/built_in.toml, which is not needed to fly.
SceneFile builtInScene() {
    SceneFile scene;
    scene.builtIn = true;
    scene.file = "terrain";
    scene.look.fogDistance = 40000;
    return scene;
}

}  // namespace

SceneFile readSceneFile(const fs::path& toml) {
    TomlDocument document(toml);
    SceneFile scene;
    scene.file = toml;
    const fs::path folder = toml.parent_path();
    readTerrain(document.section("terrain"), folder, scene);
    readColorAndSky(document.section("color"), document.section("sky"), folder, scene);
    readLook(document.section("look"), scene);
    for (TomlSection& section : document.sections("landmark"))
        scene.landmarks.push_back(readLandmark(section, folder));
    readStart(document.section("start"), scene);
    readFlightAndStereo(document.section("flight"), document.section("stereo"), folder, scene);
    document.section("options").leave();  // the program's, read elsewhere
    document.finish();
    return scene;
}

SceneFile sceneFileFromName(const std::string& name) {
    if (name.empty() || name == "terrain") return builtInScene();
    SceneFile scene;
    std::string extension = fs::path(name).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::error_code code;
    const bool isFolder = fs::is_directory(name, code);
    if (isFolder ? elevationFilesIn(name).empty() : !fs::exists(name, code))
        throw Error(name, "", isFolder ? "found a folder without elevation files" : "no such file",
                    "name a scene file (.toml), an elevation model (.tif, .hgt, .dem, .asc, .png) or a "
                    "folder of such, or nothing for the built-in terrain");
    if (extension == ".toml") return readSceneFile(name);
    scene.file = scene.dem = name;
    return scene;
}

}  // namespace stereonav
