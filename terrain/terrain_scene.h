// A loaded terrain: all that its ray caster needs, immutable but for the place of the sun under
// baked light.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/camera/recorded_path.h"
#include "engine/camera/stereo_rig.h"
#include "engine/image/color_texture.h"
#include "terrain/heightfield.h"
#include "terrain/scene_file.h"
#include "terrain/sky_map.h"

namespace stereonav {

class LandmarkSet;          // terrain/landmark.h: meshes cast with Embree
class TerrainIllumination;  // terrain/terrain_illumination.h: baked light

// What the reader did, for `info`.
struct TerrainReport {
    std::string driver;            // "GeoTIFF", "built-in", ...
    std::string sourceCrs;         // name of the source's reference system, "" when it has none
    std::string projection;        // how it was brought to metres: "as it is", "local ..."
    long long missingSamples = 0;  // nodata, NaN or infinite in the source
    long long filledSamples = 0;   // of them, filled
    glm::dvec2 sourceOffset{0.0};  // source x, y of the world's origin (metres in the local projection)
    std::string colorSource;       // "image winter.jpg 457x499", "hypsometric tint", ...
    bool colorHoldsSun = false;    // some of the colours hold the light of the look's sun
    std::string skySource;
    std::string lightSource;  // of baked light, "" without
};

struct TerrainScene {
    TerrainScene();
    ~TerrainScene();
    TerrainScene(TerrainScene&&) noexcept;
    TerrainScene& operator=(TerrainScene&&) noexcept;

    Heightfield ground;
    ColorTexture color;
    SkyMap sky;
    TerrainLook look;                        // fog, specular, sun
    std::unique_ptr<LandmarkSet> landmarks;  // null when there are none
    // Null without baked light. What is lit by it is `color`, which changes when the sun moves.
    std::unique_ptr<TerrainIllumination> illumination;
    Pose startPose;
    RecordedPath path;  // the scene's own flight
    StereoSetting stereo;
    Lens lens;               // width and height are the caller's to set
    double clearance = 2.0;  // metres kept above the ground
    TerrainReport report;
};

}  // namespace stereonav
