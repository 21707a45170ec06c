// The scene that a command shows or measures, and how: the input from which app/scene makes a scene.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/options/given_options.h"
#include "app/options/medium_options.h"
#include "app/options/option_types.h"
#include "app/options/shared_options.h"
#include "app/options/volume_options.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

// Which warped pixels of the right eye are cast in addition.
struct QualityOptions {
    std::optional<double> quality;        // 0..1: share of the expected squared error to remove
    std::optional<double> targetPsnr_db;  // PSNR against a full cast, reached by 95 of 100 frames
    std::optional<double> target_ms;      // time for both eyes of a frame; as much is cast as fits
    std::optional<int> edges;  // rays added to pixels at edges; empty: kDefaultEdgeRays for cast rays
};

// The light of a path-traced picture; each value has the same meaning as for a bake.
struct TracedOptions {
    std::optional<int> samples;  // paths from each pixel
    std::optional<int> bounces;
    std::optional<glm::dvec3> albedo;
    std::vector<LampsAsked> lights;
    std::optional<double> reach_mm;
};

// Paint on a terrain's ground in pictures.
struct GroundPaintOptions {
    std::optional<double> contours_m;  // interval; 0 or empty: no contours, unless contoursAuto
    bool contoursAuto = false;         // interval chosen by the relief
    std::string tracks;                // GPX or GeoJSON file to draw; "": none
    std::string follow;                // GPX or GeoJSON file that the scene's flight follows; "": none
    double followHeight_m = 50;        // above the ground
};

struct SceneOptions {
    // Name of the scene: "" or "terrain" (built in), a .toml, a DEM file, "colon", "cloud" or "wax" (built
    // in), a CT study.
    std::string scene;
    std::optional<double> verticalScale;  // empty: the scene's own
    bool openHoles = false;
    TilesChoice tiles = TilesChoice::Auto;
    std::optional<double> memory_bytes;  // limit for the program; empty: what the system reports
    std::string image, sky;              // files of pictures; "": the scene's own
    bool physicalSky = false;            // sky by scattering in the air
    std::optional<double> visibility_m;  // in the air of the physical sky; empty: the default
    std::optional<glm::vec3> skyColor;   // colour of the sky around traced light, in place of a picture
    bool shadeImage = false;             // whether the sun also lights the picture on the ground
    LightChoice light;
    std::optional<LightPlace> sun;  // sun over a terrain; empty: the scene's own
    std::optional<double> separation_m, zeroParallax_m;
    std::optional<double> fov_deg;  // vertical; empty: the scene's own
    int threads = 0;                // 0: as many as the system has
    SimdTarget simd = SimdTarget::Auto;
    VolumeOptions volume;
    GroundPaintOptions ground;
    std::string paint;  // a word of --paint, as written (app/options/paint_words.h); "": none
    QualityOptions quality;
    MediumOptions medium;
    std::optional<TracedOptions> traced;  // empty for commands that trace no pictures
    GivenOptions given;                   // which options of the scene and of the command were given
    // Shading of detail finer than a terrain's samples: on where pictures are shown, off where they are
    // measured.
    bool groundDetail = false;
    // Whether all that no option names is chosen for the scene: first view, light, surfaces, tone. Off where
    // pictures are measured: a lamp or the sun alone, the data as they are.
    bool chosenLook = false;
    double aspect = 16.0 / 9;  // width by height of the picture that is shown first
    double levelOfDetail = 0;  // error that distant ground may have, as a share of a pixel; 0: exact
    // Whether ground that is cast lies on a round Earth, and the share of its curvature that light follows.
    bool curvature = false;
    std::optional<double> refraction;  // empty: the default of the body that the ground lies on
    bool lightLater = true;            // a window computes sky light of ground that has none (ShownTerrain)
    // Set by a window: pictures do not wait for detail, and ground without finished tiles is shown coarsely.
    bool detailLater = false, standInFirst = false;
    bool skyTurns = false;  // set by a window: keep what is needed to turn the sky over baked transfer
};

// Returns the defaults of commands that show pictures.
inline SceneOptions shownSceneOptions() {
    SceneOptions options;
    options.groundDetail = true;
    options.chosenLook = true;
    return options;
}

}  // namespace stereonav
