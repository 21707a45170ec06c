// The program's commands as plain options and one function each; arguments.cpp fills the options
// from the command line. Each returns the exit status and throws Error for what a person can mend.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/options/given_options.h"
#include "app/options/option_types.h"
#include "engine/camera/pose.h"
#include "engine/image/stereo_compose.h"
#include "engine/light/bake/bake_sums.h"
#include "engine/light/occlusion/occlusion.h"
#include "engine/math/earth_bend.h"
#include "engine/medium/model/medium_look.h"
#include "engine/simd/simd_target.h"
#include "engine/volume/piece_choices.h"
#include "engine/volume/volume_up.h"

namespace stereonav {

// Of CT studies; what is not given is chosen from the study.
struct VolumeOptions {
    std::string series;                // of a folder with several: its number or UID
    std::optional<std::string> label;  // of a mask with several: its number or name
    std::vector<glm::dvec3> seeds;     // LPS, metres
    PieceChoices choices;              // of pieces of the colon, LPS
    FluidChoice fluid = FluidChoice::Out;
    bool resample = false;    // mend uneven or tilted slices
    bool isosurface = false;  // seen from outside, without looking for a colon
    std::optional<double> isovalue;
    std::string transfer;           // a transfer function's file or name; "": none
    std::optional<double> opacity;  // of a translucent wall a millimetre, in (0, 1]
    bool backwards = false;         // from the caecum
    std::optional<UpAxis> up;       // the file's axis that is to point up; none: z
    Shading shading = Shading::Lamp;
    std::optional<double> exposure;                      // factor on baked light; none: by its mean
    std::optional<double> ambient_mm;                    // radius of ambient occlusion; none: without
    OcclusionEstimate ambientMethod;                     // that estimates it
    std::optional<double> ambientStrength, ambientLamp;  // k of it, and the lamp's share beside it
    Modulation modulate = Modulation::None;              // of opacity
    std::optional<double> modulateRadius_mm;             // none: ambient_mm's, or ten voxels
    std::optional<double> modulateSigma;                 // none: chosen
    double turn_deg = 0;                                 // of the sky about the vertical, with baked transfer
    double tilt_deg = 0;                                 // of it before that: what lies north rises
    bool cache = true;

    bool skyMoved() const { return turn_deg != 0 || tilt_deg != 0; }
};

// Of a scene shown as a medium that light goes through.
struct MediumOptions {
    std::string medium;                // a preset or file, or "ground"; "": none, or a built-in medium's own
    std::optional<MediumModel> model;  // none: indirect
    std::string phase;                 // a phase function; "": none
    std::optional<LightPlace> lightFrom;  // where parallel light comes from
    std::optional<LampChoice> lamp;       // none: as the scene has it
    std::optional<glm::vec3> lightColor;  // linear
    std::string noise;                    // a file, cloud, fur or none; "": as the scene has it
    std::optional<Mist> mist;             // over a terrain
    std::optional<int> slices, lightSize;
    std::optional<double> cone_deg;      // that scattered light spreads in
    std::optional<double> shadingWidth;  // voxels between the places where surfaces are shaded

    // The ground of a terrain in its own colours.
    bool ground() const { return medium == "ground"; }
};

// Which warped pixels of the right eye are cast as well.
struct QualityOptions {
    std::optional<double> quality;        // 0..1: share of the expected squared error that is to go
    std::optional<double> targetPsnr_db;  // against a full cast, for 95 of 100 frames
    std::optional<double> target_ms;      // of a frame, both eyes: what fits is cast
    std::optional<int> edges;  // rays added to pixels at edges; none: kDefaultEdgeRays where rays are cast
};

// Of whole pictures.
struct RayOptions {
    int rays = 1;                    // a pixel
    std::optional<double> until_db;  // as many as this expected PSNR against very many takes; none: `rays`

    bool many() const { return rays > 1 || until_db; }
};

// The light of a picture whose every pixel is path traced; each as of a bake.
struct TracedOptions {
    std::optional<int> samples;  // of each pixel
    std::optional<int> bounces;
    std::optional<glm::dvec3> albedo;
    std::vector<LampsAsked> lights;
    std::optional<double> reach_mm;
};

// What is painted on a terrain's ground in pictures that are shown.
struct GroundPaintOptions {
    std::optional<double> contours_m;  // between them; 0: none; none: contoursAuto
    bool contoursAuto = false;         // by the relief
    std::string tracks;                // a GPX or GeoJSON file that is drawn; "": none
    std::string follow;                // ... and one that the scene's own flight goes along
    double followHeight_m = 50;        // above the ground
};

struct SceneOptions {
    // "" or "terrain": built in; a .toml; a DEM file; "colon", "cloud", "wax": built in; a CT study
    std::string scene;
    double verticalScale = 0;  // 0: as the scene says
    bool openHoles = false;
    TilesChoice tiles = TilesChoice::Auto;
    double memory_bytes = 0;            // that the program may take; 0: what the system says
    std::string image, sky;             // pictures; "": as the scene says
    bool physicalSky = false;           // by scattering in the air
    double visibility_m = 0;            // of it; 0: as usual
    std::optional<glm::vec3> skyColor;  // of traced light, in the place of a picture
    bool shadeImage = false;            // the picture is lit by the sun too
    LightChoice light;
    std::optional<LightPlace> sun;  // of a terrain; none: as the scene says
    std::optional<double> separation_m, zeroParallax_m;
    double fov_deg = 0;  // vertical; 0: as the scene says
    int threads = 0;     // 0: all
    SimdTarget simd = SimdTarget::Auto;
    VolumeOptions volume;
    GroundPaintOptions ground;
    std::string paint;  // a word of --paint, as it was written (app/options/paint_words.h); "": none
    QualityOptions quality;
    MediumOptions medium;
    std::optional<TracedOptions> traced;  // none: of commands that trace no pictures
    GivenOptions given;                   // which of these and of the command's own were given
    // Of a terrain's shading below its samples: on where pictures are shown, off where they are measured.
    bool groundDetail = false;
    double levelOfDetail = 0;  // share of a pixel that far ground may be off; 0: exact
    // Of ground that is cast: a round Earth, and the share of its curvature that light follows.
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

// How a command tells what it has done: in words, as one JSON document, or not at all.
struct Telling {
    bool json = false;
    bool quiet = false;  // neither progress nor notes: only what was asked for, and errors
};

struct SizeOption {
    int width = 1280, height = 720;  // pixels of one eye
};

struct InfoOptions {
    SceneOptions scene;
    SizeOption size;
    Telling telling;
    std::string
        series;  // folder for a picture of each series of a DICOM folder, in the place of the rest; "": none
};
int runInfo(const InfoOptions& options);

struct RenderOptions {
    SceneOptions scene = shownSceneOptions();
    Telling telling;
    SizeOption size;
    std::optional<Pose> pose;     // none: the start pose
    std::string method = "auto";  // a right-eye method; auto: the default one, whatever was measured
    RayOptions rays;
    OutputMode mode = OutputMode::SideBySide;
    std::string out;  // image file
};
int runRender(const RenderOptions& options);

constexpr double kPlayFps = 25;  // where nothing is said

struct PlayOptions {
    SceneOptions scene = shownSceneOptions();
    Telling telling;
    SizeOption size;
    std::string path;             // "": the scene's own
    std::string method = "auto";  // as in RenderOptions: files do not depend on measured times
    RayOptions rays;
    OutputMode mode = OutputMode::SideBySide;
    std::string out;                          // folder for frame_00000.png ...; "" with --video or --hash
    std::string video;                        // .mp4, .avi or .mkv
    std::optional<double> fps;                // none: 25
    int frames = 0;                           // 0: the whole path at fps; else this many, evenly
    std::optional<std::pair<int, int>> part;  // first and last of the whole path's frames at fps, from 0
    bool hash = false;                        // print one content hash of all frames
};
int runPlay(const PlayOptions& options);

struct CompareOptions {
    SceneOptions scene;
    bool quiet = false;  // no progress, and the table only where nothing else was asked for
    SizeOption size{500, 400};
    std::string path;
    int frames = 24;
    std::vector<std::string> methods;  // empty: all
    double relativeSeparation = 0;     // separation as a share of the zero-parallax distance; 0: the scene's
    std::string json, csv, images, plot;  // "": not written
    int repeats = 3;                      // timed runs of a frame, the fastest counts
    int truthRays = 64;                   // a pixel of the finer truths: a square number, 1 to 256
    bool butteraugli = false;
};
int runCompare(const CompareOptions& options);

struct ReportOptions {
    Telling telling;
    std::string out = "report";       // folder
    bool quick = false;               // within a minute, with fewer frames and repeats
    std::vector<std::string> scenes;  // beside the built-in ones
    std::optional<UpAxis> up;         // as VolumeOptions, of those that are studies
    bool curvature = false;           // as SceneOptions, of those that are ground
    std::optional<double> refraction;
    std::string compare;             // an earlier run's report.json; "": none
    std::string stability;           // rows that the stability tests wrote; "": those of this build, if any
    int threads = 0;                 // 0: all
    std::uint64_t seed = 1;          // of everything random
    std::optional<double> minutes;   // for all of it
    std::vector<std::string> parts;  // sections by id; empty: all
    bool papers = false;             // the papers' tables beside ours, in the place of the charts
    std::string data;                // folder with real data for them; "": where tests find it
};
// Exit status 1 where a figure got worse than in the earlier run.
int runReport(const ReportOptions& options);

struct ViewOptions {
    SceneOptions scene = shownSceneOptions();
    Telling telling;
    SizeOption size;
    std::string method = "auto";  // auto: the frame plan's choice
    OutputMode mode = OutputMode::SideBySide;
    std::string path;   // Z plays this one at first
    std::string shots;  // folder for screenshots and recorded flights; "": the present one
    SweepChoice sweep = SweepChoice::Auto;  // of a medium
    bool startPage = false;                 // over the scene, at first
    std::string fullScreen;                 // "": a window; auto, a monitor's number, or part of its name
    std::optional<double> screenWidth_mm, viewingDistance_mm;  // none: as the monitor tells, and usual
    bool refine = true;                                        // a picture that rests
    bool lateWarp = true;             // the newest picture is shown from where the eyes are now
    std::optional<double> target_ms;  // that a frame may take while something moves; none: by the monitor
    bool bench = false;               // flies the flight, rests, measures what was shown, and closes
    std::string json;                 // where the result is written when the window is closed; "": nowhere
};
int runView(const ViewOptions& options);

struct MeshOptions {
    SceneOptions scene;
    Telling telling;
    std::string out;      // .glb or .gltf
    double error_m = -1;  // largest vertical error; < 0: half a sample spacing
};
int runMesh(const MeshOptions& options);

// A place on the ground: x, y as the elevation model's reference system has them, metres above the ground.
struct SurveyPlace {
    glm::dvec2 reference{0.0};
    std::optional<double> height_m;
};

struct ViewshedOptions {
    SceneOptions scene;
    Telling telling;
    SurveyPlace from;
    std::optional<SurveyPlace> to;  // a line of sight
    double targetHeight_m = 0;      // of what is looked at, over the samples
    double reach_m = 0;             // 0: all of the ground
    bool curvature = false;
    std::optional<double> refraction;  // share of the curvature; none: the usual one
    std::string out;                   // GeoTIFF; "": not written
};
int runViewshed(const ViewshedOptions& options);

// A line over the ground: one of the three.
struct SurveyLine {
    std::vector<glm::dvec2> places;  // x, y as of SurveyPlace; empty: not given
    std::string track, path;         // a GPX or GeoJSON file; a recorded flight
};

struct MeasureOptions {
    SceneOptions scene;
    Telling telling;
    SurveyLine line;
    std::vector<glm::dvec2> area;   // corners, as places of the line
    std::optional<double> plane_m;  // that volumes lie over and under; none: of the area's lowest corner
    std::string csv, geojson;       // "": not written
};
int runMeasure(const MeasureOptions& options);

struct ProfileOptions {
    SceneOptions scene;
    Telling telling;
    SurveyLine line;
    std::string csv, svg;  // "": not written
};
int runProfile(const ProfileOptions& options);

struct SunOptions {
    SceneOptions scene;
    Telling telling;
    std::string at;        // "2026-06-21T19:30": UTC
    double step_min = 20;  // of the hours of sun
    std::string out;       // GeoTIFF of them, "": not written
    std::string picture;   // of them
};
int runSun(const SunOptions& options);

struct CentrelineOptions {
    SceneOptions scene;
    Telling telling;
    std::string out;  // .vtp, .vtk or .txt
};
int runCentreline(const CentrelineOptions& options);

// What options are called where they were given.
struct LightWords {
    const char *light = "--light", *probe = "--probe";
};

// What is not given is chosen from the scene.
struct BakeOptions {
    SceneOptions scene;
    Telling telling;
    std::optional<BakeKind> what;  // none: of volumes irradiance, of terrains transfer
    std::optional<int> samples;    // at most one of these three
    std::optional<double> error, minutes;
    // Texels a voxel, or baked samples a height sample in memory, along each axis.
    std::optional<double> resolution;
    std::string probe;             // a picture all around
    std::optional<glm::vec3> sky;  // light from everywhere
    std::vector<LampsAsked> lights;
    std::optional<int> bounces, order;
    std::optional<glm::dvec3> albedo;
    std::optional<ValueRange> isovalues;
    std::optional<double> reach_mm;  // how far rays look for distant light; none: a colon's mean radius
    bool full = false;               // every texel, for any isovalue
    LightWords words;
    std::string out;  // "": in the cache
};
int runBake(const BakeOptions& options);

// No command given: fly the built-in terrain where there is a display, else play it to out/ and compare.
int runDefault();

}  // namespace stereonav
