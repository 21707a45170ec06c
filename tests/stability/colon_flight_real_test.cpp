// Random steering and the automatic flight in a real colon (skipped where the data is absent): the eyes stay
// in the lumen and keep their clearance, by distances looked up finely, and by the sign of the grey field.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>

#include "colon/flight/colon_flight.h"
#include "colon/study/study.h"
#include "engine/volume/surface_cells.h"
#include "tests/support/analytic_lumen.h"

namespace stereonav {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kShareOfPath = 50;  // sanitized, one step in so many
#else
constexpr int kShareOfPath = 1;
#endif

constexpr double kTolerance = 2e-5;  // metres, of the distances looked up

std::filesystem::path maskFile() {
    const char* folder = std::getenv("STEREONAV_TEST_DATA");
    return std::filesystem::path(folder ? folder : STEREONAV_SOURCE_DIR "/../shared/data") /
           "colon/gca00020/large_intestine_mask_clean.nrrd";
}

struct Anatomy {
    LumenField lumen;
    SurfaceCells cells;
    DistanceVolume distance;
    Centreline line;

    // Returns the trilinear value in stored numbers: below the isovalue is inside.
    double valueAt(const glm::dvec3& world) const {
        const glm::dvec3 voxel = lumen.field.frame.voxelFromWorld(world);
        const glm::ivec3 corner(glm::floor(voxel));
        if (!lumen.field.frame.contains(corner) || !lumen.field.frame.contains(corner + 1)) return 1e9;
        const glm::dvec3 t = voxel - glm::dvec3(corner);
        double sum = 0;
        for (int c = 0; c < 8; ++c) {
            const glm::ivec3 o(c & 1, c >> 1 & 1, c >> 2);
            const glm::dvec3 w = glm::mix(1.0 - t, t, glm::dvec3(o));
            sum += w.x * w.y * w.z * lumen.field.at(corner + o);
        }
        return sum;
    }
    double free(const glm::dvec3& p, double upTo, double tolerance) const {
        return freeDistance(cells, p, upTo, tolerance);
    }
    // What the flight asks: a bound that is quick to find. The mean of the corners' distances to the nearest
    // outside voxel is above the distance here by no more than their mean distance from here; and every
    // point of the wall lies in a cell with an outside corner.
    double bound(const glm::dvec3& world) const {
        const VolumeFrame& frame = distance.frame;
        const glm::dvec3 voxel = frame.voxelFromWorld(world);
        const glm::ivec3 corner(glm::floor(voxel));
        if (!frame.contains(corner) || !frame.contains(corner + 1)) return 0;
        const glm::dvec3 t = voxel - glm::dvec3(corner), s = frame.spacing;
        double sum = 0;
        for (int c = 0; c < 8; ++c) {
            const glm::ivec3 o(c & 1, c >> 1 & 1, c >> 2);
            const glm::dvec3 w = glm::mix(1.0 - t, t, glm::dvec3(o));
            sum += w.x * w.y * w.z * distance.at(corner + o) * distance.unit;
        }
        return std::max(0.0, sum - glm::length(s * glm::sqrt(t * (1.0 - t))) - glm::length(s));
    }
    FreeDistance asked() const {
        return [this](const glm::dvec3& p, double upTo) { return std::min(bound(p), upTo); };
    }
    Pose home() const {
        return lookingAlong(line.points[30].position,
                            glm::normalize(line.points[50].position - line.points[30].position));
    }
};

const Anatomy& anatomy() {
    static const std::unique_ptr<Anatomy> loaded = [] {
        auto a = std::make_unique<Anatomy>();
        Progress progress;
        const Study study = readStudy(maskFile(), {}, progress);
        a->lumen = lumenFromMask(study.mask, {}, progress);
        const auto isovalue = static_cast<float>(a->lumen.isovalue);
        a->cells =
            findSurfaceCells(a->lumen.field, {isovalue, isovalue, isovalue, &a->lumen.lumen}, progress);
        a->distance = distanceToOutside(a->lumen.lumen);
        a->line = findCentreline(a->lumen, a->distance, {}, progress);
        return a;
    }();
    return *loaded;
}

double between(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

void changeOneWish(FlightInput& input, std::mt19937_64& random) {
    const double key = random() % 3 == 0 ? 0.0 : between(random, -1, 1);
    double* const wishes[] = {&input.forward, &input.right,     &input.up,
                              &input.yawRate, &input.pitchRate, &input.rollRate};
    const std::size_t which = random() % 7;
    if (which < 6)
        *wishes[which] = which < 3 ? key : 3 * key;
    else
        input.speedMultiplier = random() % 4 == 0 ? between(random, 0, 8) : 1;
    if (random() % 3 == 0) input.forward = random() % 3 == 0 ? -1 : 1;
}

void steerAnywhere(ColonFlight& flight, const FlightInput& input, double dt, std::mt19937_64& random) {
    const std::vector<CentrelinePoint>& points = anatomy().line.points;
    if (random() % 40 == 0) flight.turnBy(between(random, -2, 2), between(random, -1, 1));
    if (random() % 300 == 0) flight.setMode(static_cast<int>(random() % 2));
    if (random() % 2000 == 0) {  // anywhere along the colon, in its wall too
        Pose pose = flight.pose();
        pose.position = points[random() % points.size()].position;
        for (int axis = 0; axis < 3; ++axis) pose.position[axis] += between(random, -0.02, 0.02);
        flight.setPose(pose);
    }
    flight.step(input, dt);
}

// The wall itself is looked up every `every` steps, where the bound says that it may be near.
void steerRealAtRandom(const char* name, const FreeDistance& asked, int steps, int every) {
    const Anatomy& a = anatomy();
    const ColonFlightSetting setting{0.002, 0.03, 0.004};
    ColonFlight flight(asked, a.line, a.home(), setting);
    std::mt19937_64 random(2026);
    FlightInput input;
    double leastFree = 1, leastOver = 1, leastAllowed = 1, travelled = 0;
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < steps; ++k) {
        if (random() % 3 == 0) changeOneWish(input, random);
        const glm::dvec3 before = flight.pose().position;
        steerAnywhere(flight, input, std::pow(10.0, between(random, -3, 0)), random);
        const Pose pose = flight.pose();
        const double allowed = flight.allowedClearance();
        for (const double side : {-0.002, 0.0, 0.002}) {
            const glm::dvec3 eye = pose.position + side * pose.right();
            if (k % every == 0 && a.bound(eye) < 0.0025) {
                const double free = a.free(eye, 0.006, kTolerance);
                leastFree = std::min(leastFree, free);
                leastOver = std::min(leastOver, free - allowed);
                ASSERT_GE(free, allowed - kTolerance) << "step " << k;
            }
            ASSERT_LT(a.valueAt(eye), a.lumen.isovalue) << "in the wall, step " << k;
        }
        leastAllowed = std::min(leastAllowed, allowed);
        travelled += glm::distance(before, pose.position);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf(
        "real anatomy, %s: %d steps, %.0f m flown; nearest eye %.3f mm from the wall, asked for %.3f, least "
        "allowed %.3f, least above the allowed %.5f; %.1f s\n",
        name, steps, travelled, leastFree * 1e3, setting.clearance * 1e3, leastAllowed * 1e3, leastOver * 1e3,
        seconds);
    EXPECT_GT(leastFree, 0);
}

TEST(ColonFlightNightly, RandomSteeringKeepsTheClearance) {
    if (!std::filesystem::exists(maskFile())) GTEST_SKIP() << maskFile() << " is absent";
    steerRealAtRandom("by a bound", anatomy().asked(), 100000 / kShareOfPath, 5);
}

// With the distances of the wall itself, which take longer, the eyes come as near as they may.
TEST(ColonFlightNightly, RandomSteeringByTheWallItselfKeepsTheClearance) {
    if (!std::filesystem::exists(maskFile())) GTEST_SKIP() << maskFile() << " is absent";
    const auto exact = [](const glm::dvec3& p, double upTo) { return anatomy().free(p, upTo, kTolerance); };
    steerRealAtRandom("by the wall", exact, 100 / kShareOfPath + 1, 1);
}

TEST(ColonFlightNightly, GuidedFlightGoesThroughTheWholeColon) {
    if (!std::filesystem::exists(maskFile())) GTEST_SKIP() << maskFile() << " is absent";
    const Anatomy& a = anatomy();
    for (const double separation : {0.0, 0.004}) {
        ColonFlight flight(a.asked(), a.line, a.home(), {0.002, 0.03, separation});
        FlightInput input;
        input.forward = 1;
        double seconds = 0, jumped = 0, least = 1;
        for (; seconds < 150; seconds += 1.0 / 60) {
            const glm::dvec3 before = flight.pose().position;
            flight.step(input, 1.0 / 60);
            const double moved = glm::distance(flight.pose().position, before);
            if (moved > 0.03 / 60 * 1.5) jumped += moved;
            least = std::min(least, flight.clearanceNow());
            ASSERT_GE(flight.clearanceNow(), flight.allowedClearance() - kTolerance) << seconds;
            if (glm::distance(flight.pose().position, a.line.points.back().position) < 0.015) break;
        }
        std::printf("eyes %.1f mm apart: %.1f s for %.0f mm, %.1f mm of them jumped, nearest %.3f mm\n",
                    separation * 1e3, seconds, a.line.length() * 1e3, jumped * 1e3, least * 1e3);
        EXPECT_LT(seconds, 1.1 * a.line.length() / 0.03);
        EXPECT_LT(jumped, 0.03 * a.line.length());
    }
}

TEST(ColonFlightNightly, TheAutomaticFlightKeepsTheClearance) {
    if (!std::filesystem::exists(maskFile())) GTEST_SKIP() << maskFile() << " is absent";
    const Anatomy& a = anatomy();
    for (const bool backwards : {false, true}) {
        const RecordedPath path = centrelineFlight(a.asked(), a.line, {0.002, 0.03, 0.004}, backwards);
        EXPECT_GT(path.duration(), 0.95 * a.line.length() / 0.03);
        double least = 1, worstTurn = 0;
        for (const Pose& pose : path.framesAtRate(60)) {
            for (const double side : {-0.002, 0.0, 0.002}) {
                const double free = a.free(pose.position + side * pose.right(), 0.004, kTolerance);
                ASSERT_GE(free, 0.2 * 0.002 - kTolerance);
                least = std::min(least, free);
            }
        }
        for (double t = 0; t < path.duration(); t += 1.0 / 60) {
            const Pose now = path.at(t), next = path.at(t + 1.0 / 60);
            if (glm::distance(now.position, next.position) > 0.001) continue;  // a cut
            const double cosine = std::abs(glm::dot(now.orientation, next.orientation));
            worstTurn = std::max(worstTurn, 2 * std::acos(std::min(cosine, 1.0)) * 60);
        }
        std::printf("automatic flight %s: %.1f s, nearest %.3f mm, turns by %.2f rad/s at most\n",
                    backwards ? "back" : "there", path.duration(), least * 1e3, worstTurn);
        EXPECT_LT(worstTurn, 4);
    }
}

}  // namespace
}  // namespace stereonav
