#include "engine/camera/orbit.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

TEST(Orbit, LooksAtItsMiddleFromItsDistance) {
    const Orbit orbit{{1e5, -2, 30}, 7, -0.3};
    for (const double turn : {0.0, 1.0, kPi, 5.0}) {
        const Pose pose = poseOn(orbit, turn);
        const glm::dvec3 ahead = pose.position + orbit.distance * pose.forward();
        EXPECT_NEAR(glm::length(ahead - orbit.middle), 0, 1e-9);
        EXPECT_GT(pose.position.z, orbit.middle.z) << "from above";
    }
    EXPECT_LT(poseOn(orbit, 0).position.y, orbit.middle.y) << "northwards at first";
}

TEST(Orbit, AFlightGoesAroundOnceAndEndsWhereItBegan) {
    const Orbit orbit{{3, 4, 5}, 2, 0};
    const RecordedPath flight = flightAround(orbit, "the flight");
    const auto& samples = flight.samples();
    ASSERT_GT(samples.size(), 100u);
    EXPECT_EQ(samples.front().time, 0);
    EXPECT_NEAR(glm::length(samples.front().pose.position - samples.back().pose.position), 0, 1e-9);
    glm::dvec3 sum(0);
    for (std::size_t n = 1; n < samples.size(); ++n) {
        EXPECT_GT(samples[n].time, samples[n - 1].time);
        EXPECT_NEAR(glm::length(samples[n].pose.position - orbit.middle), 2, 1e-9);
        sum += samples[n].pose.position - orbit.middle;
    }
    EXPECT_NEAR(glm::length(sum), 0, 1e-9) << "all sides alike";
}

}  // namespace
}  // namespace stereonav
