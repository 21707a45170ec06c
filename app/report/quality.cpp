// The report's part on the quality dial: its choice among the ways of warping, whether the target is met on
// frames that were not measured, the gain of a smaller picture, and of more rays at edges.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/both_eyes.h"
#include "engine/image/enlarge.h"
#include "engine/stereo/quality_plan.h"

namespace stereonav {
namespace {

MeasuredWarps measured(ReportRun& run, const ReportScene& scene, const std::vector<NamedWarp>& warps) {
    const Scene& loaded = scene.loaded();
    std::vector<StereoViews> views;
    for (const Pose& pose : posesOf(loaded, run.pick(5, 15)))
        views.push_back(makeStereoViews(pose, loaded.lens, chartedEyes(loaded)));
    run.tell("quality, measuring " + scene.title);
    return measureWarps(rendererOf(loaded), views, warps, 1);
}

struct Wish {
    std::string name;
    QualityWish wish;
};

std::vector<Wish> wishesOf(ReportRun& run) {
    std::vector<Wish> wishes;
    for (const double quality :
         run.brief() ? std::vector<double>{0.6} : std::vector<double>{0.3, 0.6, 0.9, 0.97})
        wishes.push_back({fmt::format("quality {:g}", quality), {quality}});
    for (const double target : run.brief() ? std::vector<double>{50} : std::vector<double>{40, 50, 60})
        wishes.push_back({fmt::format("{:g} dB", target), {std::nullopt, target}});
    return wishes;
}

std::vector<Variant> variantsOf(ReportRun& run, const std::vector<NamedWarp>& warps,
                                const MeasuredWarps& known) {
    std::vector<Variant> variants;
    variants.reserve(warps.size());
    for (const NamedWarp& warp : warps)
        variants.push_back({warp.name, "as it is", warp.setting, &warp == &warps.front()});
    for (const Wish& w : wishesOf(run)) {
        const QualityPlan plan = planQuality(known, w.wish);
        variants.push_back({w.name, fmt::format("by {}, {:.1f} % cast", plan.name, 100 * plan.castShare),
                            plan.setting, false});
    }
    return variants;
}

// Measures on frames between those of the calibration.
WayChart dialChart(ReportRun& run, const ReportScene& scene, double seconds) {
    const std::vector<NamedWarp> warps = warpsWorthTrying(rendererOf(scene.loaded()));
    const MeasuredWarps known = measured(run, scene, warps);
    RightEyeTrial trial(scene, chartedEyes(scene.loaded()), variantsOf(run, warps, known));
    trial.run(run, "quality, " + scene.title, run.pick(2, 10), seconds);
    WayChart chart;
    chart.id = "quality/" + scene.id;
    chart.title = "The quality dial, " + scene.title;
    chart.setting = fmt::format("{}, {} frames", run.settingOf(scene.loaded()), trial.frames());
    chart.text = fmt::format(
        "Methods as they are, and those that are chosen and refined for --quality and --target-psnr by other "
        "frames of the same flight; {} repeats, error against the full right cast. The bound is the error "
        "that 95 of 100 frames are promised to stay below.",
        trial.repeats());
    chart.why = "The default casts only the holes; --quality casts more.";
    chart.timeLabel = "right eye, ms a frame";
    chart.points = trial.points();
    return chart;
}

// Makes both eyes with smaller sides and enlarges them; small: buffer of this size, kept between frames.
double makeEyes(const ReportScene& from, const Pose& pose, double scale, EyePair& small, EyePair& eyes) {
    const Scene& scene = from.loaded();
    Lens lens = scene.lens;
    lens.width = std::max(1, static_cast<int>(std::lround(scale * lens.width)));
    lens.height = std::max(1, static_cast<int>(std::lround(scale * lens.height)));
    const StereoViews views = makeStereoViews(pose, lens, chartedEyes(scene));
    const Stopwatch watch;
    from.frames().make(views, 0, {}, scale < 1 ? small : eyes);
    if (scale < 1) {
        enlarge(small.left, scene.lens.width, scene.lens.height, eyes.left);
        enlarge(small.right, scene.lens.width, scene.lens.height, eyes.right);
    }
    return watch.elapsed_ms();
}

WayChart sizeChart(ReportRun& run, const ReportScene& scene) {
    const int repeats = run.pick(2, 4);
    const std::vector<Pose> poses = posesOf(scene.loaded(), run.pick(1, 4));
    const auto count = static_cast<double>(poses.size());
    const std::vector<double> scales =
        run.brief() ? std::vector<double>{1, 0.5}
                    : std::vector<double>{1, std::sqrt(0.5), 0.5, std::sqrt(0.125), 0.25};
    std::vector<BothEyes> ways(scales.size(), {static_cast<std::size_t>(repeats), count});
    FrameMaker& frames = scene.frames();
    EyePair truth, eyes;
    std::vector<EyePair> small(scales.size());
    for (const Pose& pose : poses) {
        run.tell("resolution, " + scene.title);
        frames.make(makeStereoViews(pose, scene.loaded().lens, chartedEyes(scene.loaded())), 0,
                    {frames.exactMethod(), {}}, truth);
        for (std::size_t r = 0; r < static_cast<std::size_t>(repeats); ++r)
            for (std::size_t n = 0; n < ways.size(); ++n) {
                ways[n].addTime(r, makeEyes(scene, pose, scales[n], small[n], eyes));
                if (r == 0) ways[n].addError(truth.left.color, truth.right.color, eyes);
            }
    }
    WayChart chart;
    chart.id = "resolution/" + scene.id;
    chart.title = "Smaller pictures, " + scene.title;
    chart.setting = fmt::format("{}, {} frames", run.settingOf(scene.loaded()), poses.size());
    chart.text = fmt::format(
        "Both eyes by the default way in a share of the picture's sides, enlarged bilinearly, as --target-ms "
        "makes them where nothing else is fast enough; {} repeats, against both eyes cast in full.",
        repeats);
    chart.timeLabel = "both eyes, ms a frame";
    for (std::size_t n = 0; n < ways.size(); ++n)
        chart.points.push_back(ways[n].point(
            fmt::format("{:.2g}", scales[n]),
            fmt::format("{:.0f} % of the pixels", 100 * scales[n] * scales[n]), scales[n] == 1));
    return chart;
}

}  // namespace

void reportQuality(ReportRun& run, double seconds) {
    ReportSection section{"quality",
                          "Quality targets",
                          "What --quality and --target-psnr achieve, what a smaller picture saves, and what "
                          "more rays at edges give.",
                          {}};
    const Stopwatch watch;
    for (const ReportScene& scene : run.scenes()) {
        run.checkTime();
        const auto left = static_cast<double>(run.scenes().data() + run.scenes().size() - &scene);
        const double each = std::max(0.0, seconds - watch.elapsed_ms() / 1000) / left;
        addChart(run.report(), section, dialChart(run, scene, 0.6 * each));
        addChart(run.report(), section, sizeChart(run, scene));
        run.checkTime();
        addChart(run.report(), section, edgeChart(run, scene));
    }
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
