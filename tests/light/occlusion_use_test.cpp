// What openness is used for: opacity modulation by variance and by its gradient; and the estimates on volumes
// whose boxes are known in closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/mat4x4.hpp>
#include <limits>
#include <random>

#include "engine/base/error.h"
#include "occlusion_brute.h"
#include "tests/oracle/regression_gradient.h"

namespace stereonav {
namespace {

template <typename Value>
GreyVolume fill(const glm::ivec3& size, Value value) {
    GreyVolume volume(VolumeFrame{size, glm::dvec3(1e-3)});
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                volume.at(i, j, k) = static_cast<std::int16_t>(value(glm::ivec3(i, j, k)));
    return volume;
}

OpennessVolume estimate(const GreyVolume& volume, OcclusionMethod method, int radius) {
    Progress progress;
    return estimateOpenness(volume, method, glm::ivec3(radius), progress);
}

TEST(OcclusionUse, ARampHalvesTheBox) {
    // Mean in the middle, at the voxel's value: t = 1/2, beta = 1; the Gaussian at its mean. The bound says
    // nothing there: not open.
    const GreyVolume volume = fill({21, 21, 21}, [](const glm::ivec3& v) { return 300 * v.z - 70 * v.x; });
    EXPECT_EQ(estimate(volume, OcclusionMethod::Reconstructed, 6).at(10, 10, 10), 128);
    EXPECT_EQ(estimate(volume, OcclusionMethod::DrawnIn, 6).at(10, 10, 10), 128);
    EXPECT_EQ(estimate(volume, OcclusionMethod::Gaussian, 6).at(10, 10, 10), 128);
    EXPECT_EQ(estimate(volume, OcclusionMethod::Chebyshev, 6).at(10, 10, 10), 0);
}

TEST(OcclusionUse, AStepHasItsClosedForm) {
    // Values 0 and 1000; p of a box at height z are 1000. Mean p, variance p (1 - p), in thousands.
    const GreyVolume volume = fill({21, 21, 21}, [](const glm::ivec3& v) { return v.z < 10 ? 1000 : 0; });
    const OpennessVolume gaussian = estimate(volume, OcclusionMethod::Gaussian, 5);
    const OpennessVolume chebyshev = estimate(volume, OcclusionMethod::Chebyshev, 5);
    const OpennessVolume reconstructed = estimate(volume, OcclusionMethod::Reconstructed, 5);
    for (int z = 5; z < 15; ++z) {
        const double p = (15 - z) / 11.0, own = z < 10 ? 1 : 0, sigma = std::sqrt(p * (1 - p));
        if (p == 1) continue;
        const double open = 0.5 * (1 + std::erf((own - p) / sigma / std::sqrt(2.0)));
        EXPECT_LE(test::bytesAway(gaussian.at(10, 10, z), open), 0.5 + 255 * 2.5e-4) << z;
        EXPECT_LE(test::bytesAway(chebyshev.at(10, 10, z), z < 10 ? 1 - p : 0), 0.5001) << z;
        EXPECT_EQ(reconstructed.at(10, 10, z), z < 10 ? 255 : 0) << z;
    }
    EXPECT_EQ(gaussian.at(10, 10, 16), 128);  // the box no longer reaches the step
}

TEST(OcclusionUse, ASpheresCentreSeesTheDistributionOfDistance) {
    // v = -1000 |x| / R: in the centre the largest of all: open for every method.
    const GreyVolume volume = fill({21, 21, 21}, [](const glm::ivec3& v) {
        return std::lround(-100 * glm::length(glm::dvec3(v - 10)));
    });
    EXPECT_EQ(estimate(volume, OcclusionMethod::Reconstructed, 8).at(10, 10, 10), 255);
    EXPECT_GT(estimate(volume, OcclusionMethod::Gaussian, 8).at(10, 10, 10), 250);
    // And a corner of the box, the least of them, is not (the paper's F is 0 at the minimum).
    const GreyVolume pit = fill(
        {21, 21, 21}, [](const glm::ivec3& v) { return std::lround(100 * glm::length(glm::dvec3(v - 10))); });
    EXPECT_EQ(estimate(pit, OcclusionMethod::Reconstructed, 8).at(10, 10, 10), 0);
    EXPECT_LT(estimate(pit, OcclusionMethod::Gaussian, 8).at(10, 10, 10), 5);
}

TEST(OcclusionUse, VarianceModulatesAsWholeBoxesSay) {
    std::mt19937 engine(3);
    GreyVolume volume =
        fill({23, 14, 11}, [&](const glm::ivec3&) { return static_cast<int>(engine() % 900); });
    volume.scale = 0.5;
    volume.offset = 1e6;
    Progress progress;
    const auto modulation = varianceModulation(volume, glm::ivec3(3), 200, progress);
    int below = 0;
    for (int k = 0; k < 11; ++k)
        for (int j = 0; j < 14; ++j)
            for (int i = 0; i < 23; ++i) {
                const double variance = 0.25 * test::boxAt(volume, {i, j, k}, glm::ivec3(3)).variance();
                const double truth = std::min(variance / 40000, 1.0);
                ASSERT_LE(test::bytesAway(modulation.at(i, j, k), truth), 0.501);
                below += truth < 1;
            }
    EXPECT_GT(below, 1000);  // the cut at 1 does not hide everything
    const auto cut = varianceModulation(volume, glm::ivec3(3), 1e-300, progress);
    EXPECT_EQ(cut.at(5, 5, 5), 255);
    for (const double sigma : {0.0, -1.0, std::nan("")})
        EXPECT_THAT([&] { varianceModulation(volume, glm::ivec3(3), sigma, progress); },
                    testing::ThrowsMessage<Error>(testing::HasSubstr("expected a number above 0")));
}

TEST(OcclusionUse, RegressionIsTheLeastSquaresFit) {
    // Against the normal equations of a + b.x over the 27, solved by the library.
    std::mt19937 engine(4);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int n = 0; n < 50; ++n) {
        double values[27];
        for (double& v : values) v = uniform(engine);
        const auto at = [&](const glm::ivec3& o) { return values[(o.z + 1) * 9 + (o.y + 1) * 3 + o.x + 1]; };
        glm::dmat4 matrix(0.0);
        glm::dvec4 right(0.0);
        for (int m = 0; m < 27; ++m) {
            const glm::ivec3 o(m % 3 - 1, m / 3 % 3 - 1, m / 9 - 1);
            const double length = glm::length(glm::dvec3(o)), weight = length > 0 ? 1 / length : 3.7;
            const glm::dvec4 row(1.0, o.x, o.y, o.z);
            matrix += weight * glm::outerProduct(row, row);
            right += weight * at(o) * row;
        }
        const glm::dvec4 fit = glm::inverse(matrix) * right;
        const glm::dvec3 gradient = regressionGradient(at);
        for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(gradient[axis], fit[axis + 1], 1e-12);
    }
}

TEST(OcclusionUse, RegressionIsExactForLinesAndZeroForConstants) {
    const glm::dvec3 slope(0.3, -1.7, 2.5);
    const glm::dvec3 line =
        regressionGradient([&](const glm::ivec3& o) { return 42 + glm::dot(slope, glm::dvec3(o)); });
    EXPECT_LT(glm::length(line - slope), 1e-14);
    EXPECT_LT(glm::length(regressionGradient([](const glm::ivec3&) { return 1e6; })), 1e-9);
}

TEST(OcclusionUse, GradientModulates) {
    OpennessVolume openness(VolumeFrame{{12, 10, 8}, glm::dvec3(1e-3)});
    for (int k = 0; k < 8; ++k)
        for (int j = 0; j < 10; ++j)
            for (int i = 0; i < 12; ++i) openness.at(i, j, k) = static_cast<std::uint8_t>(10 * i + 5 * j);
    const double length = std::sqrt(125.0) / 255;
    const auto modulation = gradientModulation(openness, 2.5 * length);
    const auto cut = gradientModulation(openness, 0.5 * length);
    for (int k = 0; k < 8; ++k)
        for (int j = 1; j < 9; ++j)
            for (int i = 1; i < 11; ++i) {
                ASSERT_EQ(modulation.at(i, j, k), 102);
                ASSERT_EQ(cut.at(i, j, k), 255);
            }
    EXPECT_LT(modulation.at(0, 5, 4),
              128);  // beyond the face the outermost is repeated: half the slope along i
    OpennessVolume one(VolumeFrame{glm::ivec3(1), glm::dvec3(1e-3)});
    one.at(0, 0, 0) = 200;
    EXPECT_EQ(gradientModulation(one, 0.1).at(0, 0, 0), 0);
    EXPECT_THROW(gradientModulation(one, 0), Error);
}

TEST(OcclusionUse, GradientModulationIsTheRegressionAtEveryVoxel) {
    std::mt19937 engine(6);
    for (const glm::ivec3& size : {glm::ivec3(13, 7, 9), glm::ivec3(1, 1, 12), glm::ivec3(2, 1, 1)}) {
        OpennessVolume openness(VolumeFrame{size, glm::dvec3(1e-3)});
        for (std::size_t n = 0; n < openness.values.size(); ++n)
            openness.values[n] = static_cast<std::uint8_t>(engine() >> 24);
        const auto modulation = gradientModulation(openness, 0.4);
        for (int k = 0; k < size.z; ++k)
            for (int j = 0; j < size.y; ++j)
                for (int i = 0; i < size.x; ++i) {
                    const glm::dvec3 gradient = regressionGradient([&](const glm::ivec3& o) {
                        return openness.at(glm::clamp(glm::ivec3(i, j, k) + o, glm::ivec3(0), size - 1));
                    });
                    const double share = std::min(glm::length(gradient) / 255 / 0.4, 1.0);
                    ASSERT_LE(test::bytesAway(modulation.at(i, j, k), share), 0.5001);
                }
    }
}

TEST(OcclusionUse, RadiusInMetresMakesACubeInSpace) {
    VolumeFrame frame;
    frame.size = {300, 300, 40};
    frame.spacing = {1e-3, 1e-3, 20e-3};
    EXPECT_EQ(occlusionRadius(frame, 10e-3), glm::ivec3(10, 10, 1));
    EXPECT_EQ(occlusionRadius(frame, 9e-3), glm::ivec3(9, 9, 0));
    EXPECT_EQ(occlusionRadius(frame, 1e-6), glm::ivec3(1, 1, 0));
    EXPECT_THROW(occlusionRadius(frame, 0), Error);
}

TEST(OcclusionUse, ARadiusTooLargeIsRefusedAndNotCut) {
    VolumeFrame frame;
    frame.size = {300, 300, 40};
    frame.spacing = {0.7e-3, 1e-3, 20e-3};
    EXPECT_DOUBLE_EQ(largestOcclusionRadius(frame), 64 * 0.7e-3);
    EXPECT_EQ(occlusionRadius(frame, 44.8e-3), glm::ivec3(64, 45, 2));
    EXPECT_THAT([&] { occlusionRadius(frame, 44.9e-3); },
                testing::ThrowsMessage<Error>(testing::AllOf(testing::HasSubstr("at most 44.8 mm"),
                                                             testing::HasSubstr("64 voxels"),
                                                             testing::HasSubstr("got 44.9"))));
    // Along an axis of 65 voxels or less the largest box holds everything: nothing is cut off.
    frame.size = {65, 30, 40};
    EXPECT_EQ(largestOcclusionRadius(frame), std::numeric_limits<double>::infinity());
    EXPECT_EQ(occlusionRadius(frame, 1e6), glm::ivec3(64, 29, 39));
    frame.size = {65, 66, 1};
    EXPECT_DOUBLE_EQ(largestOcclusionRadius(frame), 64e-3);
}

}  // namespace
}  // namespace stereonav
