// How fast terrain is cast, warped and filled, against Embree on the same ground, view, threads and
// shading. With --marks: one JSON object of ratios, each measured side by side in this run.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/math/earth_bend.h"
#include "engine/simd/simd_target.h"
#include "engine/stereo/right_eye.h"
#include "terrain/built_in/built_in_terrain.h"
#include "terrain/cast/equidistant_caster.h"
#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"
#include "tests/bench/embree_ground.h"

namespace stereonav::bench {
namespace {

constexpr int kWidth = 500, kHeight = 400;

// The built-in terrain at 512 x 512 samples.
const TerrainScene& scene() {
    static const TerrainScene terrain = [] {
        Progress quiet;
        BuiltInTerrain built = builtInTerrain(1, 512, quiet);
        TerrainScene s;
        s.ground = Heightfield(built.size, built.size, glm::dvec2(built.spacing), built.heights, "built-in");
        const glm::dvec2 texels(built.color.width(), built.color.height());
        s.color = ColorTexture(built.color, {0.0, 0.0}, glm::dvec2(built.size - 1) / texels);
        s.sky = SkyMap(256, gradientSky);
        return s;
    }();
    return terrain;
}

enum class Attitude { Level, Pitched };

// Views from four sides, high over the ground's border, towards its middle.
std::vector<StereoViews> views(Attitude attitude, int width, int height, double fall = 0) {
    std::vector<StereoViews> all;
    const double pi = std::numbers::pi;
    const Heightfield& ground = scene().ground;
    const double extent = ground.spacing().x * (ground.width() - 1);
    for (int k = 0; k < 8; ++k) {
        const double heading = pi / 4 * k + 0.1;
        const glm::dvec2 away = -0.42 * extent * glm::dvec2(std::sin(heading), std::cos(heading));
        const double z = ground.heightAt(away) + 0.06 * extent;
        const bool pitched = attitude == Attitude::Pitched;
        const Pose pose = poseFromAngles({away, z}, heading, pitched ? -pi / 6 : 0, pitched ? pi / 9 : 0);
        const Lens lens{width, height, 0.8, 1.0, 1.0, fall};
        all.push_back(makeStereoViews(pose, lens, {0.25 * extent / 30, 0.25 * extent}));
    }
    return all;
}

void castAll(const TerrainRenderer& renderer, const std::vector<StereoViews>& all, EyeImage& image) {
    for (const StereoViews& v : all) renderEye(renderer, v.left, image);
}

// Embree casts, our kernels colour: the same shading for both.
void embreeAll(const EmbreeGround& embree, int width, const TerrainRenderer* shading,
               const std::vector<StereoViews>& all, EyeImage& image) {
    for (const StereoViews& v : all)
        for (int y = 0; y < v.left.height; y += 4) {
            embree.castRows(v.left, y, y + 4, width, image.viewDepth);
            if (shading != nullptr) shading->shadeRows(v.left, y, y + 4, image);
        }
}

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double time_ms(const std::function<void()>& work) {
    const Stopwatch watch;
    work();
    return watch.elapsed_ms();
}

// Milliseconds a picture of ours, and of Embree's fastest geometry and packet, in turn; medians of `rounds`.
struct Duel {
    double ours_ms, embree_ms;
    int embreeWidth;
    double ratio() const { return embree_ms / ours_ms; }
};

struct EmbreeWay {
    const EmbreeGround* ground;
    int width;
    std::vector<double> times;
};

Duel castAgainstEmbree(Attitude attitude, int rounds) {
    setThreadCount(1);
    const auto all = views(attitude, kWidth, kHeight);
    const TerrainRenderer renderer(scene());
    const EmbreeGround grid(scene().ground, EmbreeGeometry::Grid);
    const EmbreeGround triangles(scene().ground, EmbreeGeometry::Triangles);
    EyeImage image;
    image.resize(kWidth, kHeight);
    std::vector<EmbreeWay> ways;
    for (const int width : embreeWidths())
        for (const EmbreeGround* ground : {&grid, &triangles}) ways.push_back({ground, width, {}});
    std::vector<double> ours;
    for (int k = 0; k < rounds; ++k) {
        ours.push_back(time_ms([&] { castAll(renderer, all, image); }));
        for (EmbreeWay& way : ways)
            way.times.push_back(time_ms([&] { embreeAll(*way.ground, way.width, &renderer, all, image); }));
    }
    const double views = static_cast<double>(all.size());
    Duel duel{medianOf(ours) / views, HUGE_VAL, 0};
    for (const EmbreeWay& way : ways)
        if (const double ms = medianOf(way.times) / views; ms < duel.embree_ms)
            duel.embree_ms = ms, duel.embreeWidth = way.width;
    return duel;
}

constexpr int kRightThreads = 2;

struct RightEyeMarks {
    double warpMpixPerSecond, rightVsFull;
};

// The default right eye at 1280 x 720, and a full cast of the same eye, in turn.
RightEyeMarks rightEyeMarks(int rounds) {
    setThreadCount(kRightThreads);
    constexpr int kWide = 1280, kHigh = 720;
    const auto all = views(Attitude::Level, kWide, kHigh);
    const TerrainRenderer renderer(scene());
    RightEye rightEye;
    EyeImage left, right;
    left.resize(kWide, kHigh);
    std::vector<double> warp, ratio;
    for (const StereoViews& v : all) {
        renderEye(renderer, v.left, left);
        for (int k = 0; k < rounds; ++k) {
            WarpSetting warped, full;
            full.method = RightEyeMethod::Full;
            const RightEyeTimings t = rightEye.render(renderer, v, left, warped, right);
            const RightEyeTimings f = rightEye.render(renderer, v, left, full, right);
            if (k == 0) continue;
            warp.push_back(kWide * kHigh / t.warp_ms / 1e3);
            ratio.push_back(t.right_ms() / f.right_ms());
        }
    }
    return {medianOf(warp), medianOf(ratio)};
}

int printMarks() {
    const Duel level = castAgainstEmbree(Attitude::Level, 15);
    const Duel pitched = castAgainstEmbree(Attitude::Pitched, 15);
    const RightEyeMarks marks = rightEyeMarks(12);
    const nlohmann::ordered_json json = {{"simd", nameOf(availableTarget(SimdTarget::Auto))},
                                         {"cast_threads", 1},
                                         {"right_threads", kRightThreads},
                                         {"left_vs_embree", level.ratio()},
                                         {"left_vs_embree_pitched", pitched.ratio()},
                                         {"warp_mpix_per_s", marks.warpMpixPerSecond},
                                         {"right_vs_full", marks.rightVsFull},
                                         {"left_ms", level.ours_ms},
                                         {"embree_ms", level.embree_ms},
                                         {"embree_width", level.embreeWidth},
                                         {"left_pitched_ms", pitched.ours_ms},
                                         {"embree_pitched_ms", pitched.embree_ms},
                                         {"embree_pitched_width", pitched.embreeWidth}};
    std::printf("%s\n", json.dump().c_str());
    return 0;
}

// fall: of a round Earth.
void BM_LeftEye(benchmark::State& state, SimdTarget target, double fall) {
    setThreadCount(1);
    const auto all = views(static_cast<Attitude>(state.range(0)), kWidth, kHeight, fall);
    const TerrainRenderer renderer(scene(), target);
    EyeImage image;
    image.resize(kWidth, kHeight);
    for (auto _ : state) castAll(renderer, all, image);
    state.counters["ms_a_picture"] =
        benchmark::Counter(static_cast<double>(all.size()) * 1e-3,
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void BM_Embree(benchmark::State& state, int width) {
    const auto all = views(static_cast<Attitude>(state.range(0)), kWidth, kHeight);
    const TerrainRenderer renderer(scene());
    const EmbreeGround embree(scene().ground, static_cast<EmbreeGeometry>(state.range(1)));
    EyeImage image;
    image.resize(kWidth, kHeight);
    for (auto _ : state) embreeAll(embree, width, state.range(2) != 0 ? &renderer : nullptr, all, image);
    state.counters["ms_a_picture"] =
        benchmark::Counter(static_cast<double>(all.size()) * 1e-3,
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// The paper's stepping at half a sample spacing, unshaded, and how late its hits are on average.
void BM_Equidistant(benchmark::State& state) {
    const EyeView view = views(Attitude::Level, kWidth / 5, kHeight / 5).front().left;
    const Heightfield& ground = scene().ground;
    const double step = 0.5 * ground.spacing().x;
    double late = 0;
    std::vector<double> times;
    long long hits = 0;
    for (auto _ : state)
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 direction = view.rayDirection(x + 0.5, y + 0.5);
                const double t = castEquidistant(ground, view.eye, direction, view.nearDepth, step);
                times.push_back(t);
            }
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double t = times[static_cast<std::size_t>(y) * view.width + x];
            const double exact =
                castPlain(ground, view.eye, view.rayDirection(x + 0.5, y + 0.5), view.nearDepth).t;
            if (std::isfinite(t) && std::isfinite(exact)) late += t - exact, ++hits;
        }
    state.counters["late_m"] = hits > 0 ? late / static_cast<double>(hits) : 0;
}
BENCHMARK(BM_Equidistant)->Unit(benchmark::kMillisecond)->Iterations(1);

// The plain cell walk of the same picture.
void BM_PlainWalk(benchmark::State& state) {
    const EyeView view = views(Attitude::Level, kWidth / 5, kHeight / 5).front().left;
    for (auto _ : state)
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                benchmark::DoNotOptimize(
                    castPlain(scene().ground, view.eye, view.rayDirection(x + 0.5, y + 0.5), view.nearDepth)
                        .t);
}
BENCHMARK(BM_PlainWalk)->Unit(benchmark::kMillisecond)->Iterations(3);

// attitude: 0 level, 1 pitched by 30 and rolled by 20 degrees; geometry: 0 grid, 1 triangles; shaded: 0
// traversal alone.
void registerCasts() {
    for (const double fall : {0.0, curvatureFall(kUsualRefraction)})
        for (const SimdTarget target : simdTargets())
            benchmark::RegisterBenchmark(
                ((fall > 0 ? "BM_BentLeftEye/" : "BM_LeftEye/") + std::string(nameOf(target))).c_str(),
                BM_LeftEye, target, fall)
                ->ArgNames({"attitude"})
                ->ArgsProduct({{0, 1}})
                ->Unit(benchmark::kMillisecond);
    for (const int width : embreeWidths())
        benchmark::RegisterBenchmark(("BM_Embree" + std::to_string(width)).c_str(), BM_Embree, width)
            ->ArgNames({"attitude", "geometry", "shaded"})
            ->ArgsProduct({{0, 1}, {0, 1}, {0, 1}})
            ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace stereonav::bench

int main(int argc, char** argv) {
    for (int k = 1; k < argc; ++k)
        if (std::strcmp(argv[k], "--marks") == 0) return stereonav::bench::printMarks();
    benchmark::Initialize(&argc, argv);
    stereonav::bench::registerCasts();
    benchmark::AddCustomContext(
        "simd", std::string(stereonav::nameOf(stereonav::availableTarget(stereonav::SimdTarget::Auto))));
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
