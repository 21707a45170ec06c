// `stereonav play`, which also runs without a command.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/options/scene_options.h"
#include "app/options/shared_options.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

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
    double fps = 25;                          // frames a second of the path
    std::optional<int> frames;                // number of frames, evenly spaced; empty: the whole path at fps
    std::optional<std::pair<int, int>> part;  // first and last of the whole path's frames at fps, from 0
    bool hash = false;                        // print one content hash of all frames
};

int runPlay(const PlayOptions& options);

}  // namespace stereonav
