// Probes in harmonics: known pictures in closed form, pixels by another quadrature, the real ones turned.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/light/skies/light_probe.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/math/constants.h"
#include "probe_pictures.h"
#include "turns.h"

namespace stereonav {
namespace {

using test::probeOf;
using test::randomProbe;

// Every pixel in cuts x cuts pieces, each by three Gauss-Legendre nodes a side in the polar angle and the
// azimuth: visit(direction, weight in steradians, radiance).
template <typename Visit>
void visitPieces(const LightProbe& probe, int cuts, Visit&& visit) {
    const int width = probe.width(), height = probe.height(), nodes = 3 * cuts;
    const double place[3] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)}, weight[3] = {5, 8, 5};
    const double extent = kPi / (height * cuts) * 2 * kPi / (width * cuts) / (18 * 18);
    for (int a = 0; a < height * nodes; ++a) {
        const double row = (a / 3 + place[a % 3]) / cuts - 0.5;
        const double stretch = extent * weight[a % 3] * std::sin(kPi * (row + 0.5) / height);
        for (int b = 0; b < width * nodes; ++b) {
            const double column = (b / 3 + place[b % 3]) / cuts - 0.5;
            const glm::vec3 centre(test::pixelDirection(b / nodes, a / nodes, width, height));
            visit(test::pixelDirection(column, row, width, height), stretch * weight[b % 3],
                  probe.radiance(centre));
        }
    }
}

// The coefficients of the probe turned by `turn`, by the turned directions of its pixels' pieces.
std::vector<glm::dvec3> byPieces(const LightProbe& probe, int order, int cuts, const glm::dmat3& turn) {
    std::vector<glm::dvec3> sums(harmonicsCount(order), glm::dvec3(0.0));
    visitPieces(probe, cuts, [&](const glm::dvec3& w, double solidAngle, const glm::vec3& radiance) {
        std::array<double, kMaxHarmonics> y;
        evaluateHarmonics(turn * w, order, y.data());
        for (int i = 0; i < harmonicsCount(order); ++i) sums[i] += solidAngle * y[i] * glm::dvec3(radiance);
    });
    return sums;
}

// Largest difference relative to the length of the expected vector.
template <typename A, typename B>
double difference(const std::vector<A>& found, const std::vector<B>& expected) {
    double most = 0, length = 0;
    EXPECT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        most = std::max(most, glm::length(glm::dvec3(found[i]) - glm::dvec3(expected[i])));
        length += glm::dot(glm::dvec3(expected[i]), glm::dvec3(expected[i]));
    }
    return most / std::sqrt(length);
}

std::vector<glm::vec3> turned(const glm::dmat3& turn, const std::vector<glm::vec3>& from, int order) {
    std::vector<glm::vec3> to(from.size());
    HarmonicsRotation(turn, order).apply(from.data(), to.data());
    return to;
}

TEST(ProbeProjection, ConstantIsTheFirstHarmonicAlone) {
    for (const auto& size : {std::array{1, 1}, {1, 7}, {7, 1}, {2, 2}, {33, 17}, {256, 128}}) {
        const auto c = probeOf(size[0], size[1], [](const glm::dvec3&) {
                           return glm::dvec3(1, 2, 3);
                       }).project(kMaxHarmonicsOrder);
        ASSERT_EQ(c.size(), 36u);
        for (int k = 0; k < 3; ++k) ASSERT_NEAR(c[0][k], (k + 1) * std::sqrt(4 * kPi), 1e-6 * (k + 1));
        for (int i = 1; i < 36; ++i) ASSERT_LT(glm::length(c[i]), 1e-12) << i << " of " << size[0];
    }
}

// The upper half: integrals of the Legendre polynomials from 0 to 1 (1, 1/2, 0, -1/8, 0, 1/16).
TEST(ProbeProjection, UpperHalfInClosedForm) {
    const auto c = probeOf(6, 2, [](const glm::dvec3& w) { return glm::dvec3(w.z > 0); }).project(6);
    const double integral[6] = {1, 0.5, 0, -0.125, 0, 0.0625};
    for (int l = 0; l < 6; ++l)
        for (int m = -l; m <= l; ++m) {
            const double expected = m ? 0 : std::sqrt((2 * l + 1) / (4 * kPi)) * 2 * kPi * integral[l];
            ASSERT_NEAR(c[l * (l + 1) + m].x, expected, 1e-7) << l << " " << m;
        }
}

TEST(ProbeProjection, LuneInClosedForm) {
    // azimuth from 0 to pi / 2: column 2 of 4, over all polar angles
    const LightProbe probe(4, 1, {glm::vec3(0), glm::vec3(0), glm::vec3(1), glm::vec3(0)}, "lune");
    const auto c = probe.project(2);
    EXPECT_NEAR(c[0].x, std::sqrt(1 / (4 * kPi)) * kPi, 1e-6);
    EXPECT_NEAR(c[1].x, std::sqrt(3 / (4 * kPi)) * kPi / 2, 1e-6);  // integral of sin^2 times that of sin phi
    EXPECT_NEAR(c[2].x, 0, 1e-12);
    EXPECT_NEAR(c[3].x, std::sqrt(3 / (4 * kPi)) * kPi / 2, 1e-6);
}

TEST(ProbeProjection, PixelsByAnotherQuadrature) {
    for (const auto& size : {std::array{1, 1}, {2, 1}, {1, 2}, {5, 3}, {16, 8}}) {
        const LightProbe probe = randomProbe(size[0], size[1], 31);
        const auto expected = byPieces(probe, kMaxHarmonicsOrder, 40, glm::dmat3(1.0));
        EXPECT_LT(difference(probe.project(kMaxHarmonicsOrder), expected), 1e-6)
            << size[0] << " x " << size[1];
    }
}

TEST(ProbeProjection, LowerOrdersAreTheFirstOfHigherOnes) {
    const LightProbe probe = randomProbe(20, 10, 32);
    const auto all = probe.project(kMaxHarmonicsOrder);
    for (int order = 1; order <= kMaxHarmonicsOrder; ++order) {
        const auto some = probe.project(order);
        ASSERT_EQ(some.size(), static_cast<std::size_t>(harmonicsCount(order)));
        for (std::size_t i = 0; i < some.size(); ++i)
            ASSERT_LT(glm::length(some[i] - all[i]), 1e-5f * glm::length(all[0]));
    }
    for (const int order : {-1, 0, 7}) EXPECT_THROW(probe.project(order), Error);
}

TEST(ProbeProjection, BlackAndDazzlingProbes) {
    const LightProbe black(4, 2, std::vector<glm::vec3>(8, glm::vec3(0.0f)), "black");
    for (const auto& c : black.project(5)) ASSERT_EQ(c, glm::vec3(0.0f));
    // One pixel 1e5 times the others: theirs is the constant, its is its own projection.
    std::vector<glm::vec3> pixels(64 * 32, glm::vec3(1.0f));
    pixels[64 * 9 + 40] = glm::vec3(1e5f);
    const LightProbe dazzling(64, 32, pixels, "peak");
    const auto found = dazzling.project(6);
    EXPECT_LT(difference(found, byPieces(dazzling, 6, 2, glm::dmat3(1.0))), 1e-6);
    std::array<double, 36> y;
    evaluateHarmonics(test::pixelDirection(40, 9, 64, 32), 6, y.data());
    const double solidAngle = 2 * kPi / 64 * (std::cos(kPi * 9 / 32) - std::cos(kPi * 10 / 32));
    for (int i = 1; i < 36; ++i)
        ASSERT_NEAR(found[i].x, (1e5 - 1) * solidAngle * y[i], 0.02 * 1e5 * solidAngle);
}

// Turns that carry pixels onto pixels: about z by whole columns, half turns about x.
void expectExactTurns(const LightProbe& probe) {
    const int width = probe.width(), height = probe.height();
    const auto plain = probe.project(kMaxHarmonicsOrder);
    for (const int shift : {1, width / 7, width / 2}) {
        std::vector<glm::vec3> pixels;
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i)
                pixels.push_back(probe.radiance(
                    glm::vec3(test::pixelDirection((i - shift + width) % width, j, width, height))));
        const LightProbe shifted(width, height, pixels, "shifted");
        const glm::dmat3 turn = test::about({0, 0, 1}, 2 * kPi * shift / width);
        EXPECT_LT(difference(turned(turn, plain, kMaxHarmonicsOrder), shifted.project(kMaxHarmonicsOrder)),
                  1e-6);
    }
    std::vector<glm::vec3> pixels;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            pixels.push_back(probe.radiance(
                glm::vec3(test::pixelDirection(width - 1 - i, height - 1 - j, width, height))));
    const LightProbe flipped(width, height, pixels, "flipped");
    EXPECT_LT(difference(turned(test::about({1, 0, 0}, kPi), plain, kMaxHarmonicsOrder),
                         flipped.project(kMaxHarmonicsOrder)),
              1e-6);
}

// About any axis: the pixels' pieces turned one by one.
void expectTurnsOfPieces(const LightProbe& probe, int turns, int cuts) {
    const auto plain = probe.project(kMaxHarmonicsOrder);
    std::mt19937 random(41);
    for (int n = 0; n < turns; ++n) {
        const glm::dmat3 turn = test::randomTurn(random);
        EXPECT_LT(difference(turned(turn, plain, kMaxHarmonicsOrder),
                             byPieces(probe, kMaxHarmonicsOrder, cuts, turn)),
                  1e-6);
    }
}

// About any axis, as a picture: a probe eight times as fine, filled by looking back through the turn.
void expectTurnedPicture(const LightProbe& probe, const glm::dmat3& turn, double tolerance) {
    const glm::dmat3 back = glm::transpose(turn);
    const LightProbe picture = probeOf(8 * probe.width(), 8 * probe.height(), [&](const glm::dvec3& w) {
        return glm::dvec3(probe.radiance(glm::vec3(back * w)));
    });
    const auto plain = probe.project(kMaxHarmonicsOrder);
    EXPECT_LT(difference(turned(turn, plain, kMaxHarmonicsOrder), picture.project(kMaxHarmonicsOrder)),
              tolerance);
}

TEST(ProbeProjection, TurnedProbes) {
    expectExactTurns(randomProbe(28, 14, 33));
    expectTurnsOfPieces(randomProbe(28, 14, 34), 10, 4);
}

// The norm's square that a reconstruction misses is what the picture has beyond it (Bessel).
void expectReconstructionMissesTheRest(const LightProbe& probe) {
    for (const int order : {1, 3, 6}) {
        const auto c = probe.project(order);
        double power = 0, kept = 0, missed = 0;
        for (const auto& v : c) kept += v.x * v.x;
        visitPieces(probe, 1, [&](const glm::dvec3& w, double solidAngle, const glm::vec3& radiance) {
            std::array<double, kMaxHarmonics> y;
            evaluateHarmonics(w, order, y.data());
            double value = 0;
            for (std::size_t i = 0; i < c.size(); ++i) value += c[i].x * y[i];
            power += solidAngle * radiance.x * radiance.x;
            missed += solidAngle * (radiance.x - value) * (radiance.x - value);
        });
        EXPECT_NEAR(missed, power - kept, 1e-6 * power) << order;
        EXPECT_LT(kept, power);
    }
}

class RealProbe : public testing::TestWithParam<const char*> {};

TEST_P(RealProbe, TurnsAndReconstructs) {
    const auto file = test::realProbe(GetParam());
    if (file.empty()) GTEST_SKIP() << "no real data: set STEREONAV_TEST_DATA";
    const LightProbe probe = readLightProbe(file);
    const auto c = probe.project(kMaxHarmonicsOrder);
    EXPECT_LT(glm::length(glm::dvec3(c[0]) / std::sqrt(4 * kPi) - glm::dvec3(probe.mean())), 1e-5);
    expectExactTurns(probe);
    expectTurnsOfPieces(probe, 3, 1);
    expectTurnedPicture(probe, test::about({1, -2, 0.7}, 1.1), 0.01);
    expectReconstructionMissesTheRest(probe);
}

INSTANTIATE_TEST_SUITE_P(ProbeProjection, RealProbe, testing::Values("grace.hdr", "uffizi.hdr"),
                         [](const auto& file) { return std::string(file.param, 0, 5); });

}  // namespace
}  // namespace stereonav
