// The surface that everything casts and shades: bilinear, with its bounds, normals and holes.
#include "terrain/ground/heightfield.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "raster_files.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 14, kHeight = 11;
const glm::dvec2 kSpacing(20, 30);

Heightfield roughGround() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> height(-50, 80);
    std::vector<float> heights(kWidth * kHeight);
    for (float& h : heights) h = height(random);
    return Heightfield(kWidth, kHeight, kSpacing, heights, "rough");
}

glm::dvec2 randomPlace(std::mt19937& random) {
    std::uniform_real_distribution<double> x(-130, 130), y(-150, 150);
    return {x(random), y(random)};
}

TEST(Heightfield, SpacesAreCentredAndRoundTrip) {
    const Heightfield ground = roughGround();
    EXPECT_EQ(ground.originWorld(), glm::dvec2(-130, -150));
    EXPECT_EQ(ground.worldFromGrid({kWidth - 1, kHeight - 1}), glm::dvec2(130, 150));
    std::mt19937 random(1);
    for (int k = 0; k < 200; ++k) {
        const glm::dvec2 p = randomPlace(random), back = ground.worldFromGrid(ground.gridFromWorld(p));
        EXPECT_NEAR(back.x, p.x, 1e-9);
        EXPECT_NEAR(back.y, p.y, 1e-9);
    }
}

TEST(Heightfield, GoesThroughItsSamplesAndIsBilinearBetween) {
    const Heightfield ground = roughGround();
    for (int j = 0; j < kHeight; ++j)
        for (int i = 0; i < kWidth; ++i)
            EXPECT_NEAR(ground.heightAt(ground.worldFromGrid({i, j})), ground.sample(i, j), 1e-4);
    // Inside a cell a bilinear function is known from its corners: a second way, by areas.
    for (int j = 0; j + 1 < kHeight; ++j)
        for (int i = 0; i + 1 < kWidth; ++i)
            for (double v = 0.1; v < 1; v += 0.2)
                for (double u = 0.1; u < 1; u += 0.2) {
                    const double expected =
                        ground.sample(i, j) * (1 - u) * (1 - v) + ground.sample(i + 1, j) * u * (1 - v) +
                        ground.sample(i, j + 1) * (1 - u) * v + ground.sample(i + 1, j + 1) * u * v;
                    EXPECT_NEAR(ground.heightAt(ground.worldFromGrid({i + u, j + v})), expected, 1e-4);
                }
}

TEST(Heightfield, ClampsOutside) {
    const Heightfield ground = roughGround();
    EXPECT_EQ(ground.heightAt({-1e6, -1e6}), ground.sample(0, 0));
    EXPECT_EQ(ground.heightAt({1e6, 1e6}), ground.sample(kWidth - 1, kHeight - 1));
    EXPECT_TRUE(ground.contains({129.9, 149.9}));
    EXPECT_FALSE(ground.contains({130.1, 0}));
    EXPECT_FALSE(ground.contains({0, -150.1}));
}

TEST(Heightfield, MaxSlopeBoundsEveryDifference) {
    const Heightfield ground = roughGround();
    std::mt19937 random(2);
    double steepest = 0;
    for (int k = 0; k < 20000; ++k) {
        const glm::dvec2 p = randomPlace(random), q = p + 1e-3 * (randomPlace(random));
        if (!ground.contains(q)) continue;
        const double rise = std::abs(ground.heightAt(p) - ground.heightAt(q));
        EXPECT_LE(rise, ground.maxSlope() * glm::length(p - q) * (1 + 1e-9) + 1e-9);
        steepest = std::max(steepest, rise / glm::length(p - q));
    }
    EXPECT_GT(steepest, 0.5 * ground.maxSlope());  // and is no idle bound
}

TEST(Heightfield, NormalsAreUnitAndContinuousAcrossCells) {
    const Heightfield ground = roughGround();
    constexpr double kStep = 1e-7;
    for (int j = 1; j + 1 < kHeight; ++j)
        for (double x = -125; x < 125; x += 3.3) {
            const double y = ground.worldFromGrid({0, j}).y;
            const glm::dvec3 south = ground.normalAt({x, y - kStep}), north = ground.normalAt({x, y + kStep});
            EXPECT_NEAR(glm::length(south), 1, 1e-12);
            EXPECT_LT(glm::length(south - north), 1e-6) << x << " " << y;
        }
    for (int i = 1; i + 1 < kWidth; ++i)
        for (double y = -145; y < 145; y += 3.3) {
            const double x = ground.worldFromGrid({i, 0}).x;
            EXPECT_LT(glm::length(ground.normalAt({x - kStep, y}) - ground.normalAt({x + kStep, y})), 1e-6);
        }
}

TEST(Heightfield, NormalOfAPlaneIsThePlanesEverywhere) {
    std::vector<float> heights;
    for (int j = 0; j < 9; ++j)
        for (int i = 0; i < 8; ++i) heights.push_back(static_cast<float>(0.5 * i * 20 - 0.25 * j * 30));
    const Heightfield plane(8, 9, kSpacing, heights, "plane");
    const glm::dvec3 expected = glm::normalize(glm::dvec3(-0.5, 0.25, 1));
    std::mt19937 random(3);
    for (int k = 0; k < 300; ++k)
        EXPECT_LT(glm::length(plane.normalAt(randomPlace(random)) - expected), 1e-6);
    EXPECT_NEAR(plane.maxSlope(), std::hypot(0.5, 0.25), 1e-6);
}

TEST(Heightfield, HolesAreOpenAndLeaveTheRestAlone) {
    std::vector<float> heights(49, 5.0f);
    heights[3 * 7 + 3] = NAN;
    const Heightfield ground(7, 7, glm::dvec2(1), heights, "holed");
    EXPECT_TRUE(ground.hasHoles());
    EXPECT_TRUE(std::isinf(ground.maxSlope()));
    EXPECT_EQ(ground.minHeight(), 5);
    EXPECT_EQ(ground.maxHeight(), 5);
    for (double y = 0.05; y < 6; y += 0.1)
        for (double x = 0.05; x < 6; x += 0.1) {
            const bool open = x > 2 && x < 4 && y > 2 && y < 4;
            EXPECT_EQ(std::isnan(ground.heightAt(ground.worldFromGrid({x, y}))), open) << x << " " << y;
            EXPECT_NEAR(ground.normalAt(ground.worldFromGrid({x, y})).z, 1, 1e-12);
        }
}

TEST(Heightfield, BadGridsAreRefused) {
    const auto error = [](int w, int h, glm::dvec2 spacing, float value) {
        return test::errorOf([&] {
            Heightfield(w, h, spacing, std::vector<float>(static_cast<std::size_t>(w) * h, value), "f");
        });
    };
    EXPECT_THAT(error(1, 5, {1, 1}, 0), HasSubstr("f: expected at least 2x2 samples, got 1x5"));
    EXPECT_THAT(error(3, 3, {1, 0}, 0), HasSubstr("f:spacing: expected metres above 0"));
    EXPECT_THAT(error(3, 3, {NAN, 1}, 0), HasSubstr("f:spacing"));
    EXPECT_THAT(error(3, 3, {1, 1}, NAN), HasSubstr("no cell with four known heights"));
}

}  // namespace
}  // namespace stereonav
