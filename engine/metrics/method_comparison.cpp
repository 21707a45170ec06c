#include "engine/metrics/method_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/metrics/supersampled_picture.h"
#include "engine/metrics/surface_difference.h"

namespace stereonav {
namespace {

// One method's buffers and the fastest of its runs of the frame at hand.
struct Runner {
    RightEyeMethod method;
    RightEye eye;
    EyeImage right;
    RightEyeTimings best;

    explicit Runner(RightEyeMethod m) : method(m) {}

    void run(const EyeRenderer& renderer, const StereoViews& views, const EyeImage& left, bool first) {
        WarpSetting setting;
        setting.method = method;
        const RightEyeTimings timings = eye.render(renderer, views, left, setting, right);
        if (first || timings.right_ms() < best.right_ms()) best = timings;
    }
};

class Comparison {
public:
    Comparison(const EyeRenderer& renderer, const ComparisonSetting& setting)
        : mRenderer(renderer),
          mSetting(setting),
          mFull(RightEyeMethod::Full),
          mDefault(defaultMethodFor(renderer)) {
        for (const RightEyeMethod method : setting.methods)
            if (method != RightEyeMethod::Full) mRunners.emplace_back(method);
    }

    // The figures in the order of setting.methods.
    std::vector<MethodFigures> measure(const StereoViews& views, int index, Progress& progress,
                                       const ComparedFrameListener& listener) {
        time(views);
        const Plane<PackedColor> truth =
            renderSupersampled(mRenderer, views.right, mSetting.truthFactor, progress);
        const Plane<std::uint8_t> mask =
            edgeMask(defaultHoles(views), mFull.right.viewDepth, views.parallaxScale, mSetting.edgeRadius);
        std::vector<MethodFigures> figures;
        ComparedFrame frame{index, mLeft, mFull.right, truth, {}};
        for (const RightEyeMethod method : mSetting.methods) {
            const Runner& runner = runnerOf(method);
            figures.push_back(figuresOf(runner, truth, mask));
            frame.pictures.push_back({method, runner.right, runner.eye.holeMask()});
        }
        if (listener) listener(frame);
        return figures;
    }

private:
    void time(const StereoViews& views) {
        mLeft.resize(views.left.width, views.left.height, mRenderer.viewDependence());
        for (int repeat = 0; repeat < mSetting.repeats; ++repeat) {
            const bool first = repeat == 0;
            const Stopwatch watch;
            renderEye(mRenderer, views.left, mLeft);
            mLeft_ms = first ? watch.elapsed_ms() : std::min(mLeft_ms, watch.elapsed_ms());
            mFull.run(mRenderer, views, mLeft, first);
            for (Runner& runner : mRunners) runner.run(mRenderer, views, mLeft, first);
        }
    }

    const Runner& runnerOf(RightEyeMethod method) const {
        for (const Runner& runner : mRunners)
            if (runner.method == method) return runner;
        return mFull;
    }

    const Plane<std::uint8_t>& defaultHoles(const StereoViews& views) {
        const Runner& runner = runnerOf(mDefault.method);
        if (runner.method == mDefault.method) return runner.eye.holeMask();
        mDefault.run(mRenderer, views, mLeft, true);
        return mDefault.eye.holeMask();
    }

    MethodFigures figuresOf(const Runner& runner, const Plane<PackedColor>& truth,
                            const Plane<std::uint8_t>& mask) const {
        MethodFigures figures;
        figures.name = nameOf(runner.method);
        figures.left_ms = mLeft_ms;
        figures.warp_ms = runner.best.warp_ms;
        figures.fill_ms = runner.best.fill_ms;
        figures.right_ms = runner.best.right_ms();
        figures.full_right_ms = mFull.best.right_ms();
        figures.hole_percent = 100.0 * static_cast<double>(runner.best.holePixels) /
                               (static_cast<double>(mLeft.width()) * mLeft.height());
        figures.difference = differenceOf(mFull.right.color, runner.right.color, mask);
        figures.true_psnr_db = psnrOf(truth, runner.right.color);
        const SurfaceDifference surface =
            surfaceDifference(mFull.right, runner.right, runner.eye.holeMask(), leavesHoles(runner.method));
        figures.holesOfWarped_percent = surface.holesOfWarped_percent;
        figures.surface_psnr_db = surface.psnr_db;
        return figures;
    }

    const EyeRenderer& mRenderer;
    const ComparisonSetting& mSetting;
    EyeImage mLeft;
    double mLeft_ms = 0;
    Runner mFull, mDefault;
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
    result.hole_percent = field([](F f) { return f.hole_percent; });
    result.difference.psnr_db = field([](F f) { return f.difference.psnr_db; });
    result.difference.ssim = field([](F f) { return f.difference.ssim; });
    result.difference.rgb_mean = field([](F f) { return f.difference.rgb_mean; });
    result.difference.rgb_p99 = field([](F f) { return f.difference.rgb_p99; });
    result.difference.rgb_max = field([](F f) { return f.difference.rgb_max; });
    result.difference.edge_psnr_db = field([](F f) { return f.difference.edge_psnr_db; });
    result.true_psnr_db = field([](F f) { return f.true_psnr_db; });
    result.holesOfWarped_percent = field([](F f) { return f.holesOfWarped_percent; });
    result.surface_psnr_db = field([](F f) { return f.surface_psnr_db; });
    return result;
}

std::vector<MethodFigures> compareMethods(const EyeRenderer& renderer, const std::vector<Pose>& poses,
                                          const Lens& lens, const StereoSetting& stereo,
                                          const ComparisonSetting& setting, Progress& progress,
                                          const ComparedFrameListener& listener) {
    if (poses.empty() || setting.methods.empty())
        throw Error("", "", "expected at least one pose and one method to compare",
                    "name a path and methods");
    Comparison comparison(renderer, setting);
    std::vector<std::vector<MethodFigures>> byMethod(setting.methods.size());
    const int count = static_cast<int>(poses.size());
    for (int index = 0; index < count; ++index) {
        Progress ofFrame(
            [&](double share, const std::string& what) { progress.report((index + share) / count, what); });
        const auto figures = comparison.measure(
            makeStereoViews(poses[index], lens, setting.eyes.empty() ? stereo : setting.eyes[index]), index,
            ofFrame, listener);
        for (std::size_t k = 0; k < figures.size(); ++k) byMethod[k].push_back(figures[k]);
    }
    std::vector<MethodFigures> result;
    for (const auto& frames : byMethod) result.push_back(medianOf(frames));
    return result;
}

}  // namespace stereonav
