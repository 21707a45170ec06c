// Speed of the right eye's warp alone (no rays cast), in right pixels a second: by method, size, thread
// count and schedule. The left eye is a hilly ground drawn by floating horizon, so that survivors,
// folds and gaps are as frequent as in terrain.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "engine/stereo/parallax_histogram.h"
#include "engine/stereo/right_eye.h"
#include "engine/stereo/row_kernels.h"

namespace {

using namespace stereonav;

// Nothing to cast: only the warp is left.
class NoScene : public EyeRenderer {
public:
    int tileCount(const EyeView&) const override { return 0; }
    void renderTile(const EyeView&, int, EyeImage&) const override {}
    void renderPixels(const EyeView&, PixelRect, std::span<const PixelIndex>, EyeImage&) const override {}
    bool mayHitBeyondEdge(const EyeView&, PixelRect, double, double) const override { return false; }
};

// Colours are shaded again from normals by what is hardly more than a copy: what the warp of normals costs,
// and what the calls for the rows do.
class CheaplyLitScene final : public NoScene {
public:
    ViewDependence viewDependence() const override { return ViewDependence::Normal; }
    void shadeAgain(const EyeView&, int y, int x0, int x1, EyeImage& image) const override {
        const std::uint32_t* normal = image.normal.row(y);
        const float* depth = image.viewDepth.row(y);
        PackedColor* color = image.color.row(y);
        for (int x = x0; x < x1; ++x) color[x] = depth[x] < kMissDepth ? normal[x] : 0u;
    }
};

double groundHeight(double x, double z) {
    return 60 * std::sin(x * 0.004 + 1) * std::sin(z * 0.003) +
           25 * std::sin(x * 0.013) * std::sin(z * 0.011 + x * 0.002) + 6 * std::sin(x * 0.05 + z * 0.03);
}

// A level view from 120 m above a ground with hills, sky above.
EyeImage groundImage(const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height, ViewDependence::Normal);
    std::mt19937 random(1);
    for (int x = 0; x < view.width; ++x) {
        const double side = view.rayDirection(x + 0.5, 0).x;
        int top = view.height;
        for (double z = 20; z < 20000; z *= 1.002) {
            const double slope = (groundHeight(view.eye.x + side * z, z) - 120) / z;
            const int row = std::max(0, static_cast<int>((view.yMax - slope) / view.pixelHeight()));
            for (; top > row; --top) image.viewDepth.at(x, top - 1) = static_cast<float>(z);
        }
        for (int y = 0; y < top; ++y) image.viewDepth.at(x, y) = kMissDepth;
        for (int y = 0; y < view.height; ++y)
            image.color.at(x, y) = image.normal.at(x, y) = static_cast<std::uint32_t>(random()) & 0x3fffffffu;
    }
    return image;
}

StereoViews viewsOf(int width, int height) {
    Lens lens;
    lens.width = width;
    lens.height = height;
    return makeStereoViews(Pose{}, lens, {10, 300});  // separation 1/30 of the zero-parallax distance
}

void warp(benchmark::State& state, RightEyeMethod method, Schedule schedule, const EyeRenderer& scene) {
    const int width = static_cast<int>(state.range(0)), height = static_cast<int>(state.range(1));
    setThreadCount(static_cast<int>(state.range(2)));
    const StereoViews views = viewsOf(width, height);
    const EyeImage left = groundImage(views.left);
    RightEye eye;
    EyeImage right;
    WarpSetting setting;
    setting.method = method;
    setting.warpSchedule = schedule;
    eye.render(scene, views, left, setting, right);
    for (auto _ : state)
        state.SetIterationTime(eye.render(scene, views, left, setting, right).warp_ms * 1e-3);
    long long holes = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) holes += eye.holeMask().at(x, y) != 0;
    state.counters["Mpix/s"] =
        benchmark::Counter(1e-6 * width * height, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["holes_percent"] = 100.0 * static_cast<double>(holes) / (width * height);
}

const NoScene kNoScene;
const CheaplyLitScene kLit;

void sizes(benchmark::internal::Benchmark* b) {
    for (const int threads : {1, 2})
        for (const auto& [width, height] : {std::pair{500, 400}, std::pair{1280, 720}})
            b->Args({width, height, threads});
    b->ArgNames({"width", "height", "threads"})->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(0.2);
}

BENCHMARK_CAPTURE(warp, cubic, RightEyeMethod::Cubic, Schedule::Dynamic, kNoScene)->Apply(sizes);
BENCHMARK_CAPTURE(warp, linear, RightEyeMethod::Linear, Schedule::Dynamic, kNoScene)->Apply(sizes);
BENCHMARK_CAPTURE(warp, paper, RightEyeMethod::Paper, Schedule::Dynamic, kNoScene)->Apply(sizes);
BENCHMARK_CAPTURE(warp, mcmillan, RightEyeMethod::McMillan, Schedule::Dynamic, kNoScene)->Apply(sizes);
BENCHMARK_CAPTURE(warp, linear_normals, RightEyeMethod::Linear, Schedule::Dynamic, kLit)->Apply(sizes);
BENCHMARK_CAPTURE(warp, cubic_normals, RightEyeMethod::Cubic, Schedule::Dynamic, kLit)->Apply(sizes);
BENCHMARK_CAPTURE(warp, paper_normals, RightEyeMethod::Paper, Schedule::Dynamic, kLit)->Apply(sizes);
BENCHMARK_CAPTURE(warp, depthsplat, RightEyeMethod::DepthSplat, Schedule::Dynamic, kNoScene)->Apply(sizes);
BENCHMARK_CAPTURE(warp, cubic_interleaved, RightEyeMethod::Cubic, Schedule::Interleaved, kNoScene)
    ->Apply(sizes);
BENCHMARK_CAPTURE(warp, cubic_contiguous, RightEyeMethod::Cubic, Schedule::Contiguous, kNoScene)
    ->Apply(sizes);

// One thread, row after row.
void rows(benchmark::State& state, ResampleFunction kernel, bool cubic, bool surface) {
    const StereoViews views = viewsOf(1280, 180);
    const EyeImage left = groundImage(views.left);
    EyeImage right;
    right.resize(1280, 180);
    Plane<std::uint8_t> holes(1280, 180);
    std::vector<float> column(1280 + kRowPadding), inverse(1280 + kRowPadding);
    std::vector<std::int32_t> source(1280 + kRowPadding);
    for (auto _ : state)
        for (int y = 0; y < 180; ++y)
            kernel({left.color.row(y), left.viewDepth.row(y), right.color.row(y), right.viewDepth.row(y),
                    holes.row(y), 1280, left.color.stride(), static_cast<float>(views.shiftAtInfinity),
                    static_cast<float>(views.parallaxScale), 0.6f, 1.1f, cubic ? 2 : 1, cubic, column.data(),
                    inverse.data(), source.data(), surface});
    state.counters["Mpix/s"] =
        benchmark::Counter(1e-6 * 1280 * 180, benchmark::Counter::kIsIterationInvariantRate);
}

// Measures what a picture's parallax costs: of the ground, and of depths without any order, which no picture
// has.
void parallax(benchmark::State& state, SimdTarget target, bool noise, int threads) {
    setThreadCount(threads);
    const StereoViews views = viewsOf(1280, 720);
    EyeImage left = groundImage(views.left);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> logs(2.0f, 9.0f);
    for (int y = 0; noise && y < 720; ++y)
        for (int x = 0; x < 1280; ++x) left.viewDepth.at(x, y) = std::exp(logs(random));
    for (auto _ : state) benchmark::DoNotOptimize(parallaxSeen(views, left.viewDepth, target));
}

// For each instruction set that may be used here.
void registerRows() {
    for (const SimdTarget target : simdTargets()) {
        for (const int threads : {1, 2})
            for (const bool noise : {false, true})
                benchmark::RegisterBenchmark(("parallax/" + std::string(nameOf(target)) +
                                              (noise ? "/noise/" : "/ground/") + std::to_string(threads))
                                                 .c_str(),
                                             parallax, target, noise, threads)
                    ->UseRealTime()
                    ->Unit(benchmark::kMillisecond);
        const std::string set = "rows/" + std::string(nameOf(target));
        const ResampleFunction kernel = resampler(target);
        benchmark::RegisterBenchmark((set + "/linear").c_str(), rows, kernel, false, false);
        benchmark::RegisterBenchmark((set + "/linear_normals").c_str(), rows, kernel, false, true);
        benchmark::RegisterBenchmark((set + "/cubic").c_str(), rows, kernel, true, false);
    }
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    registerRows();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
