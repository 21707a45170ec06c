// Options that commands share: which scene, how it is read, and how it looks. Each function adds its options
// to a subcommand, which fills `options` when it is parsed.
#pragma once

#include "app/commands.h"

namespace CLI {
class App;
}

namespace stereonav {

constexpr const char* kImageHelp = "colour of the ground";
constexpr const char* kShadeImageHelp =
    "light that picture by the sun, though it holds the light of its own day";
constexpr const char* kSunHelp = "azimuth,elevation of a terrain's sun in degrees, clockwise from north";
constexpr const char* kUpHelp =
    "x, -x, y, -y, z or -z: the axis of a study's file that is to point up, by quarter turns; not where a "
    "colon is looked for";
constexpr const char* kTerrainHelp = "a scene (.toml) or an elevation model; left out: the built-in terrain";
constexpr const char* kStudyHelp =
    "a CT study (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd, a folder of DICOM slices), or colon, which is "
    "built in";

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
