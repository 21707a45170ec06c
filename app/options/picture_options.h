// The commands whose options are in the shared tables, since they show the same scenes in the same ways.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/options/scene_options.h"
#include "app/options/shared_options.h"
#include "engine/camera/pose.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

struct InfoOptions {
    SceneOptions scene;
    SizeOption size;
    Telling telling;
    // Folder for a picture of each series of a DICOM folder, in the place of the rest; "": none.
    std::string series;
};

// Pictures alone can be path traced.
inline SceneOptions renderedSceneOptions() {
    SceneOptions options = shownSceneOptions();
    options.traced.emplace();
    return options;
}

struct RenderOptions {
    SceneOptions scene = renderedSceneOptions();
    Telling telling;
    SizeOption size;
    std::optional<Pose> pose;     // none: the start pose
    std::string method = "auto";  // a right-eye method; auto: the default one, whatever was measured
    RayOptions rays;
    OutputMode mode = OutputMode::SideBySide;
    std::string out;  // image file
};

constexpr double kPlayFps = 25;  // where nothing is said

struct PlayOptions {
    SceneOptions scene = shownSceneOptions();
    Telling telling;
    SizeOption size;
    std::string path;             // "": the scene's own
    std::string method = "auto";  // auto: as in RenderOptions, whatever was measured
    RayOptions rays;
    OutputMode mode = OutputMode::SideBySide;
    std::string out;                          // folder for frame_00000.png ...; "" with --video or --hash
    std::string video;                        // .mp4, .avi or .mkv
    std::optional<double> fps;                // none: 25
    std::optional<int> frames;                // this many, evenly; none: the whole path at fps
    std::optional<std::pair<int, int>> part;  // first and last of the whole path's frames at fps, from 0
    bool hash = false;                        // print one content hash of all frames
};

struct ViewOptions {
    SceneOptions scene = shownSceneOptions();
    Telling telling;
    SizeOption size;
    std::string method = "auto";  // auto: the frame plan's choice
    OutputMode mode = OutputMode::SideBySide;
    std::string path;   // Z plays this one at first
    std::string shots;  // folder for screenshots and recorded flights; "": the present one
    SweepChoice sweep = SweepChoice::Auto;  // where a medium is swept
    bool startPage = false;                 // over the scene, at first
    std::string fullScreen;                 // "": a window; auto, a monitor's number, or part of its name
    std::optional<double> screenWidth_mm, viewingDistance_mm;  // none: as the monitor tells, and usual
    bool refine = true;                                        // a picture that rests
    bool lateWarp = true;             // the newest picture is shown from where the eyes are now
    std::optional<double> target_ms;  // time for a frame while something moves; none: by the monitor
    bool bench = false;               // flies the flight, rests, measures what was shown, and closes
    std::string json;                 // where the result is written when the window is closed; "": nowhere
};

}  // namespace stereonav
