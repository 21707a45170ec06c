// From options to what commands work on: a scene whose frames can be made, or ground for instruments.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/options/output_place.h"
#include "app/options/scene_options.h"
#include "app/scene/shown_as.h"
#include "engine/base/progress.h"
#include "engine/image/stereo_compose.h"
#include "engine/scene/scene.h"
#include "engine/simd/simd_target.h"
#include "engine/stereo/frame_plan.h"

namespace stereonav {

struct SurveyGround;  // app/scene/terrain/survey_ground.h

// Returns the inputs that the options name; words that are not files are among them.
std::vector<NamedPlace> inputsOf(const SceneOptions& options);

// Checks everything that needs no scene, and sets the thread count. Throws Error.
void checkSceneOptions(const SceneOptions& options);

// Checks options and size, sets the thread count, reads the scene. each: bytes per pixel of the pictures to
// make; their memory is checked again beside the loaded scene. Throws Error, Cancelled.
std::unique_ptr<Scene> loadScene(const SceneOptions& options, const SizeOption& size, Progress& progress,
                                 const PixelBytes& each = kRenderBytes);

// Checks the options, sets the thread count, and reads ground for instruments. Throws Error, Cancelled.
SurveyGround loadSurveyGround(const SceneOptions& options, Progress& progress);

// Throws Error, before anything is read, unless the name can be that of a colon.
void expectColonName(const std::string& scene);

// Returns the flight read from a file, or the scene's own. Throws Error where there is none, and where a
// flight from a file leaves the lumen of a colon.
const RecordedPath& flightOf(const Scene& scene, const std::optional<RecordedPath>& path,
                             const std::string& file);

// Throws Error unless a side has 1 to 32768 pixels and the pictures fit into memory.
void checkSize(const SizeOption& size, const SceneOptions& options, const PixelBytes& each = kRenderBytes);

// Throws Error that names `option` unless `method` is a method for two eyes of the scene. "auto" is the
// scene's default, since the content of files must not depend on measurements.
void checkMethod(const SceneOptions& options, const std::string& method, const char* option = "--method");
// Returns a method of the scene's FrameMaker; its default for "auto". Throws Error.
std::string_view methodNamed(const std::string& name, const Scene& scene);

// Returns the frame plan of a loaded scene: measured along its flight, or at its start where it has none,
// with the eyes as frames have them (NarrowedEyes). Returns nothing where there is nothing to choose.
std::optional<FramePlan> planScene(const Scene& scene);

// Returns the processor's name, "unknown" where the system does not report it.
std::string machineName();

}  // namespace stereonav
