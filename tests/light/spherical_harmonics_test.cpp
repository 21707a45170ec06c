// Spherical harmonics against the standard library's, closed forms and an exact quadrature.
#include "engine/light/skies/spherical_harmonics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/math/constants.h"
#include "sphere_quadrature.h"

namespace stereonav {
namespace {

double factorial(int n) {
    return std::tgamma(n + 1.0);
}

// Eq. 12 as it is printed, with the library's associated Legendre functions (which have no Condon-Shortley
// phase).
double equation12(int l, int m, double polar, double azimuth) {
    const int a = std::abs(m);
    const double n = std::sqrt((2 * l + 1) / (4 * kPi) * factorial(l - a) / factorial(l + a));
    const double p = n * std::assoc_legendre(l, a, std::cos(polar));
    if (m == 0) return p;
    return std::sqrt(2.0) * p * (m > 0 ? std::cos(m * azimuth) : std::sin(a * azimuth));
}

glm::dvec3 directionAt(double polar, double azimuth) {
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

TEST(SphericalHarmonics, EqualTheEquationOfThePaper) {
    for (int a = 0; a <= 24; ++a)
        for (int b = 0; b < 29; ++b) {
            const double polar = kPi * a / 24, azimuth = 2 * kPi * b / 29 - kPi;
            std::array<double, kMaxHarmonics> values;
            evaluateHarmonics(directionAt(polar, azimuth), kMaxHarmonicsOrder, values.data());
            for (int l = 0; l < kMaxHarmonicsOrder; ++l)
                for (int m = -l; m <= l; ++m)
                    ASSERT_NEAR(values[l * (l + 1) + m], equation12(l, m, polar, azimuth), 1e-12)
                        << l << " " << m << " at " << polar << " " << azimuth;
        }
}

// std::sph_legendre has the phase (-1)^m, which ours has not.
TEST(SphericalHarmonics, EqualTheLibrarysButForItsPhase) {
    for (int a = 0; a <= 40; ++a) {
        const double polar = kPi * a / 40;
        std::array<double, kMaxHarmonics> values;
        evaluateHarmonics(directionAt(polar, 0.0), kMaxHarmonicsOrder, values.data());
        for (int l = 0; l < kMaxHarmonicsOrder; ++l)
            for (int m = 0; m <= l; ++m) {
                const double expected =
                    std::sph_legendre(l, m, polar) * (m % 2 ? -1 : 1) * (m ? std::sqrt(2.0) : 1.0);
                ASSERT_NEAR(values[l * (l + 1) + m], expected, 1e-12) << l << " " << m << " at " << polar;
            }
    }
}

TEST(SphericalHarmonics, OrthonormalByExactQuadrature) {
    for (int order = 1; order <= kMaxHarmonicsOrder; ++order) {
        const int n = harmonicsCount(order);
        std::vector<double> products(static_cast<std::size_t>(n) * n, 0.0);
        test::integrateOverSphere([&](const glm::dvec3& w, double weight) {
            std::array<double, kMaxHarmonics> y;
            evaluateHarmonics(w, order, y.data());
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) products[i * n + j] += weight * y[i] * y[j];
        });
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) ASSERT_NEAR(products[i * n + j], i == j, 1e-12) << i << " " << j;
    }
}

TEST(SphericalHarmonics, FloatsOrthonormalToAMillionth) {
    std::vector<double> products(kMaxHarmonics * kMaxHarmonics, 0.0);
    test::integrateOverSphere([&](const glm::dvec3& w, double weight) {
        std::array<float, kMaxHarmonics> y;
        evaluateHarmonics(glm::vec3(w), kMaxHarmonicsOrder, y.data());
        for (int i = 0; i < kMaxHarmonics; ++i)
            for (int j = 0; j < kMaxHarmonics; ++j) products[i * kMaxHarmonics + j] += weight * y[i] * y[j];
    });
    for (int i = 0; i < kMaxHarmonics; ++i)
        for (int j = 0; j < kMaxHarmonics; ++j)
            ASSERT_NEAR(products[i * kMaxHarmonics + j], i == j, 1e-6) << i << " " << j;
}

TEST(SphericalHarmonics, ClosedFormsOfTheFirstBands) {
    const glm::dvec3 w = glm::normalize(glm::dvec3(0.3, -0.7, 0.4));
    std::array<double, 9> y;
    evaluateHarmonics(w, 3, y.data());
    EXPECT_NEAR(y[0], std::sqrt(1 / (4 * kPi)), 1e-15);
    EXPECT_NEAR(y[1], std::sqrt(3 / (4 * kPi)) * w.y, 1e-15);
    EXPECT_NEAR(y[2], std::sqrt(3 / (4 * kPi)) * w.z, 1e-15);
    EXPECT_NEAR(y[3], std::sqrt(3 / (4 * kPi)) * w.x, 1e-15);
    EXPECT_NEAR(y[4], std::sqrt(15 / (4 * kPi)) * w.x * w.y, 1e-15);
    EXPECT_NEAR(y[6], std::sqrt(5 / (16 * kPi)) * (3 * w.z * w.z - 1), 1e-15);
    EXPECT_NEAR(y[8], std::sqrt(15 / (16 * kPi)) * (w.x * w.x - w.y * w.y), 1e-15);
}

// At the poles all with m != 0 vanish, and the others are sqrt((2l + 1) / 4 pi), times (-1)^l below.
TEST(SphericalHarmonics, AtBothPoles) {
    for (const double z : {1.0, -1.0}) {
        std::array<double, kMaxHarmonics> y;
        std::array<float, kMaxHarmonics> yf;
        evaluateHarmonics(glm::dvec3(0, 0, z), kMaxHarmonicsOrder, y.data());
        evaluateHarmonics(glm::vec3(0, 0, z), kMaxHarmonicsOrder, yf.data());
        for (int l = 0; l < kMaxHarmonicsOrder; ++l)
            for (int m = -l; m <= l; ++m) {
                const double expected =
                    m ? 0 : std::sqrt((2 * l + 1) / (4 * kPi)) * (z < 0 && l % 2 ? -1 : 1);
                ASSERT_NEAR(y[l * (l + 1) + m], expected, 1e-14);
                ASSERT_NEAR(yf[l * (l + 1) + m], expected, 1e-6);
            }
    }
}

TEST(SphericalHarmonics, LowerOrdersAreTheFirstOfHigherOnes) {
    const glm::dvec3 w = glm::normalize(glm::dvec3(-0.2, 0.5, -0.6));
    std::array<double, kMaxHarmonics> all;
    evaluateHarmonics(w, kMaxHarmonicsOrder, all.data());
    for (int order = 1; order <= kMaxHarmonicsOrder; ++order) {
        std::array<double, kMaxHarmonics + 1> some;
        some.fill(7);
        evaluateHarmonics(w, order, some.data());
        for (int i = 0; i < harmonicsCount(order); ++i) ASSERT_DOUBLE_EQ(some[i], all[i]) << order;
        ASSERT_EQ(some[harmonicsCount(order)], 7) << "written beyond the order";
    }
}

}  // namespace
}  // namespace stereonav
