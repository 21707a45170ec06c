// A loaded terrain: everything that its ray caster needs; immutable except for the position of the sun under
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
    std::string projection;     // how the samples were brought to metres: "as it is", "local ..."
    std::string verticalDatum;  // datum of the source's heights, "" where it names none
    // Guesses about what the file does not say, in words; "" where there was nothing to guess.
    std::string placedBy;          // how the ground was placed: by control points
    std::string band;              // which band was taken, of several
    std::string heightUnit;        // the unit of the heights, where it is not plain metres
    std::string missingValue;      // what marks missing samples
    long long sourceSamples = 0;   // in the file; 0: there is none
    long long missingSamples = 0;  // missing ones among them
    long long outsideSamples = 0;  // samples of the ground beyond the file's own
    long long filledSamples = 0;   // samples of the ground that were filled: missing, or beyond the file
    long long openSamples = 0;     // samples of the ground that were left open
    glm::dvec2 sourceOffset{0.0};  // source x, y of the world's origin (metres in the local projection)
    bool placed = false;           // the file says where it lies: sourceOffset tells something
    std::string worldCrs;          // WKT of the system that sourceOffset is of; "": it is not known
    double worldUnit = 1;          // metres in the world per unit of that system
    double sourceUnit = 0;  // metres per unit of sourceOffset; 0: it is in another system than the file's own
    std::string colorSource;     // "image winter.jpg 457x499", "hypsometric tint", ...
    bool colorHoldsSun = false;  // some of the colours hold the light of the look's sun
    std::string skySource;
    std::string lightSource;         // source of baked light, "" without
    std::string tiles;               // for a tiled ground: which level lies where; "" for others
    std::vector<std::string> notes;  // guesses and omissions, a line each
};

// The ground's finer levels, which lie in tiles on disk (terrain/tiles).
struct TiledGround {
    std::shared_ptr<const GroundLevels> levels;
    int level = 0;  // level of TerrainScene::ground
    std::shared_ptr<const FineHeights> fine;
};

// Coarser ground that is shown while the tiles of a ground are not made yet
// (terrain/scene/stand_in_ground.h).
struct StandInGround {
    std::string tiles;                         // file for the tiles
    glm::dvec2 spacing{1.0};                   // metres between the finest samples
    std::function<void(Progress&)> makeTiles;  // on any thread. Throws Error, Cancelled
};

struct TerrainScene {
    TerrainScene();
    ~TerrainScene();
    TerrainScene(TerrainScene&&) noexcept;
    TerrainScene& operator=(TerrainScene&&) noexcept;

    // Returns the height in metres at a place, from the finest samples: NaN in holes, clamped to the border.
    // Throws Error where a tile can not be read.
    double heightAt(const glm::dvec2& world) const;

    Heightfield ground;                    // the whole ground; of tiled ground, a level that fits into memory
    std::optional<TiledGround> tiled;      // none: `ground` has all samples
    std::optional<StandInGround> standIn;  // none: `ground` is final
    bool ringsMayBeLate = false;  // whether a picture may be shown before its tiles are read, as in a window
    double verticalScale = 1;     // factor from the file's heights to the ground's
    ColorTexture color;
    SkyMap sky;
    bool detail = false;     // shading has detail below the sample spacing (terrain/cast/ground_detail.h)
    bool weathered = false;  // that detail is GroundDetail::Kind::Weathered
    // Share of a pixel that far ground may be off (RingWish::share); 0: none is, but tiled ground may be off
    // by kTiledShare.
    double levelOfDetail = 0;
    static constexpr double kTiledShare = 0.5;
    TerrainLook look;                        // fog, specular, sun
    std::unique_ptr<LandmarkSet> landmarks;  // null when there are none
    // The baked light; null without one. It lights `color`, which changes when the sun moves.
    std::unique_ptr<TerrainIllumination> illumination;
    // What the tint is made of, beside ground and look. Only where `color` is the tint, or paint in its
    // place, under the plain sun.
    std::optional<TintPlace> tint;
    std::optional<GroundColorSource> colorSource;  // empty where `color` comes from a picture
    std::optional<PicturedGround> pictured;        // source of the colours of a tiled ground's parts
    std::unique_ptr<EarthPlaces> earth;            // null where its file does not say where it lies
    Pose startPose;
    RecordedPath path;  // the scene's own flight
    StereoSetting stereo;
    bool eyesGiven = false;  // set by the scene's file, or an option
    Lens lens;               // width and height are set by the caller
    // Share of the ground's curvature by which light is bent (refraction), 0 to 1; empty over level ground.
    std::optional<double> refraction;
    Body body;               // the body that the ground lies on
    double clearance = 2.0;  // metres kept above the ground
    TerrainReport report;
};

}  // namespace stereonav
