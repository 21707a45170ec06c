// The generated colon: the same on any number of threads, with its axis in air, polyps that are flesh on the
// wall, and fluid under a level surface.
#include "colon/built_in/built_in_colon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

BuiltInColon small(std::uint64_t seed = 1) {
    Progress progress;
    return builtInColon({seed, {64, 64, 52}}, progress);
}
const BuiltInColon& medium() {
    static const BuiltInColon colon = [] {
        Progress progress;
        return builtInColon({1, {256, 256, 206}}, progress);
    }();
    return colon;
}

std::uint64_t hashOf(const GreyVolume& grey) {
    return Hash().add(grey.values.data(), grey.frame.count() * sizeof(std::int16_t)).value();
}

double greyAt(const GreyVolume& grey, const glm::dvec3& world) {
    const glm::dvec3 voxel = grey.frame.voxelFromWorld(world);
    const glm::ivec3 v = glm::clamp(glm::ivec3(glm::round(voxel)), glm::ivec3(0), grey.frame.size - 1);
    return grey.at(v);
}

TEST(BuiltInColon, IsTheSameOnAnyNumberOfThreads) {
    const int before = threadCount();
    setThreadCount(1);
    const std::uint64_t one = hashOf(small().grey);
    setThreadCount(2);
    const std::uint64_t two = hashOf(small().grey);
    setThreadCount(before);
    EXPECT_EQ(one, two);
    EXPECT_NE(hashOf(small(2).grey), one);
}

TEST(BuiltInColon, KeepsItsExtentAtAnySize) {
    const VolumeFrame a = small().grey.frame, b = medium().grey.frame;
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(a.spacing[axis] * a.size[axis], b.spacing[axis] * b.size[axis], 0.003);
        EXPECT_NEAR(a.spacing[axis] * a.size[axis], axis == 2 ? 0.3288 : 0.3584, 0.001);
    }
}

TEST(BuiltInColon, AxisRunsThroughAirOrFluidFromRectumToCaecum) {
    const std::vector<CentrelinePoint>& points = medium().axis.points;
    ASSERT_GT(points.size(), 1000u);
    EXPECT_NEAR(medium().axis.points.back().position.z, -0.06, 0.03);  // caecum: low on the right
    EXPECT_LT(points.back().position.x, -0.08);
    double length = 0;
    int flesh = 0;
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (n > 0) length += glm::length(points[n].position - points[n - 1].position);
        const double grey = greyAt(medium().grey, points[n].position);
        flesh += grey > -450 && grey < 250;
        EXPECT_LT(points[n].radius, 0.031) << n;
    }
    EXPECT_GE(length, 1.38);
    EXPECT_LE(length, 1.8);
    EXPECT_LE(flesh, static_cast<int>(points.size() / 50));  // polyps' heads and the fluid's surface
}

TEST(BuiltInColon, PolypsAreFleshOnTheWallBesideTheLumen) {
    const BuiltInColon& colon = medium();
    ASSERT_GE(colon.polyps.size(), 10u);
    double last = 0;
    int shapes[3] = {0, 0, 0};
    for (const Polyp& polyp : colon.polyps) {
        EXPECT_GT(polyp.along, last);
        last = polyp.along;
        EXPECT_GE(polyp.diameter, 0.0039);
        EXPECT_LE(polyp.diameter, 0.0121);
        ++shapes[static_cast<int>(polyp.shape)];
        if (polyp.diameter >= 0.006 && polyp.shape != PolypShape::Flat) {
            EXPECT_GT(greyAt(colon.grey, polyp.position), -450) << polyp.along;
        }
        // Towards the axis, or beyond it where the head reaches it, there is lumen just beyond the head.
        const glm::dvec3 axis = colon.axis.points[static_cast<std::size_t>(polyp.along * 1000)].position;
        const double apart = glm::length(axis - polyp.position);
        EXPECT_LT(apart, 0.030) << polyp.along;
        double least = 2000;
        for (int step = 0; step <= 20; ++step) {
            const double way = (polyp.diameter + 0.002) * step / 20;
            const double grey = greyAt(colon.grey, polyp.position + (axis - polyp.position) * (way / apart));
            least = std::min(least, grey > 250 ? -1000 : grey);
        }
        EXPECT_LT(least, -700) << polyp.along;
    }
    for (int count : shapes) EXPECT_GE(count, 2);
}

TEST(BuiltInColon, FluidLiesUnderALevelSurfaceAtTheBack) {
    const GreyVolume& grey = medium().grey;
    std::size_t fluid = 0;
    double front = 1;
    for (int k = 0; k < grey.frame.size.z; ++k)
        for (int j = 0; j < grey.frame.size.y; ++j)
            for (int i = 0; i < grey.frame.size.x; ++i)
                if (grey.at(i, j, k) > 300) {
                    ++fluid;
                    const glm::dvec3 world = grey.frame.worldFromVoxel({i, j, k});
                    front = std::min(front, world.y);
                    ASSERT_GT(world.x, 0.07);  // the descending part, on the patient's left
                }
    const double litres = fluid * grey.frame.spacing.x * grey.frame.spacing.y * grey.frame.spacing.z * 1000;
    EXPECT_GT(litres, 0.01);
    EXPECT_LT(litres, 0.3);
    EXPECT_NEAR(front, 0.066, 0.002);
}

TEST(BuiltInColon, RefusesSizesItCanNotShow) {
    Progress progress;
    EXPECT_THROW(builtInColon({1, {8, 64, 64}}, progress), Error);
    EXPECT_THROW(builtInColon({1, {64, 64, 5000}}, progress), Error);
}

TEST(BuiltInColon, CanBeCancelled) {
    Progress progress;
    progress.cancel();
    EXPECT_THROW(builtInColon({1, {64, 64, 52}}, progress), Cancelled);
}

}  // namespace
}  // namespace stereonav
