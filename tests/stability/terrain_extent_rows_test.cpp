// Terrains from a micrometre to a million metres of relief or extent: the fast caster on every instruction
// set against the plain cell walk in double precision.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "engine/camera/stereo_rig.h"
#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"
#include "tests/support/stability_row.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using namespace test;

using HeightOf = double (*)(int i, int j, std::mt19937& random);

double waves(int i, int j, std::mt19937&) {
    return 0.5 + 0.3 * std::sin(0.21 * i) * std::cos(0.17 * j) + 0.2 * std::sin(0.05 * i);
}
double spikes(int, int, std::mt19937& random) {
    return random() % 97 == 0 ? 1.0 : 0.0;
}
double cliffs(int i, int j, std::mt19937&) {
    return (i / 9 + j / 7) % 2;
}
double noise(int, int, std::mt19937& random) {
    return static_cast<double>(random()) / 4294967296.0;
}

TerrainScene sceneOf(HeightOf height, double relief, double spacing) {
    constexpr int kSize = 65;
    std::mt19937 random(5);
    std::vector<float> heights;
    for (int j = 0; j < kSize; ++j)
        for (int i = 0; i < kSize; ++i) heights.push_back(static_cast<float>(relief * height(i, j, random)));
    return makeScene(Heightfield(kSize, kSize, {spacing, spacing}, std::move(heights), "test"));
}

// Poses over the ground: level, looking down, rolled, straight down. above: metres over the ground.
std::vector<EyeView> viewsOf(const TerrainScene& scene, double above, double nearDepth) {
    const Lens lens{61, 43, 1.2, 1.0, nearDepth};
    std::vector<EyeView> views;
    std::mt19937 random(9);
    for (int k = 0; k < 8; ++k) {
        const glm::dvec2 grid(8 + noise(0, 0, random) * 48, 8 + noise(0, 0, random) * 48);
        const glm::dvec2 world = scene.ground.worldFromGrid(grid);
        const double z = scene.ground.heightAt(world) + above * (k % 3 + 0.1);
        views.push_back(makeEyeView(
            poseFromAngles({world, z}, k * 0.8, k % 4 == 3 ? -1.5707963 : -0.25 * k, k % 2 * 0.7 * k), lens));
    }
    return views;
}

// Where the plain walk's depth changes by more than a share from one quarter of a pixel to the next the ray
// grazes an edge, and either side of it is right.
bool grazes(const TerrainScene& scene, const EyeView& view, int x, int y, double got) {
    double least = HUGE_VAL, most = 0;
    for (const double dx : {-1e-3, 0.0, 1e-3})
        for (const double dy : {-1e-3, 0.0, 1e-3}) {
            const glm::dvec3 d = view.rayDirection(x + 0.5 + dx, y + 0.5 + dy);
            const double t = castPlain(scene.ground, view.eye, d, view.nearDepth).t;
            least = std::min(least, t);
            most = std::max(most, t);
        }
    return got >= least && got <= most;
}

void compare(const TerrainScene& scene, const std::vector<EyeView>& views, StabilityRow& row) {
    long long hits = 0;
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        for (const EyeView& view : views) {
            EyeImage image;
            image.resize(view.width, view.height);
            renderEye(renderer, view, image);
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const double truth =
                        castPlain(scene.ground, view.eye, view.rayDirection(x + 0.5, y + 0.5), view.nearDepth)
                            .t;
                    const double got = image.viewDepth.at(x, y);
                    hits += std::isfinite(truth);
                    if (got == truth) continue;  // both infinite
                    const double error = std::abs(got - truth) / truth;
                    row.saw(error > 1e-6 && grazes(scene, view, x, y, got) ? 0 : error);
                }
        }
    }
    row.saw(0);
    EXPECT_GT(hits, 1000) << "the views show no ground";
}

// Depths are stored as floats (2^-24); the Newton step in double precision is trusted to 1e-7 of the depth
// (kernel_cast.h, refine), and its inputs are floats: together below a millionth.
constexpr double kDepthBound = 1e-6;

struct Ground {
    const char* name;
    HeightOf height;
};

class TerrainExtent : public testing::TestWithParam<std::tuple<Ground, int>> {};

TEST_P(TerrainExtent, ReliefIsCast) {
    const auto& [ground, exponent] = GetParam();
    const double relief = std::pow(10.0, exponent);
    StabilityRow row(
        std::string("terrain/relief/") + ground.name + "/1e" + std::to_string(exponent),
        std::string(ground.name) + " of 1e" + std::to_string(exponent) + " m on samples 30 m apart",
        "relative depth error against the plain walk", kDepthBound, "");
    const TerrainScene scene = sceneOf(ground.height, relief, 30);
    compare(scene, viewsOf(scene, std::max(relief, 2.0), 0.1), row);
}

TEST_P(TerrainExtent, ExtentIsCast) {
    const auto& [ground, exponent] = GetParam();
    const double extent = std::pow(10.0, exponent);
    StabilityRow row(
        std::string("terrain/extent/") + ground.name + "/1e" + std::to_string(exponent),
        std::string(ground.name) + " on a terrain 1e" + std::to_string(exponent) + " m wide, a tenth as high",
        "relative depth error against the plain walk", kDepthBound, "");
    const TerrainScene scene = sceneOf(ground.height, 0.1 * extent, extent / 64);
    compare(scene, viewsOf(scene, 0.05 * extent, 1e-4 * extent), row);
}

INSTANTIATE_TEST_SUITE_P(Stability, TerrainExtent,
                         testing::Combine(testing::Values(Ground{"waves", waves}, Ground{"spikes", spikes},
                                                          Ground{"cliffs", cliffs}, Ground{"noise", noise}),
                                          testing::Values(-6, -4, -2, 0, 2, 4, 6)),
                         [](const auto& given) {
                             return testName(std::string(std::get<0>(given.param).name) + "_1e" +
                                             std::to_string(std::get<1>(given.param)));
                         });

}  // namespace
}  // namespace stereonav
