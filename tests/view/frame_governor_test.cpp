// Size of frames by their cost, which is recorded or made up here, like the time: no window and no clock.
#include "app/view/frame_governor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace stereonav {
namespace {

constexpr double kGovernedTarget = 33;

// Milliseconds of a frame in full size, by its number; fixed: the share that does not depend on the size.
struct GovernedFlight {
    std::function<double(int)> full_ms;
    double fixed = 0;
    std::vector<double> scales, ms;

    void fly(FrameGovernor& governor, int from, int to) {
        for (int n = from; n < to; ++n) {
            const double scale = governor.scale();
            const double cost = full_ms(n) * (fixed + (1 - fixed) * scale * scale);
            scales.push_back(scale);
            ms.push_back(cost);
            governor.took({scale, 1}, cost);
        }
    }
    int changes(std::size_t from, std::size_t to) const {
        int count = 0;
        for (std::size_t n = std::max<std::size_t>(from, 1); n < to; ++n) count += scales[n] != scales[n - 1];
        return count;
    }
};

TEST(FrameGovernor, StaysWhereFramesAreFast) {
    FrameGovernor governor(kGovernedTarget);
    GovernedFlight flight{[](int) { return 20.0; }, 0, {}, {}};
    flight.fly(governor, 0, 50);
    EXPECT_EQ(governor.scale(), 1);
    EXPECT_EQ(flight.changes(0, 50), 0);
}

TEST(FrameGovernor, SettlesWithinFiveFramesOfAStep) {
    for (const double fixed : {0.0, 0.2, 0.5})
        for (const double slow : {40.0, 60.0, 90.0, 150.0, 250.0}) {
            SCOPED_TRACE(testing::Message() << fixed << " " << slow);
            FrameGovernor governor(kGovernedTarget);
            GovernedFlight flight{[&](int n) { return n < 20 || n >= 60 ? 25.0 : slow; }, fixed, {}, {}};
            flight.fly(governor, 0, 100);
            EXPECT_EQ(flight.changes(0, 20), 0);
            EXPECT_EQ(flight.changes(26, 60), 0) << "it has settled";
            const double least =
                slow * (fixed + (1 - fixed) * FrameGovernor::kScales.back() * FrameGovernor::kScales.back());
            EXPECT_LE(flight.ms[26], std::max(1.15 * kGovernedTarget, least + 1e-9));
            if (least < 0.6 * kGovernedTarget) {
                EXPECT_GT(flight.ms[40], 0.55 * kGovernedTarget) << "no smaller than it has to be";
            }
            EXPECT_EQ(flight.changes(66, 100), 0) << "and back";
            EXPECT_EQ(flight.scales.back(), 1);
        }
}

// The cost rises as where a flight comes near to the ground.
TEST(FrameGovernor, FollowsARamp) {
    FrameGovernor governor(kGovernedTarget);
    GovernedFlight flight{[](int n) { return n < 100 ? 20 + 1.0 * n : 220 - 1.0 * n; }, 0.15, {}, {}};
    flight.fly(governor, 0, 200);
    int late = 0, turns = 0;
    for (std::size_t n = 1; n < 200; ++n) {
        late += flight.ms[n] > 1.3 * kGovernedTarget;
        // The size falls on the way up, rises on the way back, and does nothing else.
        turns += n < 100 ? flight.scales[n] > flight.scales[n - 1] : flight.scales[n] < flight.scales[n - 1];
    }
    EXPECT_EQ(late, 0);
    EXPECT_EQ(turns, 0);
    EXPECT_EQ(flight.scales.back(), 1);
}

// Some frames take half as long again, as beside another program.
TEST(FrameGovernor, DoesNotPumpWithNoise) {
    for (const double full : {25.0, 38.0, 50.0, 70.0, 100.0})
        for (unsigned seed = 1; seed <= 5; ++seed) {
            SCOPED_TRACE(testing::Message() << full << " " << seed);
            std::mt19937 random(seed);
            std::uniform_real_distribution<double> noise(0.85, 1.15), chance(0, 1);
            FrameGovernor governor(kGovernedTarget);
            GovernedFlight flight{
                [&](int) { return full * noise(random) * (chance(random) < 0.08 ? 1.5 : 1.0); }, 0.1, {}, {}};
            flight.fly(governor, 0, 600);
            EXPECT_LE(flight.changes(60, 600), 6) << "in eighteen seconds";
        }
}

// Costs beside a program that uses the processor now and then, as recorded, between half and twice the mean.
// The size stays the same all the same, and the mean cost is the target.
TEST(FrameGovernor, StandsStillInStrongNoise) {
    for (const double full : {20.0, 40.0, 70.0, 120.0})
        for (unsigned seed = 1; seed <= 5; ++seed) {
            SCOPED_TRACE(testing::Message() << full << " " << seed);
            std::mt19937 random(seed);
            std::normal_distribution<double> noise(0, 0.5);
            FrameGovernor governor(kGovernedTarget);
            GovernedFlight flight{[&](int) { return full * std::exp(noise(random)); }, 0.1, {}, {}};
            flight.fly(governor, 0, 1200);
            EXPECT_LE(flight.changes(200, 1200), 12) << "in half a minute";
            double sum = 0;
            for (std::size_t n = 200; n < 1200; ++n) sum += flight.ms[n] / 1000;
            EXPECT_LT(sum, 1.3 * kGovernedTarget);
            if (full > 60) {
                EXPECT_GT(sum, 0.4 * kGovernedTarget);
            }
        }
}

// A second process comes now and then and doubles the cost of frames.
TEST(FrameGovernor, WaitsLongerWhereItDidNotLast) {
    FrameGovernor governor(kGovernedTarget);
    GovernedFlight flight{[](int n) { return n / 12 % 2 ? 56.0 : 28.0; }, 0, {}, {}};
    flight.fly(governor, 0, 600);
    EXPECT_GE(flight.changes(0, 24), 1);
    EXPECT_LE(flight.changes(300, 600), 8) << "25 times another load";
}

// A medium's frame in full size takes seconds: it begins small, and grows up to what its target has room for.
TEST(FrameGovernor, BeginsAMediumWithTheLeastWork) {
    constexpr double kTarget = 130, kLight = 0.1;  // kLight: the share that no size changes
    for (const bool efforts : {true, false})
        for (const double full : {60.0, 400.0, 1200.0, 6000.0}) {
            SCOPED_TRACE(testing::Message() << efforts << " " << full);
            FrameGovernor governor(kTarget);
            governor.setMedium(true, efforts);
            EXPECT_EQ(governor.scale(), FrameGovernor::kScales.back());
            EXPECT_EQ(governor.effort(), efforts ? FrameGovernor::kEfforts.back() : 1);
            const FrameGovernor::Size none = governor.sizeWithin(450);
            EXPECT_EQ(none.scale, governor.scale()) << "nothing is known";
            std::vector<double> ms;
            for (int n = 0; n < 40; ++n) {
                const FrameGovernor::Size size{governor.scale(), governor.effort()};
                ms.push_back(full * size.effort * (kLight + (1 - kLight) * size.scale * size.scale));
                governor.took(size, ms.back());
            }
            const double least = ms.front();
            for (const double frame : ms) EXPECT_LE(frame, std::max(1.15 * kTarget, least));
            EXPECT_EQ(ms[39], ms[20]) << "it has settled";
            if (full < 2000) {
                EXPECT_GT(ms[39], std::min(0.5 * kTarget, 0.99 * full));
            }
            // A resting picture has more time.
            const FrameGovernor::Size rests = governor.sizeWithin(4 * kTarget);
            EXPECT_GE(rests.scale * rests.scale * rests.effort,
                      governor.scale() * governor.scale() * governor.effort());
            governor.setMedium(false, false);
            EXPECT_EQ(governor.effort(), 1);
        }
}

// Efforts go down only at the smallest size, and one frame that takes far too long is enough.
TEST(FrameGovernor, LeavesOutAMediumsSlicesLast) {
    FrameGovernor governor(1e6);
    governor.setMedium(true, true);
    while (governor.scale() < 1) governor.took({governor.scale(), governor.effort()}, 1);
    governor.setTarget(130);
    governor.took({}, 1000);
    EXPECT_LT(governor.scale(), 0.6);
    EXPECT_EQ(governor.effort(), 1);
    const FrameGovernor::Size before{governor.scale(), governor.effort()};
    governor.took({before.scale, 0.5}, 4000);
    EXPECT_EQ(governor.scale(), before.scale) << "a frame of another effort";
    governor.took(before, 4000);
    EXPECT_EQ(governor.scale(), FrameGovernor::kScales.back());
    EXPECT_LT(governor.effort(), 1);
}

// Frames that are cast wider than shown (LateGuard) are made smaller before one of them comes late, and the
// size comes back when the guard is gone. Some frames of the area before come after the change.
TEST(FrameGovernor, TheSizePaysForAWiderFrame) {
    for (const double fixed : {0.0, 0.2})
        for (const double full : {15.0, 30.0, 80.0})
            for (const double area : {1.2, 1.5}) {
                SCOPED_TRACE(testing::Message() << fixed << " " << full << " " << area);
                FrameGovernor governor(kGovernedTarget);
                double cast = 1;
                FrameGovernor::Size size;
                int late = 0, changes = 0, settled = 0;
                for (int n = 0; n < 120; ++n) {
                    const double wanted = n >= 40 && n < 80 ? area : 1;
                    governor.setArea(wanted);
                    // The present frame was asked for one before.
                    const double ms = full * (fixed + (1 - fixed) * size.scale * size.scale * cast);
                    governor.took(size, ms, cast);
                    if (n >= 40) {
                        late += ms > 1.15 * kGovernedTarget;
                        changes += size.scale != governor.scale();
                        settled += size.scale != governor.scale() && (n % 40) > 8;
                    }
                    size = {governor.scale(), 1};
                    cast = wanted;
                }
                EXPECT_LE(late, 1);
                EXPECT_LE(changes, full < 20 ? 0 : 6);
                EXPECT_EQ(settled, 0);
            }
}

TEST(FrameGovernor, TakesNoFrameForAnother) {
    FrameGovernor governor(kGovernedTarget);
    EXPECT_EQ(governor.usual_ms(), 0);
    for (int n = 0; n < 10; ++n) governor.took({}, 120);
    const double scale = governor.scale();
    EXPECT_LT(scale, 0.7);
    for (int n = 0; n < 10; ++n) governor.took({}, 500);  // full ones, at rest
    governor.took({scale, 1}, std::nan(""));
    governor.took({scale, 1}, 0);
    EXPECT_EQ(governor.scale(), scale);
    governor.forget();
    EXPECT_EQ(governor.scale(), scale);
    EXPECT_EQ(governor.usual_ms(), 0);
}

}  // namespace
}  // namespace stereonav
