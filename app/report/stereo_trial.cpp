#include "app/report/stereo_trial.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/report/coherence.h"
#include "app/report/trial.h"
#include "engine/camera/default_eyes.h"
#include "engine/metrics/image_difference.h"
#include "engine/metrics/surface_difference.h"

namespace stereonav {
namespace {

// One stage of one way on one number of threads: sums over the frames by repeat, and the fastest repeat of
// each frame.
struct PaperStage {
    std::vector<double> sums, fastest;

    void begin(std::size_t frames) {
        sums.push_back(0);
        fastest.resize(frames, HUGE_VAL);
    }
    void add(std::size_t frame, double ms) {
        sums.back() += ms;
        fastest[frame] = std::min(fastest[frame], ms);
    }
    Spread spread() const {
        const double frames = static_cast<double>(fastest.size());
        Spread spread = scaled(spreadOf(sums), 1 / frames);
        spread.low = std::accumulate(fastest.begin(), fastest.end(), 0.0) / frames;
        return spread;
    }
};

struct Stages {
    PaperStage left, warp, fill, right;
};

}  // namespace

std::vector<int> paperThreads(int all) {
    std::vector<int> threads;
    for (const int n : {1, 4, 8, 12, 16})
        if (n <= all) threads.push_back(n);
    if (threads.back() != all) threads.push_back(all);
    return threads;
}

LineChart emptySpeedups(const std::string& title) {
    using Kind = ChartScale::Kind;
    return {{title, "threads", "times as fast as one", Kind::Linear, Kind::Linear, {}, false}, ""};
}

ThreadsBack::~ThreadsBack() {
    setThreadCount(mBefore);
}

double StereoCounts::holesOfWarped_percent() const {
    const long long warped = surfacePixels - holePixels;
    return warped > 0 ? 100.0 * static_cast<double>(holePixels) / static_cast<double>(warped) : NAN;
}

double StereoCounts::psnr_db() const {
    if (!(compared > 0)) return NAN;
    return squares > 0 ? std::min(kIdenticalPsnr_db, 10 * std::log10(255.0 * 255.0 * compared / squares))
                       : kIdenticalPsnr_db;
}

StereoTrial::StereoTrial(const Scene& scene, std::vector<StereoWay> ways, int frames)
    : mScene(scene), mWays(std::move(ways)) {
    StereoSetting stereo = scene.stereo;
    stereo.separation = stereo.zeroParallax / kUsualParts;
    for (const Pose& pose : posesOf(scene, frames))
        mViews.push_back(makeStereoViews(pose, scene.lens, stereo));
}

void StereoTrial::castLeft(const StereoViews& views, Schedule schedule) {
    const EyeRenderer& renderer = rendererOf(mScene);
    mLeft.resize(views.left.width, views.left.height, renderer.viewDependence());
    parallelFor(
        renderer.tileCount(views.left), [&](int tile) { renderer.renderTile(views.left, tile, mLeft); },
        schedule);
}

void StereoTrial::time(ReportRun& run, const std::string& what, const std::vector<int>& threads, int least,
                       int most, double seconds) {
    const ThreadsBack back;
    const WithoutCoherence alone(rendererOf(mScene));
    std::map<int, std::vector<Stages>> stages;
    for (const int n : threads) stages[n].resize(mWays.size());
    const Stopwatch watch;
    for (int repeat = 0; repeat < most; ++repeat) {
        if (repeat >= least && watch.elapsed_ms() > 1000 * seconds) break;
        for (auto& [n, list] : stages)
            for (Stages& s : list)
                for (PaperStage* stage : {&s.left, &s.warp, &s.fill, &s.right}) stage->begin(mViews.size());
        for (std::size_t frame = 0; frame < mViews.size(); ++frame)
            for (const int n : threads) {
                run.tell(what);
                setThreadCount(n);
                for (std::size_t k = 0; k < mWays.size(); ++k) {
                    Stages& s = stages[n][k];
                    const Stopwatch left;
                    castLeft(mViews[frame], mWays[k].leftSchedule);
                    s.left.add(frame, left.elapsed_ms());
                    const EyeRenderer& scene =
                        mWays[k].coherent ? rendererOf(mScene) : static_cast<const EyeRenderer&>(alone);
                    const RightEyeTimings t =
                        mEye.render(scene, mViews[frame], mLeft, mWays[k].setting, mRight);
                    s.warp.add(frame, t.warp_ms);
                    s.fill.add(frame, t.fill_ms);
                    s.right.add(frame, t.right_ms());
                }
            }
    }
    for (const auto& [n, list] : stages) {
        mTimes[n].clear();
        for (const Stages& s : list)
            mTimes[n].push_back({s.left.spread(), s.warp.spread(), s.fill.spread(), s.right.spread()});
    }
}

StereoCounts StereoTrial::counts(std::size_t way) {
    StereoCounts all;
    FrameMaker& frames = mScene.frames();
    EyePair full;
    for (const StereoViews& views : mViews) {
        frames.make(views, 0, {frames.exactMethod(), {}}, full);
        frames.rightFromLeft()->makeRight(views, full.left, wayOf(mWays[way].setting), mRight);
        const auto [mask, open] = frames.rightFromLeft()->holes();
        const SurfaceDifference d = surfaceDifference(full.right, mRight, mask, open);
        const GapPixels gaps = gapPixels(full.right, mask);
        all.surfacePixels += d.surfacePixels;
        all.holePixels += d.holePixels;
        all.rightEnd += static_cast<double>(gaps.rightEnd);
        all.middle += static_cast<double>(gaps.middle);
        all.leftEnd += static_cast<double>(gaps.leftEnd);
        if (std::isnan(d.psnr_db)) continue;
        const double pixels = static_cast<double>(d.surfacePixels - (open ? d.holePixels : 0));
        all.compared += pixels;
        if (d.psnr_db < kIdenticalPsnr_db)
            all.squares += pixels * 255.0 * 255.0 * std::pow(10.0, -d.psnr_db / 10);
    }
    return all;
}

}  // namespace stereonav
