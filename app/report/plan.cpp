// The report's part on warping or casting: where one becomes cheaper than the other, the choice of the frame
// plan, and the cost of wrong choices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/report/trial.h"
#include "engine/base/parallel.h"
#include "engine/camera/default_eyes.h"
#include "engine/frame/cast_frames.h"
#include "engine/volume/volume_renderer.h"
#include "terrain/cast/terrain_renderer.h"

namespace stereonav {
namespace {

struct Case {
    std::string scene, size, separation;
    FrameCosts costs;                         // measured by the plan itself
    RightEyeMethod chosen, warp;              // the plan's choice; the way that it compares with casting
    double cast_ms = 1e300, warp_ms = 1e300;  // least times, measured independently of the plan; mean frame

    double chosen_ms() const { return chosen == RightEyeMethod::Full ? cast_ms : warp_ms; }
    double regret_ms() const { return chosen_ms() - std::min(cast_ms, warp_ms); }
    double ratio() const { return warp_ms / cast_ms; }
};

void measure(FrameMaker& frames, const std::vector<StereoViews>& views, int repeats, Case& c) {
    RightFromLeft& maker = *frames.rightFromLeft();
    EyePair one;
    EyeImage right;
    const FrameWay warped{nameOf(c.warp), {}}, full{frames.exactMethod(), {}};
    double cast = 0, warp = 0;
    for (const StereoViews& v : views) {
        frames.makeOne(v.left, 0, one);
        double leastCast = 1e300, leastWarp = 1e300;
        for (int n = 0; n < repeats; ++n) {
            leastWarp = std::min(leastWarp, maker.makeRight(v, one.left, warped, right).right_ms());
            leastCast = std::min(leastCast, maker.makeRight(v, one.left, full, right).right_ms());
        }
        cast += leastCast;
        warp += leastWarp;
    }
    c.cast_ms = cast / static_cast<double>(views.size());
    c.warp_ms = warp / static_cast<double>(views.size());
}

Case caseOf(ReportRun& run, const Scene& scene, FrameMaker& frames, const std::string& title,
            const SizeOption& size, int part) {
    run.tell("warp or cast, " + title);
    Lens lens = scene.lens;
    lens.width = size.width;
    lens.height = size.height;
    StereoSetting stereo = scene.stereo;
    stereo.separation = stereo.zeroParallax / part;
    std::vector<StereoViews> views;
    for (const Pose& pose : posesOf(scene, run.pick(2, 3)))
        views.push_back(makeStereoViews(pose, lens, stereo));
    const FramePlan plan = frames.measure(views).value();
    Case c{title,
           fmt::format("{}x{}", size.width, size.height),
           fmt::format("1/{}", part),
           plan.costs,
           plan.method,
           *rightEyeMethodFromName(frames.defaultMethod()),
           0,
           0};
    measure(frames, views, run.pick(2, 4), c);
    return c;
}

// Returns a renderer of the same scene without vector instructions, whose rays cost more, to show where the
// crossing lies. Returns null for scenes that other libraries cast.
std::unique_ptr<EyeRenderer> plainRenderer(const Scene& scene) {
    if (terrainOf(scene)) return std::make_unique<TerrainRenderer>(*terrainOf(scene), SimdTarget::Plain);
    if (!colonOf(scene)) return nullptr;
    VolumeCasting casting;
    casting.target = SimdTarget::Plain;
    return std::make_unique<VolumeRenderer>(colonOf(scene)->volume, casting);
}

// Returns the nanoseconds per ray at which warping and casting cost the same, with the same ratio of costs
// for rays in holes; infinite where warping never pays.
double crossing_ns(const FrameCosts& costs) {
    const double dearer = costs.cast_ns > 0 ? costs.holeShare * costs.hole_ns / costs.cast_ns : 0;
    return dearer < 1 ? costs.warp_ns / (1 - dearer) : INFINITY;
}

ReportTable tableOf(const std::vector<Case>& cases) {
    ReportTable table{
        "What the frame plan chose",
        "Regret: what the chosen way took more than the better one, both measured apart from the plan, the "
        "least of the repeats. Crossing: the cost of a ray at which both would take the same time.",
        {"scene", "size", "separation", "ns a ray", "crossing at ns", "holes", "cast ms", "warp ms", "chosen",
         "regret ms", "regret"},
        {}};
    for (const Case& c : cases)
        table.rows.push_back({c.scene, c.size, c.separation, numberText(c.costs.cast_ns),
                              numberText(crossing_ns(c.costs)),
                              fmt::format("{:.1f} %", 100 * c.costs.holeShare), numberText(c.cast_ms),
                              numberText(c.warp_ms), std::string(nameOf(c.chosen)), numberText(c.regret_ms()),
                              fmt::format("{:.0f} %", 100 * c.regret_ms() / std::min(c.cast_ms, c.warp_ms))});
    return table;
}

LineChart chartOf(const std::vector<Case>& cases) {
    LineChart chart;
    chart.chart = {"Warp or cast, by what a ray costs",
                   "a ray of the full cast, ns",
                   "warp's time of the cast's",
                   ChartScale::Kind::Logarithmic,
                   ChartScale::Kind::Logarithmic,
                   {},
                   false};
    chart.text =
        "Each point is a scene, size and separation, with vector code or without. Below 1 warping is "
        "cheaper, above it casting.";
    double least = 1e300, most = 0;
    for (const Case& c : cases) {
        const std::string title = c.scene.substr(0, c.scene.find(", plain code"));
        auto at = std::find_if(chart.chart.series.begin(), chart.chart.series.end(),
                               [&](const ChartSeries& s) { return s.name == title; });
        if (at == chart.chart.series.end())
            at = chart.chart.series.insert(chart.chart.series.end(), ChartSeries{title, {}, false});
        at->points.push_back({"", exactly(c.costs.cast_ns), exactly(c.ratio()), false});
        least = std::min(least, c.costs.cast_ns);
        most = std::max(most, c.costs.cast_ns);
    }
    chart.chart.series.push_back(
        {"the same",
         {{"", exactly(least), exactly(1), false}, {"", exactly(most), exactly(1), false}},
         true});
    return chart;
}

std::string summaryOf(const std::vector<Case>& cases) {
    int right = 0, warps = 0;
    double worst = 0, sum = 0;
    for (const Case& c : cases) {
        right += c.regret_ms() <= 0;
        warps += c.warp_ms < c.cast_ms;
        worst = std::max(worst, c.regret_ms());
        sum += c.regret_ms();
    }
    const auto count = static_cast<double>(cases.size());
    return fmt::format(
        "Warping was cheaper in {} of {} cases. The plan chose the cheaper way in {}; its choices cost {} ms "
        "a frame too much on average, {} ms at worst.",
        warps, cases.size(), right, numberText(sum / count), numberText(worst));
}

}  // namespace

void reportPlan(ReportRun& run, double seconds) {
    const Stopwatch watch;
    const std::vector<SizeOption> sizes =
        run.brief() ? std::vector<SizeOption>{{160, 120}, {640, 480}}
                    : std::vector<SizeOption>{{160, 120}, {320, 240}, {640, 480}, {1280, 720}};
    const std::vector<int> parts =
        run.brief() ? std::vector<int>{kUsualParts} : std::vector<int>{120, kUsualParts, 10};
    std::vector<Case> cases;
    const auto late = [&] { return watch.elapsed_ms() > 1000 * seconds; };
    std::vector<std::string> skipped;
    for (const ReportScene& scene : run.scenes()) {
        const auto plain = plainRenderer(scene.loaded());
        const auto plainFrames = plain ? std::make_unique<CastFrames>(*plain) : nullptr;
        for (const SizeOption& size : sizes)
            for (const int part : parts) {
                if (late() && !cases.empty() && cases.back().scene.starts_with(scene.title)) {
                    skipped.push_back(
                        fmt::format("{} {}x{} 1/{}", scene.title, size.width, size.height, part));
                    continue;
                }
                cases.push_back(caseOf(run, scene.loaded(), scene.frames(), scene.title, size, part));
                if (plainFrames && part == kUsualParts && size.width <= 320)
                    cases.push_back(
                        caseOf(run, scene.loaded(), *plainFrames, scene.title + ", plain code", size, part));
            }
    }
    ReportSection section{"plan", "Warp or cast", summaryOf(cases), {}};
    if (!skipped.empty())
        section.text += fmt::format(" {} cases were left out for want of time.", skipped.size());
    for (const Case& c : cases)
        addFigure(run.report(), {fmt::format("plan/{}/{}/{}/regret", c.scene, c.size, c.separation), "ms", "",
                                 ReportFigure::Kind::Other, exactly(c.regret_ms())});
    section.blocks.emplace_back(chartOf(cases));
    section.blocks.emplace_back(tableOf(cases));
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
