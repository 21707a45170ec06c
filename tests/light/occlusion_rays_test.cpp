// Traced openness against closed forms (flat wall, spherical bowl, floor before a wall) and against the light
// that paths bring from an even sky; the two older methods along 42 directions.
#include "engine/light/occlusion/occlusion_rays.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/math/constants.h"
#include "light_scenes.h"

namespace stereonav {
namespace {

using test::bowlVolume;
using test::cubeFrame;
using test::solidVolume;

constexpr double kVoxel = 1e-3;

GreyVolume ramp(const glm::dvec3& down) {
    return solidVolume(cubeFrame(24), [=](const glm::dvec3& v) { return glm::dot(v - 11.5, -down); });
}

TEST(OcclusionRays, AFlatWallIsOpen) {
    for (const glm::dvec3& down : {glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0), glm::dvec3(0.6, 0, -0.8)}) {
        const TracedOpenness open = traceOpenness(ramp(down), {11, 12, 10}, 7 * kVoxel);
        EXPECT_TRUE(open.surface);
        // Stored numbers are rounded, which bends the slanted wall by 1/400 of a voxel.
        EXPECT_NEAR(open.obscurance, 1, 1e-3);
        EXPECT_NEAR(open.visible, 1, 4e-3);
        EXPECT_NEAR(open.sphere, 1, 4e-3);
    }
}

TEST(OcclusionRays, ASphericalBowlHasItsClosedForm) {
    // A chord at angle a from the normal is 2 r cos a long. With c = R / (2 r): the directions of cos a < c
    // hit within R, c^2 of all by their cosine, at (cos a / c)^3: 2/5 of that is open all the same.
    const glm::dvec3 centre(24, 24, 24);
    const double r = 16;
    const GreyVolume volume = bowlVolume(49, centre, r, 1e9);
    for (const double radius : {6.0, 10.0, 16.0}) {
        const double c = radius / (2 * r);
        const TracedOpenness open = traceOpenness(volume, {24, 24, 8}, radius * kVoxel, 1024);
        EXPECT_NEAR(open.visible, 1 - c * c, 0.02) << radius;
        EXPECT_NEAR(open.obscurance, 1 - 0.6 * c * c, 0.02) << radius;
        // The tangent sphere lies within the bowl: no chord is shorter than its own.
        EXPECT_NEAR(open.sphere, 1, 0.01) << radius;
    }
}

// Floor z = 12, wall x = 20; the voxel lies on the floor, h before the wall.
GreyVolume floorAndWall() {
    return solidVolume(cubeFrame(33), [](const glm::dvec3& v) { return std::max(12.0 - v.z, v.x - 20.0); });
}

// The cosine-weighted hemisphere is the disc below it; directions that meet the wall within R are its segment
// beyond x = c = h / R, where d / R = c / x.
double wallObscurance(double c) {
    constexpr int kSteps = 20000;
    double lost = 0;
    for (int n = 0; n < kSteps; ++n) {
        const double x = c + (1 - c) * (n + 0.5) / kSteps;
        lost += 2 * std::sqrt(1 - x * x) * (1 - std::pow(c / x, 3)) * (1 - c) / kSteps;
    }
    return 1 - lost / kPi;
}

TEST(OcclusionRays, AFloorBeforeAWallHasItsClosedForm) {
    const GreyVolume volume = floorAndWall();
    for (const int h : {2, 4, 7}) {
        const double radius = 10, c = h / radius;
        const TracedOpenness open = traceOpenness(volume, {20 - h, 16, 12}, radius * kVoxel, 1024);
        EXPECT_NEAR(open.visible, 1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / kPi, 0.01) << h;
        EXPECT_NEAR(open.obscurance, wallObscurance(c), 0.01) << h;
        const double cap = std::max(radius / 2 - h, 0.0);  // height of the cap behind the wall
        const double share = cap * cap * (3 * radius / 2 - cap) / (4 * std::pow(radius / 2, 3));
        EXPECT_NEAR(open.sphere, 1 - share, 0.01) << h;
    }
}

TEST(OcclusionRays, VisibleIsWhatAnEvenSkyLights) {
    const GreyVolume volume = bowlVolume(40, {20, 20, 24}, 13, 26);
    LightSetup setup;
    setup.sky = glm::vec3(1.0f);
    setup.bounces = 0;
    const TexelLighter lighter(volume, volume.frame, setup, {});
    for (const glm::ivec3& voxel : {glm::ivec3(20, 20, 11), glm::ivec3(28, 20, 14), glm::ivec3(20, 12, 13)}) {
        const TexelSum sum = test::irradianceAt(lighter, voxel, 4096);
        const double traced = traceOpenness(volume, voxel, 100 * kVoxel, 4096).visible;
        // Both are quadratures of 4096 directions, neither is exact.
        EXPECT_NEAR(traced, sum.mean.x, 0.01 + 4 * test::standardError(sum));
        EXPECT_LT(traced, 0.8);
    }
}

TEST(OcclusionRays, NoGradientIsNoSurface) {
    GreyVolume even(cubeFrame(6));
    const TracedOpenness open = traceOpenness(even, {3, 3, 3}, 2 * kVoxel);
    EXPECT_FALSE(open.surface);
    EXPECT_EQ(open.obscurance, 1);
    EXPECT_EQ(opennessByDirections(even, {3, 3, 3}, DirectionMethod::Vicinity, 2 * kVoxel), 1);
}

TEST(OcclusionRays, NegativeScaleTurnsTheSurfaceAround) {
    GreyVolume volume = floorAndWall(), turned = floorAndWall();
    for (std::size_t n = 0; n < turned.values.size(); ++n)
        turned.values[n] = static_cast<std::int16_t>(-turned.values[n]);
    turned.scale = -1;
    const glm::ivec3 voxel(17, 16, 12);
    EXPECT_NEAR(traceOpenness(turned, voxel, 0.01).obscurance, traceOpenness(volume, voxel, 0.01).obscurance,
                1e-3);
    for (const DirectionMethod method : {DirectionMethod::Vicinity, DirectionMethod::Obscurance})
        EXPECT_EQ(opennessByDirections(turned, voxel, method, 0.01),
                  opennessByDirections(volume, voxel, method, 0.01));
}

TEST(OcclusionRays, TheDirectionsAre42EvenlySpread) {
    glm::dvec3 sum(0.0);
    glm::dmat3 squares(0.0);
    const auto& directions = occlusionDirections();
    for (std::size_t a = 0; a < directions.size(); ++a) {
        EXPECT_NEAR(glm::length(directions[a]), 1, 1e-15);
        sum += directions[a];
        squares += glm::outerProduct(directions[a], directions[a]);
        for (std::size_t b = 0; b < a; ++b) EXPECT_LT(glm::dot(directions[a], directions[b]), 0.86);
    }
    EXPECT_LT(glm::length(sum), 1e-13);
    // The icosahedron's symmetry makes it the same along every axis.
    for (int n = 0; n < 3; ++n)
        for (int m = 0; m < 3; ++m) EXPECT_NEAR(squares[n][m], n == m ? 14 : 0, 1e-13);
}

TEST(OcclusionRays, DirectionsFindWallsAndBowls) {
    for (const DirectionMethod method : {DirectionMethod::Vicinity, DirectionMethod::Obscurance}) {
        EXPECT_EQ(opennessByDirections(ramp({0, 0, 1}), {11, 12, 10}, method, 7 * kVoxel), 1);
        const double wall = opennessByDirections(floorAndWall(), {18, 16, 12}, method, 10 * kVoxel);
        const double truth = method == DirectionMethod::Vicinity
                                 ? 1 - (std::acos(0.2) - 0.2 * std::sqrt(0.96)) / kPi
                                 : wallObscurance(0.2);
        EXPECT_NEAR(wall, truth, 0.1);  // about 21 directions a hemisphere
    }
}

TEST(OcclusionRays, VolumesAreFilledVoxelByVoxelWhateverTheThreads) {
    const GreyVolume volume = bowlVolume(14, {7, 7, 8}, 5, 9);
    const int threads = threadCount();
    for (const DirectionMethod method : {DirectionMethod::Vicinity, DirectionMethod::Obscurance})
        for (int n = 1; n <= 3; ++n) {
            setThreadCount(n);
            Progress progress;
            const OpennessVolume all = opennessByDirections(volume, method, 5 * kVoxel, progress);
            for (int k = 0; k < 14; ++k)
                for (int i = 0; i < 14; ++i)
                    ASSERT_EQ(all.at(i, 6, k),
                              std::lround(255 * opennessByDirections(volume, {i, 6, k}, method, 5 * kVoxel)));
        }
    setThreadCount(threads);
}

TEST(OcclusionRays, RefuseWhatHasNoCellsAndRadiiThatAreNone) {
    const GreyVolume flat(VolumeFrame{glm::ivec3(5, 5, 1), glm::dvec3(1e-3)});
    EXPECT_THAT(
        [&] {
            traceOpenness(flat, {2, 2, 0}, 1e-3);
        },
        testing::ThrowsMessage<Error>(testing::HasSubstr("at least 2 voxels along each axis, got 5x5x1")));
    for (const double radius : {0.0, -1.0, std::nan(""), HUGE_VAL})
        EXPECT_THAT(
            [&] {
                traceOpenness(floorAndWall(), {2, 2, 2}, radius);
            },
            testing::ThrowsMessage<Error>(testing::HasSubstr("metres above 0")));
}

}  // namespace
}  // namespace stereonav
