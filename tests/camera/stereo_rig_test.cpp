// Two eyes: the shift law against projecting the same point twice, and what is refused.
#include "engine/camera/stereo_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/base/error.h"

namespace stereonav {
namespace {

Lens someLens() {
    Lens lens;
    lens.width = 1280;
    lens.height = 720;
    return lens;
}

std::string messageOf(const Lens& lens, const StereoSetting& setting) {
    try {
        makeStereoViews({}, lens, setting);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(StereoRig, ShiftLawIsTheProjectionOfTheSamePoint) {
    const StereoSetting setting{6.5, 195};
    const StereoViews views = makeStereoViews(poseFromAngles({5, 6, 700}, 2, -0.4, 0.3), someLens(), setting);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> x(0, 1280), y(0, 720), depth(1, 20000);
    for (int k = 0; k < 1000; ++k) {
        const double column = x(random), row = y(random), z = depth(random);
        const glm::dvec3 seen = views.right.project(views.left.pointAt(column, row, z));
        ASSERT_NEAR(seen.x, views.rightColumn(column, z), 1e-6);
        ASSERT_NEAR(seen.y, row, 1e-6);
        ASSERT_NEAR(seen.z, z, 1e-9 * z);
    }
}

TEST(StereoRig, NoParallaxAtTheZeroParallaxDistance) {
    const StereoViews views = makeStereoViews({}, someLens(), {0.065, 1.95});
    EXPECT_NEAR(views.rightColumn(321.5, 1.95), 321.5, 1e-9);
    EXPECT_LT(views.rightColumn(321.5, 1.0), 321.5);   // nearer: crossed, to the left
    EXPECT_GT(views.rightColumn(321.5, 10.0), 321.5);  // farther: to the right
    EXPECT_NEAR(views.rightColumn(0, 1e15), views.shiftAtInfinity, 1e-9);
}

TEST(StereoRig, TheEyesStandSideBySideAroundTheHead) {
    const Pose head = poseFromAngles({10, 20, 30}, 1, 0.2, 0);
    const StereoViews views = makeStereoViews(head, someLens(), {2, 60});
    EXPECT_LT(glm::distance(0.5 * (views.left.eye + views.right.eye), head.position), 1e-12);
    EXPECT_LT(glm::distance(views.right.eye - views.left.eye, 2.0 * head.right()), 1e-12);
    EXPECT_EQ(views.left.forward, views.right.forward);
}

TEST(StereoRig, NoSeparationGivesTheSameEyeTwice) {
    const StereoViews views = makeStereoViews({}, someLens(), {0, 1});
    EXPECT_EQ(views.left.eye, views.right.eye);
    EXPECT_EQ(views.left.xMin, views.right.xMin);
    EXPECT_EQ(views.parallaxScale, 0);
}

TEST(StereoRig, WindowHasTheLensAngle) {
    Lens lens = someLens();
    lens.verticalFov = std::numbers::pi / 2;
    lens.pixelAspect = 2;
    const EyeView view = makeEyeView({}, lens);
    EXPECT_NEAR(view.yMax, 1, 1e-12);
    EXPECT_NEAR(view.pixelWidth() / view.pixelHeight(), 2, 1e-12);
}

TEST(StereoRig, RefusesWhatIsOutOfRange) {
    using testing::HasSubstr;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const int side : {0, -1, 100000}) {
        Lens lens = someLens();
        lens.width = side;
        EXPECT_THAT(messageOf(lens, {}), HasSubstr("expected 1 to 32768 pixels a side"));
    }
    for (const double fov : {0.0, std::numbers::pi, nan}) {
        Lens lens = someLens();
        lens.verticalFov = fov;
        EXPECT_THAT(messageOf(lens, {}), HasSubstr("field of view"));
    }
    for (const double separation : {-1.0, nan})
        EXPECT_THAT(messageOf(someLens(), {separation, 1}), HasSubstr("eye separation"));
    for (const double distance : {0.0, -1.0, nan})
        EXPECT_THAT(messageOf(someLens(), {1, distance}), HasSubstr("zero-parallax distance"));
}

}  // namespace
}  // namespace stereonav
