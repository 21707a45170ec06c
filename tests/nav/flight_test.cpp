// The navigator as the viewer's window drives it: through the interface of all flights.
#include "engine/nav/flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "engine/nav/navigator.h"

namespace stereonav {
namespace {

std::unique_ptr<Flight> overFlatGround() {
    return std::make_unique<Navigator>([](const glm::dvec2&) { return 5.0; },
                                       poseFromAngles({0, 0, 25}, 0, -0.5, 0), FlightSetting());
}

TEST(NavigatorAsFlight, KnowsItsModesByNumberAndName) {
    const auto flight = overFlatGround();
    ASSERT_EQ(flight->modeCount(), 2);
    EXPECT_EQ(flight->modeName(0), "free");
    EXPECT_EQ(flight->modeName(1), "over ground");
    EXPECT_EQ(flight->mode(), 0);
    flight->setMode(1);
    EXPECT_EQ(flight->mode(), 1);
    for (const int unknown : {-1, 2, 1000}) {
        flight->setMode(unknown);
        EXPECT_EQ(flight->mode(), 1) << unknown;
        EXPECT_EQ(flight->modeName(unknown), "") << unknown;
    }
}

TEST(NavigatorAsFlight, OverGroundKeepsTheHeightWhileLookingDown) {
    const auto flight = overFlatGround();
    flight->setMode(1);
    FlightInput input;
    input.forward = 1;
    for (int k = 0; k < 100; ++k) flight->step(input, 0.05);
    EXPECT_NEAR(flight->clearanceNow(), 50, 0.1) << "the height at which following starts";
    EXPECT_GT(flight->pose().position.y, 400);
    flight->setMode(0);
    for (int k = 0; k < 10; ++k) flight->step(input, 0.05);
    EXPECT_LT(flight->clearanceNow(), 40) << "free flight goes where the viewer looks: down";
}

TEST(NavigatorAsFlight, ReportsSpeedAndClearance) {
    const auto flight = overFlatGround();
    EXPECT_EQ(flight->speed(), FlightSetting().speed);
    EXPECT_NEAR(flight->clearanceNow(), 20, 1e-12);
    FlightInput input;
    input.up = 1;
    flight->step(input, 1);
    EXPECT_NEAR(flight->clearanceNow(), flight->pose().position.z - 5, 1e-12);
    flight->goHome();
    EXPECT_NEAR(flight->clearanceNow(), 20, 1e-12);
}

}  // namespace
}  // namespace stereonav
