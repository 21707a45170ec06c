// One eye's projection: pixel conventions, and projecting what a ray hits.
#include "engine/camera/eye_view.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "engine/camera/stereo_rig.h"

namespace stereonav {
namespace {

EyeView someView() {
    Lens lens;
    lens.width = 640;
    lens.height = 480;
    return makeEyeView(poseFromAngles({100, -50, 7}, 0.9, -0.3, 0.2), lens);
}

TEST(EyeView, ProjectUndoesPointAt) {
    const EyeView view = someView();
    std::mt19937 random(2);
    std::uniform_real_distribution<double> x(-50, 700), y(-50, 500), depth(0.1, 5000);
    for (int k = 0; k < 1000; ++k) {
        const glm::dvec3 expected(x(random), y(random), depth(random));
        const glm::dvec3 found = view.project(view.pointAt(expected.x, expected.y, expected.z));
        ASSERT_NEAR(found.x, expected.x, 1e-6);
        ASSERT_NEAR(found.y, expected.y, 1e-6);
        ASSERT_NEAR(found.z, expected.z, 1e-12 * (expected.z + 200));
    }
}

TEST(EyeView, RaysHaveUnitLengthAlongTheViewAxis) {
    const EyeView view = someView();
    for (const double x : {0.0, 13.5, 640.0})
        for (const double y : {0.0, 200.25, 480.0})
            EXPECT_NEAR(glm::dot(view.rayDirection(x, y), view.forward), 1, 1e-14);
}

TEST(EyeView, CornersAreTheWindowAndYIsDown) {
    EyeView view;
    view.xMin = -2, view.xMax = 1, view.yMin = -0.5, view.yMax = 0.75;
    view.width = 300, view.height = 125;
    const glm::dvec3 topLeft = view.rayDirection(0, 0), bottomRight = view.rayDirection(300, 125);
    EXPECT_NEAR(topLeft.x, -2, 1e-14);
    EXPECT_NEAR(topLeft.y, 0.75, 1e-14);
    EXPECT_NEAR(bottomRight.x, 1, 1e-14);
    EXPECT_NEAR(bottomRight.y, -0.5, 1e-14);
    EXPECT_NEAR(view.pixelWidth(), 0.01, 1e-15);
    EXPECT_NEAR(view.pixelHeight(), 0.01, 1e-15);
}

TEST(EyeView, SupersampledSeesTheSameWindow) {
    const EyeView view = someView(), fine = view.supersampled(4);
    EXPECT_EQ(fine.width, 4 * view.width);
    EXPECT_EQ(fine.height, 4 * view.height);
    EXPECT_LT(glm::distance(view.rayDirection(10.25, 20.5), fine.rayDirection(41, 82)), 1e-12);
}

}  // namespace
}  // namespace stereonav
