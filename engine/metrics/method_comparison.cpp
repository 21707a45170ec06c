#include "engine/metrics/method_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "engine/base/error.h"
#include "engine/metrics/flicker.h"
#include "engine/metrics/rivalry.h"
#include "engine/metrics/supersampled_picture.h"
#include "engine/metrics/surface_difference.h"

namespace stereonav {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// One method's pictures and the fastest of its runs of the frame at hand.
struct Runner {
    std::string_view method;
    EyePair frame;  // without a left eye where all methods share one
    FrameTimings best;
    Plane<std::uint8_t> holeMask;  // empty: nothing is warped
    bool leavesHoles = false;
    Plane<PackedColor> beside;  // what was judged of the neighbouring frame
    Plane<float> butteraugli;

    explicit Runner(std::string_view m) : method(m) {}

    void keepTimes(bool first) {
        const FrameTimings& now = frame.timings;
        if (first) best = now;
        best.left_ms = std::min(best.left_ms, now.left_ms);
        if (now.right_ms < best.right_ms) best.right_ms = now.right_ms, best.warped = now.warped;
        best.both_ms = std::min(best.both_ms, now.both_ms);
    }
};

template <typename T>
Plane<T> oneAboveTheOther(const Plane<T>& top, const Plane<T>& bottom) {
    Plane<T> both(top.width(), top.height() + bottom.height());
    const auto copy = [&](const Plane<T>& from, int y0) {
        for (int y = 0; y < from.height(); ++y)
            std::memcpy(both.row(y0 + y), from.row(y), sizeof(T) * static_cast<std::size_t>(from.width()));
    };
    copy(top, 0);
    copy(bottom, top.height());
    return both;
}

Plane<std::uint8_t> lowerHalf(const Plane<std::uint8_t>& plane) {
    Plane<std::uint8_t> half(plane.width(), plane.height() / 2);
    for (int y = 0; y < half.height(); ++y)
        std::memcpy(half.row(y), plane.row(half.height() + y), static_cast<std::size_t>(half.width()));
    return half;
}

struct Shot {
    StereoViews views;
    double time = 0;
};

class Comparison {
public:
    Comparison(FrameMaker& frames, const ComparisonSetting& setting)
        : mFrames(frames),
          mRightFromLeft(frames.rightFromLeft()),
          mSetting(setting),
          mExact(frames.exactMethod()) {
        for (const std::string_view method : setting.methods)
            if (method != mExact.method) mRunners.emplace_back(method);
    }

    // The figures in the order of setting.methods. beside: the neighbouring frame, null without one.
    std::vector<MethodFigures> measure(const Shot& shot, const Shot* beside, int index, Progress& progress,
                                       const ComparedFrameListener& listener) {
        const auto& [views, time] = shot;
        mFlickers = beside != nullptr;
        if (beside) lookBeside(*beside, progress);
        for (int repeat = 0; repeat < mSetting.repeats; ++repeat) {
            run(mExact, views, time, repeat == 0);
            for (Runner& runner : mRunners) run(runner, views, time, repeat == 0);
        }
        if (mRightFromLeft) castTruths(views, time, progress);
        const Plane<std::uint8_t> edges = edgesOf(views, time);
        mColumns = columnsInRightEye(views, mExact.frame.left.viewDepth, mExact.frame.right.viewDepth);
        std::vector<MethodFigures> figures;
        ComparedFrame frame{index, exactLeft(), mExact.frame.right, mTruth.right, mTruth.left, {}};
        for (const std::string_view method : mSetting.methods) {
            Runner& runner = *runnerOf(method);
            figures.push_back(figuresOf(runner, edges));
            const EyeImage& left = mRightFromLeft ? exactLeft() : runner.frame.left;
            frame.pictures.push_back({method, left, runner.frame.right, runner.holeMask, runner.butteraugli});
        }
        if (listener) listener(frame);
        return figures;
    }

private:
    struct Truths {
        Plane<PackedColor> left, right;
    };

    // third: of a frame's progress, 0 to 2.
    Plane<PackedColor> castTruth(const EyeView& view, double time, int third, Progress& progress) {
        Progress part(progress, third / 3.0, (third + 1) / 3.0);
        return renderSupersampled(mFrames, view, time, mSetting.truthFactor, part);
    }

    void castTruths(const StereoViews& views, double time, Progress& progress) {
        mTruth.left = castTruth(views.left, time, 1, progress);
        mTruth.right = castTruth(views.right, time, 2, progress);
    }

    // Returns the picture that errors are counted in: the right eye, or both, one above the other.
    Plane<PackedColor> judged(const EyePair& frame) const {
        return mRightFromLeft ? frame.right.color : oneAboveTheOther(frame.left.color, frame.right.color);
    }

    void lookBeside(const Shot& shot, Progress& progress) {
        run(mExact, shot.views, shot.time, true);
        for (Runner& runner : mRunners) run(runner, shot.views, shot.time, true);
        mExact.beside = judged(mExact.frame);
        for (Runner& runner : mRunners) runner.beside = judged(runner.frame);
        mBesideTruth = mRightFromLeft ? castTruth(shot.views.right, shot.time, 0, progress) : mExact.beside;
    }

    void run(Runner& runner, const StereoViews& views, double time, bool first) {
        EyePair& frame = runner.frame;
        if (mRightFromLeft && &runner != &mExact) {
            const RightEyeTimings right =
                mRightFromLeft->makeRight(views, mExact.frame.left, {runner.method, {}}, frame.right);
            frame.timings.warped = right;
            frame.timings.right_ms = right.right_ms();
        } else {
            mFrames.make(views, time, {runner.method, {}}, frame);
        }
        if (mRightFromLeft) {
            runner.holeMask = mRightFromLeft->holes().mask;
            runner.leavesHoles = mRightFromLeft->holes().open;
            if (mSetting.edges.rays > 0) smooth(runner, views);
        }
        runner.keepTimes(first);
    }

    // Each eye's edges; the left eye is kept as it was too, for the warps.
    void smooth(Runner& runner, const StereoViews& views) {
        const FrameWay way{runner.method, {}, mSetting.edges};
        FrameTimings& timings = runner.frame.timings;
        if (&runner == &mExact) {
            mSmoothLeft = runner.frame.left;
            timings.left_ms += mRightFromLeft->smoothEdges(views.left, way, mSmoothLeft).ms;
        }
        if (!runner.leavesHoles)
            timings.right_ms += mRightFromLeft->smoothEdges(views.right, way, runner.frame.right).ms;
        timings.both_ms = timings.left_ms + timings.right_ms;
    }
    // The left eye of all methods where they differ in the right one alone.
    const EyeImage& exactLeft() const {
        return mRightFromLeft && mSetting.edges.rays > 0 ? mSmoothLeft : mExact.frame.left;
    }

    // Returns null for a method that is not among those that are compared.
    Runner* runnerOf(std::string_view method) {
        if (method == mExact.method) return &mExact;
        for (Runner& runner : mRunners)
            if (runner.method == method) return &runner;
        return nullptr;
    }

    Plane<std::uint8_t> edgesOf(const StereoViews& views, double time) {
        const EyePair& exact = mExact.frame;
        if (mRightFromLeft)
            return edgeMask(defaultHoles(views, time), exact.right.viewDepth, views.parallaxScale,
                            mSetting.edgeRadius);
        const Plane<std::uint8_t> none(views.left.width, 2 * views.left.height);
        return edgeMask(none, oneAboveTheOther(exact.left.viewDepth, exact.right.viewDepth),
                        views.parallaxScale, mSetting.edgeRadius);
    }

    const Plane<std::uint8_t>& defaultHoles(const StereoViews& views, double time) {
        if (const Runner* const runner = runnerOf(mFrames.defaultMethod())) return runner->holeMask;
        mDefault.method = mFrames.defaultMethod();
        run(mDefault, views, time, true);
        return mDefault.holeMask;
    }

    // Adds the figures of what a viewer feels.
    void addFelt(Runner& runner, const Plane<std::uint8_t>& edges, MethodFigures& figures) const {
        const EyePair& exact = mExact.frame;
        const Plane<PackedColor> truth = mRightFromLeft ? mTruth.right : judged(exact);
        figures.flicker_db =
            mFlickers ? flickerPsnr({mBesideTruth, truth}, {runner.beside, judged(runner.frame)}) : kNone;
        const TwoEyes eyes{mRightFromLeft ? exactLeft().color : runner.frame.left.color,
                           runner.frame.right.color};
        const Rivalry rivalry = mRightFromLeft ? rivalryOf(mColumns, {mTruth.left, mTruth.right}, eyes, edges)
                                               : rivalryOf(mColumns, {exact.left.color, exact.right.color},
                                                           eyes, lowerHalf(edges));
        figures.rivalry_db = rivalry.psnr_db;
        figures.edge_rivalry_db = rivalry.edge_psnr_db;
        figures.butteraugli = figures.butteraugli_max = kNone;
        figures.edge_butteraugli = figures.flat_butteraugli = kNone;
        if (!mSetting.butteraugli) return;
        ButteraugliMap map = butteraugliOf(truth, judged(runner.frame));
        const ButteraugliParts parts = partsOf(map.distances, edges);
        figures.butteraugli = map.norm3;
        figures.butteraugli_max = map.max;
        figures.edge_butteraugli = parts.inside;
        figures.flat_butteraugli = parts.outside;
        runner.butteraugli = std::move(map.distances);
    }

    MethodFigures figuresOf(Runner& runner, const Plane<std::uint8_t>& edges) const {
        const EyeImage& right = runner.frame.right;
        const RightEyeTimings warped = runner.best.warped.value_or(RightEyeTimings{});
        MethodFigures figures;
        figures.name = runner.method;
        figures.left_ms = mExact.best.left_ms;
        figures.warp_ms = warped.warp_ms;
        figures.right_ms =
            runner.best.right_ms > 0 ? runner.best.right_ms : runner.best.both_ms - figures.left_ms;
        figures.fill_ms = figures.right_ms - figures.warp_ms;
        figures.full_right_ms = mExact.best.right_ms;
        figures.pair_ms = mRightFromLeft ? figures.left_ms + figures.right_ms : runner.best.both_ms;
        figures.hole_percent = 100.0 * static_cast<double>(warped.holePixels) /
                               (static_cast<double>(right.width()) * right.height());
        figures.difference = differenceOf(judged(mExact.frame), judged(runner.frame), edges);
        addFelt(runner, edges, figures);
        figures.true_psnr_db = figures.left_true_psnr_db = kNone;
        figures.holesOfWarped_percent = figures.surface_psnr_db = kNone;
        if (!mRightFromLeft) return figures;
        figures.true_psnr_db = psnrOf(mTruth.right, right.color);
        figures.left_true_psnr_db = psnrOf(mTruth.left, exactLeft().color);
        const SurfaceDifference surface =
            surfaceDifference(mExact.frame.right, right, runner.holeMask, runner.leavesHoles);
        figures.holesOfWarped_percent = surface.holesOfWarped_percent;
        figures.surface_psnr_db = surface.psnr_db;
        return figures;
    }

    FrameMaker& mFrames;
    RightFromLeft* const mRightFromLeft;  // null: methods make both eyes
    const ComparisonSetting& mSetting;
    Runner mExact, mDefault{""};
    EyeImage mSmoothLeft;  // mExact's left eye, where edges have rays
    Truths mTruth;         // truths of the frame at hand; empty: there is no finer one
    bool mFlickers = false;
    Plane<PackedColor> mBesideTruth;  // truth of what is judged, in the neighbouring frame
    Plane<float> mColumns;            // columnsInRightEye
    std::vector<Runner> mRunners;
};

double median(std::vector<double> values) {
    std::erase_if(values, [](double value) { return std::isnan(value); });
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

MethodFigures medianOf(const std::vector<MethodFigures>& frames) {
    if (frames.empty())
        throw Error("", "", "expected figures of at least one frame, got none", "play a frame");
    const auto field = [&](auto value) {
        std::vector<double> values;
        values.reserve(frames.size());
        for (const MethodFigures& figures : frames) values.push_back(value(figures));
        return median(std::move(values));
    };
    using F = const MethodFigures&;
    MethodFigures result;
    result.name = frames.front().name;
    result.left_ms = field([](F f) { return f.left_ms; });
    result.warp_ms = field([](F f) { return f.warp_ms; });
    result.fill_ms = field([](F f) { return f.fill_ms; });
    result.right_ms = field([](F f) { return f.right_ms; });
    result.full_right_ms = field([](F f) { return f.full_right_ms; });
    result.pair_ms = field([](F f) { return f.pair_ms; });
    result.hole_percent = field([](F f) { return f.hole_percent; });
    result.difference.psnr_db = field([](F f) { return f.difference.psnr_db; });
    result.difference.ssim = field([](F f) { return f.difference.ssim; });
    result.difference.rgb_mean = field([](F f) { return f.difference.rgb_mean; });
    result.difference.rgb_p99 = field([](F f) { return f.difference.rgb_p99; });
    result.difference.rgb_max = field([](F f) { return f.difference.rgb_max; });
    result.difference.edge_psnr_db = field([](F f) { return f.difference.edge_psnr_db; });
    result.true_psnr_db = field([](F f) { return f.true_psnr_db; });
    result.left_true_psnr_db = field([](F f) { return f.left_true_psnr_db; });
    result.holesOfWarped_percent = field([](F f) { return f.holesOfWarped_percent; });
    result.surface_psnr_db = field([](F f) { return f.surface_psnr_db; });
    result.flicker_db = field([](F f) { return f.flicker_db; });
    result.rivalry_db = field([](F f) { return f.rivalry_db; });
    result.edge_rivalry_db = field([](F f) { return f.edge_rivalry_db; });
    result.butteraugli = field([](F f) { return f.butteraugli; });
    result.butteraugli_max = field([](F f) { return f.butteraugli_max; });
    result.edge_butteraugli = field([](F f) { return f.edge_butteraugli; });
    result.flat_butteraugli = field([](F f) { return f.flat_butteraugli; });
    return result;
}

std::vector<MethodFigures> compareMethods(FrameMaker& frames, const std::vector<TimedPose>& poses,
                                          const Lens& lens, const StereoSetting& stereo,
                                          const ComparisonSetting& setting, Progress& progress,
                                          const ComparedFrameListener& listener) {
    if (poses.empty() || setting.methods.empty())
        throw Error("", "", "expected at least one pose and one method to compare",
                    "name a path and methods");
    Comparison comparison(frames, setting);
    std::vector<std::vector<MethodFigures>> byMethod(setting.methods.size());
    const std::size_t count = poses.size();
    for (std::size_t n = 0; n < count; ++n) {
        Progress ofFrame(progress, static_cast<double>(n) / static_cast<double>(count),
                         static_cast<double>(n + 1) / static_cast<double>(count));
        const std::string what = fmt::format("frame {} of {}", n + 1, count);
        ofFrame.report(0, what);
        const auto shotAt = [&](const TimedPose& at) {
            return Shot{makeStereoViews(at.pose, lens, setting.eyes.empty() ? stereo : setting.eyes[n]),
                        at.time};
        };
        std::optional<Shot> beside;
        if (!setting.beside.empty()) beside = shotAt(setting.beside[n]);
        const auto figures = comparison.measure(shotAt(poses[n]), beside ? &*beside : nullptr,
                                                static_cast<int>(n), ofFrame, listener);
        for (std::size_t k = 0; k < figures.size(); ++k) byMethod[k].push_back(figures[k]);
        ofFrame.report(1, what);
    }
    std::vector<MethodFigures> result;
    result.reserve(byMethod.size());
    for (const auto& ofFrames : byMethod) result.push_back(medianOf(ofFrames));
    return result;
}

}  // namespace stereonav
