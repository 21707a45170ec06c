// Options of the commands that show scenes; their rows are in the shared tables.
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
    // Folder for a preview of each series of a DICOM folder, which is then the only result; "": none.
    std::string series;
};

// Returns the options of a scene for a picture, which can be path traced.
inline SceneOptions renderedSceneOptions() {
    SceneOptions options = shownSceneOptions();
    options.traced.emplace();
    return options;
}

struct RenderOptions {
    SceneOptions scene = renderedSceneOptions();
    Telling telling;
    SizeOption size;
    std::optional<Pose> pose;     // empty: the start pose
    std::string method = "auto";  // a right-eye method; auto: the default, independent of measurements
    RayOptions rays;
    OutputMode mode = OutputMode::SideBySide;
    std::string out;  // image file
};

constexpr double kPlayFps = 25;  // default frame rate

struct PlayOptions {
    SceneOptions scene = shownSceneOptions();
    Telling telling;
    SizeOption size;
    std::string path;             // file of a flight; "": the scene's own
    std::string method = "auto";  // auto: the default, independent of measurements
    RayOptions rays;
    OutputMode mode = OutputMode::SideBySide;
    std::string out;                          // folder for frame_00000.png ...; "" with --video or --hash
    std::string video;                        // .mp4, .avi or .mkv
    std::optional<double> fps;                // empty: 25
    std::optional<int> frames;                // number of frames, evenly spaced; empty: the whole path at fps
    std::optional<std::pair<int, int>> part;  // first and last of the whole path's frames at fps, from 0
    bool hash = false;                        // print one content hash of all frames
};

struct ViewOptions {
    SceneOptions scene = shownSceneOptions();
    Telling telling;
    SizeOption size;
    std::string method = "auto";  // auto: the frame plan's choice
    OutputMode mode = OutputMode::SideBySide;
    std::string path;   // flight that the key Z starts first
    std::string shots;  // folder for screenshots and recorded flights; "": the working folder
    SweepChoice sweep = SweepChoice::Auto;  // processor that sweeps a medium
    bool startPage = false;                 // whether the start page covers the scene at first
    std::string fullScreen;                 // "": a window; auto, a monitor's number, or part of its name
    std::optional<double> screenWidth_mm, viewingDistance_mm;  // empty: as the monitor reports, and a default
    bool refine = true;                                        // refine a picture that rests
    bool lateWarp = true;             // show the newest picture from the present place of the eyes
    std::optional<double> target_ms;  // time for a frame while something moves; empty: by the monitor
    bool bench = false;               // fly the flight, rest, measure what is shown, and close
    std::string json;                 // file for the result when the window is closed; "": none
};

}  // namespace stereonav
