// Flights in steps of 1 ms to 1 s: over ground and through lumens, the same way, and never nearer to what
// the eyes must not touch than the clearance.
#include <gmock/gmock.h>

#include <cmath>

#include "colon/centreline/centreline.h"
#include "engine/nav/navigator.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/analytic_lumen.h"
#include "tests/support/stability_row.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using namespace test;

class StepRow : public testing::TestWithParam<double> {
protected:
    double dt() const { return GetParam(); }
    std::string id(const std::string& what) const {
        return "flight/" + what + "/" + shortNumber(1000 * dt()) + "ms";
    }
    std::string words(const std::string& what) const {
        return what + " in steps of " + shortNumber(1000 * dt()) + " ms";
    }
    int stepsFor(double seconds) const { return static_cast<int>(std::lround(seconds / dt())); }
};

// Speeds follow a wish by exponential damping, whose way is known: v (T - tau (1 - exp(-T / tau))).
TEST_P(StepRow, StraightFlightIsTheClosedForm) {
    constexpr double kSeconds = 6, kTau = 0.25;
    StabilityRow row(id("straight"), words("six seconds straight ahead"), "distance from the closed form",
                     1e-9, "m");
    Navigator flight([](const glm::dvec2&) { return 0.0; }, poseFromAngles({0, 0, 500}, 0, 0, 0), {});
    FlightInput input;
    input.forward = 1;
    for (int k = 0; k < stepsFor(kSeconds); ++k) flight.step(input, dt());
    const double way = flight.speed() * (kSeconds - kTau * (1 - std::exp(-kSeconds / kTau)));
    row.saw(glm::distance(flight.pose().position, {0, way, 500}));
}

// Half a turn, a move, half a turn, in pieces of at most 1/120 s: of second order. A piece's place is off by
// less than an eighth of its way times what it turns, 0.5 radians a second, times the share of the turn's
// damping time (0.08 s) that it lasts; as is the place it is compared with.
TEST_P(StepRow, TurnsLikeTheFinestSteps) {
    constexpr double kSeconds = 6, kRate = 0.5;
    const auto flown = [&](double step) {
        Navigator flight([](const glm::dvec2&) { return 0.0; }, poseFromAngles({0, 0, 500}, 0, 0, 0), {});
        FlightInput input;
        input.forward = 1;
        input.yawRate = kRate;
        for (int k = 0; k < std::lround(kSeconds / step); ++k) flight.step(input, step);
        return flight.pose().position;
    };
    const double speed = FlightSetting().speed, piece = std::min(dt(), 1.0 / 120);
    StabilityRow row(id("turning"), words("six seconds in a bend"), "distance from steps of 0.1 ms",
                     speed * kSeconds * kRate * (piece * piece + 1e-8) / (8 * 0.08), "m");
    row.saw(glm::distance(flown(dt()), flown(1e-4)));
}

TEST_P(StepRow, NeverBelowTheClearanceOverCliffs) {
    StabilityRow row(id("cliffs"), words("20 s at full speed against cliffs and spikes"),
                     "metres below the clearance", 1e-9, "m");
    for (const std::string kind : {"cliffed", "spiked"})
        for (const int mode : {0, 1}) {
            const Heightfield ground = makeGround(kind, 97, 97, 4);
            FlightSetting setting;
            setting.speed = 300;
            setting.groundStep = 5;
            Navigator flight([&](const glm::dvec2& p) { return ground.heightAt(p); },
                             poseFromAngles({-1300, -1000, 20}, 0.9, -0.1, 0), setting);
            flight.setMode(mode);
            FlightInput input;
            input.forward = 1;
            for (int k = 0; k < stepsFor(20); ++k) {
                flight.step(input, dt());
                const glm::dvec3 p = flight.pose().position;
                row.saw(ground.heightAt(glm::dvec2(p)) + setting.clearance - p.z);
            }
        }
}

TEST_P(StepRow, LumensKeepTheirClearance) {
    StabilityRow row(id("lumen"), words("8 s guided and free in a folded tube, a bend and a throat"),
                     "metres nearer to the wall than allowed", 1e-12, "m");
    for (const AnalyticLumen& lumen : {foldedTube(), torus(), throat(0.0025)})
        for (const int mode : {0, 1}) {
            const ColonFlightSetting setting{0.002, 0.03, 0.003};
            ColonFlight flight(lumen.freeDistance(), lumen.line, lumen.home, setting);
            flight.setMode(mode);
            FlightInput input;
            input.forward = 1;
            input.speedMultiplier = 4;
            for (int k = 0; k < stepsFor(8); ++k) {
                input.right = std::sin(1.7 * k * dt());
                input.yawRate = 0.8 * std::cos(2.3 * k * dt());
                flight.step(input, dt());
                const Pose pose = flight.pose();
                for (const double side : {-0.0015, 0.0015})
                    row.saw(flight.allowedClearance() - lumen.distance(pose.position + side * pose.right()));
            }
        }
}

INSTANTIATE_TEST_SUITE_P(Stability, StepRow, testing::Values(0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0),
                         [](const auto& given) { return testName(shortNumber(1000 * given.param) + "ms"); });

// ---- lumens and distances on awkward grids

struct GridCase {
    const char* id;
    const char* words;
    glm::ivec3 size;
    glm::dvec3 spacing;
    bool (*inside)(const glm::ivec3& v);
};

bool onePixelWide(const glm::ivec3& v) {
    const int bend = v.z < 20 ? 6 : std::min(6 + (v.z - 20), 10);
    return v.y == 6 && v.z > 2 && v.z < 37 && (v.x == bend || (v.z > 20 && v.x == std::max(bend - 1, 6)));
}
bool wideTube(const glm::ivec3& v) {
    return (v.x - 10) * (v.x - 10) + (v.y - 10) * (v.y - 10) < 40 && v.z > 0;
}

class GridRow : public testing::TestWithParam<GridCase> {};

MaskVolume maskOf(const GridCase& c) {
    MaskVolume mask(frameOf(c.size, c.spacing));
    for (int k = 0; k < c.size.z; ++k)
        for (int j = 0; j < c.size.y; ++j)
            for (int i = 0; i < c.size.x; ++i) mask.at(i, j, k) = c.inside({i, j, k});
    return mask;
}

TEST_P(GridRow, DistancesAreThoseOfASearch) {
    const GridCase& c = GetParam();
    // Rounded down to whole units, one less where spacings differ (distance_transform.h): never above the
    // truth, less than two below.
    StabilityRow row(std::string("distance/") + c.id, c.words, "units from the exact distance, from above", 2,
                     "units");
    row.saw(0);
    const MaskVolume mask = maskOf(c);
    const DistanceVolume distance = distanceToOutside(mask);
    for (int k = 0; k < c.size.z; k += 2)
        for (int j = 0; j < c.size.y; ++j)
            for (int i = 0; i < c.size.x; ++i) {
                if (!mask.at(i, j, k)) continue;
                const glm::ivec3 at(i, j, k);
                double least = HUGE_VAL;
                for (int a = 0; a < 3; ++a)
                    least = std::min(least, std::min(at[a] + 1, c.size[a] - at[a]) * c.spacing[a]);
                for (int z = 0; z < c.size.z; ++z)
                    for (int y = 0; y < c.size.y; ++y)
                        for (int x = 0; x < c.size.x; ++x)
                            if (!mask.at(x, y, z))
                                least = std::min(
                                    least, glm::length(glm::dvec3(at - glm::ivec3(x, y, z)) * c.spacing));
                const double units = least / distance.unit - distance.at(at);
                row.saw(units < -1e-6 ? HUGE_VAL : units);  // above the truth: wrong by any measure
            }
}

TEST_P(GridRow, CentrelineLiesInTheLumen) {
    const GridCase& c = GetParam();
    StabilityRow row(std::string("centreline/") + c.id, c.words, "points outside the lumen's voxels", 0,
                     "points");
    row.count(0);
    Progress quiet;
    const MaskVolume mask = maskOf(c);
    const LumenField lumen = lumenFromMask(mask, {}, quiet);
    const Centreline line = findCentreline(lumen, distanceToOutside(lumen.lumen), {}, quiet);
    ASSERT_FALSE(line.points.empty());
    for (const CentrelinePoint& point : line.points) {
        const glm::ivec3 v(glm::round(mask.frame.voxelFromWorld(point.position)));
        row.count(!mask.frame.contains(v) || !mask.at(v) || !std::isfinite(point.radius));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Stability, GridRow,
    testing::Values(
        GridCase{"one-voxel", "a lumen one voxel wide", {17, 13, 40}, glm::dvec3(1e-3), onePixelWide},
        GridCase{"1:1:20",
                 "a lumen in voxels twenty times as long as wide",
                 {21, 21, 9},
                 {1e-3, 1e-3, 20e-3},
                 wideTube},
        GridCase{"20:1:1",
                 "a lumen in voxels twenty times as wide as long",
                 {21, 21, 15},
                 {20e-3, 1e-3, 1e-3},
                 wideTube},
        GridCase{"1um", "a lumen in voxels of a micrometre", {21, 21, 30}, glm::dvec3(1e-6), wideTube}),
    [](const auto& given) { return testName(given.param.id); });

}  // namespace
}  // namespace stereonav
