// Options of `stereonav render`.
#pragma once

#include <optional>
#include <string>

#include "app/options/scene_options.h"
#include "app/options/shared_options.h"
#include "engine/camera/pose.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

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

}  // namespace stereonav
