// The report's chart of ground filtering: colour by mip levels with and without a bias, shape by levels of
// detail, and more rays per pixel, against many rays per pixel into the finest levels of both.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/report/fine_pictures.h"
#include "app/report/trial.h"
#include "engine/metrics/supersampled_picture.h"
#include "terrain/cast/terrain_renderer.h"

namespace stereonav {
namespace {

struct FilterWay {
    std::string name, detail;
    GroundFilter filter;
    int factor = 1;  // rays per pixel in each direction
    bool isDefault = false;
    double levelOfDetail = 0;  // value of RingWish::share
    std::unique_ptr<TerrainRenderer> renderer = nullptr;
    std::vector<double> ms = {};  // time of the mean frame, by repeat
    double squares = 0, worst = 0;
};

std::vector<FilterWay> waysOf(const Scene& scene) {
    std::vector<FilterWay> ways;
    ways.push_back({"mip levels", "bilinear in the level of the ray's footprint", {}, 1, true});
    for (const double bias : {-1.0, -0.5, 0.5, 1.0})
        ways.push_back({fmt::format("bias {:+g}", bias),
                        "levels coarser than the footprint's, or finer",
                        {true, bias},
                        1,
                        false});
    ways.push_back({"bilinear alone", "the finest level whatever the footprint", {false, 0}, 1, false});
    ways.push_back({"mip levels, 4 rays", "a pixel, averaged in linear light", {}, 2, false});
    ways.push_back({"bilinear, 4 rays", "a pixel, averaged in linear light", {false, 0}, 2, false});
    for (const double share : {0.5, 1.0, 2.0})
        ways.push_back({fmt::format("level of detail {:g}", share),
                        "coarser samples where they are off by that share of a pixel",
                        {},
                        1,
                        false,
                        share});
    ways.push_back({"level of detail 0.5, 4 rays", "a pixel, averaged in linear light", {}, 2, false, 0.5});
    for (FilterWay& way : ways) {
        way.renderer = std::make_unique<TerrainRenderer>(*terrainOf(scene), scene.simd, way.filter);
        way.renderer->takeCoarser(way.levelOfDetail);
    }
    return ways;
}

// Returns the milliseconds of one picture.
double cast(const FilterWay& way, const EyeView& view, Progress& progress, EyeImage& image) {
    const Stopwatch watch;
    if (way.factor == 1)
        renderEye(*way.renderer, view, image);
    else
        image.color = renderSupersampled(*way.renderer, view, way.factor, progress);
    return watch.elapsed_ms();
}

}  // namespace

WayChart filteringChart(ReportRun& run, const ReportScene& scene) {
    const int frames = run.pick(2, 5), repeats = run.pick(3, 5), truthFactor = run.pick(4, 8);
    const Scene& loaded = scene.loaded();
    Progress progress([&](double, const std::string&) { run.tell("filtering, " + scene.title); });
    std::vector<FilterWay> ways = waysOf(loaded);
    for (FilterWay& way : ways) way.ms.assign(static_cast<std::size_t>(repeats), 0.0);
    const std::vector<Pose> poses = posesOf(loaded, frames);
    const auto count = static_cast<double>(poses.size());
    std::vector<FineView> views;
    views.reserve(poses.size());
    for (const Pose& pose : poses) views.push_back({makeEyeView(pose, loaded.lens)});
    const std::vector<Plane<PackedColor>> truths = finestGround(run, scene, views, truthFactor);
    EyeImage image;
    for (std::size_t n = 0; n < views.size(); ++n) {
        const EyeView& view = views[n].view;
        image.resize(view.width, view.height, rendererOf(loaded).viewDependence());
        for (const FilterWay& way : ways)
            way.renderer->lookFrom(view);  // not timed: rings last for many frames
        for (int r = 0; r < repeats; ++r)
            for (FilterWay& way : ways) {
                way.ms[static_cast<std::size_t>(r)] += cast(way, view, progress, image) / count;
                if (r > 0) continue;
                const double rms = rmsOf(truths[n], image.color);
                way.squares += rms * rms / count;
                way.worst = std::max(way.worst, rms);
            }
    }
    WayChart chart;
    chart.id = "filtering/" + scene.id;
    chart.title = "Filtering the ground, " + scene.title;
    chart.setting = fmt::format("{}, {} frames", run.settingOf(loaded), poses.size());
    chart.text = fmt::format(
        "Left eye, mean frame of the flight, {} repeats, against {} rays a pixel that read the finest level: "
        "edges of the ground's shape are in the error too, which one ray a pixel can not have right.",
        repeats, truthFactor * truthFactor);
    chart.why =
        "A finer level is nearer to the truth of a still picture and shimmers in motion, which no single "
        "frame shows; a coarser one blurs.";
    chart.timeLabel = "left eye, ms a frame";
    for (const FilterWay& way : ways)
        chart.points.push_back(
            {{way.name, spreadOf(way.ms), std::sqrt(way.squares), way.isDefault}, way.detail, way.worst});
    return chart;
}

}  // namespace stereonav
