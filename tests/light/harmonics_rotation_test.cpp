// Rotated harmonics against the rotated functions themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/base/error.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "sphere_quadrature.h"
#include "turns.h"

namespace stereonav {
namespace {

using test::about;
using test::randomTurn;

using Function = std::function<double(const glm::dvec3&)>;

std::vector<double> projected(const Function& f, int order) {
    std::vector<double> sums(harmonicsCount(order), 0.0);
    test::integrateOverSphere([&](const glm::dvec3& w, double weight) {
        std::array<double, kMaxHarmonics> y;
        evaluateHarmonics(w, order, y.data());
        for (int i = 0; i < harmonicsCount(order); ++i) sums[i] += weight * f(w) * y[i];
    });
    return sums;
}

// A polynomial of degree 9, without any symmetry.
double lopsided(const glm::dvec3& w) {
    const double a = glm::dot(w, glm::dvec3(0.3, -0.5, 0.8)), b = glm::dot(w, glm::dvec3(-0.6, 0.4, 0.1));
    return std::pow(1 + a, 4) + 0.5 * a * a * b - 0.3 * std::pow(b, 5) +
           w.x * w.y * w.z * std::pow(0.7 + w.y, 6);
}

double worstOrthogonality(const HarmonicsRotation& rotation) {
    double worst = 0;
    for (int l = 0; l < rotation.order(); ++l) {
        const auto band = rotation.band(l);
        const int n = 2 * l + 1;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                double dot = 0;
                for (int k = 0; k < n; ++k) dot += band[i * n + k] * band[j * n + k];
                worst = std::max(worst, std::abs(dot - (i == j)));
            }
    }
    return worst;
}

void expectTurnsTheFunction(const glm::dmat3& turn, int order) {
    const auto before = projected(lopsided, order);
    const glm::dmat3 back = glm::transpose(turn);
    const auto expected = projected([&](const glm::dvec3& w) { return lopsided(back * w); }, order);
    std::vector<double> turned(before.size());
    HarmonicsRotation(turn, order).apply(before.data(), turned.data());
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(turned[i], expected[i], 1e-11) << i;
}

TEST(HarmonicsRotation, EqualsProjectingTheRotatedFunction) {
    std::mt19937 random(1);
    for (int order = 1; order <= kMaxHarmonicsOrder; ++order)
        for (int n = 0; n < 20; ++n) expectTurnsTheFunction(randomTurn(random), order);
}

TEST(HarmonicsRotation, EqualsProjectingTheRotatedFunctionAboutTheAxes) {
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
        for (const double angle : {1e-9, 0.1, std::numbers::pi / 2, std::numbers::pi, -2.0})
            expectTurnsTheFunction(about(axis, angle), kMaxHarmonicsOrder);
}

// Y(R^-1 w) = R^T Y(w): point by point, beyond what the quadrature sees.
TEST(HarmonicsRotation, EqualsTheHarmonicsOfTurnedDirections) {
    std::mt19937 random(2);
    for (int n = 0; n < 200; ++n) {
        const glm::dmat3 turn = randomTurn(random);
        const glm::dvec3 w = randomTurn(random)[0];
        std::array<double, kMaxHarmonics> plain, turned, expected;
        evaluateHarmonics(w, kMaxHarmonicsOrder, plain.data());
        evaluateHarmonics(turn * w, kMaxHarmonicsOrder, expected.data());
        HarmonicsRotation(turn, kMaxHarmonicsOrder).apply(plain.data(), turned.data());
        for (int i = 0; i < kMaxHarmonics; ++i) ASSERT_NEAR(turned[i], expected[i], 1e-12) << i;
    }
}

TEST(HarmonicsRotation, MatricesAreOrthogonal) {
    std::mt19937 random(3);
    for (int n = 0; n < 200; ++n)
        ASSERT_LT(worstOrthogonality(HarmonicsRotation(randomTurn(random), kMaxHarmonicsOrder)), 1e-13);
}

TEST(HarmonicsRotation, IdentityLeavesAllAsItIs) {
    const HarmonicsRotation none(glm::dmat3(1.0), kMaxHarmonicsOrder);
    for (int l = 0; l < kMaxHarmonicsOrder; ++l) {
        const auto band = none.band(l);
        const int n = 2 * l + 1;
        ASSERT_EQ(band.size(), static_cast<std::size_t>(n) * n);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) ASSERT_NEAR(band[i * n + j], i == j, 1e-15);
    }
}

TEST(HarmonicsRotation, FirstBandIsTheMatrixItself) {
    std::mt19937 random(4);
    const glm::dmat3 turn = randomTurn(random);
    const HarmonicsRotation rotation(turn, 2);
    const auto band = rotation.band(1);
    const int axis[3] = {1, 2, 0};  // y, z, x
    for (int s = 0; s < 3; ++s)
        for (int t = 0; t < 3; ++t) ASSERT_NEAR(band[s * 3 + t], turn[axis[t]][axis[s]], 1e-15);
}

TEST(HarmonicsRotation, OneAfterTheOtherIsTheirProduct) {
    std::mt19937 random(5);
    const glm::dmat3 first = randomTurn(random), second = randomTurn(random);
    const auto c = projected(lopsided, kMaxHarmonicsOrder);
    std::vector<double> a(c.size()), b(c.size()), both(c.size());
    HarmonicsRotation(first, kMaxHarmonicsOrder).apply(c.data(), a.data());
    HarmonicsRotation(second, kMaxHarmonicsOrder).apply(a.data(), b.data());
    HarmonicsRotation(second * first, kMaxHarmonicsOrder).apply(c.data(), both.data());
    for (std::size_t i = 0; i < c.size(); ++i) ASSERT_NEAR(b[i], both[i], 1e-12);
}

TEST(HarmonicsRotation, ColoursTurnLikeNumbers) {
    std::mt19937 random(6);
    const HarmonicsRotation rotation(randomTurn(random), 5);
    const auto c = projected(lopsided, 5);
    std::vector<double> turned(c.size());
    std::vector<glm::vec3> colours(c.size()), turnedColours(c.size());
    for (std::size_t i = 0; i < c.size(); ++i) colours[i] = glm::vec3(c[i], 2 * c[i], -c[i]);
    rotation.apply(c.data(), turned.data());
    rotation.apply(colours.data(), turnedColours.data());
    for (std::size_t i = 0; i < c.size(); ++i)
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(turnedColours[i][k], turned[i] * (k == 0 ? 1 : k == 1 ? 2 : -1), 1e-5);
}

TEST(HarmonicsRotation, WhatIsNoRotationIsRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    glm::dmat3 mirror(1.0), flat(1.0), notANumber(1.0), infinite(1.0);
    mirror[1][1] = -1;
    flat[2] = flat[0];
    notANumber[1][0] = nan;
    infinite[1][0] = std::numeric_limits<double>::infinity();
    for (const glm::dmat3& bad : {mirror, flat, glm::dmat3(0.0), notANumber, infinite})
        EXPECT_THROW(HarmonicsRotation(bad, 3), Error);
    for (const int order : {-1, 0, 7}) EXPECT_THROW(HarmonicsRotation(glm::dmat3(1.0), order), Error);
}

TEST(NearestRotation, LeavesRotationsAndMendsScaledAndSkewedOnes) {
    std::mt19937 random(7);
    for (int n = 0; n < 100; ++n) {
        const glm::dmat3 turn = randomTurn(random);
        glm::dmat3 skewed = turn * 3.0;
        ASSERT_LT(test::distance(nearestRotation(turn), turn), 1e-14);
        ASSERT_LT(test::distance(nearestRotation(skewed), turn), 1e-14);
        ASSERT_LT(test::distance(nearestRotation(turn * 1e-200), turn), 1e-13);
        ASSERT_LT(test::distance(nearestRotation(turn * 1e200), turn), 1e-13);
        // The polar factor of R S, S symmetric and positive, is R.
        const glm::dmat3 stretch(1.2, 0.1, -0.05, 0.1, 0.9, 0.07, -0.05, 0.07, 1.05);
        ASSERT_LT(test::distance(nearestRotation(turn * stretch), turn), 1e-13);
    }
}

}  // namespace
}  // namespace stereonav
