// Ground over a round Earth: the plain walk against the model's own words, the closed form of the horizon and
// the viewshed; the kernels and what is painted against the plain walk.
#include "engine/math/earth_bend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "engine/camera/stereo_rig.h"
#include "engine/simd/simd_target.h"
#include "terrain/cast/plain_caster.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/paint/contour_painter.h"
#include "terrain/paint/ground_view.h"
#include "terrain/paint/track_painter.h"
#include "terrain/survey/viewshed.h"
#include "tests/oracle/plain_rings.h"
#include "tests/support/analytic_scene.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

constexpr double kUsualFall = curvatureFall(kUsualRefraction);

Heightfield groundOf(int width, int height, const glm::dvec2& spacing,
                     const std::function<double(int, int)>& heightAt) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(static_cast<float>(heightAt(i, j)));
    return Heightfield(width, height, spacing, std::move(heights), "bent");
}

// Hills of some hundred metres over many cells, and `rough` metres from one to the next.
Heightfield wavyGround(int side, double spacing, double rough = 120) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    return groundOf(side, side, glm::dvec2(spacing, 0.9 * spacing), [&](int i, int j) {
        return 400 + rough * unit(random) + 250 * std::sin(0.31 * i + 0.1 * j) * std::cos(0.23 * j);
    });
}

TEST(EarthBend, LowersWhatIsFarAndTakesItBack) {
    // 100 km away, without and with air: 784.8 m and 682.8 m.
    EXPECT_NEAR(EarthBend({{0, 0}, curvatureFall(0)}).sinkAt({6e4, 8e4}), 784.8, 0.05);
    EXPECT_NEAR(EarthBend({{0, 0}, kUsualFall}).sinkAt({6e4, 8e4}), 682.8, 0.05);
    EXPECT_EQ(curvatureFall(1), 0);
    const EarthBend bend{{500, -300}, kUsualFall};
    EXPECT_EQ(bend.sinkAt({500, -300}), 0);
    EXPECT_TRUE(std::isnan(bend.sinkAt({std::nan(""), 0})));
    for (const glm::dvec3 place :
         {glm::dvec3(0, 0, 0), glm::dvec3(1e6, -2e6, 8000), glm::dvec3(501, -300, -5)})
        EXPECT_NEAR(glm::distance(bend.placeOf(bend.apparent(place)), place), 0, 1e-9);
    const glm::dvec3 eye(500, -300, 1200), ray(0.3, 0.9, -0.02);
    const glm::dvec3 way = bend.wayToPlace(eye, ray, 4e4);
    EXPECT_NEAR(glm::distance(eye + 4e4 * way, bend.placeOf(eye + 4e4 * ray)), 0, 1e-9);
}

// How far a ray lies over the ground as the model lowers it.
double heightOver(const Heightfield& ground, const EarthBend& bend, const glm::dvec3& at) {
    return at.z - (ground.heightAt(glm::dvec2(at)) - bend.sinkAt(glm::dvec2(at)));
}

TEST(EarthBend, ThePlainWalkMeetsTheLoweredGroundFirst) {
    const Heightfield ground = wavyGround(120, 1000);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    int met = 0, missed = 0;
    for (int k = 0; k < 1500; ++k) {
        const EarthBend bend{{3e4 * unit(random), 3e4 * unit(random)}, k % 3 ? kUsualFall : 1e-6};
        const glm::dvec2 below = 5e4 * glm::dvec2(unit(random), unit(random));
        glm::dvec3 eye(below, ground.heightAt(below) - bend.sinkAt(below));
        eye.z += k % 5 ? 3 + 300 * (1 + unit(random)) : 9e4;
        const double turn = 3.2 * unit(random),
                     down = k % 5 ? 0.03 * unit(random) : -0.3 + 0.3 * unit(random);
        const glm::dvec3 way(std::sin(turn), std::cos(turn), down);
        const GroundHit hit = castPlain(ground, eye, way, 0.1, bend);
        const bool found = std::isfinite(hit.t);
        ++(found ? met : missed);
        if (found) {
            ASSERT_NEAR(heightOver(ground, bend, eye + hit.t * way), 0, 1e-6) << k;
        }
        const double end = found ? hit.t : 2.5e5;
        for (double t = 50; t < end - 1; t += 50) {
            const glm::dvec3 at = eye + t * way;
            if (ground.contains(glm::dvec2(at))) {
                ASSERT_GT(heightOver(ground, bend, at), -1e-6) << k << " " << t;
            }
        }
    }
    EXPECT_GT(met, 400);
    EXPECT_GT(missed, 200);
}

// Level ground is the same with a bend of nothing, and rays straight up and down know of none.
TEST(EarthBend, WhatDoesNotBendIsAsItWas) {
    const Heightfield ground = wavyGround(20, 1000);
    for (int k = 0; k < 200; ++k) {
        const glm::dvec3 eye(100 * k - 9000, 37 * k - 4000, 1500);
        const glm::dvec3 way(std::sin(k), std::cos(k), -0.2), straight(0, 0, k % 2 ? -1 : 1);
        EXPECT_EQ(castPlain(ground, eye, way, 0).t, castPlain(ground, eye, way, 0, {{7, 8}, 0}).t);
        const EarthBend bend{glm::dvec2(eye), 1e-4};
        EXPECT_EQ(castPlain(ground, eye, straight, 0).t, castPlain(ground, eye, straight, 0, bend).t);
    }
}

// From the water's surface nothing of it is seen, and from under it rays come up where the model says.
TEST(EarthBend, EyesInTheSeaAndUnderIt) {
    const Heightfield sea = groundOf(65, 65, glm::dvec2(2000), [](int, int) { return 0.0; });
    const EarthBend bend{{0, 0}, kUsualFall};
    EXPECT_FALSE(std::isfinite(castPlain(sea, {0, 0, 0}, {1, 0, 0}, 1, bend).t));
    EXPECT_FALSE(std::isfinite(castPlain(sea, {0, 0, 0}, {0.6, 0.8, 1e-3}, 1, bend).t));
    EXPECT_NEAR(castPlain(sea, {0, 0, 0}, {0.6, 0.8, -1e-3}, 1, bend).t, 1e-3 / kUsualFall, 1e-3);
    EXPECT_NEAR(castPlain(sea, {0, 0, -100}, {0, 1, 0}, 1, bend).t, std::sqrt(100 / kUsualFall), 1e-3);
    EXPECT_FALSE(std::isfinite(castPlain(sea, {0, 0, 100}, {0, 1, 0}, 1, bend).t));
    const glm::dvec3 nowhere(std::nan(""), 0, 100);
    EXPECT_FALSE(std::isfinite(castPlain(sea, nowhere, {0, 1, -1}, 1, bend).t));
}

// Over a sea at height 0 the horizon of an eye at h lies at sqrt(h / fall), 2 sqrt(h fall) below level. The
// row of a picture that shows it, and its depths, by every instruction set.
TEST(EarthBend, TheSeaEndsAtItsHorizon) {
    const TerrainScene scene =
        test::makeScene(groundOf(129, 129, glm::dvec2(20e3), [](int, int) { return 0.0; }));
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        for (const double height : {1.0, 100.0, 8000.0, 1e5})
            for (const double fall : {kUsualFall, curvatureFall(0)}) {
                const double dip = 2 * std::sqrt(height * fall), away = std::sqrt(height / fall);
                const Lens lens{9, 301, 3 * dip, 1.0, 0.01 * height, fall};
                const Pose pose = poseFromAngles({50, -90, height}, 0.7, 0, 0);
                const EyeView view = makeStereoViews(pose, lens, {0.02 * height, height}).left;
                const EyeImage image = test::castEye(renderer, view);
                for (int y = 0; y < view.height; ++y) {
                    const glm::dvec3 ray = view.rayDirection(4.5, y + 0.5);
                    const double run = std::hypot(ray.x, ray.y), slope = ray.z / run;
                    const double root = slope * slope - 4 * fall * height;
                    // An eye beside the head sees the sea turned by 1e-8; a row is 1e-2 of the dip.
                    if (std::abs(slope + dip) < 1e-3 * dip) continue;
                    const double want = slope < -dip ? 2 * height / (std::sqrt(root) - slope) / run
                                                     : std::numeric_limits<double>::infinity();
                    const double got = image.viewDepth.at(4, y);
                    ASSERT_EQ(std::isfinite(want), std::isfinite(got)) << height << " row " << y;
                    if (!std::isfinite(want)) continue;
                    ASSERT_NEAR(got / want, 1, 1e-3) << height << " row " << y;
                    ASSERT_LE(got * run, away * (1 + 1e-3));
                }
            }
    }
}

// What the viewshed calls seen is hit by the ray to where it is seen, and what it calls hidden is not.
TEST(EarthBend, PicturesShowWhatTheViewshedSees) {
    const Heightfield ground = groundOf(130, 130, {1000, 900}, [](int i, int j) {
        return 60 * std::sin(0.31 * i + 0.1 * j) * std::cos(0.23 * j) + 8 * std::sin(2.1 * i + j);
    });
    for (const glm::dvec2 eye : {glm::dvec2(2, 3), glm::dvec2(64, 71)})
        for (const double up : {100.0, 900.0}) {
            ViewshedSetting setting;
            setting.eye = eye;
            setting.eyeHeight = up;
            setting.fall = kUsualFall;
            Progress progress;
            const Viewshed shed = viewshedOf(ground, setting, progress);
            const glm::dvec2 below = ground.worldFromGrid(eye);
            const glm::dvec3 from(below, ground.heightAt(below) + up);
            const EarthBend bend{below, kUsualFall};
            int seen = 0, hidden = 0, level = 0, wrong = 0;
            for (int j = 0; j < ground.height(); ++j)
                for (int i = 0; i < ground.width(); ++i) {
                    const glm::dvec2 place = ground.worldFromGrid({i, j});
                    if (place == below) continue;
                    const glm::dvec3 at(place, ground.sample(i, j)), way = bend.apparent(at) - from;
                    const bool isSeen = shed.seen.at(i, j) == static_cast<std::uint8_t>(Seen::Visible);
                    const bool hit = castPlain(ground, from, way, 0, bend).t > 1 - 1e-7;
                    ++(isSeen ? seen : hidden);
                    wrong += isSeen != hit;
                    level += isSeen != (castPlain(ground, from, at - from, 0).t > 1 - 1e-7);
                }
            EXPECT_EQ(wrong, 0) << eye.x << " " << up;
            EXPECT_GT(seen, 50);
            EXPECT_GT(hidden, 50);
            EXPECT_GT(level, 20) << "a level Earth would do";
        }
}

struct BendTally {
    long long pixels = 0, wrong = 0, met = 0;
    std::string first;
    void add(double want, double got, double tolerance, int k) {
        ++pixels;
        met += std::isfinite(want);
        if (std::isfinite(want) ? std::abs(got - want) <= tolerance * want : !std::isfinite(got)) return;
        if (wrong++ == 0)
            first = "view " + std::to_string(k) + " expected " + std::to_string(want) + " got " +
                    std::to_string(got);
    }
};

// Level, pitched, straight up and down, and rolled, near the ground and high over it, over it and beside it;
// eyes far from the head.
EyeView someView(const Heightfield& ground, std::mt19937& random, int k, double fall, double over = 0.01) {
    std::uniform_real_distribution<double> unit(0, 1);
    const glm::dvec2 extent = ground.spacing() * glm::dvec2(ground.width() - 1, ground.height() - 1);
    const glm::dvec2 world =
        (glm::dvec2(unit(random), unit(random)) - 0.5) * extent * (k % 8 == 7 ? 1.6 : 0.98);
    const double height = ground.heightAt(world);
    const glm::dvec3 eye(world, (std::isfinite(height) ? height : 500) + 2 +
                                    (k % 4 == 3 ? 0.2 : over) * extent.x * unit(random) * unit(random));
    const double heading = 7 * unit(random),
                 pitch = k % 3 == 0     ? 0
                         : k % 11 == 10 ? (k % 2 ? 0.5 : -0.5) * std::numbers::pi
                                        : 0.1 - 0.8 * unit(random),
                 roll = k % 5 == 4 ? 7 * unit(random) : 0;
    const Lens lens{40, 30, 0.2 + unit(random), 1.0, 0.1, fall};
    for (double raised = 0;; raised += 0.002 * extent.x) {
        const Pose pose = poseFromAngles(eye + glm::dvec3(0, 0, raised), heading, pitch, roll);
        const StereoViews views = makeStereoViews(pose, lens, {0.001 * extent.x, 0.1 * extent.x});
        const EyeView& view = k % 2 ? views.left : views.right;
        if (!(view.eye.z < ground.heightAt(glm::dvec2(view.eye)) + 1)) return view;
    }
}

// Half of the pixels again, as holes of a picture that knows the rest.
EyeImage castTwice(const TerrainRenderer& renderer, const EyeView& view, std::mt19937& random,
                   EyeImage& image) {
    image = test::castEye(renderer, view);
    EyeImage again = image;
    std::vector<PixelIndex> holes;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            if (random() % 2) holes.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    for (const PixelIndex p : holes) again.viewDepth.at(p.x, p.y) = 0;
    renderer.renderPixels(view, {0, 0, view.width, view.height}, holes, again);
    return again;
}

class BentCaster : public testing::TestWithParam<std::string> {};

// The ground sinks by metres to kilometres from one end to the other.
TEST_P(BentCaster, HitsWhatThePlainWalkHits) {
    const TerrainScene scene = test::makeScene(test::makeGround(GetParam(), 97, 83, 7));
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        std::mt19937 random(31);
        BendTally tally;
        for (int k = 0; k < 80; ++k) {
            const double fall[] = {kUsualFall, 1e-5, 1e-4, 1e-3};
            const EyeView view = someView(scene.ground, random, k, fall[(k / 4) % 4]);
            EyeImage image;
            const EyeImage again = castTwice(renderer, view, random, image);
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const double want = castPlain(scene.ground, view.eye, view.rayDirection(x + 0.5, y + 0.5),
                                                  view.nearDepth, view.bend())
                                            .t;
                    tally.add(want, image.viewDepth.at(x, y), 2e-6, k);
                    tally.add(want, again.viewDepth.at(x, y), 2e-6, k);
                }
        }
        std::printf("[          ] target %d: %lld pixels, %lld met, %lld wrong\n", static_cast<int>(target),
                    tally.pixels, tally.met, tally.wrong);
        EXPECT_GT(tally.met, tally.pixels / 10);
        // Beside the ground a ray may pass its very border, and on a spike the near plane may lie in the
        // rock.
        EXPECT_LE(tally.wrong, tally.pixels / 10000) << tally.first;
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BentCaster, testing::ValuesIn(test::groundKinds()),
                         [](const auto& kind) { return kind.param; });

// 2,000 km, which sink by 68 km to 270 km; also of two samples a side.
TEST(EarthBend, HugeGroundIsCastAsThePlainWalkHasIt) {
    for (const int side : {2, 200}) {
        const TerrainScene scene = test::makeScene(wavyGround(side, 2e6 / (side - 1)));
        for (const SimdTarget target : simdTargets()) {
            const TerrainRenderer renderer(scene, target);
            std::mt19937 random(3);
            BendTally tally;
            for (int k = 0; k < 24; ++k) {
                const EyeView view = someView(scene.ground, random, k, kUsualFall);
                EyeImage image;
                castTwice(renderer, view, random, image);
                for (int y = 0; y < view.height; ++y)
                    for (int x = 0; x < view.width; ++x)
                        tally.add(castPlain(scene.ground, view.eye, view.rayDirection(x + 0.5, y + 0.5),
                                            view.nearDepth, view.bend())
                                      .t,
                                  image.viewDepth.at(x, y), 2e-6, k);
            }
            EXPECT_GT(tally.met, tally.pixels / 10);
            EXPECT_LE(tally.wrong, tally.pixels / 100000) << tally.first;
        }
    }
}

// From ring to ring the bend goes on around the same place.
TEST(EarthBend, RingsAreCastAsThePlainWalkHasThem) {
    const TerrainScene scene = test::makeScene(wavyGround(1100, 90, 12));
    for (const SimdTarget target : simdTargets()) {
        TerrainRenderer renderer(scene, target);
        renderer.takeCoarser(3);
        std::mt19937 random(3);
        BendTally tally;
        long long beyond = 0;
        for (int k = 0; k < 16; ++k) {
            const EyeView view = someView(scene.ground, random, k, k % 2 ? kUsualFall : 1e-6, 0.1);
            renderer.lookFrom(view);
            if (!renderer.rings()) continue;
            EyeImage image;
            const EyeImage again = castTwice(renderer, view, random, image);
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const RingHit hit =
                        castPlainRings(*renderer.rings(), view.eye, view.rayDirection(x + 0.5, y + 0.5),
                                       view.nearDepth, view.bend());
                    beyond += hit.ring > 0 && std::isfinite(hit.hit.t);
                    tally.add(hit.hit.t, image.viewDepth.at(x, y), 2e-6, k);
                    tally.add(hit.hit.t, again.viewDepth.at(x, y), 2e-6, k);
                }
        }
        EXPECT_GT(beyond, 500);
        EXPECT_LE(tally.wrong, tally.pixels / 20000) << tally.first;
    }
}

// What is painted on the ground asks for the ground's own places and heights.
TEST(EarthBend, PaintersSeeTheGroundItself) {
    const TerrainScene scene = test::makeScene(wavyGround(120, 1000));
    const TerrainRenderer renderer(scene);
    const Pose pose = poseFromAngles({-4e4, -4e4, 3500}, 0.8, -0.03, 0);
    const Lens lens{160, 100, 0.3, 1.0, 1.0, kUsualFall};
    const EyeView view = makeStereoViews(pose, lens, {300, 3e4}).right;
    const EyeImage image = test::castEye(renderer, view);
    const GroundView painted(scene.ground, view);
    int seen = 0, far = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const float depth = image.viewDepth.at(x, y);
            GroundSeen at;
            if (!std::isfinite(depth) || !painted.at(x, y, depth, at)) continue;
            ++seen;
            far += depth > 5e4f;
            ASSERT_NEAR(at.place.z, scene.ground.heightAt(glm::dvec2(at.place)), 1e-3) << x << "," << y;
            ASSERT_NEAR(at.depth / static_cast<double>(depth), 1, 1e-5) << x << "," << y;
            const glm::dvec3 back = view.project(view.bend().apparent(at.place));
            ASSERT_NEAR(back.x, x + 0.5, 1e-3);
            ASSERT_NEAR(back.y, y + 0.5, 1e-3);
        }
    EXPECT_GT(seen, 3000);
    EXPECT_GT(far, 500);
}

// A line over the plan is drawn where its ground is seen: nowhere else, and all along it.
TEST(EarthBend, TracksLieOnTheGroundThatIsSeen) {
    const TerrainScene scene = test::makeScene(groundOf(120, 120, glm::dvec2(1000), [](int i, int j) {
        return 200 + 30 * std::sin(0.3 * i) + 30 * std::cos(0.2 * j);
    }));
    const TerrainRenderer renderer(scene);
    const Fog fog;
    const glm::dvec2 from(-8000, 1e4), to(9000, 1.2e4);
    const Lens lens{300, 160, 0.12, 1.0, 1.0, kUsualFall};
    const EyeView view = makeEyeView(poseFromAngles({0, -5.5e4, 4000}, 0, -0.065, 0), lens);
    const EyeImage image = test::castEye(renderer, view);
    EyeImage drawn = image;
    TrackPainter(scene.ground, fog, {{from, to}}, {}).paint(view, drawn);
    int columns = 0;
    for (int x = 0; x < view.width; ++x) {
        bool any = false;
        for (int y = 0; y < view.height; ++y) {
            if (image.color.at(x, y) == drawn.color.at(x, y)) continue;
            any = true;
            const glm::dvec2 place(view.pointAt(x + 0.5, y + 0.5, image.viewDepth.at(x, y)));
            const double share = (place.x - from.x) / (to.x - from.x);
            const glm::dvec2 on = from + share * (to - from);
            const glm::dvec3 seen = view.project(view.bend().apparent({on, scene.ground.heightAt(on)}));
            ASSERT_LT(std::abs(seen.y - (y + 0.5)), 3.5) << x << "," << y;
        }
        columns += any;
    }
    EXPECT_GT(columns, 150);
}

// The air is that on the way to the place itself, not to where it is seen: by kernels and painters alike.
TEST(EarthBend, AirIsThatUpToThePlace) {
    TerrainScene scene = test::makeScene(groundOf(120, 120, glm::dvec2(2000), [](int, int) { return 20.0; }));
    const Lens lens{64, 48, 0.2, 1.0, 1.0, kUsualFall};
    const EyeView view = makeEyeView(poseFromAngles({0, -1.1e5, 9000}, 0, -0.12, 0), lens);
    const auto cast = [&](SimdTarget target) { return test::castEye(TerrainRenderer(scene, target), view); };
    const EyeImage clear = cast(SimdTarget::Plain);
    scene.look.physicalSky = true;
    const Fog fog(scene.look);
    for (const SimdTarget target : simdTargets()) {
        const EyeImage aired = cast(target);
        double off = 0, offStraight = 0;
        int pixels = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const double depth = aired.viewDepth.at(x, y);
                if (!std::isfinite(depth) || depth < 1e5) continue;
                ++pixels;
                const glm::vec3 base = unpackColor(clear.color.at(x, y));
                const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
                const auto against = [&](const glm::dvec3& way) {
                    return glm::length(unpackColor(aired.color.at(x, y)) -
                                       fog.seen(base, view.eye, way, depth));
                };
                off = std::max<double>(off, against(view.bend().wayToPlace(view.eye, ray, depth)));
                offStraight = std::max<double>(offStraight, against(ray));
            }
        EXPECT_GT(pixels, 100);
        EXPECT_LT(off, 0.003);
        EXPECT_GT(offStraight, 0.01);
    }
}

// A slope with one line of height: where it is drawn, the ground is as high as that.
TEST(EarthBend, ContoursLieAtTheirHeights) {
    const TerrainScene scene =
        test::makeScene(groundOf(120, 120, glm::dvec2(1000), [](int, int j) { return 20.0 * j; }));
    const TerrainRenderer renderer(scene);
    const Fog fog;
    for (const double fall : {0.0, kUsualFall}) {
        const Lens lens{60, 200, 0.5, 1.0, 1.0, fall};
        const EyeView view = makeEyeView(poseFromAngles({0, -5.5e4, 4000}, 0, -0.2, 0), lens);
        const EyeImage image = test::castEye(renderer, view);
        EyeImage lined = image;
        ContourPainter(scene.ground, fog, {500, 1}).paint(view, lined);
        int inked = 0;
        for (int y = 0; y < view.height; ++y) {
            if (image.color.at(30, y) == lined.color.at(30, y)) continue;
            ++inked;
            const auto heightOf = [&](int row) {
                const double depth = image.viewDepth.at(30, row);
                return scene.ground.heightAt(glm::dvec2(view.pointAt(30.5, row + 0.5, depth)));
            };
            const double height = heightOf(y), line = 500 * std::round(height / 500);
            ASSERT_LE(std::abs(height - line), 2 * std::abs(heightOf(y + 1) - height))
                << fall << " row " << y;
        }
        EXPECT_GE(inked, 4) << fall;
    }
}

}  // namespace
}  // namespace stereonav
