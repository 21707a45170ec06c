// The eye in turn stays right when swaps come late, early or not at all. Times are made up.
#include "engine/display/frame_sequence.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace stereonav {
namespace {

// A display with a true period that shows what was swapped last.
struct Display {
    double period, start = 100;
    double at(long long refresh) const { return start + static_cast<double>(refresh) * period; }
};

// Swaps at these refreshes of the display, each late by jitter. Returns how many pictures after the first
// `settled` were drawn for the wrong eye.
int wrongEyes(FrameSequence& sequence, const Display& display, const std::vector<long long>& refreshes,
              double jitter, int settled = 0) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> late(0, jitter * display.period);
    int wrong = 0, n = 0;
    std::optional<long long> offset;  // offset of the eyes; known after the first swap
    for (const long long refresh : refreshes) {
        const int eye = sequence.eye();
        if (!offset) offset = (refresh + eye) & 1;
        if (n++ >= settled && ((refresh + eye) & 1) != *offset) ++wrong;
        sequence.swapped(display.at(refresh) + late(random));
    }
    return wrong;
}

std::vector<long long> upTo(long long count) {
    std::vector<long long> refreshes;
    for (long long n = 0; n < count; ++n) refreshes.push_back(n);
    return refreshes;
}

TEST(FrameSequence, AlternatesAtEachRefresh) {
    for (const double rate : {60.0, 100.0, 120.0, 240.0}) {
        FrameSequence sequence(rate);
        EXPECT_EQ(sequence.eye(), 0) << "the one that comes first";
        EXPECT_EQ(wrongEyes(sequence, {1 / rate}, upTo(5000), 0), 0) << rate;
        EXPECT_EQ(sequence.dropped(), 0);
        EXPECT_TRUE(sequence.synchronised());
        EXPECT_EQ(sequence.wait(200), 0) << "the swap waits itself";
    }
}

// Rates of 59.94 and 119.88 are reported as whole numbers; an hour of them would be 216 refreshes off.
TEST(FrameSequence, FollowsTheTrueRate) {
    for (const double told : {60.0, 120.0}) {
        FrameSequence sequence(told);
        const double period = 1.001 / told;
        EXPECT_EQ(wrongEyes(sequence, {period}, upTo(400000), 0.2), 0) << told;
        EXPECT_NEAR(sequence.period() / period, 1, 2e-3);
    }
}

TEST(FrameSequence, ADroppedSwapDoesNotExchangeTheEyes) {
    // Every hundredth refresh is missed, later ones in twos and threes.
    std::vector<long long> refreshes;
    long long missed = 0;
    for (long long n = 0; n < 20000; ++n) {
        const bool out = n % 100 == 50 || (n > 10000 && n % 100 >= 60 && n % 100 <= 60 + n % 3);
        missed += out;
        if (!out) refreshes.push_back(n);
    }
    FrameSequence sequence(120);
    // The picture right after a miss was drawn for the missed refresh: wrong once, then right again.
    const int wrong = wrongEyes(sequence, {1.0 / 120}, refreshes, 0.2);
    EXPECT_LE(wrong, missed);
    EXPECT_GT(wrong, 0) << "misses are seen by nobody else";
    EXPECT_EQ(sequence.dropped(), missed);
    EXPECT_EQ(wrongEyes(sequence, {1.0 / 120, 100 + 20000 / 120.0}, upTo(100), 0), 0);
}

TEST(FrameSequence, ALateReturnOfTheSwapIsNoRefresh) {
    // One return in fifty comes 0.7 of a refresh late: taken for a miss, and put right by the next one.
    FrameSequence sequence(100);
    const double period = 0.01;
    int wrong = 0;
    for (int n = 0; n < 5000; ++n) {
        wrong += sequence.eye() != (n & 1);
        sequence.swapped(50 + n * period + (n % 50 == 25 ? 0.7 * period : 0));
    }
    EXPECT_LE(wrong, 100);
    EXPECT_EQ(sequence.eye(), 0);
    EXPECT_EQ(sequence.refreshes(), 4999);
    EXPECT_TRUE(sequence.synchronised());
}

TEST(FrameSequence, AStopOfSecondsIsCounted) {
    FrameSequence sequence(120);
    wrongEyes(sequence, {1.0 / 120}, upTo(2000), 0);
    const int before = sequence.eye();
    sequence.swapped(100 + (1999 + 600) / 120.0);  // 600 refreshes later
    EXPECT_EQ(sequence.eye(), before) << "an even number";
    sequence.swapped(100 + (1999 + 600 + 3) / 120.0);
    EXPECT_NE(sequence.eye(), before);
    EXPECT_EQ(sequence.dropped(), 599 + 2);
}

TEST(FrameSequence, TheClockStandsInForSwapsThatDoNotWait) {
    FrameSequence sequence(60);
    double now = 10;
    for (int n = 0; n < 200; ++n) sequence.swapped(now += 0.0005);
    EXPECT_FALSE(sequence.synchronised());
    EXPECT_THAT(sequence.takeProblem().value_or(""), testing::HasSubstr("60 Hz"));
    EXPECT_THAT(sequence.takeProblem().value_or(""), testing::HasSubstr("vertical synchronisation"));
    EXPECT_EQ(sequence.takeProblem(), std::nullopt) << "each once";
    int before = sequence.eye(), changes = 0;
    const double began = now;
    for (int n = 0; n < 120; ++n) {
        const double wait = sequence.wait(now);
        EXPECT_GE(wait, 0);
        EXPECT_LE(wait, 1.03 / 60);
        now += wait + 0.001;
        sequence.swapped(now);
        changes += sequence.eye() != before;
        before = sequence.eye();
    }
    EXPECT_GT(changes, 110);
    EXPECT_NEAR(now - began, 2.0, 0.25) << "as fast as the display";
    EXPECT_FALSE(sequence.synchronised()) << "for good";
}

TEST(FrameSequence, SaysWhatKeepsTheEyesFromAlternating) {
    FrameSequence slow(75);
    slow.swapped(1);
    EXPECT_THAT(slow.takeProblem().value_or(""), testing::HasSubstr("75 Hz"));
    FrameSequence fast(144);
    for (int n = 0; n < 1000; ++n) fast.swapped(n / 144.0);
    EXPECT_EQ(fast.takeProblem(), std::nullopt);
    FrameSequence late(144);
    for (int n = 0; n < 1000; ++n) late.swapped((n + n / 5) / 144.0);
    EXPECT_THAT(late.takeProblem().value_or(""), testing::HasSubstr("too late"));
    for (const double none : {0.0, -60.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
        FrameSequence unknown(none);
        unknown.swapped(1);
        EXPECT_NEAR(unknown.period(), 1.0 / 60, 1e-12) << none;
        EXPECT_THAT(unknown.takeProblem().value_or(""), testing::HasSubstr("does not tell"));
    }
}

TEST(FrameSequence, BearsWhatClocksDo) {
    FrameSequence sequence(120);
    EXPECT_EQ(sequence.wait(0), 0);
    for (const double time : {5.0, 5.0, 4.0, 1e300, std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(), -1e300, 0.0, 1.0 / 120})
        sequence.swapped(time);
    EXPECT_TRUE(std::isfinite(sequence.period()));
    EXPECT_GE(sequence.refreshes(), 0);
    EXPECT_TRUE(sequence.eye() == 0 || sequence.eye() == 1);
}

}  // namespace
}  // namespace stereonav
