#include "app/report/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/camera/default_eyes.h"
#include "engine/metrics/image_difference.h"

namespace stereonav {
namespace {

constexpr int kLeastRepeats = 3, kMostRepeats = 9;

}  // namespace

Variant methodVariant(RightEyeMethod method) {
    Variant v{std::string(nameOf(method)), "", {}, false};
    v.setting.method = method;
    return v;
}

Variant tuned(RightEyeMethod method, float WarpSetting::*what, const char* name, float value) {
    Variant v = methodVariant(method);
    v.setting.*what = value;
    v.name = fmt::format("{} {:g}", nameOf(method), value);
    v.detail = fmt::format("{} {:g}", name, value);
    return v;
}

std::vector<Variant> rightEyeVariants(const Scene& scene) {
    std::vector<Variant> variants;
    for (const RightEyeMethod method : methodsFor(rendererOf(scene))) {
        variants.push_back(methodVariant(method));
        variants.back().isDefault = method == defaultMethodFor(rendererOf(scene));
    }
    const bool glass = rendererOf(scene).translucent();
    if (glass)
        for (const float spread : {0.2f, 0.4f, 1.0f, 1.5f, 3.0f})
            variants.push_back(tuned(RightEyeMethod::Selective, &WarpSetting::mostSpread,
                                     "largest shift of depths", spread));
    else
        for (const float stretch : {1.05f, 1.1f, 1.2f, 1.8f, 2.5f})
            variants.push_back(
                tuned(RightEyeMethod::Linear, &WarpSetting::maxStretch, "largest stretch", stretch));
    if (!glass)
        for (const float weight : {0.25f, 0.75f})
            variants.push_back(
                tuned(RightEyeMethod::Paper, &WarpSetting::weightThreshold, "least weight", weight));
    return variants;
}

StereoSetting chartedEyes(const Scene& scene) {
    StereoSetting stereo = scene.stereo;
    stereo.separation = stereo.zeroParallax * kUsualShare;
    return stereo;
}

double rmsOfPsnr(double psnr_db) {
    return psnr_db >= kIdenticalPsnr_db ? 0.0 : 255 * std::pow(10.0, -psnr_db / 20);
}

double rmsOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& picture) {
    return rmsOfPsnr(psnrOf(truth, picture));
}

std::vector<Pose> posesOf(const Scene& scene, int frames) {
    return scene.path.samples().empty() ? std::vector<Pose>{scene.startPose} : scene.path.frames(frames);
}

int measureWhatFits(int most, double seconds,
                    const std::function<void(const std::vector<int>& some, int of)>& measure) {
    const Stopwatch watch;
    measure({0}, most);
    // The first frame is the same for any number of frames.
    const double affordable = 1000 * seconds / std::max(watch.elapsed_ms(), 1e-3);
    const int count = static_cast<int>(std::clamp(affordable, 1.0, std::max(1.0, double(most))));
    std::vector<int> others;
    for (int n = 1; n < count; ++n) others.push_back(n);
    measure(others, count);
    return count;
}

RightEyeTrial::RightEyeTrial(const ReportScene& scene, const StereoSetting& stereo,
                             std::vector<Variant> variants)
    : mScene(scene.loaded()),
      mMaker(scene.frames()),
      mRightMaker(scene.rightFromLeft()),
      mStereo(stereo),
      mVariants(std::move(variants)),
      mSums(mVariants.size()),
      mRepeats(kLeastRepeats) {
    for (const Variant& v : mVariants) mBounds |= v.setting.refinement.calibration != nullptr;
}

void RightEyeTrial::run(ReportRun& run, const std::string& what, int frames, double seconds) {
    std::vector<Pose> poses = posesOf(mScene, frames);
    const Stopwatch watch;
    for (std::size_t n = 0; n < poses.size(); ++n) {
        run.tell(what);
        frame(run, makeStereoViews(poses[n], mScene.lens, mStereo), what);
        // The number of frames is limited by the time; the first is the same for any number of them.
        const double affordable = 1000 * seconds / std::max(watch.elapsed_ms(), 1e-3);
        if (n == 0 && affordable < frames) poses = posesOf(mScene, std::max(1, static_cast<int>(affordable)));
        if (n == 0) chooseRepeats(watch.elapsed_ms(), poses.size(), seconds);
        for (std::size_t k = 0; k < mSums.size(); ++k) mSums[k].least_ms += mFastest[k];
    }
    mFrames = static_cast<int>(poses.size());
}

std::vector<WayPoint> RightEyeTrial::points() const {
    std::vector<WayPoint> points;
    for (std::size_t n = 0; n < mVariants.size(); ++n) points.push_back(pointOf(mVariants[n], mSums[n]));
    return points;
}

// Chooses the number of repeats by the time of the first frame, which was repeated kLeastRepeats times.
void RightEyeTrial::chooseRepeats(double first_ms, std::size_t frames, double seconds) {
    const double perRepeat_ms = mTimed_ms / kLeastRepeats,
                 fixed_ms = std::max(0.0, first_ms - mTimed_ms) * static_cast<double>(frames);
    const double affordable =
        (1000 * seconds - fixed_ms) / std::max(perRepeat_ms * static_cast<double>(frames), 1e-3);
    mRepeats = std::clamp(static_cast<int>(affordable), kLeastRepeats, kMostRepeats);
    // The remaining repeats of the first frame.
    for (int r = kLeastRepeats; r < mRepeats; ++r) repeat(r);
}

void RightEyeTrial::frame(ReportRun& run, const StereoViews& views, const std::string& what) {
    mViews = views;
    mMaker.make(views, 0, {mMaker.exactMethod(), {}}, mFull);
    for (std::size_t n = 0; n < mVariants.size(); ++n) measureError(n);
    mFastest.assign(mVariants.size(), 1e300);
    const Stopwatch watch;
    for (int r = 0; r < mRepeats; ++r) {
        run.tell(what);
        repeat(r);
    }
    mTimed_ms = watch.elapsed_ms();
}

void RightEyeTrial::measureError(std::size_t n) {
    const RightEyeTimings timings =
        mRightMaker.makeRight(mViews, mFull.left, wayOf(mVariants[n].setting), mRight);
    Plane<std::uint8_t> nothing(mRight.width(), mRight.height());
    const ImageDifference difference = differenceOf(mFull.right.color, mRight.color, nothing);
    const double rms = rmsOfPsnr(difference.psnr_db);
    Sums& sums = mSums[n];
    sums.squares += rms * rms;
    sums.worst = std::max(sums.worst, rms);
    sums.ssim += difference.ssim;
    sums.kept += difference.psnr_db >= timings.boundPsnr_db;
    sums.bound_db += timings.boundPsnr_db;
    sums.holes +=
        static_cast<double>(timings.holePixels) / (static_cast<double>(mRight.width()) * mRight.height());
}

void RightEyeTrial::repeat(int r) {
    for (std::size_t n = 0; n < mVariants.size(); ++n) {
        const RightEyeTimings t =
            mRightMaker.makeRight(mViews, mFull.left, wayOf(mVariants[n].setting), mRight);
        const auto add = [r](std::vector<double>& sums, double ms) {
            sums.resize(std::max(sums.size(), static_cast<std::size_t>(r) + 1));
            sums[static_cast<std::size_t>(r)] += ms;
        };
        add(mSums[n].right_ms, t.right_ms());
        mFastest[n] = std::min(mFastest[n], t.right_ms());
        add(mSums[n].warp_ms, t.warp_ms);
        add(mSums[n].fill_ms, t.fill_ms);
    }
}

WayPoint RightEyeTrial::pointOf(const Variant& v, const Sums& sums) const {
    const double count = mFrames;
    const auto mean = [count](const std::vector<double>& times) {
        return scaled(spreadOf(times), 1 / count);
    };
    WayPoint point;
    Spread time = mean(sums.right_ms);
    time.low = sums.least_ms / count;
    point.way = {v.name, time, std::sqrt(sums.squares / count), v.isDefault};
    point.detail = v.detail;
    point.worstError = sums.worst;
    point.others = {{"warp ms", mean(sums.warp_ms).median},
                    {"fill ms", mean(sums.fill_ms).median},
                    {"holes %", 100 * sums.holes / count},
                    {"SSIM", sums.ssim / count}};
    if (mBounds) {
        point.others.emplace_back("bound dB", sums.bound_db / count);
        point.others.emplace_back("frames within it %", 100 * sums.kept / count);
    }
    return point;
}

}  // namespace stereonav
