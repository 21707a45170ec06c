#include "engine/frame/cast_frames.h"

#include <array>
#include <string>

#include "engine/base/error.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

constexpr auto kNames = [] {
    std::array<std::string_view, kRightEyeMethods.size()> names;
    for (std::size_t n = 0; n < names.size(); ++n) names[n] = kRightEyeMethods[n].name;
    return names;
}();

RightEyeMethod methodNamed(std::string_view name) {
    if (const auto method = rightEyeMethodFromName(name)) return *method;
    throw Error("", "", "there is no method \"" + std::string(name) + "\" of making the right eye",
                "use one of methods()");
}

}  // namespace

std::span<const std::string_view> CastFrames::allMethods() {
    return kNames;
}

std::string_view CastFrames::defaultMethod() const {
    return nameOf(defaultMethodFor(mRenderer));
}

std::vector<std::string_view> CastFrames::compared() const {
    std::vector<std::string_view> names;
    for (const RightEyeMethod method : methodsFor(mRenderer))
        if (method != mUncompared) names.push_back(nameOf(method));
    return names;
}

void CastFrames::make(const StereoViews& views, double, const FrameWay& way, EyePair& frame) {
    const WarpSetting setting = settingOf(way);
    mRenderer.lookFrom(views.left, views.right);
    frame.left.resize(views.left.width, views.left.height, mRenderer.viewDependence());
    const Stopwatch watch;
    renderEye(mRenderer, views.left, frame.left);
    frame.timings.left_ms = watch.elapsed_ms();
    const RightEyeTimings right = warp(views, frame.left, setting, frame.right);
    frame.timings.right_ms = right.right_ms();
    frame.timings.warped = right;
    // After the warp, which takes each pixel for one surface.
    const EdgeTimings leftEdges = smoothEdges(views.left, way, frame.left);
    const EdgeTimings rightEdges =
        leavesHoles(setting.method) ? EdgeTimings{} : smoothEdges(views.right, way, frame.right);
    frame.timings.left_ms += leftEdges.ms;
    frame.timings.right_ms += rightEdges.ms;
    frame.timings.edges = {leftEdges.ms + rightEdges.ms, leftEdges.pixels + rightEdges.pixels};
    frame.timings.both_ms = frame.timings.left_ms + frame.timings.right_ms;
}

RightEyeTimings CastFrames::makeRight(const StereoViews& views, const EyeImage& left, const FrameWay& way,
                                      EyeImage& right) {
    return warp(views, left, settingOf(way), right);
}

WarpSetting CastFrames::settingOf(const FrameWay& way) const {
    WarpSetting setting = way.warp;
    setting.method = methodNamed(way.method.empty() ? defaultMethod() : way.method);
    return setting;
}

RightEyeTimings CastFrames::warp(const StereoViews& views, const EyeImage& left, const WarpSetting& setting,
                                 EyeImage& right) {
    mLast = setting.method;
    return mRightEye.render(mRenderer, views, left, setting, right);
}

void CastFrames::makeOne(const EyeView& view, double, EyePair& frame) {
    mRenderer.lookFrom(view);
    frame.left.resize(view.width, view.height, mRenderer.viewDependence());
    frame.right = {};
    const Stopwatch watch;
    renderEye(mRenderer, view, frame.left);
    frame.timings = {};
    frame.timings.both_ms = frame.timings.left_ms = watch.elapsed_ms();
}

std::optional<FramePlan> CastFrames::measure(std::span<const StereoViews> views) {
    return planFrame(mRenderer, views);
}

std::optional<QualityPlan> CastFrames::meet(const QualityWish& wish, std::string_view method,
                                            std::span<const StereoViews> views) {
    constexpr int kTimedRepeats = 2;  // where times are wished for
    QualityWish wished = wish;
    std::vector<NamedWarp> warps = warpsWorthTrying(mRenderer);
    if (!method.empty()) {
        warps.erase(warps.begin(), warps.end() - 1);
        warps.insert(warps.begin(), {std::string(method), {}});
        warps.front().setting.method = methodNamed(method);
        wished.firstAlone = true;
    }
    return planQuality(measureWarps(mRenderer, views, warps, wish.target_ms ? kTimedRepeats : 1), wished);
}

}  // namespace stereonav
