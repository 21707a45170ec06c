// From what the command line says to a scene that can be cast: shared by all commands.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/command/commands.h"
#include "app/output/output_place.h"
#include "engine/base/progress.h"
#include "engine/image/stereo_compose.h"
#include "engine/scene/scene.h"
#include "engine/simd/simd_target.h"
#include "engine/stereo/frame_plan.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

// What the options name to be read; words that are no files are among them.
std::vector<NamedPlace> inputsOf(const SceneOptions& options);

// Checks what can be checked before the scene is read, and sets the thread count. Throws Error.
void checkSceneOptions(const SceneOptions& options);

// Bytes that a command holds for each pixel of one eye beside the scene, measured at 1500x1500 and rounded
// up: both eyes and the composed picture while it is encoded (as WebP, which takes most) or refined; a video
// encoder's frames, FFV1's apart, and its libraries; every method with its truths and the SSIM's intermediate
// pictures; eyes that are measured and not composed; a window's frames, its software renderer's textures and
// a picture that is saved (measured at 320x240, 1200x700 and 2400x1400; shaders of all modes take 40 MB, of
// which half is the 20 MB that every program has).
struct PixelBytes {
    double cast = 0, swept = 0;  // of scenes whose rays are cast; of media
    double beside = 0;           // bytes, of pictures of any size
};
constexpr PixelBytes kRenderBytes{88, 176}, kVideoBytes{80, 176, 24e6}, kLosslessVideoBytes{400, 480, 24e6},
    kCompareBytes{320, 608}, kInfoBytes{48, 128}, kViewBytes{88, 144, 24e6}, kNoPicture{};

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

// A way of making the right eye by name, none for "auto": the scene's default, since what is written to files
// must not depend on what was measured. Throws Error with the known names.
std::optional<RightEyeMethod> methodFromText(const std::string& name, const char* option = "--method");
// ... and one of making both eyes of a medium, its default for "auto".
std::string_view sweepMethodFromText(const std::string& name, const char* option = "--method");
// The same of either kind, by what the scene offers; its default for "auto".
std::string_view methodNamed(const std::string& name, const Scene& scene);
// Separation, zero parallax and field of view that were asked for.
void adjustViews(const SceneOptions& options, Scene& scene);

// The frame plan of a loaded scene: measured at the start pose and along its flight. Nothing where there is
// nothing to weigh.
std::optional<FramePlan> planScene(const Scene& scene);

// The processor's name, "unknown" where the system does not tell.
std::string machineName();

}  // namespace stereonav
