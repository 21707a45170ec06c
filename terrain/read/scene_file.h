// The content of a TOML scene file: which files it uses, where they are placed, how the scene looks and how
// it is flown. Parsing checks keys and values; it opens none of the files named.
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

constexpr double kUsualVisibility = 60e3;  // metres; default for a physical sky

// How a terrain is lit and shown.
struct TerrainLook {
    double sunAzimuth = 5.5;     // radians clockwise from north; the default shines from the north-west
    double sunElevation = 0.79;  // radians above the horizon
    float ambient = 0.35f;       // share of the light in shadow, 0..1
    double fogDistance = 0.0;    // metres over which 63 % (1 - 1/e) of the light is lost; 0: no fog
    glm::vec3 fogColor{0.62f, 0.68f, 0.75f};  // linear
    float specular = 0.0f;                    // strength of the view-dependent highlight; 0: none
    float shininess = 32.0f;                  // Blinn-Phong exponent
    bool shadeImage = false;                  // shade the image as well; images mostly contain light already
    // Sky and air by scattering (terrain/light/atmosphere.h), instead of a picture and fog.
    bool physicalSky = false;
    double visibility = kUsualVisibility;  // metres: meteorological range at the sea
    double seaLevel = 0, skySeenFrom = 0;  // world heights, metres; the loader sets them
    // Below the horizon is the sky's light at the horizon, as where ground ends in haze, instead of a plain.
    bool hazyBelow = false;
};

// What colours ground without a picture: its own colours, how it lies (terrain/scene/slope_color.h), or one
// of the palettes (terrain/scene/ground_tones.h).
enum class GroundPaint { None, Slope, Aspect, Hillshade, Natural, Hypsometric, Swiss, Grey };

// Whether an elevation model's samples are put into tiles on disk (terrain/scene/tiled_ground.h): where they
// would not fit into memory, always, or never.
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
    // Samples per side of the coarser ground that is shown while tiles are being made; 0: none.
    int standInSide = 0;
    bool openHoles = false;                 // leave missing samples open instead of filling them
    std::filesystem::path image;            // "" for hypsometric tint
    GroundPaint paint = GroundPaint::None;  // not with an image
    std::filesystem::path sky;              // "" for the built-in gradient
    std::filesystem::path light;            // file of baked light; "auto": from the cache; "": none
    bool colorsAlone = false;  // colours of the ground without the sun's light, for callers that light them
    TerrainLook look;
    // Whether first view, sun, sky and light are chosen by the program where nothing sets them, and a note
    // about them.
    bool chosen = false;
    bool sunGiven = false, fogGiven = false, visibilityGiven = false;
    bool quickLight = false;  // light is computed while loading (terrain/light/quick_light.h)
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

// Reads a .toml scene. Relative file names are relative to the scene's folder. Throws Error: for all unknown
// keys together, each with its line and the nearest known key; for wrong types and ranges with their line.
SceneFile readSceneFile(const std::filesystem::path& toml);

// Returns the scene for a user's argument: "" or "terrain" for the built-in terrain, a .toml file, or an
// elevation model.
SceneFile sceneFileFromName(const std::string& name);

}  // namespace stereonav
