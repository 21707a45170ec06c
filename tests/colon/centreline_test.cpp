// Centrelines of lumens whose axis is known in closed form, and of lumens with hardly any room for one.
#include "colon/centreline/centreline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "centreline_lumens.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

using test::lumenOf;
using test::lumenOfVoxels;
using test::Shape;
using testing::HasSubstr;

Centreline lineOf(const LumenField& lumen, const CentrelineSetting& setting = {}) {
    Progress progress;
    return findCentreline(lumen, distanceToOutside(lumen.lumen), setting, progress);
}

double lumenValueAt(const LumenField& lumen, const glm::dvec3& world) {
    const glm::dvec3 v = lumen.field.frame.voxelFromWorld(world);
    const glm::ivec3 low = glm::clamp(glm::ivec3(glm::floor(v)), glm::ivec3(0), lumen.field.frame.size - 1);
    const glm::dvec3 t = v - glm::dvec3(low);
    double sum = 0;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 up(n & 1, n >> 1 & 1, n >> 2);
        const glm::dvec3 w = glm::mix(1.0 - t, t, glm::dvec3(up));
        sum += w.x * w.y * w.z * lumen.field.at(glm::min(low + up, lumen.field.frame.size - 1));
    }
    return sum;
}

// Expects points inside, evenly spaced, with radii never beyond the nearest outside voxel's centre.
void expectSound(const LumenField& lumen, const Centreline& line, double spacing) {
    ASSERT_FALSE(line.points.empty());
    for (std::size_t n = 0; n < line.points.size(); ++n) {
        const CentrelinePoint& p = line.points[n];
        const glm::ivec3 nearest(glm::round(lumen.lumen.frame.voxelFromWorld(p.position)));
        ASSERT_TRUE(lumen.lumen.frame.contains(nearest)) << n;
        EXPECT_EQ(lumen.lumen.at(nearest), p.segment) << n;
        EXPECT_LT(lumenValueAt(lumen, p.position), lumen.isovalue) << n;
        EXPECT_GE(p.radius, 0) << n;
        if (n == 0 || line.points[n - 1].segment != p.segment) continue;
        EXPECT_NEAR(glm::length(p.position - line.points[n - 1].position), spacing, 0.2 * spacing) << n;
    }
}

double farthest(const Centreline& line, const std::function<double(const glm::dvec3&)>& away) {
    double most = 0;
    for (const CentrelinePoint& p : line.points) most = std::max(most, away(p.position));
    return most;
}

double capsule(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double radius) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - a - t * (b - a)) - radius;
}

TEST(Centreline, OfAStraightTubeIsItsAxis) {
    const glm::dvec3 a(0.013, 0.0121, 0.012), b(0.031, 0.027, 0.082);
    const LumenField lumen =
        lumenOf([&](const glm::dvec3& p) { return capsule(p, a, b, 0.008); }, glm::dvec3(0.0),
                glm::dvec3(0.045, 0.04, 0.095), glm::dvec3(8e-4, 8e-4, 7e-4));
    const Centreline line = lineOf(lumen);
    expectSound(lumen, line, 0.001);
    EXPECT_LT(farthest(line, [&](const glm::dvec3& p) { return capsule(p, a, b, 0); }), 0.0006);
    EXPECT_NEAR(line.length(), glm::length(b - a), 0.004);
    EXPECT_LT(line.points.front().position.z, line.points.back().position.z);
    for (const CentrelinePoint& p : line.points) {  // conservative: up to a voxel and a quarter too small
        EXPECT_LT(p.radius, 0.0081);
        EXPECT_GT(p.radius, 0.007);
    }
}

// Three quarters of a circle around y, as a tube with round ends.
struct Arc {
    double bend = 0.03, tube = 0.01;
    glm::dvec3 nearest(const glm::dvec3& p) const {
        const double angle = std::atan2(p.z, p.x);
        if (angle < -kPi / 2) return angle < -0.75 * kPi ? glm::dvec3(-bend, 0, 0) : glm::dvec3(0, 0, -bend);
        return {bend * std::cos(angle), 0, bend * std::sin(angle)};
    }
    double away(const glm::dvec3& p) const { return glm::length(p - nearest(p)); }
};

void expectArc(const glm::dvec3& spacing, std::size_t moreVoxelsThan, const CentrelineSetting& setting = {}) {
    const Arc arc;
    const LumenField lumen = lumenOf([&](const glm::dvec3& p) { return arc.away(p) - arc.tube; },
                                     {-0.042, -0.0121, -0.042}, {0.042, 0.0121, 0.042}, spacing);
    ASSERT_GT(lumen.segments.at(0).voxels, moreVoxelsThan);
    const Centreline line = lineOf(lumen, setting);
    expectSound(lumen, line, 0.001);
    EXPECT_LT(farthest(line, [&](const glm::dvec3& p) { return arc.away(p); }), 0.001);
    EXPECT_NEAR(line.length(), 1.5 * kPi * arc.bend, 0.05 * 1.5 * kPi * arc.bend);
    EXPECT_LT(line.points.front().position.z, -0.02);  // the lower end first
}

TEST(Centreline, OfATorusArcIsItsCircle) {
    expectArc({9e-4, 8e-4, 1e-3}, 10000);
}

// Large enough to be searched in blocks of voxels first: of 8, and of 4 where one axis is coarser.
TEST(Centreline, OfATorusArcOfManyVoxelsIsItsCircle) {
    expectArc(glm::dvec3(4e-4), 500000);
    expectArc({2.5e-4, 8e-4, 2.5e-4}, 500000);
}

// Lumens of very many voxels are searched like this: in blocks of two along the coarser axis, too.
TEST(Centreline, InBlocksThatAreLongAlongAnAxisIsItsCircle) {
    CentrelineSetting even;
    even.mostUneven = 1000;
    expectArc({2.5e-4, 8e-4, 2.5e-4}, 500000, even);
}

// A winding axis y = A sin(w z), with bulges of the radius (haustra) where depth is not 0.
struct Winding {
    double amplitude = 0.015, wave = 2 * kPi / 0.08, tube = 0.007, depth = 0, bulges = 2 * kPi / 0.02;
    glm::dvec3 at(double z) const { return {0.0, amplitude * std::sin(wave * z), z}; }
    double nearest(const glm::dvec3& p) const {  // z of the nearest axis point
        double best = 0, least = 1e9;
        const double low = std::max(0.01, p.z - 0.03), high = std::min(0.15, p.z + 0.03);
        for (double z = std::min(low, 0.15); z <= std::max(high, 0.01); z += 0.0004)
            if (const double d = glm::length(p - at(z)); d < least) {
                least = d;
                best = z;
            }
        return best;
    }
    double distance(const glm::dvec3& p) const {
        const double z = nearest(p);
        return glm::length(p - at(z)) - tube - depth * 0.5 * (1 + std::sin(bulges * z));
    }
    LumenField lumen(const glm::dvec3& spacing) const {
        return lumenOf([&](const glm::dvec3& p) { return distance(p); }, {-0.014, -0.03, -0.004},
                       {0.014, 0.03, 0.164}, spacing);
    }
};

TEST(Centreline, OfAWindingTubeFollowsItsAxis) {
    const Winding tube;
    const LumenField lumen = tube.lumen(glm::dvec3(0.0008, 0.0008, 0.0007));
    const Centreline line = lineOf(lumen);
    expectSound(lumen, line, 0.001);
    const double away =
        farthest(line, [&](const glm::dvec3& p) { return glm::length(p - tube.at(tube.nearest(p))); });
    EXPECT_LT(away, 0.001);
    std::printf("winding tube: at most %.2f mm from its axis\n", away * 1e3);
}

TEST(Centreline, DoesNotWanderIntoHaustra) {
    Winding tube;
    tube.depth = 0.005;  // radius 7 to 12 mm
    const LumenField lumen = tube.lumen(glm::dvec3(0.0008, 0.0008, 0.0007));
    const Centreline line = lineOf(lumen);
    expectSound(lumen, line, 0.001);
    const double away =
        farthest(line, [&](const glm::dvec3& p) { return glm::length(p - tube.at(tube.nearest(p))); });
    EXPECT_LT(away, 0.0025);
    double axis = 0;
    for (double z = 0.01; z < 0.15 - 1e-9; z += 0.0002) axis += glm::length(tube.at(z + 0.0002) - tube.at(z));
    EXPECT_NEAR(line.length(), axis, 0.08 * axis);
    std::printf("haustra: at most %.2f mm from the axis; %.1f mm long, the axis %.1f mm\n", away * 1e3,
                line.length() * 1e3, axis * 1e3);
}

// Distance to the nearest outside voxel's centre, by looking at all of them around.
double clearanceByBruteForce(const MaskVolume& mask, const glm::dvec3& world) {
    double least = INFINITY;
    for (int k = -1; k <= mask.frame.size.z; ++k)
        for (int j = -1; j <= mask.frame.size.y; ++j)
            for (int i = -1; i <= mask.frame.size.x; ++i)
                if (!mask.frame.contains({i, j, k}) || !mask.at(i, j, k))
                    least =
                        std::min(least, glm::length(mask.frame.worldFromVoxel(glm::dvec3(i, j, k)) - world));
    return least;
}

TEST(Centreline, RadiiStayBelowTheTrueClearance) {
    for (const glm::dvec3& spacing :
         {glm::dvec3(0.0008, 0.0008, 0.0007), glm::dvec3(0.0006, 0.0006, 0.003)}) {
        const LumenField lumen = lumenOf(
            [&](const glm::dvec3& p) {
                const glm::dvec3 axis(0.004 * std::sin(p.z * 120), 0, p.z);
                return glm::length(p - axis) - 0.004 - 0.002 * std::cos(p.z * 300);
            },
            {-0.012, -0.008, 0}, {0.012, 0.008, 0.05}, spacing);
        const Centreline line = lineOf(lumen);
        expectSound(lumen, line, 0.001);
        ASSERT_GT(line.points.size(), 20u);
        for (std::size_t n = 0; n < line.points.size(); n += 3) {
            const double clearance = clearanceByBruteForce(lumen.lumen, line.points[n].position);
            EXPECT_LE(line.points[n].radius, clearance) << n;
            EXPECT_GE(line.points[n].radius, clearance - glm::length(spacing)) << n;
        }
    }
}

TEST(Centreline, TheLowerEndComesFirstElseTheHinderOne) {
    const auto firstOf = [](const glm::dvec3& a, const glm::dvec3& b, bool reversed = false) {
        const glm::dvec3 low = glm::min(a, b) - 0.006, high = glm::max(a, b) + 0.006;
        const LumenField lumen = lumenOf([&](const glm::dvec3& p) { return capsule(p, a, b, 0.004); }, low,
                                         high, glm::dvec3(0.001));
        CentrelineSetting setting;
        setting.reversed = reversed;
        const glm::dvec3 first = lineOf(lumen, setting).points.front().position;
        return glm::length(first - a) < glm::length(first - b) ? 0 : 1;
    };
    EXPECT_EQ(firstOf({0, 0, 0}, {0, 0.01, 0.05}), 0);
    EXPECT_EQ(firstOf({0, 0, 0.05}, {0, 0.01, 0}), 1);
    EXPECT_EQ(firstOf({0, 0, 0.05}, {0, 0.01, 0}, true), 0);
    EXPECT_EQ(firstOf({0, 0.05, 0}, {0.01, 0, 0}), 0);
    EXPECT_EQ(firstOf({0, 0, 0}, {0.01, 0.05, 0}), 1);
    // A bend whose ends are nearly level: both lie low, the one further back (larger y) is the rectum's.
    const glm::dvec3 front(0, 0, 0.001), back(0, 0.04, 0), top(0, 0.02, 0.06);
    const LumenField bend = lumenOf(
        [&](const glm::dvec3& p) {
            return std::min(capsule(p, front, top, 0.005), capsule(p, top, back, 0.005));
        },
        {-0.007, -0.007, -0.007}, {0.007, 0.047, 0.067}, glm::dvec3(0.001));
    EXPECT_GT(lineOf(bend).points.front().position.y, 0.03);
}

// Pieces of lumen at different places, numbered in order.
LumenField pieces(const std::vector<std::pair<glm::dvec3, glm::dvec3>>& axes) {
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const auto& [a, b] : axes) {
        low = glm::min(low, glm::min(a, b) - 0.007);
        high = glm::max(high, glm::max(a, b) + 0.007);
    }
    LumenField lumen = lumenOf(
        [&](const glm::dvec3& p) {
            double d = INFINITY;
            for (const auto& [a, b] : axes) d = std::min(d, capsule(p, a, b, 0.005));
            return d;
        },
        low, high, glm::dvec3(0.0009));
    const LumenSegment whole = lumen.segments[0];
    lumen.segments.assign(axes.size(), whole);
    const VolumeFrame& frame = lumen.lumen.frame;
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                for (std::size_t n = 0; n < axes.size(); ++n)
                    if (lumen.lumen.at(i, j, k) && capsule(frame.worldFromVoxel(glm::dvec3(i, j, k)),
                                                           axes[n].first, axes[n].second, 0.005) < 0.001)
                        lumen.lumen.at(i, j, k) = static_cast<std::uint8_t>(n + 1);
    return lumen;
}

TEST(Centreline, SegmentsFollowOneAnotherHeadToTail) {
    const glm::dvec3 a(0, 0, 0), b(0.03, 0, 0.03), c(0.05, 0, 0.03), d(0.07, 0.01, -0.01),
        e(0.09, 0.01, -0.01), f(0.09, 0.01, 0.04);
    // The second is given upside down: it runs downwards because its upper end is nearer.
    const LumenField lumen = pieces({{a, b}, {d, c}, {e, f}});
    Centreline line = lineOf(lumen);
    expectSound(lumen, line, 0.001);
    const glm::dvec3 ends[] = {a, b, c, d, e, f};
    std::vector<std::size_t> starts;
    for (std::size_t n = 0; n < line.points.size(); ++n)
        if (n == 0 || line.points[n].segment != line.points[n - 1].segment) starts.push_back(n);
    ASSERT_EQ(starts.size(), 3u);
    starts.push_back(line.points.size());
    for (int segment = 0; segment < 3; ++segment) {
        EXPECT_EQ(line.points[starts[segment]].segment, segment + 1);
        EXPECT_LT(glm::length(line.points[starts[segment]].position - ends[2 * segment]), 0.005) << segment;
        EXPECT_LT(glm::length(line.points[starts[segment + 1] - 1].position - ends[2 * segment + 1]), 0.005);
    }
    CentrelineSetting back;
    back.reversed = true;
    const Centreline reversed = lineOf(lumen, back);
    ASSERT_EQ(reversed.points.size(), line.points.size());
    for (std::size_t n = 0; n < line.points.size(); ++n) {
        EXPECT_EQ(reversed.points[n].position, line.points[line.points.size() - 1 - n].position);
        EXPECT_EQ(reversed.points[n].segment, line.points[line.points.size() - 1 - n].segment);
    }
}

TEST(Centreline, OfVeryFewVoxels) {
    const Centreline one = lineOf(lumenOfVoxels({{2, 2, 2}}, glm::ivec3(5)));
    ASSERT_EQ(one.points.size(), 1u);
    EXPECT_LT(glm::length(one.points[0].position - glm::dvec3(0.002)), 1e-12);
    EXPECT_NEAR(one.points[0].radius, 0.0005, 1e-5);
    EXPECT_EQ(one.length(), 0);

    const Centreline two = lineOf(lumenOfVoxels({{2, 2, 2}, {2, 2, 3}}, glm::ivec3(6)));
    ASSERT_EQ(two.points.size(), 2u);
    EXPECT_LT(glm::length(two.points[0].position - glm::dvec3(0.002)), 1e-12);
    EXPECT_LT(glm::length(two.points[1].position - glm::dvec3(0.002, 0.002, 0.003)), 1e-12);

    // At the volume's faces and filling it.
    const Centreline filled = lineOf(lumenOfVoxels({{0, 0, 0}}, glm::ivec3(1)));
    ASSERT_EQ(filled.points.size(), 1u);
    EXPECT_NEAR(filled.points[0].radius, 0.0005, 1e-5);
}

TEST(Centreline, OfALumenOneVoxelWideFollowsItsCorners) {
    std::vector<glm::ivec3> voxels;
    for (int n = 0; n < 8; ++n) voxels.emplace_back(1 + n, 2, 1);
    for (int n = 1; n < 8; ++n) voxels.emplace_back(8, 2, 1 + n);
    for (int n = 1; n < 5; ++n) voxels.emplace_back(8, 2 + n, 8);
    const LumenField lumen = lumenOfVoxels(voxels, {10, 8, 10});
    CentrelineSetting setting;
    setting.spacing = 0.0005;
    Progress progress;
    const Centreline line = findCentreline(lumen, distanceToOutside(lumen.lumen), setting, progress);
    expectSound(lumen, line, 0.0005);
    EXPECT_GT(line.length(), 0.011);
    EXPECT_LE(line.length(), 0.0181);
    for (const CentrelinePoint& p : line.points) EXPECT_LE(p.radius, 0.0006);
}

TEST(Centreline, OfLumensThatAreNoTubes) {
    const glm::dvec3 spacing(0.001);
    const LumenField ball = lumenOf([](const glm::dvec3& p) { return glm::length(p) - 0.01; },
                                    glm::dvec3(-0.012), glm::dvec3(0.012), spacing);
    const Centreline across = lineOf(ball);
    expectSound(ball, across, 0.001);
    EXPECT_GE(across.points.size(), 2u);
    EXPECT_LT(farthest(across, [](const glm::dvec3& p) { return glm::length(p); }), 0.0075);

    const LumenField ring = lumenOf(
        [](const glm::dvec3& p) { return glm::length(glm::dvec2(std::hypot(p.x, p.z) - 0.02, p.y)) - 0.005; },
        {-0.027, -0.007, -0.027}, {0.027, 0.007, 0.027}, spacing);
    const Centreline half = lineOf(ring);
    expectSound(ring, half, 0.001);
    EXPECT_NEAR(half.length(), kPi * 0.02, 0.012);
    EXPECT_LT(farthest(half, [](const glm::dvec3& p) { return std::abs(std::hypot(p.x, p.z) - 0.02); }),
              0.0015);

    const LumenField plate = lumenOf(
        [](const glm::dvec3& p) {
            return std::max({std::abs(p.x) - 0.015, std::abs(p.y) - 0.015, std::abs(p.z) - 0.0008});
        },
        {-0.017, -0.017, -0.003}, {0.017, 0.017, 0.003}, spacing);
    const Centreline corner = lineOf(plate);
    expectSound(plate, corner, 0.001);
    EXPECT_GT(corner.length(), 0.02);
}

TEST(Centreline, OfVeryUnevenSpacing) {
    const glm::dvec3 a(0.01, 0.01, 0.02), b(0.03, 0.02, 0.5);
    const LumenField lumen = lumenOf([&](const glm::dvec3& p) { return capsule(p, a, b, 0.008); },
                                     {-0.002, -0.002, 0}, {0.042, 0.034, 0.52}, {0.001, 0.001, 0.02});
    const Centreline line = lineOf(lumen);
    expectSound(lumen, line, 0.001);
    EXPECT_LT(farthest(line, [&](const glm::dvec3& p) { return capsule(p, a, b, 0); }), 0.002);
    EXPECT_GT(line.length(), 0.44);
}

TEST(Centreline, SpacingIsKept) {
    const glm::dvec3 a(0.0), b(0.0, 0.0, 0.06);
    const LumenField lumen = lumenOf([&](const glm::dvec3& p) { return capsule(p, a, b, 0.006); },
                                     {-0.008, -0.008, -0.008}, {0.008, 0.008, 0.068}, glm::dvec3(0.001));
    for (const double spacing : {0.0001, 0.0007, 0.005, 10.0}) {
        CentrelineSetting setting;
        setting.spacing = spacing;
        const Centreline line = lineOf(lumen, setting);
        ASSERT_GE(line.points.size(), 2u);
        for (std::size_t n = 1; n < line.points.size(); ++n) {
            const double step = glm::length(line.points[n].position - line.points[n - 1].position);
            EXPECT_LT(step, spacing * 1.1) << n;
            EXPECT_GT(step, std::min(0.9 * spacing, 0.05)) << n;
        }
    }
}

std::string lineErrorOf(const LumenField& lumen, const DistanceVolume& distance, double spacing) {
    CentrelineSetting setting;
    setting.spacing = spacing;
    Progress progress;
    try {
        findCentreline(lumen, distance, setting, progress);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Centreline, RefusesWhatHasNone) {
    const LumenField empty = lumenOfVoxels({}, glm::ivec3(4));
    EXPECT_THAT(lineErrorOf(empty, distanceToOutside(empty.lumen), 0.001), HasSubstr("the lumen is empty"));
    EXPECT_THAT(lineErrorOf(LumenField{}, DistanceVolume{}, 0.001), HasSubstr("the lumen is empty"));
    LumenField hollow = lumenOfVoxels({}, glm::ivec3(4));
    hollow.segments.emplace_back();
    EXPECT_THAT(lineErrorOf(hollow, distanceToOutside(hollow.lumen), 0.001),
                HasSubstr("segment 1 of the lumen has no voxels"));
    const LumenField good = lumenOfVoxels({{1, 1, 1}, {1, 1, 2}}, glm::ivec3(4));
    EXPECT_THAT(lineErrorOf(good, DistanceVolume{}, 0.001), HasSubstr("distances are not those"));
    for (const double spacing : {0.0, -1.0, double(NAN), double(INFINITY)})
        EXPECT_THAT(lineErrorOf(good, distanceToOutside(good.lumen), spacing),
                    HasSubstr("expected metres, more than 0"));
}

// A line like that of a lumen of kilometres, where nobody would wait for a point each millimetre.
TEST(Centreline, PointsOfVeryLongLinesAreFurtherApart) {
    const LumenField good = lumenOfVoxels({{1, 1, 1}, {1, 1, 2}}, glm::ivec3(4));
    const DistanceVolume distance = distanceToOutside(good.lumen);
    Progress progress;
    CentrelineSetting fine, usual;
    fine.spacing = 1e-11;
    const Centreline line = findCentreline(good, distance, fine, progress);
    EXPECT_EQ(line.points.size(), 50'001u);
    EXPECT_NEAR(line.length(), findCentreline(good, distance, usual, progress).length(), 1e-9);
}

TEST(Centreline, StopsWhenCancelled) {
    const LumenField lumen = lumenOfVoxels({{1, 1, 1}, {1, 1, 2}}, glm::ivec3(4));
    Progress progress;
    progress.cancel();
    EXPECT_THROW(findCentreline(lumen, distanceToOutside(lumen.lumen), {}, progress), Cancelled);
}

TEST(Centreline, IsTheSameOnAnyNumberOfThreads) {
    const Winding tube;
    const LumenField lumen = tube.lumen(glm::dvec3(0.0015));
    const int before = threadCount();
    setThreadCount(1);
    const Centreline alone = lineOf(lumen);
    setThreadCount(4);
    const Centreline together = lineOf(lumen);
    setThreadCount(before);
    ASSERT_EQ(alone.points.size(), together.points.size());
    for (std::size_t n = 0; n < alone.points.size(); ++n) {
        EXPECT_EQ(alone.points[n].position, together.points[n].position);
        EXPECT_EQ(alone.points[n].radius, together.points[n].radius);
    }
}

}  // namespace
}  // namespace stereonav
