// What a scene's frames need and how their right eye is made, decided once by measurement. It lives
// with the stereo code, one room above the renderers, because it weighs the warp against the cast.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "engine/camera/stereo_rig.h"
#include "engine/render/eye_renderer.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

// Measured costs of one frame of a given size and separation.
struct FrameCosts {
    double cast_ns = 0;    // a pixel of a full cast, all threads together
    double warp_ns = 0;    // a pixel of the warp
    double hole_ns = 0;    // a ray cast into a hole; 0 when there were none
    double holeShare = 0;  // share of pixels that are holes in all right eyes, 0..1; 1 where all pixels are
                           // cast from known depths
};

// The decision for frames of one size, with the figures that it rests on.
struct FramePlan {
    int width = 0, height = 0;  // pixels of one eye
    ViewDependence dependence = ViewDependence::None;
    bool viewDependent = false;                      // planes are stored from which colours are shaded again
    RightEyeMethod method = kDefaultRightEyeMethod;  // Full where casting is cheaper
    double castRight_ms = 0, warpRight_ms = 0;       // predicted for the right eye alone
    FrameCosts costs;
    std::size_t bytes = 0;  // bytes of both eyes and the hole mask
    std::string reason;     // one sentence with the figures

    // Returns whether the right eye is warped rather than cast in full.
    bool warps() const { return method != RightEyeMethod::Full; }
};

// Decides which is cheaper for this many pixels. warp: the method used where it wins.
FramePlan planFromCosts(const FrameCosts& costs, int width, int height, ViewDependence dependence,
                        RightEyeMethod warp = kDefaultRightEyeMethod);

// Measures a few calibration frames in their order and decides. views: at least one, all of one size. Takes
// about `budget_ms`, but measures at least three frames, or all where there are fewer; the first is made once
// before it is timed. warp: the method to compare with the full cast; none: defaultMethodFor(renderer).
// Throws Error without views.
FramePlan planFrame(const EyeRenderer& renderer, std::span<const StereoViews> views,
                    std::optional<RightEyeMethod> warp = std::nullopt, double budget_ms = 300.0);

// Returns the bytes that a frame of this size holds: both eyes' planes and the hole mask.
std::size_t frameBytes(int width, int height, ViewDependence dependence);

}  // namespace stereonav
