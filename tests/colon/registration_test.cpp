// Lines registered with themselves, and with what they become when they are stretched, widened and bent.
#include "colon/instruments/registration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "colon/instruments/finding.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

// A winding line, u in [0, 1], with a radius that goes up and down along it.
CentrelinePoint pointAt(double u, double bend) {
    const glm::dvec3 place(0.1 * std::sin(5 * u) + bend * std::sin(17 * u + 1), 0.06 * std::cos(9 * u),
                           0.3 * u + bend * std::cos(13 * u));
    return {place, 0.015 + 0.004 * std::sin(23 * u) + 0.003 * std::sin(41 * u + 2), 1};
}

Centreline winding(double bend, double inflation, double (*speed)(double), int count = 1200) {
    Centreline line;
    for (int n = 0; n <= count; ++n) {
        line.points.push_back(pointAt(speed(static_cast<double>(n) / count), bend));
        line.points.back().radius *= inflation;
    }
    return line;
}
double even(double u) {
    return u;
}

TEST(Registration, OfALineWithItselfIsExact) {
    const Centreline line = winding(0, 1, even);
    const LineRegistration same(line, line);
    EXPECT_NEAR(same.cost(), 0, 1e-12);
    for (double along = 0; along <= line.length(); along += 0.01) {
        EXPECT_NEAR(same.toSecond(along), along, 1e-9);
        EXPECT_NEAR(same.toFirst(along), along, 1e-9);
    }
    EXPECT_EQ(same.toSecond(-1), 0);
    EXPECT_NEAR(same.toSecond(9), line.length(), 1e-9);
}

TEST(Registration, FindsPlacesOfABentAndInflatedLine) {
    const Centreline a = winding(0, 1, even), b = winding(0.006, 1.2, even);
    const LineRegistration registration(a, b);
    double worst = 0, byShare = 0;
    for (double u = 0.02; u < 1; u += 0.02) {
        const double first = alongLine(a, pointAt(u, 0).position),
                     second = alongLine(b, pointAt(u, 0.006).position);
        worst = std::max(worst, std::abs(registration.toSecond(first) - second));
        byShare = std::max(byShare, std::abs(first / a.length() * b.length() - second));
        EXPECT_NEAR(registration.toFirst(registration.toSecond(first)), first, 0.007);
    }
    EXPECT_LT(worst, 0.012);
    EXPECT_LT(worst, byShare) << "better than the share of the length alone";
}

// A patient who has turned round, with more gas, is still the same; another one is not, whatever the way up.
TEST(Registration, KnowsTwoColonsApart) {
    const Centreline a = winding(0, 1, even);
    EXPECT_TRUE(LineRegistration(a, a).matches());
    EXPECT_TRUE(LineRegistration(a, winding(0.006, 1.2, even)).matches());
    EXPECT_TRUE(LineRegistration(winding(0.006, 0.8, even), a).matches());
    Centreline other = a, longer = a, back = a;
    for (std::size_t n = 0; n < other.points.size(); ++n) {
        const double u = static_cast<double>(n) / static_cast<double>(other.points.size() - 1);
        other.points[n].position = {0.12 * std::cos(4 * u), 0.05 * std::sin(7 * u + 1),
                                    0.1 * std::sin(6 * u)};
        longer.points[n].position =
            a.points[n].position + glm::dvec3(0, 0.05 * std::sin(40 * u), 0.2 * u * u);
        back.points[n] = a.points[a.points.size() - 1 - n];
    }
    for (const Centreline& line : {other, longer, back}) {
        EXPECT_FALSE(LineRegistration(a, line).matches()) << LineRegistration(a, line).cost();
        EXPECT_FALSE(LineRegistration(line, a).matches());
    }
}

TEST(Registration, NeverGoesBack) {
    const LineRegistration registration(winding(0, 1, even), winding(0.01, 0.8, even));
    double before = -1;
    for (double along = 0; along < 1; along += 0.001) {
        EXPECT_GE(registration.toSecond(along), before);
        before = registration.toSecond(along);
    }
}

TEST(Registration, TakesLinesOfAnyLength) {
    const auto straight = [](double length, int count) {
        Centreline line;
        for (int n = 0; n < count; ++n) line.points.push_back({{0, 0, length * n / (count - 1)}, 0.01, 1});
        return line;
    };
    const LineRegistration apart(straight(0.01, 2), straight(1, 50));
    EXPECT_NEAR(apart.toSecond(0.01), 1, 1e-9);
    EXPECT_NEAR(apart.toSecond(0.005), 0.5, 0.3);
    EXPECT_THROW(LineRegistration(straight(1, 2), Centreline{}), Error);
    Centreline one;
    one.points.push_back({});
    EXPECT_THROW(LineRegistration(one, straight(1, 2)), Error);
    one.points.push_back({});
    EXPECT_THROW(LineRegistration(one, straight(1, 2)), Error) << "no length";
}

TEST(Registration, PlacesAlongALine) {
    Centreline line;
    line.points = {{{0, 0, 0}, 1, 1}, {{0, 0, 1}, 1, 1}, {{0, 1, 1}, 1, 1}};
    EXPECT_EQ(placeAlong(line, -1), glm::dvec3(0, 0, 0));
    EXPECT_EQ(placeAlong(line, 1.25), glm::dvec3(0, 0.25, 1));
    EXPECT_EQ(placeAlong(line, 5), glm::dvec3(0, 1, 1));
}

}  // namespace
}  // namespace stereonav
