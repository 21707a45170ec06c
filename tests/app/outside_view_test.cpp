// The first view of objects that are seen from outside.
#include "app/scene/type/outside_view.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <stdexcept>

namespace stereonav {
namespace {

// A scene of which only the view is asked for.
class ViewedScene final : public Scene {
public:
    FrameMaker& frames() const override { throw std::logic_error("has no frames"); }
    std::unique_ptr<Flight> makeFlight() const override { return nullptr; }
};

std::vector<SurfaceSample> seenCornersOf(double size, const glm::dvec3& middle) {
    std::vector<SurfaceSample> samples;
    for (int n = 0; n < 8; ++n)
        samples.push_back({middle + size * (glm::dvec3(n & 1, n >> 1 & 1, n >> 2) - 0.5), {}});
    return samples;
}

// Returns the distance of the first view from the middle.
double firstDistanceTo(const std::vector<SurfaceSample>& samples, const glm::dvec3& middle) {
    ViewedScene scene;
    EXPECT_TRUE(seeFromBestSide(samples, {}, SeenAs::Outside, "flight", scene));
    EXPECT_GT(scene.lens.nearDepth, 0);
    return glm::length(scene.startPose.position - middle);
}

TEST(OutsideView, AnObjectOfAnySizeFillsThePicture) {
    const double usual = firstDistanceTo(seenCornersOf(1, {}), {});
    EXPECT_GT(usual, 1);
    EXPECT_LT(usual, 6);
    for (const double size : {1e-30, 1e-12, 1e-7, 1e8})
        EXPECT_NEAR(firstDistanceTo(seenCornersOf(size, {}), {}) / size, usual, 1e-3 * usual) << size;
}

TEST(OutsideView, WhatFloatsTakeForAPointIsSeenAsOne) {
    const glm::dvec3 at(1000, -2000, 3000);
    const double point = firstDistanceTo({{at, {}}}, at);
    EXPECT_GT(point, 1e-3);
    EXPECT_LT(point, 1);
    EXPECT_NEAR(firstDistanceTo(seenCornersOf(1e-9, at), at), point, 0.7 * point);
    EXPECT_GT(firstDistanceTo({{glm::dvec3(0.0), {}}}, {}), 1e-6);
}

}  // namespace
}  // namespace stereonav
