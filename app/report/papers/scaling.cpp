// Speed-up of the program's work with threads, from one to all of the machine, beside the processors of the
// papers.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "app/report/light.h"
#include "app/report/papers/data.h"
#include "app/report/papers/run.h"
#include "app/report/stereo_trial.h"
#include "app/report/subjects.h"
#include "app/report/whole_medium.h"
#include "engine/light/bake/bake_rate.h"
#include "engine/light/occlusion/occlusion.h"
#include "engine/medium/model/built_in_media.h"
#include "engine/medium/sweep/medium_sweep.h"
#include "engine/volume/surface_cells.h"

namespace stereonav {
namespace {

struct Work {
    std::string name, measured;
    std::function<void()> run;
    const char* paper;
    std::string said;
};

// Returns the numbers of threads to try: 1 to 16 one by one, then powers of two, none above `all`, and `all`.
std::vector<int> allThreads(int all) {
    std::vector<int> counts;
    for (int n = 1; n <= all; n = n < 16 ? n + 1 : 2 * n) counts.push_back(n);
    if (counts.back() != all) counts.push_back(all);
    return counts;
}

// Returns the least time of each work on each number of threads.
std::vector<std::vector<Spread>> measure(ReportRun& run, const std::vector<Work>& works,
                                         const std::vector<int>& counts, double seconds) {
    const ThreadsBack back;
    std::vector<std::vector<std::vector<double>>> ms(works.size(),
                                                     std::vector<std::vector<double>>(counts.size()));
    const Stopwatch watch;
    const int most = run.pick(3, 15);
    for (int repeat = 0; repeat < most; ++repeat) {
        if (repeat >= 2 && watch.elapsed_ms() > 1000 * seconds) break;
        for (std::size_t w = 0; w < works.size(); ++w)
            for (std::size_t c = 0; c < counts.size(); ++c) {
                run.tell("scaling, " + works[w].name);
                setThreadCount(counts[c]);
                const Stopwatch one;
                works[w].run();
                ms[w][c].push_back(one.elapsed_ms());
            }
    }
    std::vector<std::vector<Spread>> times(works.size());
    for (std::size_t w = 0; w < works.size(); ++w)
        for (const auto& list : ms[w]) times[w].push_back(spreadOf(list));
    return times;
}

LineChart speedupChart(const std::vector<Work>& works, const std::vector<int>& counts,
                       const std::vector<std::vector<Spread>>& times) {
    LineChart chart = emptySpeedups("Speed-up over threads");
    for (std::size_t w = 0; w < works.size(); ++w) {
        ChartSeries series{works[w].name, {}, true};
        for (std::size_t c = 0; c < counts.size(); ++c)
            series.points.push_back(
                {"", exactly(counts[c]), exactly(times[w].front().low / times[w][c].low), false});
        chart.chart.series.push_back(std::move(series));
    }
    ChartSeries theirs{"Wan et al., left image", {}, true};
    const std::pair<int, double> left[] = {{1, 3.21}, {4, 0.85}, {8, 0.44}, {12, 0.33}, {16, 0.23}};
    for (const auto& [processors, s] : left)
        theirs.points.push_back({"", exactly(processors), exactly(left[0].second / s), false});
    chart.chart.series.push_back(std::move(theirs));
    chart.text = "From the least times of the repeats.";
    return chart;
}

}  // namespace

void reportPapersScaling(ReportRun& run, double seconds) {
    const std::vector<int> counts = allThreads(threadCount());
    run.tell("scaling");
    // The works are a terrain and its right eye, a bake, a sweep, openness and the cells of a surface: each
    // stage has a loop of its own.
    SceneOptions options;
    options.threads = run.options().threads;
    Progress quiet([&](double, const std::string&) { run.tell("scaling, the terrain"); });
    const SizeOption size = run.quick() ? SizeOption{250, 200} : SizeOption{1280, 720};
    const std::unique_ptr<Scene> loaded = loadScene(options, size, quiet);
    const Scene& scene = *loaded;
    const StereoViews views = scene.viewsAt(scene.startPose);
    FrameMaker& frames = scene.frames();
    EyePair one;
    EyeImage right;
    frames.makeOne(views.left, 0, one);
    const std::string picture = fmt::format("the generated terrain, {}x{}", size.width, size.height);

    const GreyVolume block = blockWithHoles();
    const TexelLighter lighter(block, block.frame, clearSkyLight(), {});
    std::vector<TexelPiece> pieces = inSmallPieces(shuffledBricks(block.frame.size));
    pieces.resize(std::min<std::size_t>(pieces.size(), run.quick() ? 64 : 1024));
    const Medium cloud(makeCloudField(), findMediumTransfer("cloud"), cloudPerturbation());
    MediumSweep sweep(cloud);
    const WholeMedium whole = wholeMedium(cloud, run.quick() ? 64 : 256);
    const EyeView cloudView = makeEyeView(whole.pose, whole.lens);
    MediumPicture swept;
    Progress none;

    const std::string theirs = "near linear: 14 times on 16 processors";
    const std::vector<Work> works{
        {"left image of a terrain", picture, [&] { frames.makeOne(views.left, 0, one); }, "Wan et al. 2004",
         theirs},
        {"right image, the default way", picture,
         [&] { frames.rightFromLeft()->makeRight(views, one.left, {}, right); }, "Wan et al. 2004",
         "near linear: 13 times on 16 processors"},
        {"irradiance, 16 samples", "a made block with three holes",
         [&] { irradianceRate(lighter, pieces, 16, 1e9); }, "Wyman et al. 2006",
         "run on 30 and 60 processors"},
        {"sweep, both lights", "the generated cloud",
         [&] {
             sweep.render({}, {}, {&cloudView, 1}, cloudView.head, 0, {&swept, 1});
         },
         "Kniss et al. 2003", "run on a graphics card"},
        {"openness, radius 10", "a made block with three holes",
         [&] { estimateOpenness(block, OcclusionMethod::Gaussian, glm::ivec3(10), none); },
         "Ruiz et al. 2010", "run on a graphics card"},
        {"cells of a surface", "a made block with three holes",
         [&] {
             findSurfaceCells(
                 block, {float(kBlockSurface), float(kBlockSurface), float(kBlockSurface), nullptr}, none);
         },
         "Wan et al. 2004", "not told"}};
    const auto times = measure(run, works, counts, seconds);
    std::vector<PaperRow> rows;
    for (std::size_t w = 0; w < works.size(); ++w)
        for (std::size_t c = 0; c < counts.size(); ++c) {
            rows.push_back(
                {.paper = works[w].paper,
                 .table = "Scaling",
                 .row = works[w].name,
                 .column = fmt::format("{} thread{}", counts[c], counts[c] == 1 ? "" : "s"),
                 .said = works[w].said,
                 .ours = times[w][c],
                 .unit = "ms",
                 .measured = works[w].measured,
                 .how = fmt::format("{:.2f} times as fast as one", times[w].front().low / times[w][c].low),
                 .why =
                     "Times by the clock; hyper-threads and what else runs on the machine cost some of it.",
                 .kind = PaperRow::Kind::Time});
        }
    ReportSection section{"papers-scaling",
                          "Scaling over threads",
                          fmt::format("From one thread to all {} that this machine runs.", counts.back()),
                          {}};
    section.blocks.emplace_back(speedupChart(works, counts, times));
    addPaperRows(run.report(), section, std::move(rows));
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
