// The automatic flight along a centreline, looked at finely: place, speed, clearance, view and cuts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "tests/support/analytic_lumen.h"

namespace stereonav {
namespace {

constexpr ColonFlightSetting kSetting{0.002, 0.03, 0.004};

RecordedPath pathIn(const AnalyticLumen& lumen, bool backwards = false) {
    return centrelineFlight(lumen.freeDistance(), lumen.line, kSetting, backwards);
}

TEST(CentrelineFlight, KeepsTheClearanceAtEveryPose) {
    for (const AnalyticLumen& lumen : {straightTube(), torus(), foldedTube(0.02, 0.008), flexure()})
        for (const bool backwards : {false, true}) {
            const RecordedPath path = pathIn(lumen, backwards);
            for (double t = 0; t <= path.duration(); t += 0.001) {
                const Pose pose = path.at(t);
                for (const double side : {-0.002, 0.0, 0.002})
                    ASSERT_GE(lumen.distance(pose.position + side * pose.right()), 0.002)
                        << lumen.name << " at " << t;
            }
        }
}

TEST(CentrelineFlight, NeverReachesTheWallInAThroat) {
    for (const double least : {0.0045, 0.004, 0.003}) {
        const AnalyticLumen lumen = throat(least);
        const RecordedPath path = pathIn(lumen);
        double nearest = 1;
        for (double t = 0; t <= path.duration(); t += 0.0005) {
            const Pose pose = path.at(t);
            for (const double side : {-0.002, 0.0, 0.002})
                nearest = std::min(nearest, lumen.distance(pose.position + side * pose.right()));
        }
        EXPECT_GT(nearest, 0.2 * 0.002) << least;
    }
}

// What is told of a flight against a look at every tenth of a millisecond of it.
TEST(CentrelineFlight, TheClearanceToldIsTheLeastOfHeadAndEyes) {
    for (const AnalyticLumen& lumen :
         {straightTube(), torus(), foldedTube(0.02, 0.008), throat(0.0045), throat(0.003)}) {
        const RecordedPath path = pathIn(lumen);
        for (const double separation : {0.0, 0.004}) {
            double head = 1, eyes = 1;
            for (double t = 0; t <= path.duration(); t += 0.0001) {
                const Pose pose = path.at(t);
                head = std::min(head, lumen.distance(pose.position));
                for (const double side : {-separation / 2, separation / 2})
                    eyes = std::min(eyes, lumen.distance(pose.position + side * pose.right()));
            }
            const FlightClearance told = clearanceOf(path, lumen.freeDistance(), separation);
            EXPECT_LE(told.head, head) << lumen.name;
            EXPECT_GE(told.head, head - 2e-5) << lumen.name;
            EXPECT_LE(told.eyes, eyes) << lumen.name << separation;
            EXPECT_GE(told.eyes, eyes - 2e-5) << lumen.name << separation;
        }
    }
}

// A fold that the samples pass between two looks.
TEST(CentrelineFlight, TheClearanceToldKnowsWhatLiesBetweenSamples) {
    const glm::dvec3 edge(0, 0.0105, 0.003);
    const FreeDistance free = [&](const glm::dvec3& p, double upTo) {
        return std::min(glm::distance(p, edge), upTo);
    };
    const Pose first = poseFromAngles({0, 0, 0}, 0, 0, 0), last = poseFromAngles({0, 0.04, 0}, 0, 0, 0);
    const RecordedPath path({{0, first}, {1, last}}, "test");
    const FlightClearance told = clearanceOf(path, free, 0.002);
    EXPECT_NEAR(told.head, 0.003, 1e-5);
    EXPECT_NEAR(told.eyes, std::hypot(0.003, 0.001), 1e-5);
}

TEST(CentrelineFlight, IsEvenAndStaysOnTheLine) {
    for (const AnalyticLumen& lumen : {straightTube(), torus(), flexure()})
        for (const bool backwards : {false, true}) {
            const RecordedPath path = pathIn(lumen, backwards);
            EXPECT_NEAR(path.duration(), lumen.line.length() / 0.03, 1e-6) << lumen.name;
            const glm::dvec3 first = lumen.line.points.front().position,
                             last = lumen.line.points.back().position;
            EXPECT_LT(glm::distance(path.at(0).position, backwards ? last : first), 1e-9);
            EXPECT_LT(glm::distance(path.at(path.duration()).position, backwards ? first : last), 1e-9);
            for (double t = 0.05; t < path.duration(); t += 0.05) {
                const double moved = glm::distance(path.at(t).position, path.at(t - 0.05).position);
                // Corners are cut by the chord between two samples.
                ASSERT_NEAR(moved, 0.03 * 0.05, 0.03 * 0.05 * 0.45) << lumen.name << " at " << t;
                if (lumen.name != "tight flexure") {
                    ASSERT_NEAR(moved, 0.03 * 0.05, 1e-6) << lumen.name << " at " << t;
                }
            }
        }
}

TEST(CentrelineFlight, LooksAheadWithoutRollingAndTurnsSmoothly) {
    for (const AnalyticLumen& lumen : {torus(), flexure(), interrupted()}) {
        for (const bool backwards : {false, true}) {
            const RecordedPath path = pathIn(lumen, backwards);
            for (double t = 0.1; t < path.duration() - 0.2; t += 0.01) {
                const Pose pose = path.at(t), next = path.at(t + 0.01);
                const glm::dvec3 way = path.at(t + 0.2).position - pose.position;
                if (glm::length(way) > 0.01) continue;  // over a cut
                const glm::dvec3 forward = pose.forward();
                ASSERT_GT(glm::dot(forward, glm::normalize(way)), 0.1) << lumen.name << " at " << t;
                // Parallel transport: the head does not turn about the viewing axis.
                const glm::dquat turn = glm::inverse(pose.orientation) * next.orientation;
                ASSERT_LT(std::abs(turn.z), 1e-3) << lumen.name << " at " << t;
                if (glm::distance(next.position, pose.position) < 0.001) {
                    ASSERT_LT(2 * std::acos(std::min(1.0, std::abs(turn.w))), 0.05)
                        << lumen.name << " at " << t;
                }
            }
        }
    }
}

TEST(CentrelineFlight, CutsLieBetweenFrames) {
    const AnalyticLumen lumen = interrupted();
    for (const bool backwards : {false, true}) {
        const RecordedPath path = pathIn(lumen, backwards);
        for (const int rate : {24, 25, 30, 50, 60, 100})
            for (const Pose& pose : path.framesAtRate(rate))
                ASSERT_GE(lumen.distance(pose.position), 0.002) << rate << " frames a second";
        double inTissue = 0;
        for (double t = 0; t < path.duration(); t += 1e-5)
            if (lumen.distance(path.at(t).position) < 0.002) inTissue += 1e-5;
        EXPECT_GT(inTissue, 0) << "there is a cut";
        EXPECT_LT(inTissue, 0.0006);
    }
}

TEST(CentrelineFlight, FliesOnlyWhereThereIsRoom) {
    // 3 mm wide at the narrowest: nothing is left beside eyes 4 mm apart.
    const AnalyticLumen lumen = throat(0.0015);
    const RecordedPath path = pathIn(lumen);
    for (const Pose& pose : path.framesAtRate(60))
        for (const double side : {-0.002, 0.0, 0.002})
            ASSERT_GT(lumen.distance(pose.position + side * pose.right()), 0.2 * 0.002);
    EXPECT_GT(path.at(path.duration()).position.y, 0.155) << "the part beyond the throat is flown too";
}

TEST(CentrelineFlight, RefusesWhatCanNotBeFlown) {
    AnalyticLumen lumen = straightTube();
    EXPECT_THROW(centrelineFlight(lumen.freeDistance(), {}, kSetting), Error);
    EXPECT_THROW(centrelineFlight(lumen.freeDistance(), lumen.line, {0.002, 0, 0}), Error);
    lumen.distance = [](const glm::dvec3&) { return std::nan(""); };
    EXPECT_THROW(pathIn(lumen), Error);
    lumen = straightTube();
    lumen.line.points.resize(1);
    EXPECT_THROW(pathIn(lumen), Error);
    lumen = straightTube();
    lumen.line.points[100].position.x = std::nan("");
    const RecordedPath path = pathIn(lumen);
    for (const PathSample& sample : path.samples())
        ASSERT_TRUE(std::isfinite(sample.pose.position.x)) << sample.time;
}

}  // namespace
}  // namespace stereonav
