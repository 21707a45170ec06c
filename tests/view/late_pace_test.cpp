// How far ahead frames are cast, and how often one is shown: times are made up here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "app/view/frame_governor.h"
#include "app/view/late_view.h"

namespace stereonav {
namespace {

// Frames in sequence, each asked for when the one before is there; cost: seconds, by the time.
struct LeadFlight {
    LateLead lead;
    double now = 0;
    // Distances of a picture's moment from the middle of the time in which it is seen.
    std::vector<double> off;

    void fly(double until, const std::function<double(double)>& cost) {
        while (now < until) {
            const double asked = now, ahead = lead.seconds();
            now += cost(now);
            lead.came(asked, now);
            off.push_back(asked + ahead - (now + 0.5 * cost(now)));
        }
    }
};

TEST(LateLead, AimsAtTheMiddleOfTheTimeThatAPictureIsSeen) {
    for (const double cost : {0.02, 0.1, 0.5}) {
        LeadFlight flight;
        flight.lead.begin(cost);
        flight.fly(50 * cost, [&](double) { return cost; });
        for (const double off : flight.off) EXPECT_NEAR(off, 0, 1e-9) << cost;
    }
}

TEST(LateLead, FollowsAStepWithinTenFramesAndNeverGoesBeyondIt) {
    for (const double after : {0.02, 0.3}) {
        LeadFlight flight;
        flight.lead.begin(0.1);
        flight.fly(1, [](double) { return 0.1; });
        const std::size_t stepped = flight.off.size();
        flight.fly(1 + 20 * after, [&](double) { return after; });
        for (std::size_t n = stepped + 10; n < flight.off.size(); ++n)
            EXPECT_LT(std::abs(flight.off[n]), 0.05 * std::abs(after - 0.1) * 1.5) << n;
        for (std::size_t n = stepped; n < flight.off.size(); ++n)
            EXPECT_GE(flight.off[n] * (0.1 - after), -1e-9) << "from one side";
    }
}

TEST(LateLead, BeginsWithWhatIsExpectedAndForgetsRests) {
    LateLead lead;
    EXPECT_EQ(lead.seconds(), 0);
    lead.begin(0.2);
    EXPECT_DOUBLE_EQ(lead.seconds(), 0.3);
    lead.begin(0);  // nothing is known
    EXPECT_DOUBLE_EQ(lead.seconds(), 0.3);
    lead.came(0, 0.2);
    EXPECT_NEAR(lead.seconds(), 0.3, 1e-9) << "the first has none before it";
    lead.came(60, 60.2);
    EXPECT_NEAR(lead.seconds(), 0.3, 1e-9) << "a minute of rest";
    lead.came(60.2, 90);
    EXPECT_NEAR(lead.seconds(), 0.3, 1e-9) << "a load";
}

TEST(LatePace, ShowsAsOftenAsThereIsTimeFor) {
    LatePace pace;
    EXPECT_DOUBLE_EQ(pace.period(1 / 60.0, 0), 1 / 60.0);
    EXPECT_DOUBLE_EQ(pace.period(1 / 60.0, 0.1), 0.1) << "wished for";
    for (int n = 0; n < 100; ++n) pace.took(0.0155);
    const double slower = pace.period(1 / 60.0, 0);
    EXPECT_GT(slower, 0.0155) << "the rest is left to the casting";
    EXPECT_LT(slower, 1.6 * 0.0155);
    for (int n = 0; n < 100; ++n) pace.took(1);
    EXPECT_LE(pace.period(1 / 60.0, 0), 1 / 30.0) << "slower ones are seen one by one";
    EXPECT_DOUBLE_EQ(pace.period(1 / 20.0, 0), 1 / 20.0);
}

// Another process takes half of the processor now and then: the size follows, and the moment that frames are
// cast for stays within half a frame of the one in which they are seen.
TEST(LateLead, HoldsWithTheGovernorBesideAnotherProcess) {
    constexpr double kFull_s = 0.08, kTarget_s = 0.033;
    FrameGovernor governor(1000 * kTarget_s);
    LeadFlight flight;
    std::vector<double> scales, at;
    const auto loaded = [](double t) { return t > 4 && t < 8; };
    const auto cost = [&](double t) {
        return kFull_s * (loaded(t) ? 2 : 1) * (0.1 + 0.9 * governor.scale() * governor.scale());
    };
    double worst = 0;
    int changes = 0, settled = 0;
    flight.lead.begin(kFull_s);
    while (flight.now < 12) {
        const double asked = flight.now, ahead = flight.lead.seconds(), took = cost(asked);
        flight.now += took;
        flight.lead.came(asked, flight.now);
        const double scale = governor.scale();
        governor.took({scale, 1}, 1000 * took);
        changes += governor.scale() != scale;
        const bool steady = asked > 1.5 && std::abs(asked - 4) > 0.6 && std::abs(asked - 8) > 3;
        if (steady) worst = std::max(worst, std::abs(asked + ahead - (flight.now + 0.5 * took)) / took);
        settled += asked > 5 && asked < 8 && took <= 1.2 * kTarget_s;
        scales.push_back(scale);
        at.push_back(asked);
    }
    EXPECT_LT(worst, 0.5) << "of a frame";
    EXPECT_LE(changes, 8);
    EXPECT_GT(settled, 60) << "of some 90 frames beside the other one";
}

}  // namespace
}  // namespace stereonav
