// The report's chart of rays at edges: time and error of more rays there, or everywhere.
#include <fmt/format.h>

#include "app/report/both_eyes.h"
#include "app/report/fine_pictures.h"
#include "engine/frame/refined_frames.h"

namespace stereonav {
namespace {

struct RayWay {
    std::string name, detail;
    EdgeSetting edges = {};
    int rays = 1;  // rays for the whole picture
    bool isDefault = false;
};

RayWay atEdges(int rays, int contrast = EdgeSetting().contrast) {
    RayWay way{fmt::format("edges {}", rays),
               rays == 0 ? "one ray a pixel" : fmt::format("{} rays more at edges", rays)};
    way.edges.rays = rays;
    way.edges.contrast = contrast;
    way.isDefault = rays == kDefaultEdgeRays && contrast == EdgeSetting().contrast;
    if (contrast == EdgeSetting().contrast) return way;
    way.name += fmt::format(", contrast {}", contrast);
    way.detail += fmt::format(", which begin at a contrast of {} of 1023", contrast);
    return way;
}
RayWay everywhere(int rays) {
    return {fmt::format("rays {}", rays),
            fmt::format("{} rays in each pixel, the mean of whole pictures", rays),
            {},
            rays};
}

std::vector<RayWay> waysOf(const ReportRun& run) {
    if (run.brief()) return {atEdges(0), atEdges(kDefaultEdgeRays), everywhere(4)};
    return {atEdges(0),
            atEdges(2),
            atEdges(kDefaultEdgeRays, 180),
            atEdges(kDefaultEdgeRays),
            atEdges(4, 50),
            atEdges(8),
            atEdges(16),
            atEdges(16, 50),
            everywhere(2),
            everywhere(4),
            everywhere(16)};
}

double make(FrameMaker& frames, const StereoViews& views, double time, const RayWay& way,
            RefinedFrames& refined) {
    const Stopwatch watch;
    for (refined.restart(); refined.count() < way.rays;)
        refined.add(frames, views, time, {"", {}, way.edges});
    refined.mean();
    return watch.elapsed_ms();
}

}  // namespace

WayChart edgeChart(ReportRun& run, const ReportScene& scene) {
    const Scene& loaded = scene.loaded();
    FrameMaker& frames = scene.frames();
    const std::vector<RayWay> ways = waysOf(run);
    const int repeats = run.pick(2, 4), factor = run.pick(4, 8);
    const std::vector<Pose> poses = posesOf(loaded, run.pick(1, 3));
    const auto count = static_cast<double>(poses.size());
    std::vector<BothEyes> eyes(ways.size(), {static_cast<std::size_t>(repeats), count});
    RefinedFrames refined;
    std::vector<FineView> eyesOfAll;
    for (const Pose& pose : poses) {
        const StereoViews views = makeStereoViews(pose, loaded.lens, chartedEyes(loaded));
        eyesOfAll.push_back({views.left});
        eyesOfAll.push_back({views.right});
    }
    const std::vector<Plane<PackedColor>> truths = finePictures(run, scene, eyesOfAll, factor);
    const std::string what = "rays at edges, " + scene.title;
    for (std::size_t p = 0; p < poses.size(); ++p) {
        const StereoViews views = makeStereoViews(poses[p], loaded.lens, chartedEyes(loaded));
        const Plane<PackedColor>&left = truths[2 * p], &right = truths[2 * p + 1];
        for (int r = 0; r < repeats; ++r)
            for (std::size_t n = 0; n < ways.size(); ++n) {
                run.tell(what);
                eyes[n].addTime(static_cast<std::size_t>(r), make(frames, views, 0, ways[n], refined));
                if (r == 0) eyes[n].addError(left, right, refined.mean());
            }
    }
    WayChart chart;
    chart.id = "edges/" + scene.id;
    chart.title = "Rays at edges, " + scene.title;
    chart.setting = fmt::format("{}, {} frames", run.settingOf(loaded), poses.size());
    chart.text = fmt::format(
        "Both eyes by the default way, against {} rays in each pixel of each eye; {} repeats. Rays are added "
        "where a colour differs from its neighbours and the depth is bent.",
        factor * factor, repeats);
    chart.why = "In a view without edges the search for them costs time and gains nothing.";
    chart.timeLabel = "both eyes, ms a frame";
    for (std::size_t n = 0; n < ways.size(); ++n)
        chart.points.push_back(eyes[n].point(ways[n].name, ways[n].detail, ways[n].isDefault));
    return chart;
}

}  // namespace stereonav
