// Frames of scenes whose rays are cast: the left eye in full, the right one from it
// (engine/stereo/right_eye.h), then more rays at the edges of both (engine/sampling/edge_rays.h).
#pragma once

#include "engine/frame/frame_maker.h"
#include "engine/render/eye_renderer.h"

namespace stereonav {

// Makes frames by rays and a warp, keeping its buffers between them.
class CastFrames final : public FrameMaker, public RightFromLeft {
public:
    // renderer must outlive this object. Its default method is defaultMethodFor(renderer); compared() returns
    // methodsFor(renderer) without `uncompared`.
    explicit CastFrames(const EyeRenderer& renderer, std::optional<RightEyeMethod> uncompared = {})
        : mRenderer(renderer), mUncompared(uncompared) {}

    // Returns the methods of all scenes whose rays are cast.
    static std::span<const std::string_view> allMethods();
    std::span<const std::string_view> methods() const override { return allMethods(); }
    std::string_view defaultMethod() const override;
    std::string_view exactMethod() const override { return nameOf(RightEyeMethod::Full); }
    std::vector<std::string_view> compared() const override;
    std::string_view whatMethodsMake() const override { return "right eye"; }
    void make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) override;
    void makeOne(const EyeView& view, double time, EyePair& frame) override;
    RightFromLeft* rightFromLeft() override { return this; }
    RightEyeTimings makeRight(const StereoViews& views, const EyeImage& left, const FrameWay& way,
                              EyeImage& right) override;
    EdgeTimings smoothEdges(const EyeView& view, const FrameWay& way, EyeImage& image) override {
        return mEdges.smooth(mRenderer, view, way.edges, image);
    }
    RightHoles holes() const override { return {mRightEye.holeMask(), leavesHoles(mLast)}; }
    std::optional<FramePlan> measure(std::span<const StereoViews> views) override;
    std::optional<QualityPlan> meet(const QualityWish& wish, std::string_view method,
                                    std::span<const StereoViews> views) override;

private:
    WarpSetting settingOf(const FrameWay& way) const;
    RightEyeTimings warp(const StereoViews& views, const EyeImage& left, const WarpSetting& setting,
                         EyeImage& right);

    const EyeRenderer& mRenderer;
    std::optional<RightEyeMethod> mUncompared;
    RightEye mRightEye;
    EdgeRays mEdges;
    RightEyeMethod mLast = kDefaultRightEyeMethod;  // how the last right eye was made
};

}  // namespace stereonav
