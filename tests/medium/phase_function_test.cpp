// Phase functions by table: against the closed form, their mean, and how they are sampled.
#include "engine/medium/model/phase_function.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "engine/base/error.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

double closedForm(double g, double cosine) {
    return (1 - g * g) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
}

// Simpson's rule over the angle, by lookup alone.
double meanOver(const PhaseFunction& phase, int channel, bool timesCosine) {
    constexpr int kSteps = 20480;
    const double h = M_PI / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = i * h;
        const double f = phase.at(static_cast<float>(std::cos(angle)))[channel] * std::sin(angle) *
                         (timesCosine ? std::cos(angle) : 1.0);
        sum += f * (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2);
    }
    return 0.5 * sum * h / 3;
}

TEST(PhaseFunction, NoneIsOneEverywhere) {
    const PhaseFunction none;
    EXPECT_TRUE(none.isotropic());
    for (float cosine = -1; cosine <= 1; cosine += 0.01f)
        EXPECT_EQ(none.at(cosine), glm::vec3(1.0f)) << cosine;
    EXPECT_NEAR(none.meanCosine().x, 0, 1e-7);
    EXPECT_TRUE(PhaseFunction::henyeyGreenstein(glm::vec3(0.0f)).isotropic());
    EXPECT_FALSE(PhaseFunction::henyeyGreenstein({0, 0.1f, 0}).isotropic());
}

TEST(PhaseFunction, HenyeyGreensteinByLookupIsTheClosedForm) {
    for (const float g : {-0.95f, -0.5f, 0.1f, 0.5f, 0.8f, 0.95f}) {
        const PhaseFunction phase = PhaseFunction::henyeyGreenstein({g, 0, -g});
        EXPECT_NEAR(phase.meanCosine().x, g, 2e-4) << g;
        double worst = 0;
        for (int i = 0; i <= 20000; ++i) {
            const float cosine = static_cast<float>(std::cos(M_PI * i / 20000));
            const double truth = closedForm(g, cosine);
            worst = std::max(worst, std::abs(phase.at(cosine).x - truth) / truth);
            worst = std::max(worst,
                             std::abs(phase.at(cosine).z - closedForm(-g, cosine)) / closedForm(-g, cosine));
        }
        // Linear interpolation: h^2 / 8 of the second derivative, 3 |g| / (1 - |g|)^2 of the peak.
        const double h = M_PI / 1024, a = std::abs(g);
        EXPECT_LT(worst, 2 * h * h / 8 * 3 * a / ((1 - a) * (1 - a)) + 3e-5) << g;
    }
}

TEST(PhaseFunction, EveryTableHasTheMeanOne) {
    const PhaseFunction table = PhaseFunction::table(
        {{0, {9, 100, 1e30f}}, {7.3, {5, 1, 0}}, {90, {1, 0, 0}}, {180, {3, 2, 0}}}, "test");
    for (const PhaseFunction& phase : {PhaseFunction::henyeyGreenstein({0.95f, -0.7f, 0.3f}), table})
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(meanOver(phase, c, false), 1, 2e-5) << c;
            EXPECT_NEAR(meanOver(phase, c, true), phase.meanCosine()[c], 2e-5) << c;
        }
}

TEST(PhaseFunction, TablesAreLinearInTheAngle) {
    const PhaseFunction phase =
        PhaseFunction::table({{0, glm::vec3(4)}, {90, glm::vec3(2)}, {180, glm::vec3(2)}}, "");
    const float scale = phase.at(1).x / 4;
    for (double angle = 0; angle <= 180; angle += 0.5)
        EXPECT_NEAR(phase.at(static_cast<float>(std::cos(angle * M_PI / 180))).y,
                    scale * (angle < 90 ? 4 - 2 * angle / 90 : 2), 3e-4)
            << angle;
    EXPECT_EQ(phase.at(5), phase.at(1));
    EXPECT_EQ(phase.at(-5), phase.at(-1));
    EXPECT_TRUE(std::isfinite(phase.at(std::nanf("")).x));
}

// Counts in bins of the cosine against the integrals of the table's density.
double chiSquare(const PhaseFunction& phase, int channel, int samples, int bins) {
    std::vector<double> expected(bins, 0.0), counted(bins, 0.0);
    const auto binOf = [&](double angle) {
        return std::min(static_cast<int>(angle / M_PI * bins), bins - 1);
    };
    constexpr int kFine = 1 << 18;
    for (int i = 0; i < kFine; ++i) {
        const double angle = M_PI * (i + 0.5) / kFine;
        expected[binOf(angle)] += 0.5 * phase.at(static_cast<float>(std::cos(angle)))[channel] *
                                  std::sin(angle) * M_PI / kFine * samples;
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    for (int i = 0; i < samples; ++i) {
        const float u = std::min(uniform(random), 0x1.fffffep-1f);
        const float cosine = phase.sampleCosine(channel, u);
        EXPECT_TRUE(cosine >= -1 && cosine <= 1) << u;
        ++counted[binOf(std::acos(cosine))];
    }
    double sum = 0;
    for (int b = 0; b < bins; ++b)
        if (expected[b] > 5) sum += (counted[b] - expected[b]) * (counted[b] - expected[b]) / expected[b];
    return sum;
}

TEST(PhaseFunction, SamplesFollowTheTable) {
    const PhaseFunction phase = PhaseFunction::henyeyGreenstein({0.85f, -0.4f, 0});
    const PhaseFunction table = PhaseFunction::table(
        {{0, glm::vec3(1)}, {40, glm::vec3(0)}, {120, glm::vec3(0)}, {180, glm::vec3(1)}}, "");
    // 63 degrees of freedom: 1 in 1,000 above 103.4. The seed is fixed.
    for (int c = 0; c < 3; ++c) EXPECT_LT(chiSquare(phase, c, 200000, 64), 103.4) << c;
    EXPECT_LT(chiSquare(table, 1, 200000, 64), 103.4);
}

TEST(PhaseFunction, SampledMeanIsTheMeanCosine) {
    const PhaseFunction phase = PhaseFunction::henyeyGreenstein({0.95f, 0.5f, -0.9f});
    constexpr int kSteps = 100000;
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) sum += phase.sampleCosine(c, (i + 0.5f) / kSteps);
        EXPECT_NEAR(sum / kSteps, phase.meanCosine()[c], 1e-4) << c;
    }
    EXPECT_FLOAT_EQ(phase.sampleCosine(0, 0), 1);
    EXPECT_GE(phase.sampleCosine(0, 1), -1);
}

using test::errorOf;

TEST(PhaseFunction, RefusesBadNumbers) {
    for (const float g : {1.0f, -1.0f, 0.9995f, 5.0f, std::nanf("")})
        EXPECT_THAT(errorOf([&] {
                        PhaseFunction::henyeyGreenstein({0, g, 0});
                    }),
                    HasSubstr("asymmetry"))
            << g;
    const auto error = [](std::vector<PhaseFunction::Point> points) {
        return errorOf([&] { PhaseFunction::table(points, "p.txt"); });
    };
    const glm::vec3 one(1.0f);
    EXPECT_EQ(error({{0, one}, {180, one}}), "no error");
    EXPECT_THAT(error({}), HasSubstr("p.txt: expected at least two points, got 0"));
    EXPECT_THAT(error({{1, one}, {180, one}}), HasSubstr("p.txt:point 1: expected the angle 0, got 1"));
    EXPECT_THAT(error({{0, one}, {170, one}}), HasSubstr("up to 180, got 170"));
    EXPECT_THAT(error({{0, one}, {190, one}}), HasSubstr("up to 180, got 190"));
    EXPECT_THAT(error({{0, one}, {90, one}, {90, one}, {180, one}}),
                HasSubstr("point 3: expected an angle above 90"));
    EXPECT_THAT(error({{0, one}, {std::nan(""), one}, {180, one}}), HasSubstr("point 2"));
    EXPECT_THAT(error({{0, {1, -1, 1}}, {180, one}}), HasSubstr("weight of 0 or more, got -1"));
    EXPECT_THAT(error({{0, {1, 0, 1}}, {180, {1, 0, 1}}}), HasSubstr("none in green"));
}

}  // namespace
}  // namespace stereonav
