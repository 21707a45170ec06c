// Frames of scenes whose rays are cast: the left eye in full, the right one from it
// (engine/stereo/right_eye.h).
#pragma once

#include "engine/frame/frame_maker.h"
#include "engine/render/eye_renderer.h"

namespace stereonav {

class CastFrames final : public FrameMaker {
public:
    // renderer must outlive this. Default method: defaultMethodFor(renderer).
    explicit CastFrames(const EyeRenderer& renderer) : mRenderer(renderer) {}

    std::span<const std::string_view> methods() const override;
    std::string_view defaultMethod() const override;
    std::string_view whatMethodsMake() const override { return "right eye"; }
    void make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) override;
    void makeOne(const EyeView& view, double time, EyePair& frame) override;
    std::optional<FramePlan> measure(std::span<const StereoViews> views) override;
    std::optional<QualityPlan> meet(const QualityWish& wish, std::string_view method,
                                    std::span<const StereoViews> views) override;

private:
    const EyeRenderer& mRenderer;
    RightEye mRightEye;
};

}  // namespace stereonav
