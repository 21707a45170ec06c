// Which scene a command shows or measures, and how: what app/scene makes a scene from.
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

// Which warped pixels of the right eye are cast as well.
struct QualityOptions {
    std::optional<double> quality;        // 0..1: share of the expected squared error that is to go
    std::optional<double> targetPsnr_db;  // against a full cast, for 95 of 100 frames
    std::optional<double> target_ms;      // time for both eyes of a frame: what fits is cast
    std::optional<int> edges;  // rays added to pixels at edges; none: kDefaultEdgeRays where rays are cast
};

// The light of a picture whose every pixel is path traced; each value means what it means to a bake.
struct TracedOptions {
    std::optional<int> samples;  // paths from each pixel
    std::optional<int> bounces;
    std::optional<glm::dvec3> albedo;
    std::vector<LampsAsked> lights;
    std::optional<double> reach_mm;
};

// What is painted on a terrain's ground in pictures that are shown.
struct GroundPaintOptions {
    std::optional<double> contours_m;  // between them; 0 or none: no contours, unless contoursAuto
    bool contoursAuto = false;         // by the relief
    std::string tracks;                // a GPX or GeoJSON file that is drawn; "": none
    std::string follow;                // ... and one that the scene's own flight goes along
    double followHeight_m = 50;        // above the ground
};

struct SceneOptions {
    // "" or "terrain": built in; a .toml; a DEM file; "colon", "cloud", "wax": built in; a CT study
    std::string scene;
    std::optional<double> verticalScale;  // none: as the scene says
    bool openHoles = false;
    TilesChoice tiles = TilesChoice::Auto;
    std::optional<double> memory_bytes;  // limit for the program; none: what the system says
    std::string image, sky;              // pictures; "": as the scene says
    bool physicalSky = false;            // by scattering in the air
    std::optional<double> visibility_m;  // through that air; none: as usual
    std::optional<glm::vec3> skyColor;   // around traced light, in the place of a picture
    bool shadeImage = false;             // the picture is lit by the sun too
    LightChoice light;
    std::optional<LightPlace> sun;  // over a terrain; none: as the scene says
    std::optional<double> separation_m, zeroParallax_m;
    std::optional<double> fov_deg;  // vertical; none: as the scene says
    int threads = 0;                // 0: all
    SimdTarget simd = SimdTarget::Auto;
    VolumeOptions volume;
    GroundPaintOptions ground;
    std::string paint;  // a word of --paint, as it was written (app/options/paint_words.h); "": none
    QualityOptions quality;
    MediumOptions medium;
    std::optional<TracedOptions> traced;  // none: of commands that trace no pictures
    GivenOptions given;                   // which of these and of the command's own were given
    // Shading below a terrain's samples: on where pictures are shown, off where they are measured.
    bool groundDetail = false;
    double levelOfDetail = 0;  // share of a pixel that far ground may be off; 0: exact
    // Whether ground that is cast lies on a round Earth, and the share of its curvature that light follows.
    bool curvature = false;
    std::optional<double> refraction;  // none: what is usual on the body that the ground lies on
    bool lightLater = true;            // a window works out sky light of ground that has none (ShownTerrain)
    // Set by a window: pictures do not wait for detail; ground whose tiles are not made yet is shown coarse.
    bool detailLater = false, standInFirst = false;
    bool skyTurns = false;  // set by a window: keep what turning the sky over baked transfer takes
};

// What commands that show pictures begin with.
inline SceneOptions shownSceneOptions() {
    SceneOptions options;
    options.groundDetail = true;
    return options;
}

}  // namespace stereonav
