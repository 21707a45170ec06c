// The paper's stepping against the exact hit: late by at most a step on ground without thin features, and
// blind to what is thinner.
#include "terrain/cast/equidistant_caster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "terrain/cast/plain_caster.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

TEST(EquidistantCaster, IsLateByAtMostAStepOnATiltedPlane) {
    const Heightfield ground = test::makeGround("tilted", 60, 60, 1);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int k = 0; k < 500; ++k) {
        const glm::dvec3 origin(300 * unit(random), 300 * unit(random), 900);
        const glm::dvec3 direction(unit(random), unit(random), -1.2);
        const GroundHit exact = castPlain(ground, origin, direction, 0.1);
        const double t = castEquidistant(ground, origin, direction, 0.1, 0.7);
        if (!std::isfinite(exact.t)) continue;
        ASSERT_GE(t, exact.t - 1e-9);
        // At the border the next sample may lie outside.
        if (std::isfinite(t)) {
            ASSERT_LE(t, exact.t + 0.7 + 1e-9);
        }
    }
}

TEST(EquidistantCaster, ErrorShrinksWithTheStep) {
    const Heightfield ground = test::makeGround("smooth", 97, 83, 1);
    double last = 1e300;
    for (const double step : {40.0, 10.0, 2.5}) {
        double sum = 0;
        int count = 0;
        for (int k = 0; k < 400; ++k) {
            const glm::dvec3 origin(0, 0, 400),
                direction(std::sin(0.1 * k), std::cos(0.1 * k), -0.2 - 0.001 * k);
            const GroundHit exact = castPlain(ground, origin, direction, 0.1);
            const double t = castEquidistant(ground, origin, direction, 0.1, step);
            if (!std::isfinite(exact.t) || !std::isfinite(t)) continue;
            sum += t - exact.t;
            ++count;
        }
        ASSERT_GT(count, 200);
        EXPECT_LT(sum / count, step);
        EXPECT_LT(sum, last / 2);
        last = sum;
    }
}

// Rays that look down come up again over level ground.
TEST(EquidistantCaster, SeesGroundOverARoundEarthWhereTheExactHitDoes) {
    const Heightfield ground = test::makeGround("smooth", 97, 83, 1);
    const EarthBend bend{glm::dvec2(0), 2e-4};
    int met = 0, otherwise = 0;
    for (int k = 0; k < 200; ++k) {
        const glm::dvec3 origin(0, 0, 400), direction(std::sin(0.1 * k), std::cos(0.1 * k), -0.6 - 0.002 * k);
        const GroundHit exact = castPlain(ground, origin, direction, 0.1, bend),
                        level = castPlain(ground, origin, direction, 0.1);
        const double t = castEquidistant(ground, origin, direction, 0.1, 0.25, bend);
        otherwise += std::isfinite(level.t) && !(std::abs(level.t - exact.t) < 1);
        if (!std::isfinite(exact.t) || !std::isfinite(t)) continue;
        EXPECT_GE(t, exact.t - 1e-9);
        EXPECT_LE(t, exact.t + 1);
        ++met;
    }
    EXPECT_GT(met, 100);
    EXPECT_GT(otherwise, 100);
}

TEST(EquidistantCaster, StepsOverASpikeThatTheExactHitFinds) {
    std::vector<float> heights(21 * 21, 0.0f);
    heights[10 * 21 + 10] = 100;
    const Heightfield ground(21, 21, {1, 1}, heights, "spike");
    const glm::dvec3 origin(-9, 0, 60), direction(1, 0, -0.1);
    EXPECT_TRUE(std::isfinite(castPlain(ground, origin, direction, 0).t));
    EXPECT_FALSE(std::isfinite(castEquidistant(ground, origin, direction, 0, 4.1)));
}

}  // namespace
}  // namespace stereonav
