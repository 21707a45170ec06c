// From what the command line says to a scene that can be cast: shared by all commands.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/command/commands.h"
#include "app/output/output_place.h"
#include "app/scene/lazy_light.h"
#include "app/scene/traced_light.h"
#include "colon/colon_scene.h"
#include "engine/base/progress.h"
#include "engine/frame/frame_maker.h"
#include "engine/image/stereo_compose.h"
#include "engine/light/turning_sky.h"
#include "engine/math/simd_target.h"
#include "engine/medium/medium_scene.h"
#include "engine/nav/flight.h"
#include "engine/stereo/frame_plan.h"
#include "engine/stereo/room_seen.h"
#include "terrain/terrain_scene.h"

namespace stereonav {

class SweptFrames;  // engine/medium/swept_frames.h

struct LoadedScene {
    std::string name;  // as given, "terrain" for the built-in one
    // What the rest refers to: one of the first two, but for a built-in medium. Shared so that a program that
    // leaves one of them out needs nothing of it.
    std::shared_ptr<TerrainScene> terrain;
    std::shared_ptr<ColonScene> colon;
    std::shared_ptr<MediumScene> medium;       // null where rays are cast
    std::optional<double> modulateSigma;       // of opacity modulation, given or chosen; none: without
    std::shared_ptr<LazyLight> lazyLight;      // of a volume lit while it is shown; else null
    std::shared_ptr<TracedLight> tracedLight;  // of one lit at every pixel of a picture; else null
    std::shared_ptr<TurningSky> sky;           // over baked transfer, where SceneOptions::skyTurns; else null
    std::unique_ptr<EyeRenderer> renderer;     // null for a medium
    std::unique_ptr<FrameMaker> frames;        // of the renderer's rays, or of the medium
    SweptFrames* swept = nullptr;              // what frames is, of a medium
    std::unique_ptr<EyeRenderer> wall;   // of a medium inside a colon: tells its eyes of the room; else null
    SimdTarget simd = SimdTarget::Auto;  // that the renderer uses
    Lens lens;                           // with the size asked for
    StereoSetting stereo;
    Pose startPose;
    RecordedPath path;                    // the scene's own flight
    std::vector<RightEyeMethod> methods;  // that compare runs when none are named
    std::function<std::unique_ptr<Flight>()> makeFlight;
    // Of volumes that are cast: eyes that suit the room around them, and the distance to what is near, of the
    // head and of eyes as far apart as they get, metres. eyesFollow: the window's do at the start, and those
    // of pictures and videos come together as they do: in a colon, where neither --separation nor
    // --zero-parallax is given.
    std::function<StereoFollower(const StereoSetting& from)> makeFollower;
    std::function<double(const Pose& head)> clearanceAt;
    bool eyesFollow = false;
    // Of a terrain under baked light, and of a medium under parallel light: turns the sun, radians. Not while
    // a picture is made.
    std::function<void(double azimuth, double elevation)> moveSun;

    StereoViews viewsAt(const Pose& head) const { return makeStereoViews(head, lens, stereo); }
    RightEyeMethod defaultMethod() const { return defaultMethodFor(*renderer); }
};

enum class SceneKind { Terrain, Volume, Medium };  // Medium: a built-in one
// What a scene's name stands for. Throws Error for a name of nothing, with what can be named.
SceneKind kindOf(const std::string& name);
// From files: not the built-in colon.
bool isStudy(const std::string& name);

// What the options name to be read; words that are no files are among them.
std::vector<NamedPlace> inputsOf(const SceneOptions& options);

// Checks options and size, sets the thread count, reads the scene. Throws Error, Cancelled.
LoadedScene loadScene(const SceneOptions& options, const SizeOption& size, Progress& progress);

// The recorded path read from `file`, or the scene's own. Throws Error where there is none, and where a
// recorded one leaves the lumen of a colon.
const RecordedPath& flightOf(const LoadedScene& scene, const std::optional<RecordedPath>& path,
                             const std::string& file);

// Bytes that a command holds for each pixel of one eye, measured at 2000x2000 and rounded up: both
// eyes and the composed picture; a video encoder's frames (FFV1); every method with its truths and
// the SSIM's intermediate pictures.
constexpr int kRenderBytesPerPixel = 96, kVideoBytesPerPixel = 384, kCompareBytesPerPixel = 320;

// 1 to 32768 pixels a side, and no more than the memory that can be had. Throws Error.
void checkSize(const SizeOption& size, int bytesPerPixel = kRenderBytesPerPixel);

// "x,y,z,heading,pitch,roll" in metres and degrees; the last ones may be left out (0). Throws Error.
Pose poseFromText(const std::string& text);

// A way of making the right eye by name, none for "auto": the scene's default, since what is written to files
// must not depend on what was measured. Throws Error with the known names.
std::optional<RightEyeMethod> methodFromText(const std::string& name, const char* option = "--method");
// ... and one of making both eyes of a medium, its default for "auto".
std::string_view sweepMethodFromText(const std::string& name, const char* option = "--method");
OutputMode modeFromText(const std::string& name);
// Separation, zero parallax and field of view that were asked for.
void adjustViews(const SceneOptions& options, LoadedScene& scene);
SimdTarget simdFromText(const std::string& name);

// The frame plan of a loaded scene: measured at the start pose and along its flight. Nothing where there is
// nothing to weigh.
std::optional<FramePlan> planScene(const LoadedScene& scene);

// The processor's name, "unknown" where the system does not tell.
std::string machineName();

}  // namespace stereonav
