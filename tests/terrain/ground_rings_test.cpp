// Levels of detail: bounds that hold, rings that keep to them, and the caster against the plain walk over
// rings.
#include "terrain/ground/ground_rings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/camera/stereo_rig.h"
#include "engine/simd/simd_target.h"
#include "terrain/cast/terrain_renderer.h"
#include "tests/oracle/plain_rings.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

// Rough at all scales, 30 m between samples; odd sizes, so that levels end before the ground does.
Heightfield roughGround(int width, int height, double holes = 0) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<float> heights(static_cast<std::size_t>(width) * height);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            double h = 20 * unit(random);
            for (const double wave : {7.0, 31.0, 120.0})
                h += 0.9 * wave * std::sin(i / wave * 3 + wave) * std::cos(j / wave * 2.6);
            heights[static_cast<std::size_t>(j) * width + i] =
                unit(random) < holes ? std::nanf("") : static_cast<float>(h);
        }
    return Heightfield(width, height, {30, 24}, std::move(heights), "rough");
}

TEST(GroundLevels, BoundsHoldAtEverySampleAndBetween) {
    for (const double holes : {0.0, 0.002}) {
        const Heightfield ground = roughGround(531, 402, holes);
        const GroundLevels levels(ground);
        ASSERT_EQ(levels.count(), 3);
        std::mt19937 random(1);
        for (int level = 1; level < levels.count(); ++level) {
            const Heightfield coarse = levels.part(level, glm::ivec2(0), levels.size(level)).value();
            double closest = 1;
            for (int k = 0; k < 20000; ++k) {
                std::uniform_real_distribution<double> x(0, coarse.width() - 1), y(0, coarse.height() - 1);
                glm::dvec2 grid(x(random), y(random));
                if (k % 2 == 0) grid = glm::floor(grid * double(1 << level)) / double(1 << level);
                const glm::dvec2 world = coarse.worldFromGrid(grid);
                const double off = std::abs(coarse.heightAt(world) - ground.heightAt(world));
                if (std::isnan(off)) continue;
                const glm::ivec2 block =
                    glm::min(glm::ivec2(grid) / GroundLevels::kBlock, levels.blocks(level) - 1);
                const double bound = levels.errorBound(level, block.x, block.y);
                ASSERT_LE(off, bound) << level << " at " << grid.x << "," << grid.y;
                closest = std::min(closest, 1 - off / bound);
            }
            EXPECT_LT(closest, 0.5) << "a bound that is nowhere near says nothing";
        }
    }
}

TEST(GroundLevels, OfAPlaneAreThePlane) {
    std::vector<float> heights;
    for (int j = 0; j < 300; ++j)
        for (int i = 0; i < 300; ++i) heights.push_back(static_cast<float>(2 * i - j));
    const Heightfield ground(300, 300, {10, 10}, std::move(heights), "plane");
    const GroundLevels levels(ground);
    // All but the border, where there is nothing beyond to average with.
    EXPECT_EQ(levels.part(1, {64, 64}, {64, 64})->sample(3, 7), ground.sample(134, 142));
    EXPECT_NEAR(levels.errorBound(1), 2.0 / 3, 1e-4) << "at the west border two samples of three count";
}

double worstShare(const Heightfield& ground, const GroundLevels& levels, const std::vector<RingBox>& boxes,
                  const RingWish& wish) {
    double worst = 0;
    std::mt19937 random(2);
    for (int k = 0; k < 1500; ++k) {
        std::uniform_real_distribution<double> x(0, ground.width() - 1), y(0, ground.height() - 1);
        const glm::dvec2 grid(x(random), y(random));
        for (const RingBox& box : boxes) {
            const glm::dvec2 at = grid / double(1 << box.level) - glm::dvec2(box.low);
            if (at.x < 0 || at.y < 0 || at.x > box.size.x - 1 || at.y > box.size.y - 1) continue;
            const auto part = levels.part(
                box.level, box.low + glm::ivec2(glm::min(at, glm::dvec2(box.size - 2))), glm::ivec2(2));
            const glm::dvec2 world = ground.worldFromGrid(grid);
            const double off = std::abs(part.value().heightAt(world) - ground.heightAt(world));
            const double away = glm::distance(glm::dvec3(world, ground.heightAt(world)), wish.eye);
            worst = std::max(worst, off / (wish.pixelAngle * away));
            break;
        }
    }
    return worst;
}

TEST(GroundRings, KeepToTheShareOfAPixel) {
    const Heightfield ground = roughGround(1537, 1281);
    const GroundLevels levels(ground);
    std::size_t most = 0;
    for (const double share : {0.5, 2.0})
        for (const glm::dvec3 eye : {glm::dvec3(0, 0, 300), glm::dvec3(29000, -17000, 250),
                                     glm::dvec3(3000, 900, 40000), glm::dvec3(-60000, 0, 2000)}) {
            const RingWish wish{eye, 0.02, share};
            const std::vector<RingBox> boxes = planRings(levels, wish);
            ASSERT_FALSE(boxes.empty());
            EXPECT_LE(worstShare(ground, levels, boxes, wish), share) << eye.x << " " << eye.z;
            for (std::size_t n = 0; n + 1 < boxes.size(); ++n) EXPECT_LT(boxes[n].level, boxes[n + 1].level);
            EXPECT_EQ(boxes.back().size, levels.size(boxes.back().level)) << "the last is whole";
            most = std::max(most, boxes.size());
        }
    EXPECT_GE(most, 3u);
    const std::vector<RingBox> exact = planRings(levels, {{0, 0, 300}, 0.02, 0});
    EXPECT_EQ(exact, (std::vector<RingBox>{{0, {0, 0}, {1537, 1281}}}));
}

TEST(GroundRings, AreKeptWhereTheyStay) {
    const Heightfield ground = roughGround(1537, 1281);
    const GroundLevels levels(ground);
    const auto first = makeRings(levels, planRings(levels, {{0, 0, 300}, 0.02, 2}), nullptr);
    const auto second = makeRings(levels, planRings(levels, {{9500, 0, 300}, 0.02, 2}), first.get());
    ASSERT_GE(first->rings.size(), 2u);
    EXPECT_EQ(first->rings.back(), second->rings.back());
    EXPECT_NE(first->rings.front(), second->rings.front());
}

// What is around one eye alone would leave the other one outside: rays begin inside all rings but the last.
TEST(GroundRings, HoldBothEyes) {
    const TerrainScene scene = test::makeScene(roughGround(1400, 1201));
    TerrainRenderer renderer(scene);
    renderer.takeCoarser(1);
    const Lens lens{40, 30, 1.1, 1.0, 0.1};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    int apart = 0, nested = 0;
    long long wrong = 0;
    for (int k = 0; k < 24; ++k) {
        const glm::dvec2 place = (glm::dvec2(unit(random), unit(random)) - 0.5) * 26000.,
                         aside = 7000 * unit(random) * glm::dvec2(std::cos(k), std::sin(k));
        const double height = 60 + 500 * unit(random);
        const auto viewAt = [&](const glm::dvec2& at) {
            return makeEyeView(poseFromAngles({at, scene.ground.heightAt(at) + height}, k, -0.2, 0), lens);
        };
        const EyeView left = viewAt(place), right = viewAt(place + aside);
        renderer.lookFrom(left);
        const auto alone = renderer.rings() ? renderer.rings()->rings.front()->ground : scene.ground;
        apart += !alone.contains(glm::dvec2(right.eye));
        renderer.lookFrom(left, right);
        if (!renderer.rings()) continue;
        nested += renderer.rings()->rings.size() > 1;
        for (std::size_t n = 0; n + 1 < renderer.rings()->rings.size(); ++n)
            for (const EyeView* const view : {&left, &right})
                EXPECT_TRUE(renderer.rings()->rings[n]->ground.contains(glm::dvec2(view->eye))) << k;
        for (const EyeView* const view : {&left, &right}) {
            EyeImage image;
            image.resize(view->width, view->height);
            renderEye(renderer, *view, image);
            for (int y = 0; y < view->height; ++y)
                for (int x = 0; x < view->width; ++x) {
                    const double got = image.viewDepth.at(x, y),
                                 want = castPlainRings(*renderer.rings(), view->eye,
                                                       view->rayDirection(x + 0.5, y + 0.5), view->nearDepth)
                                            .hit.t;
                    wrong += std::isfinite(want) ? std::abs(got - want) > 2e-6 * want : std::isfinite(got);
                }
        }
    }
    EXPECT_GT(apart, 5);
    EXPECT_GT(nested, 5);
    EXPECT_LE(wrong, 3);
}

class RingCaster : public testing::TestWithParam<bool> {};

// Level, pitched, rolled and straight views, from over and beside the ground, and holes.
TEST_P(RingCaster, HitsWhatThePlainWalkHits) {
    const TerrainScene scene = test::makeScene(roughGround(1400, 1201, GetParam() ? 0.0005 : 0));
    for (const SimdTarget target : simdTargets()) {
        TerrainRenderer renderer(scene, target);
        renderer.takeCoarser(1);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> unit(0, 1);
        long long pixels = 0, wrong = 0, beyond = 0;
        std::string first;
        for (int k = 0; k < 30; ++k) {
            const glm::dvec2 world =
                (glm::dvec2(unit(random), unit(random)) - 0.5) * (k % 10 == 9 ? 60000. : 34000.);
            const double height = scene.ground.heightAt(world);
            const glm::dvec3 eye(
                world, (std::isfinite(height) ? height : 300) + 2 + 3000 * unit(random) * unit(random));
            const double heading = 7 * unit(random), pitch = k % 3 == 0 ? 0 : -unit(random),
                         roll = k % 5 == 4 ? 7 * unit(random) : 0;
            const Lens lens{40, 30, 1.1, 1.0, 0.1};
            const EyeView view = makeEyeView(poseFromAngles(eye, heading, pitch, roll), lens);
            renderer.lookFrom(view);
            EyeImage image;
            image.resize(view.width, view.height);
            renderEye(renderer, view, image);
            if (!renderer.rings()) continue;
            // Half of them again, as pixels of holes.
            EyeImage again = image;
            std::vector<PixelIndex> holes;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x)
                    if (random() % 2)
                        holes.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
            for (const PixelIndex p : holes) again.viewDepth.at(p.x, p.y) = 0;
            renderer.renderPixels(view, {0, 0, view.width, view.height}, holes, again);
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const RingHit hit = castPlainRings(*renderer.rings(), view.eye,
                                                       view.rayDirection(x + 0.5, y + 0.5), view.nearDepth);
                    ++pixels;
                    beyond += hit.ring > 0 && std::isfinite(hit.hit.t);
                    for (const float got : {image.viewDepth.at(x, y), again.viewDepth.at(x, y)}) {
                        const double want = hit.hit.t;
                        if (std::isfinite(want) ? std::abs(got - want) <= 2e-6 * want : !std::isfinite(got))
                            continue;
                        if (wrong++ == 0)
                            first = "view " + std::to_string(k) + " pixel " + std::to_string(x) + "," +
                                    std::to_string(y) + " expected " + std::to_string(want) + " of ring " +
                                    std::to_string(hit.ring) + " got " + std::to_string(got);
                    }
                }
        }
        std::printf("[          ] target %d: %lld pixels, %lld beyond the first ring, %lld wrong\n",
                    static_cast<int>(target), pixels, beyond, wrong);
        EXPECT_GT(beyond, pixels / 50);
        EXPECT_LE(wrong, pixels / 20000) << first;
    }
}

INSTANTIATE_TEST_SUITE_P(Holes, RingCaster, testing::Bool());

// Rays that come to the coarser ground just at its surface: above or below by what single precision tells.
TEST(GroundRings, AreMetWhereOneEnds) {
    const TerrainScene scene = test::makeScene(roughGround(1400, 1201));
    for (const SimdTarget target : simdTargets()) {
        TerrainRenderer renderer(scene, target);
        renderer.takeCoarser(1);
        const Lens lens{1, 1, 0.003, 1.0, 0.1};
        const glm::dvec3 eye(500, -300, scene.ground.heightAt({500, -300}) + 900);
        renderer.lookFrom(makeEyeView(poseFromAngles(eye, 0, -0.3, 0), Lens{40, 30, 1.1, 1.0, 0.1}));
        ASSERT_GT(renderer.rings()->rings.size(), 1u);
        const GroundRing &inner = *renderer.rings()->rings[0], &outer = *renderer.rings()->rings[1];
        std::mt19937 random(8);
        std::uniform_real_distribution<double> along(0.05, 0.95), off(-1e-6, 1e-6);
        int tried = 0, lost = 0;
        for (int k = 0; k < 6000; ++k) {
            const glm::dvec2 size(inner.ground.width() - 1, inner.ground.height() - 1);
            const double u = along(random);
            const glm::dvec2 grid = k % 2 ? glm::dvec2(u * size.x, k % 4 == 1 ? 0 : size.y)
                                          : glm::dvec2(k % 4 == 0 ? 0 : size.x, u * size.y);
            const glm::dvec2 place = inner.ground.worldFromGrid(grid);
            const double away = glm::distance(eye, glm::dvec3(place, outer.ground.heightAt(place)));
            const glm::dvec3 aim(place, outer.ground.heightAt(place) + off(random) * away);
            const glm::dvec3 way = aim - eye;
            const EyeView view = makeEyeView(
                poseFromAngles(eye, std::atan2(way.x, way.y), std::atan2(way.z, std::hypot(way.x, way.y)), 0),
                lens);
            // The picture has the width that the rings were chosen for: one look is enough.
            EyeImage image;
            image.resize(1, 1);
            renderer.renderTile(view, 0, image);
            const RingHit hit =
                castPlainRings(*renderer.rings(), eye, view.rayDirection(0.5, 0.5), view.nearDepth);
            if (hit.ring == 0 || !std::isfinite(hit.hit.t)) continue;
            ++tried;
            lost += !(std::abs(image.viewDepth.at(0, 0) - hit.hit.t) <= 0.02 * hit.hit.t);
        }
        EXPECT_GT(tried, 1000);
        EXPECT_EQ(lost, 0) << "of " << tried << ", target " << static_cast<int>(target);
    }
}

}  // namespace
}  // namespace stereonav
