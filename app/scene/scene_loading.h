// From what the command line says to a scene that can be cast: shared by all commands.
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

// What the options name to be read; words that are no files are among them.
std::vector<NamedPlace> inputsOf(const SceneOptions& options);

// Checks what can be checked before the scene is read, and sets the thread count. Throws Error.
void checkSceneOptions(const SceneOptions& options);

// Checks options and size, sets the thread count, reads the scene. each: of the pictures that will be made;
// once the scene is there they are checked again, beside it. Throws Error, Cancelled.
std::unique_ptr<Scene> loadScene(const SceneOptions& options, const SizeOption& size, Progress& progress,
                                 const PixelBytes& each = kRenderBytes);

// The recorded path read from `file`, or the scene's own. Throws Error where there is none, and where a
// recorded one leaves the lumen of a colon.
const RecordedPath& flightOf(const Scene& scene, const std::optional<RecordedPath>& path,
                             const std::string& file);

// 1 to 32768 pixels a side, and no more than the memory that can be had. Throws Error.
void checkSize(const SizeOption& size, const SceneOptions& options, const PixelBytes& each = kRenderBytes);

// Throws Error, naming the option that it is of, unless `method` names a way of making two eyes of what the
// options show. "auto" is one: the scene's default, since what is written to files must not depend on what
// was measured.
void checkMethod(const SceneOptions& options, const std::string& method, const char* option = "--method");
// One of the scene's FrameMaker; its default for "auto". Throws Error.
std::string_view methodNamed(const std::string& name, const Scene& scene);
// Separation, zero parallax and field of view that were asked for.
void adjustViews(const SceneOptions& options, Scene& scene);

// The frame plan of a loaded scene: measured along its flight, or at its start where it has none, with the
// eyes as frames have them (NarrowedEyes). Nothing where there is nothing to weigh.
std::optional<FramePlan> planScene(const Scene& scene);

// The processor's name, "unknown" where the system does not tell.
std::string machineName();

}  // namespace stereonav
