// Options that commands share: which scene, how it is read, and how it looks. Each function adds its options
// to a subcommand, which fills `options` when it is parsed.
#pragma once

#include "app/command/commands.h"
#include "engine/math/number_range.h"

namespace CLI {
class App;
}

namespace stereonav {

constexpr const char* kImageHelp = "colour of the ground";
constexpr const char* kShadeImageHelp =
    "light that picture by the sun, though it holds the light of its own day";
constexpr const char* kSunHelp = "a terrain's, clockwise from north";
constexpr const char* kUpHelp =
    "x, -x, y, -y, z or -z: the axis of a study's file that is to point up, by quarter turns; not where a "
    "colon is looked for";
constexpr const char* kTerrainHelp = "a scene (.toml) or an elevation model; left out: the built-in terrain";
constexpr const char* kStudyHelp =
    "a CT study (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd, a folder of DICOM slices), or colon, which is "
    "built in";

// Of traced light and of bakes.
constexpr NumberRange kSamplesRange = within(1, 1 << 24);
constexpr const char* kSamplesAdvice = "100 is a first look";
constexpr NumberRange kBouncesRange = within(0, 8);
constexpr const char* kBouncesHelp = "of light between surfaces";
constexpr const char* kBouncesAdvice = "2 shows most of it";
constexpr NumberRange kReachRange = above(0, 1e12, "mm");
constexpr const char* kReachAdvice = "leave it out for no limit";
constexpr const char* kAlbedoHelp = "of the surface: one number, or red,green,blue";
constexpr const char* kPointLightHelp =
    "a place and its intensity; or centreline and the lights' distance, in a colon; may be given several "
    "times";

constexpr NumberRange kThreadsRange = within(0, 256);
constexpr const char* kThreadsHelp = "threads to use, 0 for all processors";
constexpr const char* kThreadsAdvice = "leave it out to use all processors";

// Which study, and where the colon is in it.
void addStudy(CLI::App& command, VolumeOptions& options);
void addThreads(CLI::App& command, SceneOptions& options);
// How the ground of a terrain is read.
void addGround(CLI::App& command, SceneOptions& options);
// Which scene, and how it is read.
void addSource(CLI::App& command, SceneOptions& options);
// The same, and how it looks.
void addScene(CLI::App& command, SceneOptions& options);
void addMedium(CLI::App& command, MediumOptions& options);
void addTraced(CLI::App& command, TracedOptions& options);

}  // namespace stereonav
