// The report's first part: every way of making the right eye, error against time, on every scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/report_run.h"
#include "engine/base/parallel.h"
#include "engine/image/image_file.h"
#include "engine/metrics/difference_picture.h"
#include "engine/metrics/image_difference.h"
#include "engine/metrics/supersampled_picture.h"

namespace stereonav {
namespace {

constexpr int kLeastRepeats = 3, kMostRepeats = 9;
constexpr int kTruthFactor = 4;      // 16 rays a pixel
constexpr double kShare = 1.0 / 30;  // of the zero-parallax distance: the eyes' separation

struct Variant {
    std::string name, detail;
    WarpSetting setting;
    bool isDefault = false;
};

Variant methodVariant(RightEyeMethod method) {
    Variant v{std::string(nameOf(method)), "", {}, false};
    v.setting.method = method;
    return v;
}

// The same way with one setting changed.
Variant tuned(RightEyeMethod method, float WarpSetting::*what, const char* name, float value) {
    Variant v = methodVariant(method);
    v.setting.*what = value;
    v.name = fmt::format("{} {:g}", nameOf(method), value);
    v.detail = fmt::format("{} {:g}", name, value);
    return v;
}

// Sums over the frames of one repeat, and over frames.
struct Sums {
    std::vector<double> right_ms, warp_ms, fill_ms;  // by repeat, over frames
    double least_ms = 0;                             // of each frame the fastest repeat, over frames
    double squares = 0, trueSquares = 0, worst = 0, ssim = 0, holes = 0;
};

// Root mean square error in 8-bit levels.
double rmsOf(double psnr_db) {
    return psnr_db >= kIdenticalPsnr_db ? 0.0 : 255 * std::pow(10.0, -psnr_db / 20);
}

// Runs variants over frames, one after another in each repeat, so that the machine's moods meet all alike.
class Trial {
public:
    // truths: also against 16 rays a pixel, which takes as long as 16 frames.
    Trial(const ReportScene& scene, const StereoSetting& stereo, std::vector<Variant> variants, bool truths)
        : mTruths(truths),
          mScene(scene.loaded),
          mStereo(stereo),
          mVariants(std::move(variants)),
          mSums(mVariants.size()) {}

    void run(ReportRun& run, const std::string& what, int frames, double seconds) {
        std::vector<Pose> poses = posesOf(frames);
        const Stopwatch watch;
        for (std::size_t n = 0; n < poses.size(); ++n) {
            run.tell(what);
            frame(run, makeStereoViews(poses[n], mScene.lens, mStereo), what);
            // As many frames as there is time for; the first one is the same for any number of them.
            const double affordable = 1000 * seconds / std::max(watch.elapsed_ms(), 1e-3);
            if (n == 0 && affordable < frames) poses = posesOf(std::max(1, static_cast<int>(affordable)));
            if (n == 0) chooseRepeats(watch.elapsed_ms(), poses.size(), seconds);
            for (std::size_t k = 0; k < mSums.size(); ++k) mSums[k].least_ms += mFastest[k];
        }
        mFrames = static_cast<int>(poses.size());
    }

    std::vector<WayPoint> points() const {
        std::vector<WayPoint> points;
        for (std::size_t n = 0; n < mVariants.size(); ++n) points.push_back(pointOf(mVariants[n], mSums[n]));
        return points;
    }
    int frames() const { return mFrames; }
    int repeats() const { return mRepeats; }

private:
    std::vector<Pose> posesOf(int frames) const {
        return mScene.path.samples().empty() ? std::vector<Pose>{mScene.startPose}
                                             : mScene.path.frames(frames);
    }

    // From the first frame, which ran kLeastRepeats times: half of that is truths.
    void chooseRepeats(double first_ms, std::size_t frames, double seconds) {
        const double perRepeat_ms = mTimed_ms / kLeastRepeats,
                     fixed_ms = std::max(0.0, first_ms - mTimed_ms) * static_cast<double>(frames);
        const double affordable =
            (1000 * seconds - fixed_ms) / std::max(perRepeat_ms * static_cast<double>(frames), 1e-3);
        mRepeats = std::clamp(static_cast<int>(affordable), kLeastRepeats, kMostRepeats);
        // what is left of the first frame's repeats
        for (int r = kLeastRepeats; r < mRepeats; ++r) repeat(r);
    }

    void frame(ReportRun& run, const StereoViews& views, const std::string& what) {
        mViews = views;
        mLeft.resize(views.left.width, views.left.height, mScene.renderer->viewDependence());
        renderEye(*mScene.renderer, views.left, mLeft);
        WarpSetting full;
        full.method = RightEyeMethod::Full;
        mEye.render(*mScene.renderer, views, mLeft, full, mFull);
        Progress quiet([&](double, const std::string&) { run.tell(what); });
        const Plane<PackedColor> truth =
            mTruths ? renderSupersampled(*mScene.renderer, views.right, kTruthFactor, quiet)
                    : Plane<PackedColor>();
        for (std::size_t n = 0; n < mVariants.size(); ++n) measureError(n, truth);
        mFastest.assign(mVariants.size(), 1e300);
        const Stopwatch watch;
        for (int r = 0; r < mRepeats; ++r) {
            run.tell(what);
            repeat(r);
        }
        mTimed_ms = watch.elapsed_ms();
    }

    void measureError(std::size_t n, const Plane<PackedColor>& truth) {
        const RightEyeTimings timings =
            mEye.render(*mScene.renderer, mViews, mLeft, mVariants[n].setting, mRight);
        Plane<std::uint8_t> nothing(mRight.width(), mRight.height());
        const ImageDifference difference = differenceOf(mFull.color, mRight.color, nothing);
        const double rms = rmsOf(difference.psnr_db),
                     trueRms = mTruths ? rmsOf(psnrOf(truth, mRight.color)) : 0;
        Sums& sums = mSums[n];
        sums.squares += rms * rms;
        sums.trueSquares += trueRms * trueRms;
        sums.worst = std::max(sums.worst, rms);
        sums.ssim += difference.ssim;
        sums.holes +=
            static_cast<double>(timings.holePixels) / (static_cast<double>(mRight.width()) * mRight.height());
    }

    void repeat(int r) {
        for (std::size_t n = 0; n < mVariants.size(); ++n) {
            const RightEyeTimings t =
                mEye.render(*mScene.renderer, mViews, mLeft, mVariants[n].setting, mRight);
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

    WayPoint pointOf(const Variant& v, const Sums& sums) const {
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
        if (mTruths) point.others.emplace_back("RMS against 16 rays", std::sqrt(sums.trueSquares / count));
        return point;
    }

    bool mTruths;
    const LoadedScene& mScene;
    StereoSetting mStereo;
    std::vector<Variant> mVariants;
    std::vector<Sums> mSums;
    StereoViews mViews;
    RightEye mEye;
    EyeImage mLeft, mFull, mRight;
    int mRepeats = kLeastRepeats, mFrames = 0;
    double mTimed_ms = 0;
    std::vector<double> mFastest;  // of the frame at hand, by variant
};

std::vector<Variant> variantsOf(const LoadedScene& scene) {
    std::vector<Variant> variants;
    for (const RightEyeMethod method : methodsFor(*scene.renderer)) {
        variants.push_back(methodVariant(method));
        variants.back().isDefault = method == scene.defaultMethod();
    }
    const bool glass = scene.renderer->translucent();
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

WayChart chartOf(ReportRun& run, const ReportScene& scene, const Trial& trial) {
    WayChart chart;
    chart.id = "right_eye/" + scene.id;
    chart.title = "Right eye, " + scene.title;
    chart.setting = fmt::format(
        "{}, {} frames", run.settingOf(scene.loaded.lens.width, scene.loaded.lens.height), trial.frames());
    chart.text = fmt::format(
        "Eyes 1/30 of the zero-parallax distance apart; the mean frame of the scene's flight, {} repeats. "
        "Error "
        "against the full right cast of one ray a pixel, which is exact by definition; the table has the "
        "error "
        "against 16 rays too. A number after a way's name is a setting other than its own.",
        trial.repeats());
    chart.why =
        "The default's thresholds are one choice for all scenes. A lower one casts more pixels again (holes "
        "in the "
        "table): where its time is not longer, repeats spread by more than those rays take.";
    chart.timeLabel = "right eye, ms a frame";
    chart.timeUnit = "ms";
    chart.errorLabel = "RMS error, 8-bit levels";
    chart.errorUnit = "levels";
    chart.points = trial.points();
    return chart;
}

// Pictures of the middle frame by the default way.
ReportPictures picturesOf(const ReportScene& scene, const StereoSetting& stereo) {
    const LoadedScene& s = scene.loaded;
    const std::vector<Pose> poses =
        s.path.samples().empty() ? std::vector<Pose>{s.startPose} : s.path.frames(3);
    const StereoViews views = makeStereoViews(poses[poses.size() / 2], s.lens, stereo);
    EyeImage left, right, full;
    left.resize(views.left.width, views.left.height, s.renderer->viewDependence());
    renderEye(*s.renderer, views.left, left);
    RightEye eye;
    WarpSetting setting;
    setting.method = RightEyeMethod::Full;
    eye.render(*s.renderer, views, left, setting, full);
    setting.method = s.defaultMethod();
    eye.render(*s.renderer, views, left, setting, right);
    ReportPictures pictures{"Pictures, " + scene.title, "From the middle of the flight.", {}};
    const auto add = [&](const char* title, const Plane<PackedColor>& picture) {
        pictures.pictures.push_back({title, encodeColorImage(picture, ".png")});
    };
    add("left eye", left.color);
    add("right eye, the default way", right.color);
    add("cast again, in red", holesInRed(right.color, eye.holeMask()));
    add("difference from the full cast, times five", differenceTimes(full.color, right.color, 5));
    return pictures;
}

// The default way with the eyes ever further apart.
WayChart separationsOf(ReportRun& run, const ReportScene& scene, double seconds) {
    const std::vector<int> parts =
        run.brief() ? std::vector<int>{240, 30, 8} : std::vector<int>{1000, 240, 120, 60, 30, 15, 8, 4};
    WayChart chart;
    const Lens& lens = scene.loaded.lens;
    int least = 1 << 30, most = 0;  // frames
    for (const int part : parts) {
        StereoSetting stereo = scene.loaded.stereo;
        stereo.separation = stereo.zeroParallax / part;
        Variant v = methodVariant(scene.loaded.defaultMethod());
        v.name = fmt::format("1/{}", part);
        v.detail = fmt::format("eyes 1/{} of the zero-parallax distance apart", part);
        v.isDefault = part == 30;
        Trial trial(scene, stereo, {v}, false);
        trial.run(run, "separations, " + scene.title, run.pick(2, 6),
                  seconds / static_cast<double>(parts.size()));
        chart.points.push_back(trial.points().front());
        least = std::min(least, trial.frames());
        most = std::max(most, trial.frames());
    }
    chart.id = "separation/" + scene.id;
    chart.title = "Separations, " + scene.title;
    chart.setting = fmt::format("{}, {} to {} frames", run.settingOf(lens.width, lens.height), least, most);
    chart.text =
        "The default way with the eyes from 1/1000 to 1/4 of the zero-parallax distance apart; the ring "
        "marks 1/30, "
        "which the other charts use. Bars upwards reach to the worst frame.";
    chart.timeLabel = "right eye, ms a frame";
    chart.timeUnit = "ms";
    chart.errorLabel = "RMS error, 8-bit levels";
    chart.errorUnit = "levels";
    chart.front = false;
    return chart;
}

}  // namespace

void reportRightEye(ReportRun& run, double seconds) {
    ReportSection section{"right-eye",
                          "The right eye",
                          "Warping the left eye and casting the holes, against casting every pixel.",
                          {}};
    const Stopwatch watch;
    for (const ReportScene& scene : run.scenes()) {
        StereoSetting stereo = scene.loaded.stereo;
        stereo.separation = stereo.zeroParallax * kShare;
        const std::string what = "right eye, " + scene.title;
        const auto scenesLeft = static_cast<double>(run.scenes().data() + run.scenes().size() - &scene);
        const double each = std::max(0.0, seconds - watch.elapsed_ms() / 1000) / scenesLeft;
        Trial trial(scene, stereo, variantsOf(scene.loaded), !run.brief());
        trial.run(run, what, run.pick(3, 12), 0.65 * each);
        addChart(run.report(), section, chartOf(run, scene, trial));
        addChart(run.report(), section, separationsOf(run, scene, 0.3 * each));
        run.tell(what);
        section.blocks.emplace_back(picturesOf(scene, stereo));
    }
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
