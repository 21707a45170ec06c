// Data that the window's thread and the others exchange: scenes, requests for frames, frames.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>

#include "app/view/frame_truth.h"
#include "engine/camera/stereo_rig.h"
#include "engine/frame/frame_maker.h"
#include "engine/image/stereo_compose.h"
#include "engine/late/late_warp.h"
#include "engine/render/eye_painter.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/live_paint.h"
#include "engine/scene/scene.h"
#include "engine/stereo/parallax_histogram.h"

namespace stereonav {

// A scene as the window shows it. Changes behind it (light, the sun, a medium's model) are made on the thread
// that makes frames.
struct OpenScene {
    std::shared_ptr<Scene> scene;
    FrameWay way;  // planned when the scene was opened; names its method
    SunPlace sun;  // at the beginning: place of its light, if that turns, and its model
    int model = 0;
    bool changed = false;  // made from the scene before, which showed the same (SurfaceChoices::changed)
};

// Everything that a frame depends on: one value, read at the beginning of a frame.
struct FrameRequest {
    long long version = 0;
    double asked_s = 0;  // time of asking, in seconds of the window's clock
    double ahead_s = 0;  // seconds after that for which it is made
    Pose pose;
    Lens lens;
    StereoSetting stereo;
    FrameWay way;
    int model = 0;                       // one of LightModels::names()
    double time = 0;                     // seconds, for animated scenes
    SunPlace sun;                        // for scenes whose sun can be moved
    long long paint = 0;                 // LivePaint::version(), where the scene offers it
    bool twoEyes = true;                 // false: one eye, at the head itself
    OutputMode mode = OutputMode::Left;  // mode that the eyes' size was chosen for
    // Whether the eyes may be changed to be comfortable in this picture (comfortableEyes); the frame's
    // request has the result.
    bool fitEyes = false;
    TruthView truth = TruthView::None;            // picture instead of the right eye
    double scale = 1;                             // share of the full size: less while something moves
    glm::ivec2 guard{0};                          // pixels that are cast outside the lens's, on each side
    glm::ivec2 whole{0};                          // the full size; 0: the lens's
    double effort = 1;                            // FrameEffort, where the scene offers it
    bool flying = false;                          // something moves: a newer request comes soon
    bool late = false;                            // it will also be seen from elsewhere (ViewFrame::late)
    bool refines = false;                         // whether it is refined while it rests (rest_refiner.h)
    std::shared_ptr<const EyePainter> paintOver;  // over the scene's own paint; null: nothing
};

struct ViewFrame : EyePair {
    FrameRequest request;
    std::string sweep;  // processor of the sweep, "" where it is not known
    // Parallax of the nearest and the farthest object, as shares of the width; positive is behind the screen.
    // Measured for every pixel of the left eye by its view depth: for translucent objects and media that of
    // the first hit, however faint.
    double nearParallax = 0, farParallax = 0;
    ParallaxHistogram parallax;  // for all pixels; empty for one eye
    double depthAhead = 0;       // metres: typical for the picture's middle; infinite where it is empty
    // Why the right eye does not show request.truth, or an explanation of it; mostly "".
    std::string truthNote;
    std::optional<PictureError> truthError;  // error of the right eye as made, where the difference is shown
    double made_ms = 0;                      // time of the whole frame
    // Rays per pixel of a picture that rested, and its expected PSNR against very many; 0 for one ray.
    int rays = 1;
    double effort = 1;  // for media: multiple of the scene's slices
    double expected_db = 0;
    bool lacksDetail = false;     // detail comes later (LateDetail)
    std::array<LateEye, 2> late;  // planes for the late warp; not ready where nobody asked for it
};

}  // namespace stereonav
