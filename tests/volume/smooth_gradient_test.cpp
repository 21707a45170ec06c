// Gradients under a cubic B-spline, against closed forms and differences of the spline itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/volume/plain_volume_caster.h"
#include "engine/volume/surface_cells.h"
#include "test_volumes.h"

namespace stereonav {
namespace {

using test::greyVolume;
using test::Random;
using test::slantedFrame;

// The cubic B-spline by its two pieces.
double basis(double x) {
    x = std::abs(x);
    if (x >= 2) return 0;
    return x < 1 ? 2.0 / 3 - x * x + x * x * x / 2 : std::pow(2 - x, 3) / 6;
}

double smoothed(const GreyVolume& volume, const glm::dvec3& v) {
    const glm::ivec3 last = volume.frame.size - 1;
    double sum = 0;
    for (int k = -4; k <= last.z + 4; ++k)
        for (int j = -4; j <= last.y + 4; ++j)
            for (int i = -4; i <= last.x + 4; ++i) {
                const double w = basis(v.x - i) * basis(v.y - j) * basis(v.z - k);
                if (w > 0)
                    sum += w * volume.at(std::clamp(i, 0, last.x), std::clamp(j, 0, last.y),
                                         std::clamp(k, 0, last.z));
            }
    return sum;
}

// Corners then have no normal, and all together lead up, whatever the value: not where the roundings of the
// sum lead.
TEST(SmoothGradient, OfWhatIsTheSameAllAroundThereIsNone) {
    VolumeFrame frame;
    frame.size = {7, 6, 8};
    frame.spacing = {0.7e-3, 0.9e-3, 1.1e-3};
    for (const int value : {1, 3, 7, 11, 255, -1000, 3071, 32767, -32768}) {
        const GreyVolume volume = greyVolume(frame, [&](const glm::dvec3&) { return value; });
        SurfaceSetting setting;
        setting.isovalue = static_cast<float>(value);
        setting.lowest = setting.isovalue - 1;
        setting.highest = setting.isovalue + 1;
        Progress progress;
        const SurfaceCells cells = findSurfaceCells(volume, setting, progress);
        ASSERT_GT(cells.active, 0u);
        const std::uint32_t none = packCornerNormal({0, 0, 0});
        for (int k = 0; k < 7; ++k)
            for (int j = 0; j < 5; ++j)
                for (int i = 0; i < 6; ++i) {
                    const std::optional<CellRecord> record = cells.record({i, j, k});
                    ASSERT_TRUE(record);
                    for (const std::uint32_t normal : record->normals) ASSERT_EQ(normal, none) << value;
                    EXPECT_EQ(plainNormal(volume, {i + 0.3, j + 0.6, k + 0.1}), glm::dvec3(0, 0, 1)) << value;
                }
    }
}

TEST(SmoothGradient, IsExactForALinearField) {
    const glm::dvec3 slope(12, -7, 30);  // by voxels
    const GreyVolume volume =
        greyVolume(slantedFrame({12, 10, 11}), [&](const glm::dvec3& v) { return glm::dot(slope, v) + 3; });
    const glm::dvec3 expected = volume.frame.axes * (slope / volume.frame.spacing);
    Random random(1);
    for (int n = 0; n < 200; ++n) {
        const glm::dvec3 at = random.inBox({2, 2, 2}, {8.99, 6.99, 7.99});
        EXPECT_LT(glm::length(smoothGradient(volume, at) - expected), 1e-9 * glm::length(expected)) << n;
    }
}

TEST(SmoothGradient, IsTheSlopeOfTheSpline) {
    Random random(2);
    const GreyVolume volume =
        greyVolume(slantedFrame({5, 4, 6}), [&](const glm::dvec3&) { return random.between(-30000, 30000); });
    const VolumeFrame& frame = volume.frame;
    for (int n = 0; n < 200; ++n) {
        const glm::dvec3 at = random.inBox(glm::dvec3(-3), glm::dvec3(frame.size) + 2.0);
        const glm::dvec3 gradient = smoothGradient(volume, at);
        const glm::dvec3 along = random.direction();
        constexpr double kStep = 1e-6;  // metres
        const auto value = [&](double s) {
            return smoothed(volume, at + frame.voxelDirection(along) * (s * kStep));
        };
        const double slope = (value(1) - value(-1)) / (2 * kStep);
        EXPECT_NEAR(glm::dot(gradient, along), slope, 1e2) << n;  // slopes here are about 1e7
    }
}

TEST(SmoothGradient, EndsBeyondTheFacesAndTakesAnyPoint) {
    Random random(3);
    const GreyVolume volume =
        greyVolume(VolumeFrame{{3, 3, 3}}, [&](const glm::dvec3&) { return random.between(-900, 900); });
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double far : {-2.0, 4.0, 1e300, -1e300, infinity, -infinity, nan})
        EXPECT_LT(glm::length(smoothGradient(volume, {far, far, far})), 1e-12) << far;
    EXPECT_LT(std::abs(smoothGradient(volume, {-50, 1, 1}).x), 1e-12);
    EXPECT_GT(std::abs(smoothGradient(volume, {-50, 1, 1}).y), 1e-3);
    const GreyVolume one = greyVolume(VolumeFrame{{1, 1, 1}}, [](const glm::dvec3&) { return 5; });
    EXPECT_LT(glm::length(smoothGradient(one, {0.3, -0.2, 0.9})), 1e-12);
}

}  // namespace
}  // namespace stereonav
