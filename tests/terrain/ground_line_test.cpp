// Lengths, areas and volumes over ground against closed forms.
#include "terrain/survey/ground_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "terrain/survey/ground_area.h"
#include "terrain/survey/sun_hours.h"

namespace stereonav {
namespace {

// height: of a place in the world, in metres.
Heightfield shaped(int width, int height, const glm::dvec2& spacing,
                   const std::function<double(double, double)>& heightAt) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            heights.push_back(static_cast<float>(
                heightAt((i - 0.5 * (width - 1)) * spacing.x, (j - 0.5 * (height - 1)) * spacing.y)));
    return Heightfield(width, height, spacing, std::move(heights), "test");
}

using Places = std::vector<glm::dvec2>;

TEST(GroundLine, LengthsOnAPlaneAreThoseOfItsSlope) {
    const Heightfield plane =
        shaped(41, 31, {10, 14}, [](double x, double y) { return 0.75 * x - 0.25 * y + 50; });
    const Places line{{-150.5, -100}, {101.25, 37}, {101.25, 120}, {20, 120}};
    const LineMeasure m = measureLine(plane, line);
    double plan = 0, along = 0, climb = 0, descent = 0;
    for (std::size_t n = 1; n < line.size(); ++n) {
        const glm::dvec2 d = line[n] - line[n - 1];
        const double run = std::hypot(d.x, d.y), rise = 0.75 * d.x - 0.25 * d.y;
        plan += run, along += std::hypot(run, rise);
        (rise > 0 ? climb : descent) += std::abs(rise);
    }
    EXPECT_NEAR(m.plan, plan, 1e-9);
    EXPECT_NEAR(m.along, along, 2e-5);  // heights are floats
    EXPECT_NEAR(m.straight, along, 2e-5);
    EXPECT_NEAR(m.climb, climb, 1e-4);
    EXPECT_NEAR(m.descent, descent, 1e-4);
    EXPECT_NEAR(m.rise, climb - descent, 1e-4);
    const LineMeasure errors = errorsOfLine(plane, line, measureLine(plane, line));
    EXPECT_EQ(errors.plan, 0);
    EXPECT_LT(errors.along, 1e-4);
    EXPECT_LT(errors.rise, 1e-4);
}

// One cell whose height along its diagonal is 2 s (1 - s) times its edges': a parabola.
TEST(GroundLine, AParabolaHasItsLengthAndItsTop) {
    for (const glm::dvec2& size : {glm::dvec2(1, 1), {2, 0.5}, {0.5, 3}}) {
        const Heightfield cell = shaped(2, 2, size, [](double x, double y) { return x * y < 0 ? 1.0 : 0.0; });
        const LineMeasure m = measureLine(cell, {-0.5 * size, 0.5 * size});
        // Slopes go from 2 / plan to -2 / plan.
        const double plan = std::hypot(size.x, size.y), steep = 2 / plan,
                     along = plan * (std::sqrt(1 + steep * steep) + std::asinh(steep) / steep) / 2;
        EXPECT_NEAR(m.plan, plan, 1e-12);
        EXPECT_NEAR(m.along, along, 1e-12);
        EXPECT_NEAR(m.highest, 0.5, 1e-12);
        EXPECT_NEAR(m.lowest, 0, 1e-12);
        EXPECT_NEAR(m.climb, 0.5, 1e-12);
        EXPECT_NEAR(m.descent, 0.5, 1e-12);
        EXPECT_NEAR(m.straight, plan, 1e-12);
    }
}

// Parts of that parabola, up over its top and down less far, and of one that opens upwards.
TEST(GroundLine, ClimbAndDescentAreThoseOfEachSideOfATurn) {
    for (const double sign : {1.0, -1.0}) {
        const Heightfield cell =
            shaped(2, 2, {2, 0.5}, [&](double x, double y) { return x * y < 0 ? sign : 0.0; });
        for (const bool back : {false, true}) {
            // From share 0.1 of the diagonal, where the surface is at 0.18, over the middle at 0.5, to share
            // 0.7 at 0.42.
            const glm::dvec2 a = 0.1 * glm::dvec2(2, 0.5) - 0.5 * glm::dvec2(2, 0.5),
                             b = 0.7 * glm::dvec2(2, 0.5) - 0.5 * glm::dvec2(2, 0.5);
            const LineMeasure m = back ? measureLine(cell, {b, a}) : measureLine(cell, {a, b});
            const double first = back ? 0.42 : 0.18, last = back ? 0.18 : 0.42;
            EXPECT_NEAR(sign > 0 ? m.climb : m.descent, 0.5 - first, 1e-12) << back;
            EXPECT_NEAR(sign > 0 ? m.descent : m.climb, 0.5 - last, 1e-12) << back;
            EXPECT_NEAR(m.rise, sign * (last - first), 1e-8) << back;
            EXPECT_NEAR(sign > 0 ? m.highest : -m.lowest, 0.5, 1e-12) << back;
            EXPECT_NEAR(sign > 0 ? m.lowest : -m.highest, 0.18, 1e-12) << back;
        }
    }
}

TEST(GroundLine, PointsLieOnTheSurfaceAndEverWhereItBends) {
    const Heightfield hills =
        shaped(40, 30, {25, 20}, [](double x, double y) { return 60 * std::sin(x / 90) * std::cos(y / 70); });
    const Places line{{-301.7, -222.2}, {333.3, 250.1}, {-40, 100}};
    const std::vector<LinePoint> points = groundLine(hills, line);
    ASSERT_GT(points.size(), 60u);
    double polyline = 0;
    for (std::size_t n = 0; n < points.size(); ++n) {
        EXPECT_NEAR(points[n].height, hills.heightAt(points[n].world), 1e-9);
        if (n == 0) continue;
        ASSERT_GT(points[n].distance, points[n - 1].distance);
        polyline +=
            std::hypot(points[n].distance - points[n - 1].distance, points[n].height - points[n - 1].height);
    }
    const LineMeasure m = measureLine(hills, line);
    EXPECT_NEAR(points.back().distance, m.plan, 1e-9);
    EXPECT_NEAR(points.back().along, m.along, 1e-9);
    EXPECT_GE(m.along, polyline);  // chords are shorter than arcs
    EXPECT_LT(m.along, polyline * 1.01);
    EXPECT_GE(m.along, m.straight);
    EXPECT_NEAR(m.climb - m.descent, m.rise, 1e-9);
}

// The meridian of a sphere: an arc whose length is its radius times its angle. The error that is told holds.
TEST(GroundLine, AnArcIsWithinItsError) {
    constexpr double kRadius = 1000;
    for (const double spacing : {20.0, 40.0, 80.0}) {
        const int side = static_cast<int>(1200 / spacing) + 1;
        const Heightfield sphere = shaped(side, 25, {spacing, 31}, [](double x, double y) {
            return std::sqrt(kRadius * kRadius - x * x - y * y);
        });
        const Places line{{-500, 0}, {500, 0}};
        const double truth = kRadius * 2 * std::asin(0.5);
        const double error = std::abs(measureLine(sphere, line).along - truth);
        const double told = errorsOfLine(sphere, line, measureLine(sphere, line)).along;
        EXPECT_LE(error, told) << spacing;
        EXPECT_LT(told, 0.02 * truth);
        EXPECT_GT(told, 0);
    }
}

// Ground that is longer from south to north, and ground of few samples one way alone: what leaves half of
// them out can not tell.
TEST(GroundLine, TallAndNarrowGroundIsMeasuredToItsEnds) {
    for (const glm::ivec2& size : {glm::ivec2(4, 60), {60, 4}, {3, 60}, {60, 3}, {2, 9}}) {
        const Heightfield plane =
            shaped(size.x, size.y, {10, 14}, [](double x, double y) { return 0.5 * x + 0.25 * y; });
        const glm::dvec2 end = 0.5 * glm::dvec2(size - 1) * glm::dvec2(10, 14), way = 2.0 * end;
        const LineMeasure m = measureLine(plane, {-end, end}), errors = errorsOfLine(plane, {-end, end}, m);
        const double rise = 0.5 * way.x + 0.25 * way.y;
        EXPECT_NEAR(m.plan, glm::length(way), 1e-9) << size.x;
        EXPECT_NEAR(m.along, std::hypot(glm::length(way), rise), 1e-3) << size.x;
        EXPECT_NEAR(m.climb, rise, 1e-3) << size.x;
        EXPECT_EQ(std::isnan(errors.along), size.x < 4 || size.y < 4) << size.x;
        if (!std::isnan(errors.along)) {
            EXPECT_LT(errors.along, 1e-3) << size.x;
        }
        const GroundSamples samples(plane);
        for (const glm::dvec2& share : {glm::dvec2(0, 0), {1, 1}, {-1, 1}, {0.3, -0.9}}) {
            EXPECT_NEAR(samples.heightAt(share * end), 0.5 * share.x * end.x + 0.25 * share.y * end.y, 1e-4);
            EXPECT_TRUE(samples.contains(share * end));
        }
        for (const glm::dvec2& beside : {glm::dvec2(1.001, 0.5), {-1.001, 0.5}, {0.5, 1.001}, {0.5, -1.001}})
            EXPECT_FALSE(samples.contains(beside * end)) << beside.x << " " << beside.y;
    }
}

TEST(GroundLine, HolesLeaveWhatGoesThroughThemOpen) {
    const Heightfield holed = shaped(20, 20, {10, 12}, [](double x, double y) {
        return std::abs(x) < 20 && std::abs(y) < 20 ? std::nan("") : 5.0;
    });
    const LineMeasure through = measureLine(holed, {{-90, 0}, {90, 0}}),
                      beside = measureLine(holed, {{-90, 80}, {90, 80}});
    EXPECT_NEAR(through.plan, 180, 1e-9);
    EXPECT_TRUE(std::isnan(through.along));
    EXPECT_NEAR(through.rise, 0, 1e-9);
    EXPECT_NEAR(beside.along, 180, 1e-9);
}

TEST(GroundArea, APlaneSlopesByItsCosineAndVolumesAreWedges) {
    const Heightfield plane = shaped(41, 21, {10, 16}, [](double x, double) { return 0.5 * x; });
    // From x = -100 to 60: 0.5 x over and under 0.
    const Places area{{-100, -80}, {60, -80}, {60, 55.5}, {-100, 55.5}};
    for (const bool turned : {false, true}) {
        Places corners = area;
        if (turned) std::reverse(corners.begin(), corners.end());
        const AreaMeasure m = measureArea(plane, corners, 0);
        EXPECT_NEAR(m.plan, 160 * 135.5, 1e-6);
        EXPECT_NEAR(m.along, 160 * 135.5 * std::sqrt(1.25), 1e-2);
        EXPECT_NEAR(m.above, 0.25 * 60 * 60 * 135.5, 1e-3);
        EXPECT_NEAR(m.below, 0.25 * 100 * 100 * 135.5, 1e-3);
        EXPECT_NEAR(m.perimeter, 2 * (160 + 135.5), 1e-9);
        EXPECT_NEAR(m.lowest, -50, 1e-4);
        EXPECT_NEAR(m.highest, 30, 1e-4);
        const AreaMeasure errors = errorsOfArea(plane, corners, 0, m);
        EXPECT_LT(errors.along, 1e-2);
        EXPECT_LT(errors.above, 1);
    }
}

// A plane that slopes both ways, cells longer one way and then the other. Its surface is steeper by the same
// factor everywhere, and a plane through its height at the middle of a rectangle has as much over as under
// it.
TEST(GroundArea, CellsAreAsLongAndAsWideAsTheyAre) {
    for (const glm::dvec2& spacing : {glm::dvec2(12, 12), {20, 8}, {8, 20}}) {
        const Heightfield plane =
            shaped(1 + 2 * static_cast<int>(300 / spacing.x), 1 + 2 * static_cast<int>(250 / spacing.y),
                   spacing, [](double x, double y) { return 0.75 * x - 0.25 * y + 90; });
        const Places area{{-120.5, -90}, {100, -90}, {100, 61.25}, {-120.5, 61.25}};
        const double plan = 220.5 * 151.25, middle = 0.75 * -10.25 - 0.25 * -14.375 + 90;
        const AreaMeasure m = measureArea(plane, area, middle), low = measureArea(plane, area, middle - 300);
        EXPECT_NEAR(m.plan, plan, 1e-6) << spacing.x;
        EXPECT_NEAR(m.along, plan * std::sqrt(1 + 0.5625 + 0.0625), 1e-2) << spacing.x;
        EXPECT_NEAR(m.perimeter, 2 * (220.5 + 151.25), 1e-9) << spacing.x;
        EXPECT_NEAR(m.above, m.below, 1e-4 * m.above) << spacing.x;
        EXPECT_NEAR(low.above, 300 * plan, 1e-2) << spacing.x;
        EXPECT_NEAR(m.highest, 0.75 * 100 + 0.25 * 90 + 90, 1e-3) << spacing.x;
        EXPECT_NEAR(lowestInArea(plane, area), 0.75 * -120.5 - 0.25 * 61.25 + 90, 1e-3) << spacing.x;
        EXPECT_LT(errorsOfArea(plane, area, middle, m).along, 1e-2) << spacing.x;
    }
}

// An L, which has a dent, and a star: by the shoelace formula.
TEST(GroundArea, DentsAndManyCornersAreCutRight) {
    const Heightfield level = shaped(60, 50, {3, 4}, [](double, double) { return 7.0; });
    const Places ell{{-50, -50}, {40, -50}, {40, -10}, {-5, -10}, {-5, 44}, {-50, 44}};
    const AreaMeasure m = measureArea(level, ell, 5);
    const double truth = 90 * 40 + 45 * 54;
    EXPECT_NEAR(m.plan, truth, 1e-6);
    EXPECT_NEAR(m.along, truth, 1e-6);
    EXPECT_NEAR(m.above, 2 * truth, 1e-6);
    EXPECT_EQ(m.below, 0);
    Places star;
    for (int k = 0; k < 24; ++k) {
        const double r = k % 2 ? 30.3 : 80.7, a = k * std::numbers::pi / 12;
        star.emplace_back(r * std::cos(a), r * std::sin(a));
    }
    double shoelace = 0;
    for (std::size_t n = 0; n < star.size(); ++n) {
        const glm::dvec2 &a = star[n], &b = star[(n + 1) % star.size()];
        shoelace += 0.5 * (a.x * b.y - a.y * b.x);
    }
    EXPECT_NEAR(measureArea(level, star, 0).plan, shoelace, 1e-6);
}

TEST(GroundArea, TellsHowMuchIsDoneAndEndsWhereThatThrows) {
    const Heightfield level(6, 1200, glm::dvec2(1), std::vector<float>(6 * 1200, 7.0f), "level");
    const std::vector<glm::dvec2> corners{{-2, -590}, {2, -590}, {2, 590}, {-2, 590}};
    std::vector<double> shares;
    const AreaMeasure measured = measureArea(level, corners, 0),
                      told = errorsOfArea(level, corners, 0, measured,
                                          [&](double share) { shares.push_back(share); });
    EXPECT_EQ(told.above, errorsOfArea(level, corners, 0, measured).above);
    ASSERT_GT(shares.size(), 10u);
    EXPECT_EQ(shares.front(), 0);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GT(shares.back(), 0.9);
    EXPECT_LT(shares.back(), 1);
    const auto stop = [](double share) {
        if (share > 0.4) throw Cancelled();
    };
    EXPECT_THROW(measureArea(level, corners, 0, stop), Cancelled);
    EXPECT_THROW(lowestInArea(level, corners, stop), Cancelled);
}

// The cap of a sphere over a level plane: its volume and its area, within the errors that are told.
TEST(GroundArea, ACapIsWithinItsErrors) {
    constexpr double kRadius = 1000, kLevel = 900, kTall = kRadius - kLevel;
    const Heightfield sphere = shaped(
        61, 49, {20, 26}, [](double x, double y) { return std::sqrt(kRadius * kRadius - x * x - y * y); });
    const Places square{{-560, -560}, {560, -560}, {560, 560}, {-560, 560}};
    const AreaMeasure m = measureArea(sphere, square, kLevel),
                      errors = errorsOfArea(sphere, square, kLevel, m);
    const double volume = std::numbers::pi * kTall * kTall * (3 * kRadius - kTall) / 3;
    EXPECT_NEAR(m.above, volume, errors.above);
    EXPECT_LT(errors.above, 0.02 * volume);
    // The sphere over a disc of radius r: 2 pi R (R - sqrt(R^2 - r^2)).
    Places disc;
    for (int k = 0; k < 720; ++k) {
        const double a = k * std::numbers::pi / 360;
        disc.emplace_back(500 * std::cos(a), 500 * std::sin(a));
    }
    const double cap = 2 * std::numbers::pi * kRadius * (kRadius - std::sqrt(kRadius * kRadius - 500 * 500));
    const AreaMeasure round = measureArea(sphere, disc, 0),
                      roundErrors = errorsOfArea(sphere, disc, 0, round);
    // 720 corners leave 1.3e-5 of the disc out.
    EXPECT_NEAR(round.along, cap, roundErrors.along + 2e-5 * cap);
    EXPECT_LT(roundErrors.along, 0.01 * cap);
}

// A wall from west to east: south of it the shadow of a low sun in the north is its height over the tangent.
TEST(SunHours, AWallThrowsAShadowOfItsLength) {
    const Heightfield wall =
        shaped(9, 60, {7, 10}, [](double, double y) { return std::abs(y - 95) < 1 ? 40.0 : 0.0; });
    const HeightPyramid maxima(wall);
    const SightLines lines(wall, maxima, 0);
    const double elevation = std::atan(40.0 / 155);  // 155 m long
    for (int j = 0; j < 60; ++j) {
        const double y = (j - 29.5) * 10;
        const bool shadow = y < 95 && 95 - y < 155;
        ASSERT_EQ(sunShinesOn(lines, 4, j, {0, elevation}), !shadow) << y;
        ASSERT_EQ(sunShinesOn(lines, 4, j, {std::numbers::pi, elevation}), y <= 95 || y - 95 > 155) << y;
        ASSERT_TRUE(sunShinesOn(lines, 4, j, {std::numbers::pi / 2, 0}));
        ASSERT_FALSE(sunShinesOn(lines, 4, j, {0, -0.01}));
    }
    Progress progress;
    const Plane<float> hours =
        hoursOfSun(lines, {{0, elevation}, {std::numbers::pi, elevation}, {0, -0.5}, {0, 0.6}}, 24, progress);
    EXPECT_EQ(hours.row(0)[4], 18);  // far south: three of four
    EXPECT_EQ(hours.row(38)[4], 6);  // 10 m to the wall's south: when the sun is there
}

// Walls along both axes, and suns that stand askew of them: along the sun's way the shadow has the same
// length, over the plan across the wall its share of it.
TEST(SunHours, AShadowReachesAsFarAcrossTheWallAsTheSunsWayLeads) {
    constexpr double kWall = 60, kShadow = 300;  // metres; of the sun's way
    const double elevation = std::atan(kWall / kShadow);
    for (const bool northSouth : {false, true})
        for (const glm::dvec2& spacing : {glm::dvec2(6, 15), {15, 6}}) {
            const int width = northSouth ? 101 : 41, height = northSouth ? 41 : 101;
            const int axis = northSouth ? 0 : 1;
            const Heightfield ground = shaped(width, height, spacing, [&](double x, double y) {
                return std::abs(northSouth ? x : y) < 0.1 ? kWall : 0.0;
            });
            const HeightPyramid maxima(ground);
            const SightLines lines(ground, maxima, 0);
            std::vector<SunOverGround> suns;
            for (const double degrees : {20.0, 70.0, 200.0, 250.0}) {
                const double azimuth = degrees * std::numbers::pi / 180,
                             towards = northSouth ? std::sin(azimuth) : std::cos(azimuth);
                // From the middle of a row beside the wall; lines that leave the ground before the wall see
                // the sun.
                for (int n = 0; n < (northSouth ? width : height); ++n) {
                    const int i = northSouth ? n : width / 2, j = northSouth ? height / 2 : n;
                    const glm::dvec2 place = ground.worldFromGrid({i, j});
                    const double way = -place[axis] / towards;  // to the wall, metres
                    const glm::dvec2 at = place + way * glm::dvec2(std::sin(azimuth), std::cos(azimuth));
                    if (!ground.contains(at) && way > 0) continue;
                    const bool shadow = way > 0 && way < kShadow;
                    ASSERT_EQ(sunShinesOn(lines, i, j, {azimuth, elevation}), !shadow)
                        << degrees << " " << place.x << " " << place.y << " " << spacing.x;
                }
                suns.push_back({azimuth, elevation});
            }
            // Each sample has the hours of the suns that shine on it.
            Progress progress;
            const Plane<float> hours = hoursOfSun(lines, suns, 24, progress);
            ASSERT_EQ(hours.width(), width);
            ASSERT_EQ(hours.height(), height);
            for (int j = 0; j < height; ++j)
                for (int i = 0; i < width; ++i) {
                    int shining = 0;
                    for (const SunOverGround& sun : suns) shining += sunShinesOn(lines, i, j, sun);
                    ASSERT_EQ(hours.at(i, j), 6.0f * static_cast<float>(shining)) << i << " " << j;
                }
        }
}

// Every second sample, from the first or the second one on, lies where it lay.
TEST(GroundLine, ThinnedGroundHasItsSamplesWhereTheyWere) {
    for (const glm::ivec2& size : {glm::ivec2(7, 10), {8, 5}, {4, 4}}) {
        const Heightfield ground =
            shaped(size.x, size.y, {10, 14}, [](double x, double y) { return 3 * x + 1000 * y; });
        const GroundSamples samples(ground);
        for (const int firstX : {0, 1})
            for (const int firstY : {0, 1}) {
                glm::dvec2 shift;
                const GroundSamples thin = samples.thinned(firstX, firstY, shift);
                EXPECT_EQ(thin.width(), (size.x - firstX + 1) / 2);
                EXPECT_EQ(thin.height(), (size.y - firstY + 1) / 2);
                EXPECT_EQ(thin.spacing(), glm::dvec2(20, 28));
                for (int j = 0; j < thin.height(); ++j)
                    for (int i = 0; i < thin.width(); ++i) {
                        const glm::dvec2 world = thin.worldFromGrid({i, j}) + shift;
                        ASSERT_NEAR(thin.sample(i, j), 3 * world.x + 1000 * world.y, 1e-2) << i << " " << j;
                        ASSERT_EQ(thin.sample(i, j), ground.sample(firstX + 2 * i, firstY + 2 * j));
                    }
            }
    }
}

}  // namespace
}  // namespace stereonav
