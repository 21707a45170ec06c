// Openness from the numbers of a box: against the library's erf, against what the distributions must have as
// their means and bounds, and the answers for boxes without a distribution.
#include "tests/oracle/occlusion_formulas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(OcclusionFormulas, ErrorFunctionIsWithinThePapersBound) {
    for (int n = -6000; n <= 6000; ++n) {
        const double x = n / 1000.0;
        ASSERT_LE(std::abs(errorFunction(x) - std::erf(x)), 4e-4 * std::abs(std::erf(x))) << x;
        ASSERT_EQ(errorFunction(-x), -errorFunction(x)) << x;
    }
    for (const double tiny : {1e-100, 1e-20, 1e-9})
        EXPECT_NEAR(errorFunction(tiny) / std::erf(tiny), 1, 4e-4) << tiny;
    for (const double large : {1e3, 1e200, kInfinity}) EXPECT_EQ(errorFunction(large), 1) << large;
}

TEST(OcclusionFormulas, ReconstructedDistributionHasTheMeanItWasMadeFrom) {
    // The mean of a distribution on [low, high] is high minus the integral of its cumulative function.
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> share(0.05, 0.95);
    for (int n = 0; n < 20; ++n) {
        const double low = -1000 * share(engine), high = 2000 * share(engine);
        const double mean = low + (high - low) * share(engine);
        constexpr int kSteps = 200000;
        const double width = (high - low) / kSteps;
        double integral = 0;
        for (int s = 0; s < kSteps; ++s)
            integral += width * reconstructedOpenness(low + (s + 0.5) * width, low, high, mean);
        // t^beta with beta >= 1/19 rises steeply at 0: the midpoint rule is off there by less than a step.
        EXPECT_NEAR(high - integral, mean, 2 * width) << low << " " << high << " " << mean;
    }
}

TEST(OcclusionFormulas, DrawingEndsInKeepsTheMean) {
    // The same with 3 sigma cut off the lower end, the upper, both and none.
    for (const double mean : {-800.0, 100.0, 1900.0})
        for (const double sigma : {20.0, 150.0, 400.0, 1500.0}) {
            constexpr int kSteps = 200000;
            constexpr double kWidth = 3000.0 / kSteps;
            double integral = 0;
            for (int s = 0; s < kSteps; ++s)
                integral +=
                    kWidth * drawnInOpenness(-1000 + (s + 0.5) * kWidth, -1000, 2000, mean, sigma * sigma);
            EXPECT_NEAR(2000 - integral, mean, 2 * kWidth) << mean << " " << sigma;
        }
}

TEST(OcclusionFormulas, BeyondTheDrawnInEndsNothingIsLeft) {
    EXPECT_EQ(drawnInOpenness(-31, -1000, 1000, 0, 100), 0);
    EXPECT_EQ(drawnInOpenness(-30, -1000, 1000, 0, 100), 0);
    EXPECT_EQ(drawnInOpenness(30, -1000, 1000, 0, 100), 1);
    EXPECT_EQ(drawnInOpenness(31, -1000, 1000, 0, 100), 1);
    EXPECT_DOUBLE_EQ(drawnInOpenness(15, -1000, 1000, 0, 100), 0.75);  // beta 1: linear
    // Only the upper end: t = (v + 10) / 40, beta = 1/3.
    EXPECT_DOUBLE_EQ(drawnInOpenness(0, -10, 1000, 0, 100), std::cbrt(0.25));
    EXPECT_EQ(drawnInOpenness(0.5, -1, 1, 0.2, 100), reconstructedOpenness(0.5, -1, 1, 0.2));
}

TEST(OcclusionFormulas, DrawnInHasAnAnswerForEveryBox) {
    EXPECT_EQ(drawnInOpenness(5, 5, 5, 5, 0), 0.5);
    EXPECT_EQ(drawnInOpenness(5, 5, 5, 5, -1e-9), 0.5);
    EXPECT_EQ(drawnInOpenness(6, 0, 9, 5, 0), 1);  // variance 0: all at the mean, as for the Gaussian
    EXPECT_EQ(drawnInOpenness(4, 0, 9, 5, 0), 0);
    EXPECT_EQ(drawnInOpenness(0.5, 0, 1, 0, 1), 1);
    EXPECT_EQ(drawnInOpenness(0.5, 0, 1, 1, 1), 0);
    EXPECT_EQ(drawnInOpenness(1, 0, 1, 1, 1), 1);
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        EXPECT_EQ(drawnInOpenness(bad, 0, 1, 0.5, 1), 0.5);
        EXPECT_EQ(drawnInOpenness(0.5, bad, 1, 0.5, 1), 0.5);
        EXPECT_EQ(drawnInOpenness(0.5, 0, bad, 0.5, 1), 0.5);
        EXPECT_EQ(drawnInOpenness(0.5, 0, 1, bad, 1), 0.5);
        EXPECT_EQ(drawnInOpenness(0.5, 0, 1, 0.5, bad), 0.5);
    }
    for (const double value : {-900.0, -100.0, 35.0, 700.0})
        EXPECT_EQ(drawnInOpenness(value + 1e6, 1e6 - 1000, 1e6 + 3000, 1e6 + 200, 62500),
                  drawnInOpenness(value, -1000, 3000, 200, 62500));
}

TEST(OcclusionFormulas, GaussianIsTheLibrarysWithinTheApproximation) {
    for (int n = -500; n <= 500; ++n) {
        const double value = 7 + n * 0.1;
        const double exact = 0.5 * (1 + std::erf((value - 7) / (3 * std::sqrt(2.0))));
        ASSERT_NEAR(gaussianOpenness(value, 7, 9), exact, 2e-4) << value;
    }
}

TEST(OcclusionFormulas, ChebyshevIsABoundForEveryDistribution) {
    std::mt19937 engine(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int box = 0; box < 200; ++box) {
        std::vector<double> values(100);
        for (double& v : values) v = std::pow(uniform(engine), 1 + box % 7);
        double sum = 0, squares = 0;
        for (const double v : values) sum += v, squares += v * v;
        const double mean = sum / 100, variance = squares / 100 - mean * mean;
        for (const double own : values) {
            double denser = 0;
            for (const double v : values) denser += v >= own ? 0.01 : 0;
            ASSERT_LE(chebyshevOpenness(own, mean, variance), 1 - denser + 1e-12) << box;
        }
    }
}

TEST(OcclusionFormulas, AllValuesEqualIsHalfOpen) {
    EXPECT_EQ(reconstructedOpenness(5, 5, 5, 5), 0.5);
    EXPECT_EQ(gaussianOpenness(5, 5, 0), 0.5);
    EXPECT_EQ(chebyshevOpenness(5, 5, 0), 0.5);
    EXPECT_EQ(gaussianOpenness(1e6 + 5, 1e6 + 5, -1e-9), 0.5);  // what rounding made of variance 0
}

TEST(OcclusionFormulas, ValuesBesideAVarianceOfZeroAreOpenOrNot) {
    for (const auto& openness : {gaussianOpenness, chebyshevOpenness}) {
        EXPECT_EQ(openness(6, 5, 0), 1);
        EXPECT_EQ(openness(4, 5, 0), 0);
    }
    EXPECT_EQ(reconstructedOpenness(6, 5, 5, 5), 1);
    EXPECT_EQ(reconstructedOpenness(4, 5, 5, 5), 0);
}

TEST(OcclusionFormulas, MeanAtAnEndIsAStepThere) {
    for (const double value : {0.0, 1e-9, 0.5, 1.0}) EXPECT_EQ(reconstructedOpenness(value, 0, 1, 0), 1);
    EXPECT_EQ(reconstructedOpenness(-1e-9, 0, 1, 0), 0);
    for (const double value : {0.0, 0.5, 1 - 1e-9}) EXPECT_EQ(reconstructedOpenness(value, 0, 1, 1), 0);
    EXPECT_EQ(reconstructedOpenness(1, 0, 1, 1), 1);
    EXPECT_EQ(reconstructedOpenness(0.5, 0, 1, -1e-12), 1);  // what rounding made of a mean at the minimum
    EXPECT_EQ(reconstructedOpenness(0.5, 0, 1, 1 + 1e-12), 0);
}

TEST(OcclusionFormulas, EndsOfTheRange) {
    EXPECT_EQ(reconstructedOpenness(0, 0, 1, 0.3), 0);
    EXPECT_EQ(reconstructedOpenness(1, 0, 1, 0.3), 1);
    EXPECT_EQ(reconstructedOpenness(7, 0, 1, 0.3), 1);
    EXPECT_NEAR(gaussianOpenness(1e300, 0, 1e-300), 1, 1e-15);
    EXPECT_EQ(chebyshevOpenness(1e300, 0, 1e-300), 1);
    EXPECT_EQ(chebyshevOpenness(0, 0, 4), 0);
    EXPECT_DOUBLE_EQ(chebyshevOpenness(2, 0, 4), 0.5);
}

TEST(OcclusionFormulas, WhatIsNotFiniteIsHalfOpen) {
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        EXPECT_EQ(reconstructedOpenness(bad, 0, 1, 0.5), 0.5);
        EXPECT_EQ(reconstructedOpenness(0.5, bad, 1, 0.5), 0.5);
        EXPECT_EQ(reconstructedOpenness(0.5, 0, bad, 0.5), 0.5);
        EXPECT_EQ(reconstructedOpenness(0.5, 0, 1, bad), 0.5);
        EXPECT_EQ(gaussianOpenness(bad, 0, 1), 0.5);
        EXPECT_EQ(gaussianOpenness(0, bad, 1), 0.5);
        EXPECT_EQ(gaussianOpenness(0, 0, bad), 0.5);
        EXPECT_EQ(chebyshevOpenness(bad, 0, 1), 0.5);
        EXPECT_EQ(chebyshevOpenness(0, 0, bad), 0.5);
    }
}

TEST(OcclusionFormulas, AnOffsetOfAMillionChangesNothing) {
    for (const double value : {-900.0, -100.0, 35.0, 700.0}) {
        EXPECT_EQ(reconstructedOpenness(value + 1e6, 1e6 - 1000, 1e6 + 3000, 1e6 + 200),
                  reconstructedOpenness(value, -1000, 3000, 200));
        EXPECT_EQ(gaussianOpenness(value + 1e6, 1e6 + 200, 250000), gaussianOpenness(value, 200, 250000));
        EXPECT_EQ(chebyshevOpenness(value + 1e6, 1e6 + 200, 250000), chebyshevOpenness(value, 200, 250000));
    }
}

}  // namespace
}  // namespace stereonav
