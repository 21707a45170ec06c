// The calibration of a warp from views of a scene.
#pragma once

#include <span>

#include "engine/stereo/error_prediction.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

// Warps and casts each of the views, at least one, of one size.
inline ErrorCalibration calibrateError(const EyeRenderer& renderer, std::span<const StereoViews> views,
                                       const WarpSetting& setting) {
    WarpSetting warp = setting, full = setting;
    warp.refinement = full.refinement = {};
    full.method = RightEyeMethod::Full;
    EyeImage left, warped, cast;
    RightEye eye;
    ErrorCalibrator calibrator;
    for (const StereoViews& view : views) {
        left.resize(view.left.width, view.left.height, renderer.viewDependence());
        renderer.lookFrom(view.left, view.right);
        renderEye(renderer, view.left, left);
        eye.render(renderer, view, left, full, cast);
        eye.render(renderer, view, left, warp, warped);
        calibrator.add(warped, eye.holeMask(), cast);
    }
    return calibrator.result();
}

}  // namespace stereonav
