// A loaded terrain: all that its ray caster needs, immutable but for the place of the sun under
// baked light.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/camera/recorded_path.h"
#include "engine/camera/stereo_rig.h"
#include "engine/image/color_texture.h"
#include "engine/light/skies/sky_map.h"
#include "engine/math/earth_bend.h"
#include "terrain/ground/ground_levels.h"
#include "terrain/ground/heightfield.h"
#include "terrain/raster/earth_places.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/ground_recolor.h"
#include "terrain/scene/ground_tint.h"

namespace stereonav {

class FineHeights;          // terrain/scene/fine_heights.h
class LandmarkSet;          // terrain/scene/landmark.h: meshes cast with Embree
class TerrainIllumination;  // terrain/scene/terrain_illumination.h: baked light

// A report on how the elevation model was read.
struct TerrainReport {
    std::string driver;         // "GeoTIFF", "built-in", ...
    std::string sourceCrs;      // name of the source's reference system, "" when it has none
    std::string projection;     // how it was brought to metres: "as it is", "local ..."
    std::string verticalDatum;  // datum of the source's heights, "" where it names none
    // Guesses about things that the file does not say, in words; "" where there is nothing to say.
    std::string placedBy;          // control points
    std::string band;              // the band, of several
    std::string heightUnit;        // where heights were not plain metres
    std::string missingValue;      // what marks missing samples
    long long sourceSamples = 0;   // in the file; 0: there is none
    long long missingSamples = 0;  // missing ones among them
    long long outsideSamples = 0;  // samples of the ground beyond the file's own
    long long filledSamples = 0;   // samples of the ground that were filled: missing as resampled, or beyond
    long long openSamples = 0;     // samples of the ground that were left open
    glm::dvec2 sourceOffset{0.0};  // source x, y of the world's origin (metres in the local projection)
    bool placed = false;           // the file says where it lies: sourceOffset tells something
    std::string worldCrs;          // WKT of the system that sourceOffset is of; "": it is not known
    double worldUnit = 1;          // metres of the world for a unit of that system
    double sourceUnit = 0;       // metres of a unit of sourceOffset; 0: it is not in the source's own system
    std::string colorSource;     // "image winter.jpg 457x499", "hypsometric tint", ...
    bool colorHoldsSun = false;  // some of the colours hold the light of the look's sun
    std::string skySource;
    std::string lightSource;         // source of baked light, "" without
    std::string tiles;               // on a tiled ground: what lies where; "" on others
    std::vector<std::string> notes;  // what was guessed or left aside, a line each
};

// The ground's finer levels, which lie in tiles on disk (terrain/tiles).
struct TiledGround {
    std::shared_ptr<const GroundLevels> levels;
    int level = 0;  // level of TerrainScene::ground
    std::shared_ptr<const FineHeights> fine;
};

// Coarser ground in the place of one in tiles, which are not made yet (terrain/scene/stand_in_ground.h).
struct StandInGround {
    std::string tiles;                         // the file that they will lie in
    glm::dvec2 spacing{1.0};                   // metres between the finest samples
    std::function<void(Progress&)> makeTiles;  // on any thread. Throws Error, Cancelled
};

struct TerrainScene {
    TerrainScene();
    ~TerrainScene();
    TerrainScene(TerrainScene&&) noexcept;
    TerrainScene& operator=(TerrainScene&&) noexcept;

    // Returns metres at a place, of the finest samples: NaN in holes, clamped to the border. Throws Error
    // where a tile can not be read.
    double heightAt(const glm::dvec2& world) const;

    Heightfield ground;                    // all of it; of a tiled one at a level that fits into memory
    std::optional<TiledGround> tiled;      // none: `ground` has all samples
    std::optional<StandInGround> standIn;  // none: `ground` is what it is to be
    bool ringsMayBeLate = false;           // pictures do not wait for tiles: for who shows one after another
    double verticalScale = 1;              // the ground's heights for one of the file's
    ColorTexture color;
    SkyMap sky;
    bool detail = false;  // shading has detail below the sample spacing (terrain/cast/ground_detail.h)
    // Share of a pixel that far ground may be off (RingWish::share); 0: none is, but tiled ground may be off
    // by kTiledShare.
    double levelOfDetail = 0;
    static constexpr double kTiledShare = 0.5;
    TerrainLook look;                        // fog, specular, sun
    std::unique_ptr<LandmarkSet> landmarks;  // null when there are none
    // The baked light, null without any. What is lit by it is `color`, which changes when the sun moves.
    std::unique_ptr<TerrainIllumination> illumination;
    // Where `color` is the tint under the plain sun, or paint in its place: what the tint is made of, beside
    // ground and look.
    std::optional<TintPlace> tint;
    std::optional<GroundColorSource> colorSource;  // none of a picture's
    std::optional<PicturedGround> pictured;        // colours of a tiled ground's parts
    std::unique_ptr<EarthPlaces> earth;            // null where its file does not say where it lies
    Pose startPose;
    RecordedPath path;  // the scene's own flight
    StereoSetting stereo;
    bool eyesGiven = false;  // by the scene's file, or an option
    Lens lens;               // width and height are the caller's to set
    // The share of the ground's curvature that light follows, 0 to 1; none over level ground.
    std::optional<double> refraction;
    Body body;               // the body that the ground lies on
    double clearance = 2.0;  // metres kept above the ground
    TerrainReport report;
};

}  // namespace stereonav
