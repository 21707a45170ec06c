// Frames that are cast wider than they are shown: what comes into view is there, and no wider than it has to
// be.
#include "engine/late/late_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace stereonav {
namespace {

constexpr double kGuardDegree = 3.14159265358979323846 / 180;

Lens guardLens() {
    Lens lens;
    lens.width = 200;
    lens.height = 120;
    lens.verticalFov = 0.8;
    return lens;
}

StereoViews guardEyes(double heading, const Lens& lens, double ahead = 0) {
    return makeStereoViews(poseFromAngles({0, ahead, 10}, heading, 0.1, 0.05), lens, {0.5, 8});
}

// A wall all around that is so far away, in colours that tell where each of its points lies.
EyeImage castWall(const EyeView& view, float depth) {
    EyeImage image;
    image.resize(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::dvec3 d = glm::normalize(view.rayDirection(x + 0.5, y + 0.5));
            image.viewDepth.at(x, y) = depth;
            image.color.at(x, y) =
                packColor(glm::vec3(0.5) + 0.4f * glm::vec3(glm::sin(glm::dvec3(9.0, 7.0, 8.0) * d)));
        }
    return image;
}

int setIn(const Plane<std::uint8_t>& mask) {
    int count = 0;
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) count += mask.at(x, y) != 0;
    return count;
}

int largestApart(const Plane<PackedColor>& a, const Plane<PackedColor>& b) {
    int most = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int k = 0; k < 30; k += 10)
                most = std::max(most, std::abs(static_cast<int>(a.at(x, y) >> k & 1023u) -
                                               static_cast<int>(b.at(x, y) >> k & 1023u)));
    return most;
}

TEST(LateGuard, KeepsEachPixelOfBothEyesWhereItIs) {
    const Lens lens = guardLens();
    const glm::ivec2 guard(13, 7);
    const Lens wide = guarded(lens, guard);
    EXPECT_EQ(wide.width, lens.width + 26);
    EXPECT_EQ(wide.height, lens.height + 14);
    const StereoViews shown = guardEyes(0.3, lens), cast = guardEyes(0.3, wide);
    EXPECT_NEAR(cast.parallaxScale, shown.parallaxScale, 1e-9 * shown.parallaxScale);
    EXPECT_NEAR(cast.shiftAtInfinity, shown.shiftAtInfinity, 1e-9 * shown.shiftAtInfinity);
    for (const auto eye : {&StereoViews::left, &StereoViews::right})
        for (const double x : {0.0, 0.5, 77.0, 200.0})
            for (const double y : {0.0, 33.3, 120.0}) {
                const glm::dvec3 one = (shown.*eye).rayDirection(x, y),
                                 other = (cast.*eye).rayDirection(x + guard.x, y + guard.y);
                EXPECT_LT(glm::length(one - other), 1e-12) << x << " " << y;
            }
    const Lens same = guarded(lens, {0, 0});
    EXPECT_EQ(same.width, lens.width);
    EXPECT_EQ(same.verticalFov, lens.verticalFov);
}

// A turn of the guard's width: all of the new picture was cast, in either eye, and is what is seen there.
TEST(LateGuard, ATurnOfItsWidthUncoversNothing) {
    const Lens lens = guardLens();
    const glm::ivec2 guard(20, 12);
    for (const SimdTarget target : simdTargets())
        for (const auto eye : {&StereoViews::left, &StereoViews::right})
            for (const double side : {-1.0, 1.0}) {
                SCOPED_TRACE(testing::Message() << nameOf(target) << " " << side);
                const EyeView shown = guardEyes(0, lens).*eye, cast = guardEyes(0, guarded(lens, guard)).*eye;
                // The corner that moves farthest decides, since the axis of the turn leans by 0.11.
                const double turn = side * 4.5 * kGuardDegree;
                const EyeView to = guardEyes(turn, lens).*eye;
                const EyeImage wide = castWall(cast, kMissDepth), narrow = castWall(shown, kMissDepth);
                LateEye late;
                Plane<PackedColor> image;
                Plane<std::uint8_t> uncovered;
                late.prepare(narrow.viewDepth, shown, target);
                const glm::dvec2 beyond = seenBeyond(late, {0, 0}, to);
                EXPECT_LE(beyond.x * lens.width, guard.x);
                EXPECT_GT(beyond.x * lens.width, 0.8 * guard.x) << "the turn is as wide as the guard";
                EXPECT_LE(beyond.y * lens.height, guard.y);
                late.warp(narrow.color, to, image, &uncovered);
                EXPECT_GT(setIn(uncovered), 10 * lens.height) << "it is stretched without";
                late.prepare(wide.viewDepth, cast, target);
                const glm::dvec2 ofWide = seenBeyond(late, guard, to);
                EXPECT_NEAR(ofWide.x, beyond.x, 1e-4) << "the same, whatever was cast";
                late.warp(wide.color, to, image, &uncovered);
                EXPECT_EQ(setIn(uncovered), 0);
                EXPECT_LE(largestApart(image, castWall(to, kMissDepth).color), 3);
            }
}

// What is near moves more: backwards, so far that a guard is needed.
TEST(LateGuard, FollowsTheDepthsAtTheBorders) {
    const Lens lens = guardLens();
    const EyeView from = guardEyes(0, lens).left;
    for (const float depth : {2.0f, 10.0f, 100.0f}) {
        EyeView to = from;
        to.eye -= 0.2 * from.forward;
        LateEye late;
        late.prepare(castWall(from, depth).viewDepth, from);
        const glm::dvec2 beyond = seenBeyond(late, {0, 0}, to);
        // At the border it is seen as far out as there is between the two places.
        const double grows = 0.2 / static_cast<double>(depth);
        EXPECT_NEAR(beyond.y, 0.5 * grows, 0.03 * grows) << depth;
        to.eye = from.eye + 0.2 * from.forward;
        EXPECT_EQ(seenBeyond(late, {0, 0}, to).y, 0) << "ahead all of it is there";
    }
    EyeView behind = guardEyes(180 * kGuardDegree, lens).left;
    LateEye late;
    late.prepare(castWall(from, 5).viewDepth, from);
    EXPECT_EQ(seenBeyond(late, {0, 0}, behind), glm::dvec2(1.0));
}

TEST(GuardBand, GrowsAtOnceByStepsAndIsNothingAtRest) {
    GuardBand band;
    EXPECT_EQ(band.shares(), glm::dvec2(0.0));
    band.saw({0, 0}, 1);
    EXPECT_EQ(band.shares(), glm::dvec2(0.0)) << "what sees nothing beyond needs none";
    band.saw({0.031, 0.005}, 1.02);
    EXPECT_NEAR(band.shares().x, 2 * GuardBand::kStep, 1e-12) << "0.031 is more than a step";
    EXPECT_NEAR(band.shares().y, GuardBand::kStep, 1e-12);
    band.saw({0.9, 0.9}, 1.04);
    EXPECT_NEAR(band.shares().x, GuardBand::kMost, 1e-12) << "and no wider";
    band.forget();
    EXPECT_EQ(band.shares(), glm::dvec2(0.0));
}

// Frames whose sizes change cost memory and time: with noise in what is seen the guard keeps still.
TEST(GuardBand, KeepsStillAndShrinksSlowly) {
    GuardBand band;
    double now = 0;
    int changes = 0;
    glm::dvec2 before(0.0);
    const auto fly = [&](int pictures, auto beyond) {
        changes = 0;
        for (int n = 0; n < pictures; ++n) {
            band.saw(glm::dvec2(beyond(n)), now += 0.025);
            changes += band.shares() != before;
            before = band.shares();
        }
    };
    // Between none and 5 %, as frames are shown before and after the moment that they are cast for.
    const auto wavers = [](int n) { return 0.05 * std::abs(std::sin(1.7 * n)); };
    fly(20, wavers);
    EXPECT_LE(changes, 3);
    fly(200, wavers);
    EXPECT_EQ(changes, 0);
    EXPECT_NEAR(band.shares().x, 0.06, 1e-12);
    // One picture of many that lags far behind.
    fly(200, [&](int n) { return n % 30 == 7 ? 0.12 : wavers(n); });
    EXPECT_EQ(changes, 0);
    // The flight turns now and then.
    fly(400, [](int n) { return n % 80 < 30 ? 0.05 : 0.0; });
    EXPECT_EQ(changes, 0);
    fly(30, [](int) { return 0.0; });
    EXPECT_NEAR(band.shares().x, 0.06, 1e-12) << "it may begin again";
    fly(160, [](int) { return 0.0; });
    EXPECT_EQ(band.shares(), glm::dvec2(0.0));
    EXPECT_LE(changes, 1);
}

}  // namespace
}  // namespace stereonav
