// The report's first part: every way of making the right eye, error against time, for every scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/report/trial.h"
#include "engine/base/parallel.h"
#include "engine/camera/default_eyes.h"
#include "engine/image/image_file.h"
#include "engine/metrics/difference_picture.h"

namespace stereonav {
namespace {

WayChart chartOf(ReportRun& run, const ReportScene& scene, const RightEyeTrial& trial) {
    WayChart chart;
    chart.id = "right_eye/" + scene.id;
    chart.title = "Right eye, " + scene.title;
    chart.setting = fmt::format("{}, {} frames", run.settingOf(scene.loaded()), trial.frames());
    chart.text = fmt::format(
        "Eyes 1/30 of the zero-parallax distance apart; the mean frame of the scene's flight, {} repeats. "
        "Error against the full right cast of one ray a pixel, which is exact by definition. A number after "
        "a method's name is a setting other than its default.",
        trial.repeats());
    chart.why =
        "The default's thresholds are one choice for all scenes. A lower one casts more pixels again (holes "
        "in the table): where its time is not longer, repeats spread by more than those rays take.";
    chart.timeLabel = "right eye, ms a frame";
    chart.points = trial.points();
    return chart;
}

// Returns pictures of the middle frame by the default way.
ReportPictures picturesOf(const ReportScene& scene, const StereoSetting& stereo) {
    const Scene& s = scene.loaded();
    const std::vector<Pose> poses = posesOf(s, 3);
    const StereoViews views = makeStereoViews(poses[poses.size() / 2], s.lens, stereo);
    FrameMaker& frames = scene.frames();
    EyePair full;
    EyeImage right;
    frames.make(views, 0, {frames.exactMethod(), {}}, full);
    scene.rightFromLeft().makeRight(views, full.left, {frames.defaultMethod(), {}}, right);
    ReportPictures pictures{"Pictures, " + scene.title, "From the middle of the flight.", {}};
    const auto add = [&](const char* title, const Plane<PackedColor>& picture) {
        pictures.pictures.push_back({title, encodeColorImage(picture, ".png")});
    };
    add("left eye", full.left.color);
    add("right eye, the default way", right.color);
    add("cast again, in red", holesInRed(right.color, scene.rightFromLeft().holes().mask));
    add("difference from the full cast, times five", differenceTimes(full.right.color, right.color, 5));
    return pictures;
}

// Measures the default way with increasing separations of the eyes.
WayChart separationsOf(ReportRun& run, const ReportScene& scene, double seconds) {
    const std::vector<int> parts = run.brief() ? std::vector<int>{240, kUsualParts, 8}
                                               : std::vector<int>{1000, 240, 120, 60, kUsualParts, 15, 8, 4};
    WayChart chart;
    int least = 1 << 30, most = 0;  // numbers of frames
    for (const int part : parts) {
        StereoSetting stereo = scene.loaded().stereo;
        stereo.separation = stereo.zeroParallax / part;
        Variant v = methodVariant(defaultMethodFor(rendererOf(scene.loaded())));
        v.name = fmt::format("1/{}", part);
        v.detail = fmt::format("eyes 1/{} of the zero-parallax distance apart", part);
        v.isDefault = part == kUsualParts;
        RightEyeTrial trial(scene, stereo, {v});
        trial.run(run, "separations, " + scene.title, run.pick(2, 6),
                  seconds / static_cast<double>(parts.size()));
        chart.points.push_back(trial.points().front());
        least = std::min(least, trial.frames());
        most = std::max(most, trial.frames());
    }
    chart.id = "separation/" + scene.id;
    chart.title = "Separations, " + scene.title;
    chart.setting = fmt::format("{}, {} to {} frames", run.settingOf(scene.loaded()), least, most);
    chart.text =
        "The default way with the eyes from 1/1000 to 1/4 of the zero-parallax distance apart; the ring "
        "marks 1/30, which the other charts use. Bars upwards reach to the worst frame.";
    chart.timeLabel = "right eye, ms a frame";
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
        run.checkTime();
        const StereoSetting stereo = chartedEyes(scene.loaded());
        const std::string what = "right eye, " + scene.title;
        const auto scenesLeft = static_cast<double>(run.scenes().data() + run.scenes().size() - &scene);
        const double each = std::max(0.0, seconds - watch.elapsed_ms() / 1000) / scenesLeft;
        RightEyeTrial trial(scene, stereo, rightEyeVariants(scene.loaded()));
        trial.run(run, what, run.pick(3, 12), 0.65 * each);
        addChart(run.report(), section, chartOf(run, scene, trial));
        addChart(run.report(), section, separationsOf(run, scene, 0.3 * each));
        run.tell(what);
        section.blocks.emplace_back(picturesOf(scene, stereo));
    }
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
