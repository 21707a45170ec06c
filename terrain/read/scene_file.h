// A scene as its TOML file says it: which files, where, how it looks, how it is flown. Parsing
// checks keys and values; it opens none of the files named.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace stereonav {

constexpr int kBuiltInSizeMin = 17, kBuiltInSizeMax = 2049;  // samples a side of the generated terrain

constexpr double kUsualVisibility = 60e3;  // metres; of a physical sky

// How a terrain is lit and shown.
struct TerrainLook {
    double sunAzimuth = 5.5;     // radians clockwise from north; the default shines from the north-west
    double sunElevation = 0.79;  // radians above the horizon
    float ambient = 0.35f;       // share of light that is there in shadow, 0..1
    double fogDistance = 0.0;    // metres over which 63 % (1 - 1/e) is lost; 0: no fog
    glm::vec3 fogColor{0.62f, 0.68f, 0.75f};  // linear
    float specular = 0.0f;    // strength of the view-dependent highlight, 0: none (nothing is stored)
    float shininess = 32.0f;  // Blinn-Phong exponent
    bool shadeImage = false;  // light the colour image too (images mostly hold light already)
    // Sky and air by scattering (terrain/light/atmosphere.h), in the place of a picture and of fog.
    bool physicalSky = false;
    double visibility = kUsualVisibility;  // metres: meteorological range at the sea
    double seaLevel = 0, skySeenFrom = 0;  // world heights, metres; the loader sets them
    // Whether below the horizon is the sky's light at it, as where ground ends in haze, and not a plain.
    bool hazyBelow = false;
};

// What colours ground without a picture: its tints, or how it lies (terrain/scene/slope_color.h).
enum class GroundPaint { None, Slope, Aspect, Hillshade };

// Whether an elevation model's samples go into tiles on disk (terrain/scene/tiled_ground.h): where they would
// not fit into memory, always, or never.
enum class GroundTiles { Auto, On, Off };

// A mesh in the scene.
struct LandmarkFile {
    std::filesystem::path mesh;     // .gltf or .glb
    glm::dvec2 positionWorld{0.0};  // metres from the world's origin
    std::optional<double> z;        // metres; none: on the ground
    double heading = 0.0;           // radians clockwise from north
    double scale = 1.0;             // factor on the mesh, above 0 to 1e9
};

struct SceneFile {
    std::filesystem::path file;  // the TOML file, or the DEM when there is none
    bool builtIn = false;        // the generated terrain
    std::uint64_t seed = 1;      // seed of the generated terrain
    int builtInSize = 513;       // samples a side of the built-in ground
    std::filesystem::path dem;
    double verticalScale = 1.0;  // factor on heights, > 0
    GroundTiles tiles = GroundTiles::Auto;
    // Samples a side of the coarser ground that is given while tiles have to be made; 0: none.
    int standInSide = 0;
    bool openHoles = false;                 // leave nodata open instead of filling it
    std::filesystem::path image;            // "" for hypsometric tint
    GroundPaint paint = GroundPaint::None;  // not with an image
    std::filesystem::path sky;              // "" for the built-in gradient
    std::filesystem::path light;            // baked light; "auto": the cache's; "" for none
    bool colorsAlone = false;  // the ground's, without the sun's light: whoever shows it lights it
    TerrainLook look;
    // Whether first view, sun, sky and light are chosen where nothing says them, and what is said.
    bool chosen = false;
    bool sunGiven = false, fogGiven = false, visibilityGiven = false;
    bool quickLight = false;  // light that is worked out with the loading (terrain/light/quick_light.h)
    std::vector<LandmarkFile> landmarks;
    std::optional<glm::dvec3> startPosition;  // world metres; z above the ground when startAboveGround
    bool startAboveGround = true;
    double startHeading = 0, startPitch = 0, startRoll = 0;  // radians: poseFromAngles()
    std::filesystem::path path;                              // "" for the scene's own computed flight
    std::optional<double> separation;                        // metres between the eyes
    std::optional<double> zeroParallax;                      // metres along the view axis
    double verticalFov = 0.8;                                // radians
    double clearance = 0.0;                                  // metres; 0: chosen from the spacing
};

// Reads a .toml scene. Relative files are relative to the scene's folder. Throws Error: unknown keys
// all together, each with line and the nearest known key; wrong types and ranges with their line.
SceneFile readSceneFile(const std::filesystem::path& toml);

// `name` as a user gives it: "" or "terrain" for the built-in terrain, a .toml, or a DEM file.
SceneFile sceneFileFromName(const std::string& name);

}  // namespace stereonav
