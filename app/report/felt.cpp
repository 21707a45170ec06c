// The report's part on what a viewer feels: flicker from frame to frame, rivalry between the eyes, and
// Butteraugli, of every way of making the right eye.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/felt_errors.h"
#include "app/report/trial.h"
#include "engine/image/image_file.h"
#include "engine/metrics/butteraugli.h"
#include "engine/metrics/image_difference.h"
#include "engine/metrics/supersampled_picture.h"

namespace stereonav {
namespace {

// Frames of one scene's flight, each with the one that follows it.
class FeltTrial {
public:
    FeltTrial(ReportRun& run, const ReportScene& scene, const std::vector<Variant>& variants)
        : mRun(run),
          mScene(scene.loaded()),
          mMaker(scene.frames()),
          mRightMaker(scene.rightFromLeft()),
          mWhat("what is felt, " + scene.title),
          mVariants(variants),
          mErrors(variants.size()),
          mFactor(run.pick(2, 8)) {}

    // As many as `seconds` allow, one at least: in the middle of as many parts of the flight.
    void run(int frames, double seconds) {
        const Stopwatch watch;
        for (int n = 0; n < frames; ++n) {
            frame(n, frames);
            // the first one is the same for any number of them
            const double affordable = 1000 * seconds / std::max(watch.elapsed_ms(), 1e-3);
            if (n == 0) frames = std::clamp(static_cast<int>(affordable), 1, frames);
        }
        mFrames = frames;
    }

    const std::vector<FeltErrors>& errors() const { return mErrors; }
    const std::vector<ReportPicture>& pictures() const { return mPictures; }
    int frames() const { return mFrames; }
    int rays() const { return mFactor * mFactor; }

private:
    // The first is in the middle of the flight.
    double shareOf(int n, int frames) const {
        return (0.5 + static_cast<double>((n + frames / 2) % frames)) / frames;
    }

    StereoViews viewsAt(double time) const {
        return makeStereoViews(mScene.path.at(mScene.path.startTime() + time), mScene.lens,
                               chartedEyes(mScene));
    }

    Plane<PackedColor> truthOf(const EyeView& view, double time) {
        Progress quiet([&](double, const std::string&) { mRun.tell(mWhat); });
        return renderSupersampled(mMaker, view, time, mFactor, quiet);
    }

    void frame(int n, int frames) {
        mRun.tell(mWhat);
        const double time = std::max(0.0, shareOf(n, frames) * (mScene.path.duration() - kNextFrame_s)),
                     nextTime = time + kNextFrame_s;
        const StereoViews views = viewsAt(time), next = viewsAt(nextTime);
        EyePair exact, exactNext;
        mMaker.make(views, time, {mMaker.exactMethod(), {}}, exact);
        mMaker.make(next, nextTime, {mMaker.exactMethod(), {}}, exactNext);
        FeltTruth truth{truthOf(views.left, time),
                        truthOf(views.right, time),
                        truthOf(next.right, nextTime),
                        columnsInRightEye(views, exact.left.viewDepth, exact.right.viewDepth),
                        {}};
        EyeImage right, rightNext;
        mRightMaker.makeRight(views, exact.left, {mMaker.defaultMethod(), {}}, right);
        truth.edges = edgeMask(mRightMaker.holes().mask, exact.right.viewDepth, views.parallaxScale, 2);
        for (std::size_t k = 0; k < mVariants.size(); ++k) {
            mRun.tell(mWhat);
            mRightMaker.makeRight(views, exact.left, wayOf(mVariants[k].setting), right);
            mRightMaker.makeRight(next, exactNext.left, wayOf(mVariants[k].setting), rightNext);
            const Plane<float> map = mErrors[k].add(truth, {exact.left.color, right.color}, rightNext.color);
            if (n > 0 || !mVariants[k].isDefault) continue;
            mPictures = {
                {"right eye, the default way", encodeColorImage(right.color, ".png")},
                {"the truth", encodeColorImage(truth.right, ".png")},
                {"Butteraugli: black 0, grey 1, white 2 and more", encodeColorImage(pictureOf(map), ".png")}};
        }
    }

    ReportRun& mRun;
    const Scene& mScene;
    FrameMaker& mMaker;
    RightFromLeft& mRightMaker;
    std::string mWhat;
    const std::vector<Variant>& mVariants;
    std::vector<FeltErrors> mErrors;
    std::vector<ReportPicture> mPictures;  // of the first frame, by the default way
    int mFactor, mFrames = 0;
};

void chart(ReportRun& run, ReportSection& section, const ReportScene& scene, double seconds) {
    std::vector<Variant> variants = rightEyeVariants(scene.loaded());
    if (run.brief())  // methods with their own settings alone
        std::erase_if(variants, [](const Variant& v) { return !v.detail.empty(); });
    FeltTrial felt(run, scene, variants);
    felt.run(run.pick(1, 4), 0.6 * seconds);
    RightEyeTrial times(scene, chartedEyes(scene.loaded()), variants);
    times.run(run, "times, " + scene.title, run.pick(1, 6), 0.3 * seconds);
    WayChart frame;
    frame.title = scene.title;
    frame.setting = fmt::format("{}, {} frames", run.settingOf(scene.loaded()), felt.frames());
    frame.text = fmt::format(
        "Against {} rays a pixel. Eyes 1/30 of the zero-parallax distance apart; times are the mean frame's "
        "of "
        "the scene's flight. A number after a way's name is a setting other than its own.",
        felt.rays());
    frame.why =
        "One ray a pixel flickers and differs between the eyes by itself, full casts too: ways nearer to "
        "each "
        "other than that are chosen by their error against the full cast.";
    frame.timeLabel = "right eye, ms a frame";
    frame.timeUnit = "ms";
    addFeltCharts(run, section, scene.id, frame, times.points(), felt.errors());
    section.blocks.emplace_back(ReportPictures{"What would be noticed, " + scene.title,
                                               "From the middle of the flight.", felt.pictures()});
}

}  // namespace

void reportFelt(ReportRun& run, double seconds) {
    ReportSection section{"felt",
                          "What a viewer feels",
                          "Flicker: how far the right eye's change over a 30th of a second is from the "
                          "truth's change. Rivalry: how "
                          "far the two eyes differ, at points that both see, from how their truths differ. "
                          "Butteraugli: how much of "
                          "the right eye's error a person would notice, by libjxl, white at 80 cd/m2; at 1 a "
                          "flip between picture "
                          "and truth is just noticed.",
                          {}};
    const Stopwatch watch;
    for (const ReportScene& scene : run.scenes()) {
        if (scene.loaded().path.samples().empty()) continue;  // nothing moves
        run.checkTime();
        const auto left = static_cast<double>(run.scenes().data() + run.scenes().size() - &scene);
        chart(run, section, scene, std::max(0.0, seconds - watch.elapsed_ms() / 1000) / left);
    }
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
