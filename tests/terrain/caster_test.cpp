// The fast caster against the plain cell walk: same cell, same depth, for any view, on every
// instruction set this processor has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "engine/base/parallel.h"
#include "engine/camera/stereo_rig.h"
#include "engine/sampling/pixel_samples.h"
#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/support/own_cache.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

struct Tally {
    long long pixels = 0, wrong = 0;
    double worst = 0;  // relative depth error of pixels that are right
    std::string first;
};

bool sameDepth(double expected, double got, double tolerance) {
    if (!std::isfinite(expected) || !std::isfinite(got)) return std::isfinite(expected) == std::isfinite(got);
    return std::abs(got - expected) <= tolerance * expected;
}

void compare(const TerrainScene& scene, const TerrainRenderer& renderer, const EyeView& view, Tally& tally) {
    EyeImage image;
    image.resize(view.width, view.height);
    renderEye(renderer, view, image);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const GroundHit hit =
                castPlain(scene.ground, view.eye, view.rayDirection(x + 0.5, y + 0.5), view.nearDepth);
            const double got = image.viewDepth.at(x, y);
            ++tally.pixels;
            if (sameDepth(hit.t, got, 1e-6)) {
                if (std::isfinite(hit.t)) tally.worst = std::max(tally.worst, std::abs(got - hit.t) / hit.t);
                continue;
            }
            if (tally.wrong++ == 0)
                tally.first = "pixel " + std::to_string(x) + "," + std::to_string(y) + " expected " +
                              std::to_string(hit.t) + " got " + std::to_string(got);
        }
}

// A pose over the ground (mostly inside its extent), any heading; kind chooses pitch and roll.
Pose randomPose(const Heightfield& ground, std::mt19937& random, int kind) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const glm::dvec2 last(ground.width() - 1, ground.height() - 1);
    const glm::dvec2 spread = kind % 10 == 9 ? glm::dvec2(2.0) : glm::dvec2(1.0);
    const glm::dvec2 grid = last * (0.5 + spread * (glm::dvec2(unit(random), unit(random)) - 0.5));
    const glm::dvec2 world = ground.worldFromGrid(grid);
    double height = ground.heightAt(world);
    if (!std::isfinite(height)) height = ground.maxHeight();
    const double z = height + 2.0 + 400.0 * unit(random) * unit(random);
    const double pi = std::numbers::pi, heading = 2 * pi * unit(random);
    switch (kind % 5) {
        case 0:
            return poseFromAngles({world, z}, heading, 0, 0);  // level
        case 1:
            return poseFromAngles({world, z}, heading, -0.9 * unit(random), 0);  // looking down
        case 2:
            return poseFromAngles({world, z}, heading, 0, 2 * pi * unit(random));  // rolled
        case 3:
            return poseFromAngles({world, z}, heading, pi * (unit(random) - 0.5), 2 * pi * unit(random));
        default:
            return poseFromAngles({world, z}, heading, unit(random) < 0.7 ? -pi / 2 : pi / 2, 0);  // straight
    }
}

EyeView randomView(const Heightfield& ground, std::mt19937& random, int kind) {
    std::uniform_int_distribution<int> width(1, 70), height(1, 60);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Lens lens{width(random), height(random), 0.2 + 1.8 * unit(random), 1.0, 0.1};
    StereoSetting stereo{2.0 * unit(random), 20.0 + 200.0 * unit(random)};
    return makeStereoViews(randomPose(ground, random, kind), lens, stereo).right;
}

void expectPlainHits(const TerrainScene& scene, int views, unsigned seed) {
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        std::mt19937 random(seed);
        Tally tally;
        for (int k = 0; k < views; ++k) compare(scene, renderer, randomView(scene.ground, random, k), tally);
        std::printf("[          ] target %d: %lld pixels, %lld wrong, worst depth error %.1e\n",
                    static_cast<int>(target), tally.pixels, tally.wrong, tally.worst);
        EXPECT_LE(tally.wrong, tally.pixels / 1000000) << tally.first;
    }
}

// Scattered pixels of a picture that knows the rest, as holes of a warped image are filled.
void expectPlainHitsInHoles(const TerrainScene& scene, int views, unsigned seed) {
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        std::mt19937 random(seed);
        Tally tally;
        for (int k = 0; k < views; ++k) {
            const EyeView view = randomView(scene.ground, random, k);
            EyeImage image;
            image.resize(view.width, view.height);
            renderEye(renderer, view, image);
            std::vector<PixelIndex> holes;
            std::vector<float> full;
            std::vector<PackedColor> colors;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x)
                    if (random() % 5 == 0 || (x > 10 && x < 30 && y > 8)) {
                        holes.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
                        full.push_back(image.viewDepth.at(x, y));
                        colors.push_back(image.color.at(x, y));
                        image.viewDepth.at(x, y) = 0;
                        image.color.at(x, y) = 0;
                    }
            renderer.renderPixels(view, {0, 0, view.width, view.height}, holes, image);
            for (std::size_t n = 0; n < holes.size(); ++n) {
                const float got = image.viewDepth.at(holes[n].x, holes[n].y);
                ++tally.pixels;
                if (sameDepth(full[n], got, 1e-6)) {
                    ASSERT_EQ(image.color.at(holes[n].x, holes[n].y), colors[n]);
                } else if (tally.wrong++ == 0) {
                    tally.first = "expected " + std::to_string(full[n]) + " got " + std::to_string(got);
                }
            }
        }
        EXPECT_LE(tally.wrong, tally.pixels / 1000000) << tally.first;
    }
}

// More rays through pixels of a picture that is known, by the plain walk of each.
void expectPlainHitsBeside(const TerrainScene& scene, int views, unsigned seed) {
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> within(-0.5, 0.5);
        Tally tally;
        for (int k = 0; k < views; ++k) {
            const EyeView view = randomView(scene.ground, random, k);
            EyeImage known, image;
            known.resize(view.width, view.height);
            image.resize(view.width, view.height);
            renderEye(renderer, view, known);
            const EyeView beside = shiftedBy(view, {within(random), within(random)});
            std::vector<PixelIndex> pixels;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x)
                    if (random() % 3 == 0)
                        pixels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
            renderer.renderMoreRays(beside, view, known.viewDepth, {0, 0, view.width, view.height}, pixels,
                                    image);
            for (const PixelIndex p : pixels) {
                const GroundHit hit = castPlain(scene.ground, beside.eye,
                                                beside.rayDirection(p.x + 0.5, p.y + 0.5), beside.nearDepth);
                ++tally.pixels;
                if (!sameDepth(hit.t, image.viewDepth.at(p.x, p.y), 1e-6) && tally.wrong++ == 0)
                    tally.first = "pixel " + std::to_string(p.x) + "," + std::to_string(p.y) + " expected " +
                                  std::to_string(hit.t) + " got " +
                                  std::to_string(image.viewDepth.at(p.x, p.y));
            }
        }
        EXPECT_LE(tally.wrong, tally.pixels / 1000000) << tally.first;
    }
}

class CasterOnGround : public testing::TestWithParam<std::string> {};

TEST_P(CasterOnGround, AddsRaysThatHitWhatThePlainWalkHits) {
    expectPlainHitsBeside(test::makeScene(test::makeGround(GetParam(), 97, 83, 7)), 100, 29);
}

TEST_P(CasterOnGround, HitsWhatThePlainWalkHits) {
    expectPlainHits(test::makeScene(test::makeGround(GetParam(), 97, 83, 7)), 150, 11);
}

TEST(Caster, HitsWhatThePlainWalkHitsOnRealGround) {
    const std::filesystem::path file = test::realData() / "terrain" / "srtm_bigtujunga30m_utm11.tif";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no real data: set STEREONAV_TEST_DATA";
    Progress quiet;
    TerrainScene scene = loadTerrain(sceneFileFromName(file.string()), quiet);
    expectPlainHits(scene, 150, 23);
}

TEST_P(CasterOnGround, FillsHolesAsTheWholePictureIsCast) {
    expectPlainHitsInHoles(test::makeScene(test::makeGround(GetParam(), 97, 83, 7)), 100, 17);
}

// The same ground, metres higher. Floats have steps of a metre at ten thousand kilometres: both casters read
// the same.
Heightfield raised(const Heightfield& ground, double metres) {
    std::vector<float> heights;
    for (int j = 0; j < ground.height(); ++j)
        for (int i = 0; i < ground.width(); ++i)
            heights.push_back(static_cast<float>(ground.sample(i, j) + metres));
    return Heightfield(ground.width(), ground.height(), ground.spacing(), std::move(heights), "raised");
}

TEST_P(CasterOnGround, HitsWhatThePlainWalkHitsAtAnyHeight) {
    const Heightfield ground = test::makeGround(GetParam(), 97, 83, 7);
    for (const double metres : {1e5, -1e5, 1e7, -1e7}) {
        SCOPED_TRACE(metres);
        expectPlainHits(test::makeScene(raised(ground, metres)), 60, 11);
    }
}

// From so far away that the ground fills the view of a telescope. Up to 4,000 spacings away hits are the
// same; beyond, single-precision distances pass by single tips and edges, narrower than a pixel of any wider
// view.
TEST_P(CasterOnGround, HitsWhatThePlainWalkHitsFromFarAway) {
    const TerrainScene scene = test::makeScene(test::makeGround(GetParam(), 97, 83, 7));
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        for (const auto& [away, share] : {std::pair{1e5, 0.0}, {1e6, 1e-4}, {1e7, 1e-3}}) {
            Tally tally;
            for (int k = 0; k < 24; ++k) {
                const double heading = 0.3 + k * std::numbers::pi / 12, pitch = -0.05 - 0.06 * k;
                const glm::dvec3 forward(std::sin(heading) * std::cos(pitch),
                                         std::cos(heading) * std::cos(pitch), std::sin(pitch));
                const Pose pose =
                    poseFromAngles(glm::dvec3(0, 0, 50) - away * forward, heading, pitch, 0.1 * k);
                const Lens lens{57, 41, 2500 / away, 1.0, 0.1};
                compare(scene, renderer, makeStereoViews(pose, lens, {1.0, away}).right, tally);
            }
            EXPECT_LE(double(tally.wrong), share * double(tally.pixels)) << away << ": " << tally.first;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, CasterOnGround, testing::ValuesIn(test::groundKinds()),
                         [](const auto& kind) { return kind.param; });

}  // namespace
}  // namespace stereonav
