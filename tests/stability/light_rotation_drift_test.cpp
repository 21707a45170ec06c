// Ten thousand rotations, one after the other: what dragging a light probe for minutes comes to.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <random>
#include <vector>

#include "engine/light/skies/spherical_harmonics.h"
#include "tests/support/stability_row.h"

namespace stereonav {
namespace {

constexpr int kTurns = 10000;

glm::dmat3 about(const glm::dvec3& axis, double angle) {
    const glm::dvec3 a = glm::normalize(axis);
    const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
    return glm::dmat3(1.0) + std::sin(angle) * cross + (1 - std::cos(angle)) * (cross * cross);
}

std::vector<glm::dmat3> steps() {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<glm::dmat3> all;
    for (int n = 0; n < kTurns; ++n) {
        const double x = normal(random), y = normal(random), z = normal(random);
        all.push_back(about({x, y, z}, 0.3 * normal(random)));
    }
    return all;
}

double worstOrthogonality(std::span<const double> band, int n) {
    double worst = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            double dot = 0;
            for (int k = 0; k < n; ++k) dot += band[i * n + k] * band[j * n + k];
            worst = std::max(worst, std::abs(dot - (i == j)));
        }
    return worst;
}

template <typename Matrix>
double worstOrthogonality(const Matrix& m) {
    const glm::dmat3 product = glm::transpose(glm::dmat3(m)) * glm::dmat3(m) - glm::dmat3(1.0);
    double worst = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) worst = std::max(worst, std::abs(product[c][r]));
    return worst;
}

// Rotations that ten thousand steps leave orthogonal to 1e-6 turn light without visible loss: a level of
// 1,023 is a thousand times that.
constexpr double kOrthogonal = 1e-6;

TEST(LightRotationDrift, MatrixComposedInFloatsIsMended) {
    test::StabilityRow row("harmonics/mended", "10,000 rotations composed in floats, then mended",
                           "departure from orthogonality", kOrthogonal, "");
    glm::mat3 composed(1.0f);
    glm::mat3 mended(1.0f);
    for (const glm::dmat3& step : steps()) {
        composed = glm::mat3(step) * composed;
        mended = glm::mat3(nearestRotation(glm::dmat3(glm::mat3(step) * mended)));
        ASSERT_LT(worstOrthogonality(mended), 1e-6);
    }
    EXPECT_GT(worstOrthogonality(composed), 1e-6) << "nothing to mend: the test shows nothing";
    const HarmonicsRotation rotation(composed, kMaxHarmonicsOrder);
    for (int l = 0; l < kMaxHarmonicsOrder; ++l) row.saw(worstOrthogonality(rotation.band(l), 2 * l + 1));
}

TEST(LightRotationDrift, MatrixComposedInDoublesStaysARotation) {
    test::StabilityRow row("harmonics/doubles", "10,000 rotations composed in doubles",
                           "departure from orthogonality", kOrthogonal, "");
    glm::dmat3 composed(1.0);
    for (const glm::dmat3& step : steps()) composed = step * composed;
    row.saw(worstOrthogonality(composed));
    const HarmonicsRotation rotation(composed, kMaxHarmonicsOrder);
    for (int l = 0; l < kMaxHarmonicsOrder; ++l) row.saw(worstOrthogonality(rotation.band(l), 2 * l + 1));
}

// The bands' own matrices multiplied: orthogonal still, and the same as those of the composed rotation.
TEST(LightRotationDrift, BandsComposedStayThoseOfTheComposedRotation) {
    const auto all = steps();
    std::array<std::vector<double>, kMaxHarmonicsOrder> products;
    for (int l = 0; l < kMaxHarmonicsOrder; ++l) {
        products[l].assign((2 * l + 1) * (2 * l + 1), 0.0);
        for (int i = 0; i < 2 * l + 1; ++i) products[l][i * (2 * l + 2)] = 1;
    }
    glm::dmat3 composed(1.0);
    for (const glm::dmat3& step : all) {
        const HarmonicsRotation rotation(step, kMaxHarmonicsOrder);
        composed = step * composed;
        for (int l = 0; l < kMaxHarmonicsOrder; ++l) {
            const int n = 2 * l + 1;
            const auto band = rotation.band(l);
            std::vector<double> next(products[l].size(), 0.0);
            for (int i = 0; i < n; ++i)
                for (int k = 0; k < n; ++k)
                    for (int j = 0; j < n; ++j) next[i * n + j] += band[i * n + k] * products[l][k * n + j];
            products[l].swap(next);
        }
    }
    const HarmonicsRotation whole(composed, kMaxHarmonicsOrder);
    for (int l = 0; l < kMaxHarmonicsOrder; ++l) {
        test::StabilityRow row("harmonics/band/" + std::to_string(l),
                               "matrices of band " + std::to_string(l) + " multiplied 10,000 times",
                               "departure from orthogonality and from the composed rotation's", kOrthogonal,
                               "");
        row.saw(worstOrthogonality(products[l], 2 * l + 1));
        for (std::size_t i = 0; i < products[l].size(); ++i)
            row.saw(std::abs(products[l][i] - whole.band(l)[i]));
    }
}

// Light carried along by rotating its coefficients each frame, in floats as the program holds them.
TEST(LightRotationDrift, CoefficientsTurnedTenThousandTimesKeepTheirPower) {
    std::vector<glm::vec3> c(harmonicsCount(5)), next(c.size());
    for (std::size_t i = 0; i < c.size(); ++i)
        c[i] = glm::vec3(1.0f / static_cast<float>(i + 1), 0.5f, -2.0f);
    const auto power = [&](int l) {
        double sum = 0;
        for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum += glm::dot(glm::dvec3(c[i]), glm::dvec3(c[i]));
        return sum;
    };
    std::array<double, 5> before;
    for (int l = 0; l < 5; ++l) before[l] = power(l);
    for (const glm::dmat3& step : steps()) {
        HarmonicsRotation(step, 5).apply(c.data(), next.data());
        c.swap(next);
    }
    // Each turn rounds a coefficient to 2^-24 some (2 l + 1) times: 10,000 walks of that, of either sign.
    test::StabilityRow row("harmonics/power", "coefficients in floats turned 10,000 times",
                           "relative change of a band's power", 2 * 9 * 0x1p-24 * 100, "");
    for (int l = 0; l < 5; ++l) row.saw(std::abs(power(l) / before[l] - 1));
}

}  // namespace
}  // namespace stereonav
