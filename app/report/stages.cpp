// The report's part on stages: time by thread count, speed-up and its limits.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/report/mood.h"
#include "app/report/run.h"
#include "app/report/stereo_trial.h"
#include "app/report/trial.h"
#include "engine/base/parallel.h"
#include "engine/camera/default_eyes.h"

namespace stereonav {
namespace {

enum Stage { kLeft, kFull, kWarp, kFill, kPaperWarp, kPaperFill, kStages };
constexpr std::array<const char*, kStages> kStageNames{"left eye cast",     "right eye cast in full",
                                                       "default way: warp", "default way: holes",
                                                       "paper's way: warp", "paper's way: holes"};

struct StageTimes {
    std::array<Spread, kStages> ms;  // times per frame
};

// Returns 1, 2, 4, ... and all.
std::vector<int> threadCounts(int all) {
    std::vector<int> counts;
    for (int n = 1; n < all; n *= 2) counts.push_back(n);
    counts.push_back(all);
    return counts;
}

class StageTrial {
public:
    explicit StageTrial(const ReportScene& scene)
        : mFrames(scene.frames()), mRightMaker(scene.rightFromLeft()) {}

    std::array<double, kStages> once(const StereoViews& views) {
        std::array<double, kStages> ms{};
        mFrames.make(views, 0, {mFrames.exactMethod(), {}}, mFull);
        ms[kLeft] = mFull.timings.left_ms;
        ms[kFull] = mFull.timings.right_ms;
        const RightEyeTimings own = right(views, mFrames.defaultMethod()),
                              paper = right(views, nameOf(RightEyeMethod::Paper));
        ms[kWarp] = own.warp_ms;
        ms[kFill] = own.fill_ms;
        ms[kPaperWarp] = paper.warp_ms;
        ms[kPaperFill] = paper.fill_ms;
        return ms;
    }

private:
    RightEyeTimings right(const StereoViews& views, std::string_view method) {
        return mRightMaker.makeRight(views, mFull.left, {method, {}}, mRight);
    }

    FrameMaker& mFrames;
    RightFromLeft& mRightMaker;
    EyePair mFull;
    EyeImage mRight;
};

using TimesByThreads = std::map<int, StageTimes>;

// Measures one frame after another, each with all thread counts in turn.
TimesByThreads measureStages(ReportRun& run, const ReportScene& scene, const std::vector<int>& counts,
                             double seconds) {
    const ThreadsBack back;
    const std::vector<Pose> poses = posesOf(scene.loaded(), run.pick(2, 5));
    StereoSetting stereo = scene.loaded().stereo;
    stereo.separation = stereo.zeroParallax / kUsualParts;
    std::map<int, std::array<std::vector<double>, kStages>> sums;  // sums over the frames, by repeat
    StageTrial trial(scene);
    const Stopwatch watch;
    const int most = run.pick(5, 15);
    for (int repeat = 0; repeat < most; ++repeat) {
        if (repeat >= 3 && watch.elapsed_ms() > 1000 * seconds) break;
        for (const int threads : counts)
            for (auto& list : sums[threads]) list.push_back(0);
        for (const Pose& pose : poses)
            for (const int threads : counts) {
                run.tell("stages, " + scene.title);
                setThreadCount(threads);
                const auto ms = trial.once(makeStereoViews(pose, scene.loaded().lens, stereo));
                for (std::size_t s = 0; s < kStages; ++s)
                    sums[threads][s].back() += ms[s] / static_cast<double>(poses.size());
            }
    }
    TimesByThreads times;
    for (const auto& [threads, lists] : sums)
        for (std::size_t s = 0; s < kStages; ++s) times[threads].ms[s] = spreadOf(lists[s]);
    return times;
}

// Returns the serial share of the work, 0..1, by the least squares fit of t = a + b / threads (Amdahl).
double serialShare(const TimesByThreads& times, std::size_t stage) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [threads, t] : times) {
        const double u = 1.0 / threads, v = t.ms[stage].low;
        n += 1, x += u, y += v, xx += u * u, xy += u * v;
    }
    const double spread = n * xx - x * x;
    if (!(spread > 0)) return 0;
    const double b = (n * xy - x * y) / spread, a = (y - b * x) / n;
    return a + b > 0 ? std::clamp(a / (a + b), 0.0, 1.0) : 0.0;
}

// Returns the longest of `threads` queues, filled by dynamic scheduling, over an equal share: 1 is perfect.
double imbalanceOf(const std::vector<double>& tiles, int threads) {
    std::vector<double> queues(static_cast<std::size_t>(threads), 0.0);
    double sum = 0;
    for (const double tile : tiles) {
        *std::min_element(queues.begin(), queues.end()) += tile;
        sum += tile;
    }
    return sum > 0 ? *std::max_element(queues.begin(), queues.end()) * threads / sum : 1.0;
}

// Returns the milliseconds of each tile of the left eye, on one thread, the least of three.
std::vector<double> tileTimes(const Scene& scene) {
    const EyeView view = scene.viewsAt(scene.startPose).left;
    EyeImage image;
    image.resize(view.width, view.height, rendererOf(scene).viewDependence());
    std::vector<double> tiles(static_cast<std::size_t>(rendererOf(scene).tileCount(view)), 1e300);
    for (int round = 0; round < 3; ++round)
        for (std::size_t n = 0; n < tiles.size(); ++n) {
            const Stopwatch watch;
            rendererOf(scene).renderTile(view, static_cast<int>(n), image);
            tiles[n] = std::min(tiles[n], watch.elapsed_ms());
        }
    return tiles;
}

// Returns the bytes per pixel that a stage has to move: planes read and written, without the scene's own
// data.
double leastBytes(std::size_t stage, ViewDependence dependence) {
    const double again = dependence == ViewDependence::Highlight ? 8
                         : dependence == ViewDependence::Normal  ? 4
                                                                 : 0;
    const double planes = 8 + again;
    if (stage == kLeft || stage == kFull) return planes;
    return stage == kWarp || stage == kPaperWarp ? 2 * planes + 1 : 0;
}

double lastCacheBytes() {
    return static_cast<double>(std::max(sysconf(_SC_LEVEL3_CACHE_SIZE), sysconf(_SC_LEVEL2_CACHE_SIZE)));
}

struct Limits {
    double speedup, serial, imbalance;
    double traffic;  // share of the triad's rate
    bool inCache;    // whether the stage's data fit into the last cache
};

std::string limitText(const Limits& limits, int threads) {
    if (threads < 2) return "one thread: nothing to share";
    if (limits.speedup > 0.9 * threads) return "nothing: nearly linear";
    if (limits.traffic > 0.5 && !limits.inCache) return "memory traffic";
    if (limits.imbalance > 1.1) return "uneven tiles";
    return "the serial part, or other tasks on the processors";
}

void addStageTable(ReportRun& run, ReportSection& section, const ReportScene& scene,
                   const TimesByThreads& times, const std::map<int, double>& triad) {
    const int all = times.rbegin()->first;
    const std::vector<double> tiles = tileTimes(scene.loaded());
    const double pixels = static_cast<double>(scene.loaded().lens.width) * scene.loaded().lens.height;
    ReportTable table{
        "Stages, " + scene.title,
        "Milliseconds a frame: the median and, in brackets, the least and the most of the repeats. Speed-up "
        "from the least times. Memory: bytes of the planes that the stage reads and writes, as a share of "
        "what the triad moves in that time (more than all: they stayed in caches); uneven tiles: the longest "
        "queue over an even share, from the times of single tiles.",
        {"stage"},
        {}};
    for (const auto& [threads, t] : times)
        table.columns.push_back(fmt::format("{} thread{}", threads, threads > 1 ? "s" : ""));
    for (const char* more : {"speed-up", "serial part", "memory", "uneven tiles", "what limits it"})
        table.columns.emplace_back(more);
    for (std::size_t s = 0; s < kStages; ++s) {
        std::vector<std::string> row{kStageNames[s]};
        for (const auto& [threads, t] : times) {
            row.push_back(spreadText(t.ms[s]));
            addFigure(run.report(),
                      {fmt::format("stages/{}/{}/{} threads/time", scene.id, kStageNames[s], threads), "ms",
                       fmt::format("{}x{}", scene.loaded().lens.width, scene.loaded().lens.height),
                       ReportFigure::Kind::Time, t.ms[s]});
        }
        const double least = times.at(all).ms[s].low;
        const double bytes = leastBytes(s, rendererOf(scene.loaded()).viewDependence()) * pixels;
        const Limits limits{least > 0 ? times.begin()->second.ms[s].low / least : 0, serialShare(times, s),
                            s == kLeft || s == kFull ? imbalanceOf(tiles, all) : 1.0,
                            least > 0 ? 1e-6 * bytes / least / triad.at(all) : 0, bytes < lastCacheBytes()};
        row.push_back(fmt::format("{:.2f}", limits.speedup));
        row.push_back(fmt::format("{:.0f} %", 100 * limits.serial));
        row.push_back(fmt::format("{:.0f} %", 100 * limits.traffic));
        row.push_back(s == kLeft || s == kFull ? fmt::format("{:.2f}", limits.imbalance) : "-");
        row.push_back(limitText(limits, all));
        table.rows.push_back(std::move(row));
    }
    section.blocks.emplace_back(std::move(table));
}

void addSpeedups(ReportSection& section, const std::string& title, const TimesByThreads& times) {
    LineChart chart = emptySpeedups("Speed-up, " + title);
    for (const std::size_t s : {kLeft, kWarp, kFill}) {
        ChartSeries series{kStageNames[s], {}, true};
        for (const auto& [threads, t] : times)
            if (t.ms[s].low > 0)
                series.points.push_back(
                    {"", exactly(threads), exactly(times.begin()->second.ms[s].low / t.ms[s].low), false});
        chart.chart.series.push_back(std::move(series));
    }
    ChartSeries ideal{"as many times as threads", {}, true};
    for (const auto& [threads, t] : times)
        ideal.points.push_back({"", exactly(threads), exactly(threads), false});
    chart.chart.series.push_back(std::move(ideal));
    section.blocks.emplace_back(std::move(chart));
}

}  // namespace

void reportStages(ReportRun& run, double seconds) {
    ReportSection section{"time", "Where the time goes", "", {}};
    const std::vector<int> counts = threadCounts(threadCount());
    std::map<int, double> triad;
    {
        const ThreadsBack back;
        for (const int threads : counts) {
            run.tell("memory");
            setThreadCount(threads);
            triad[threads] = triadRate();
            addFigure(run.report(), {fmt::format("machine/triad/{} threads", threads), "GB/s", "",
                                     ReportFigure::Kind::Other, exactly(triad[threads])});
        }
    }
    section.text = "Memory traffic by the triad a = b + k c:";
    for (const auto& [threads, rate] : triad)
        section.text += fmt::format("{} {:.1f} GB/s on {} thread{}", threads == counts.front() ? "" : ",",
                                    rate, threads, threads > 1 ? "s" : "");
    section.text += ".";
    const double each = seconds / static_cast<double>(run.scenes().size());
    for (const ReportScene& scene : run.scenes()) {
        run.checkTime();
        const TimesByThreads times = measureStages(run, scene, counts, 0.9 * each);
        addStageTable(run, section, scene, times, triad);
        if (counts.size() > 1) addSpeedups(section, scene.title, times);
    }
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
