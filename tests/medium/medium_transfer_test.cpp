// Transfer functions of media: extinctions from opacities, mixing, ranges, what is refused; and their table.
#include "engine/medium/model/medium_transfer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "engine/medium/model/medium_table.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

MediumMaterial materialOf(double opacity, const glm::vec3& color = glm::vec3(1.0f)) {
    MediumMaterial m;
    m.opacity = opacity;
    m.color = color;
    return m;
}

using test::errorOf;

MediumTransfer ramp() {
    return MediumTransfer(
        {{-100, materialOf(0, {0, 0, 1})}, {0, materialOf(0.5, {1, 0, 0})}, {50, materialOf(0.9)}}, 0.002,
        "test");
}

TEST(MediumTransfer, ALayerOfTheReferenceLengthTakesItsOpacity) {
    for (const double opacity : {0.0, 1e-6, 0.1, 0.5, 0.999, 1.0}) {
        const MediumTransfer function({{0, materialOf(opacity)}}, 0.002, "test");
        const double tau = function.at(0, 0).extinction;
        EXPECT_NEAR(1 - std::exp(-tau * 0.002), std::min(opacity, MediumTransfer::kDensest), 1e-7) << opacity;
        EXPECT_NEAR(std::exp(-function.at(0, 0).indirectExtinction.y * 0.002), opacity > 0 ? 0.5 : 1, 1e-6)
            << opacity;
    }
}

TEST(MediumTransfer, ExtinctionIsLinearBetweenPoints) {
    const MediumTransfer function = ramp();
    const double first = -std::log(0.5) / 0.002, second = -std::log(0.1) / 0.002;
    EXPECT_NEAR(function.at(-50, 0).extinction, first / 2, 1e-3);
    EXPECT_NEAR(function.at(0, 0).extinction, first, 1e-3);
    EXPECT_NEAR(function.at(20, 0).extinction, 0.6 * first + 0.4 * second, 1e-3);
    EXPECT_NEAR(function.at(1e9, 0).extinction, second, 1e-3);
    EXPECT_EQ(function.at(-1e9, 0).extinction, 0.0f);
    EXPECT_EQ(MediumTransfer().at(0, 0).extinction, 0.0f);
}

TEST(MediumTransfer, TransparentNeighboursDoNotBleed) {
    const MediumTransfer function = ramp();
    for (const double value : {-99.999, -50.0, -1.0, 0.0}) {
        EXPECT_FLOAT_EQ(function.at(value, 0).color.x, 1.0f) << value;
        EXPECT_FLOAT_EQ(function.at(value, 0).color.z, 0.0f) << value;
    }
    const double first = -std::log(0.5), second = -std::log(0.1);
    EXPECT_NEAR(function.at(25, 0).color.y, second / (first + second), 1e-6);
}

MediumRegion region(double a, double b, double c, double d, double opacity, const glm::vec3& color) {
    return {{a, b, c, d}, {0, 0, kInfinity, kInfinity}, materialOf(opacity, color)};
}

TEST(MediumTransfer, RegionsAddUpByExtinction) {
    MediumRegion steep = region(0, 10, 20, 30, 0.5, {1, 0, 0});
    const double edges[4] = {100, 200, 300, 500};
    std::copy_n(edges, 4, steep.gradient);
    const MediumTransfer function({steep, region(15, 25, 35, 45, 0.75, {0, 1, 0})}, 1, "test");
    const double red = -std::log(0.5), green = -std::log(0.25);
    EXPECT_NEAR(function.at(15, 250).extinction, red, 1e-6);
    EXPECT_NEAR(function.at(5, 150).extinction, red / 4, 1e-6);
    EXPECT_NEAR(function.at(15, 400).extinction, red / 2, 1e-6);
    EXPECT_EQ(function.at(15, 50).extinction, 0.0f);
    EXPECT_NEAR(function.at(20, 250).extinction, red + green / 2, 1e-6);
    EXPECT_NEAR(function.at(20, 250).color.x, red / (red + green / 2), 1e-6);
    EXPECT_NEAR(function.at(30, 1e30).color.y, 1, 1e-6);
    EXPECT_EQ(function.visibleRange().lowest, 0);
    EXPECT_EQ(function.visibleRange().highest, 45);
    EXPECT_EQ(function.largestGradient(), 500);
    EXPECT_TRUE(function.usesGradient());
}

TEST(MediumTransfer, SurfaceRampFollowsTheGradient) {
    MediumMaterial m = materialOf(0.5);
    m.surface = 0.8;
    MediumTransfer function({{0, m}}, 1, "test");
    EXPECT_FLOAT_EQ(function.at(0, 0).surface, 0.8f);
    function.setSurfaceRamp(10, 30, "test");
    EXPECT_EQ(function.at(0, 5).surface, 0.0f);
    EXPECT_FLOAT_EQ(function.at(0, 20).surface, 0.4f);
    EXPECT_FLOAT_EQ(function.at(0, 99).surface, 0.8f);
    EXPECT_EQ(makeMediumTable(function, 0, 255).rows, MediumTable::kGradients + 1);
    EXPECT_NE(errorOf([&] { function.setSurfaceRamp(3, 3, "x"); }), "no error");
    EXPECT_NE(errorOf([&] { function.setSurfaceRamp(kNotANumber, 3, "x"); }), "no error");
}

TEST(MediumTransfer, KnowsWhereSomethingIsVisible) {
    EXPECT_EQ(ramp().visibleRange().lowest, -100);
    EXPECT_EQ(ramp().visibleRange().highest, kInfinity);
    EXPECT_GT(MediumTransfer().visibleRange().lowest, MediumTransfer().visibleRange().highest);
}

TEST(MediumTransfer, RefusesBadNumbers) {
    const auto pointError = [](MediumMaterial m, double value = 0, double length = 1) {
        return errorOf([&] { MediumTransfer({{-5, materialOf(0)}, {value, m}}, length, "wax.txt"); });
    };
    EXPECT_EQ(pointError(materialOf(0.5)), "no error");
    EXPECT_THAT(pointError(materialOf(1.5)),
                AllOf(HasSubstr("wax.txt:point 2"), HasSubstr("opacity"), HasSubstr("1.5")));
    EXPECT_THAT(pointError(materialOf(kNotANumber)), AllOf(HasSubstr("opacity"), Not(HasSubstr("\n"))));
    EXPECT_THAT(pointError(materialOf(0.5, {0, 2, 0})), HasSubstr("colour"));
    EXPECT_THAT(pointError(materialOf(0.5), -5), HasSubstr("expected a value above -5"));
    EXPECT_THAT(pointError(materialOf(0.5), kNotANumber), HasSubstr("finite value"));
    for (const double length : {0.0, -1.0, kNotANumber, kInfinity, 1e-30})
        EXPECT_THAT(pointError(materialOf(0.5), 0, length), HasSubstr("reference length")) << length;
    MediumMaterial bad = materialOf(0.5);
    bad.glow.y = -1;
    EXPECT_THAT(pointError(bad), HasSubstr("glow"));
    bad = materialOf(0.5);
    bad.surface = 2;
    EXPECT_THAT(pointError(bad), HasSubstr("surface weight"));
    bad = materialOf(0.5);
    bad.transport.z = -0.1f;
    EXPECT_THAT(pointError(bad), HasSubstr("transport"));
}

TEST(MediumTransfer, RefusesRegionsWithoutRamps) {
    const auto error = [](const MediumRegion& r) {
        return errorOf([&] { MediumTransfer({r}, 1, "a.txt"); });
    };
    EXPECT_EQ(error(region(0, 1, 1, 2, 0.5, {})), "no error");
    EXPECT_THAT(error(region(0, 0, 1, 2, 0.5, {})), HasSubstr("a.txt:region 1: expected four finite values"));
    EXPECT_THAT(error(region(0, 2, 1, 3, 0.5, {})), HasSubstr("A < B <= C < D"));
    EXPECT_THAT(error(region(0, 1, 2, kInfinity, 0.5, {})), HasSubstr("A < B <= C < D"));
    MediumRegion r = region(0, 1, 1, 2, 0.5, {});
    r.gradient[3] = kNotANumber;
    r.gradient[2] = 5;
    EXPECT_THAT(error(r), HasSubstr("gradient magnitudes"));
    r.gradient[3] = kInfinity;
    EXPECT_EQ(error(r), "no error");
    r.gradient[0] = -1;
    EXPECT_THAT(error(r), HasSubstr("gradient magnitudes"));
}

TEST(MediumTable, WholeNumbersAreLookedUpExactly) {
    const MediumTransfer function(
        {{20, materialOf(0)}, {21, materialOf(0.5)}, {30, materialOf(0.1)}, {200, materialOf(0.9)}}, 0.001,
        "test");
    const MediumTable table = makeMediumTable(function, 0, 255);
    for (int value = 0; value <= 255; ++value)
        EXPECT_EQ(table.at(value, 0).extinction, function.at(value, 0).extinction) << value;
    for (double value = 0; value <= 255; value += 0.37)
        EXPECT_NEAR(table.at(value, 0).extinction, function.at(value, 0).extinction, 1e-3) << value;
}

TEST(MediumTable, FollowsTheFunctionOverWideAndNarrowRanges) {
    for (const double scale : {1e-6, 1e-3, 1.0, 13.7, 1e6}) {
        const MediumTransfer function({{-10 * scale, materialOf(0)}, {70 * scale, materialOf(0.9)}}, 1,
                                      "test");
        const MediumTable table = makeMediumTable(function, -100 * scale, 90 * scale);
        const double slope = function.at(70 * scale, 0).extinction / 80;
        for (double x = -100; x <= 90; x += 1.7)
            EXPECT_NEAR(table.at(x * scale, 0).extinction, function.at(x * scale, 0).extinction, slope * 0.2)
                << x << " " << scale;
        EXPECT_EQ(table.at(-10 * scale, 0).extinction, 0.0f) << scale;
        EXPECT_EQ(table.at(-99 * scale, 0).extinction, 0.0f) << scale;
    }
}

TEST(MediumTable, AStepIsWithinTwoEntries) {
    const MediumTransfer function({{100, materialOf(0)}, {100.001, materialOf(0.5)}, {2000, materialOf(0.5)}},
                                  1, "test");
    const MediumTable table = makeMediumTable(function, -1000, 3000);
    const double step = 1 / table.perValue;
    EXPECT_LE(step, 3000.0 / 1024);
    EXPECT_EQ(table.at(100 - 2 * step, 0).extinction, 0.0f);
    EXPECT_EQ(table.at(100 + 2 * step, 0).extinction, function.at(200, 0).extinction);
}

TEST(MediumTable, TheLargestExtinctionIsABound) {
    const MediumTransfer function(
        {{0, materialOf(0.1)}, {3, materialOf(0.9)}, {7, materialOf(0)}, {9, materialOf(0.3)}}, 1, "test");
    const MediumTable table = makeMediumTable(function, -2.5, 11.25);
    for (double low = -4; low < 13; low += 0.31)
        for (double high = low; high < 13; high += 0.47) {
            const float bound = table.largestExtinction(low, high);
            float found = 0;
            for (double value = low; value <= high; value += 0.0157)
                found = std::max(found, table.at(value, 0).extinction);
            ASSERT_LE(found, bound) << low << " " << high;
            ASSERT_GE(found, bound - 0.1f) << low << " " << high;  // one entry's rise
        }
    EXPECT_EQ(table.largestExtinction(3, 2), 0.0f);
}

TEST(MediumTable, EmptyEntriesHaveTheirNeighboursColour) {
    const MediumTable table = makeMediumTable(ramp(), -1000, 1000);
    for (double value = -100; value < 0; value += 0.01) {
        const OpticalProperties p = table.at(value, 0);
        ASSERT_EQ(p.color, glm::vec3(1, 0, 0)) << value;
    }
}

TEST(MediumTable, TwoDimensionsAgreeWithTheFunctionAtTheEntries) {
    MediumRegion r = region(100, 200, 400, 500, 0.5, {1, 0, 0});
    const double edges[4] = {1000, 2000, 3000, 4000};
    std::copy_n(edges, 4, r.gradient);
    const MediumTransfer function({r, region(50, 60, 110, 130, 0.2, {0, 0, 1})}, 0.01, "test");
    const MediumTable table = makeMediumTable(function, -1000, 3000);
    ASSERT_EQ(table.rows, 65);
    for (double value = 0; value < 600; value += 3.1)
        for (double gradient = 0; gradient <= 5000; gradient += 4000.0 / 64)
            ASSERT_NEAR(table.at(value, gradient).extinction, function.at(value, gradient).extinction, 0.5)
                << value << " " << gradient;
}

TEST(MediumTable, NothingVisibleAndOneValue) {
    const MediumTransfer function({{0, materialOf(0)}, {10, materialOf(0.5)}}, 1, "test");
    const MediumTable none = makeMediumTable(function, -50, -10);
    EXPECT_EQ(none.at(5, 0).extinction, 0.0f);
    EXPECT_GT(none.visibleRange().lowest, none.visibleRange().highest);
    EXPECT_FLOAT_EQ(makeMediumTable(function, 5, 5).at(5, 0).extinction, function.at(5, 0).extinction);
    EXPECT_FLOAT_EQ(makeMediumTable(function, 50, 60).at(55, 0).extinction, function.at(55, 0).extinction);
    EXPECT_EQ(MediumTable().at(5, 0).extinction, 0.0f);
    EXPECT_EQ(makeMediumTable(MediumTransfer(), 0, 1).at(kNotANumber, 0).extinction, 0.0f);
}

}  // namespace
}  // namespace stereonav
