// One frame of the pipeline without a window: left eye, right eye, one picture for the display.
#pragma once

#include "app/scene_loading.h"
#include "engine/base/hash.h"

namespace stereonav {

class StereoFrame {
public:
    StereoFrame(const LoadedScene& scene, RightEyeMethod method) : mScene(scene) { mWarp.method = method; }

    // Both eyes at one pose.
    void render(const Pose& head);

    const EyeImage& left() const { return mLeft; }
    const EyeImage& right() const { return mRight; }
    double left_ms() const { return mLeft_ms; }
    const RightEyeTimings& timings() const { return mTimings; }
    Plane<PackedColor> compose(OutputMode mode) const {
        return composeStereo(mLeft.color, mRight.color, {mode, false, false});
    }

    // Colour and depth of both eyes, pixels only.
    void addTo(Hash& hash) const;

private:
    const LoadedScene& mScene;
    WarpSetting mWarp;
    RightEye mEye;
    EyeImage mLeft, mRight;
    double mLeft_ms = 0;
    RightEyeTimings mTimings;
};

}  // namespace stereonav
