// Values of the options of the command `view`.
#pragma once

#include <optional>
#include <string>

#include "app/options/scene_options.h"
#include "app/options/shared_options.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

struct ViewOptions {
    SceneOptions scene = shownSceneOptions();
    Telling telling;
    SizeOption size;
    std::string method = "auto";     // auto: the frame plan's choice
    std::optional<OutputMode> mode;  // empty: as the window was left, at first one eye
    std::string path;                // flight that the key Z starts first
    std::string shots;               // folder for screenshots and recorded flights; "": the working folder
    SweepChoice sweep = SweepChoice::Auto;  // processor that sweeps a medium
    std::string fullScreen;                 // "": a window; auto, a monitor's number, or part of its name
    std::optional<double> screenWidth_mm, viewingDistance_mm;  // empty: as the monitor reports, and a default
    bool refine = true;                                        // refine a picture that rests
    bool lateWarp = true;             // show the newest picture from the present place of the eyes
    std::optional<double> target_ms;  // time for a frame while something moves; empty: by the monitor
    bool bench = false;               // fly the flight, rest, measure what is shown, and close
    std::string json;                 // file for the result when the window is closed; "": none
};

}  // namespace stereonav
