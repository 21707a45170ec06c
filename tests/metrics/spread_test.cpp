// Medians and spreads, and which ways are on the front.
#include "engine/metrics/spread.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "engine/metrics/pareto_verdict.h"

namespace stereonav {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Spread, IsMedianAndEnds) {
    const Spread odd = spreadOf({5, 1, 3}), even = spreadOf({4, 1, 2, 9});
    EXPECT_EQ(odd.median, 3);
    EXPECT_EQ(odd.low, 1);
    EXPECT_EQ(odd.high, 5);
    EXPECT_EQ(odd.count, 3);
    EXPECT_EQ(even.median, 3);
    EXPECT_DOUBLE_EQ(odd.relative(), 2.0 / 3);
}

TEST(Spread, LeavesOutWhatIsNotFinite) {
    const Spread spread = spreadOf({NAN, 2, INFINITY});
    EXPECT_EQ(spread.count, 1);
    EXPECT_EQ(spread.median, 2);
    EXPECT_EQ(spreadOf({}).count, 0);
    EXPECT_EQ(spreadOf({NAN}).count, 0);
    EXPECT_EQ(spreadText(spreadOf({})), "not measured");
}

TEST(Spread, MedianOfHugeValuesIsFinite) {
    const double most = std::numeric_limits<double>::max();
    EXPECT_EQ(spreadOf({most, most}).median, most);
}

TEST(Spread, IsWrittenWithThreeDigits) {
    EXPECT_EQ(numberText(0), "0");
    EXPECT_EQ(numberText(1.23456), "1.23");
    EXPECT_EQ(numberText(123456), "123456");
    EXPECT_EQ(numberText(1.5e-7), "1.50e-07");
    EXPECT_EQ(numberText(NAN), "none");
    EXPECT_EQ(spreadText({2, 1, 3, 3}), "2 (1 to 3)");
    EXPECT_EQ(spreadText(exactly(2)), "2");
    EXPECT_EQ(spreadText(scaled({2, 1, 3, 3}, 10)), "20 (10 to 30)");
}

Way way(const char* name, double low, double error, bool isDefault = false) {
    return {name, {low * 1.1, low, low * 1.2, 3}, error, isDefault};
}

TEST(Pareto, FrontIsWhatNoneBeats) {
    const std::vector<Way> ways{way("exact", 10, 0), way("slow", 12, 1), way("fast", 1, 5),
                                way("middle", 3, 2)};
    EXPECT_THAT(frontOf(ways), ElementsAre(2, 3, 0));
    EXPECT_TRUE(frontOf({}).empty());
}

TEST(Pareto, WhatWasNotMeasuredIsNotOnIt) {
    std::vector<Way> ways{way("a", 1, 1), way("b", 0, 0)};
    ways[1].time.count = 0;
    EXPECT_THAT(frontOf(ways), ElementsAre(0));
    EXPECT_THAT(frontText({ways[1]}), HasSubstr("Nothing was measured"));
}

TEST(Pareto, VerdictSaysByHowMuch) {
    const std::vector<Way> ways{way("exact", 8, 0), way("fast", 2, 4), way("usual", 4, 4, true),
                                way("fine", 4, 1)};
    const ParetoVerdict verdict = verdictOf(ways, 2);
    EXPECT_FALSE(verdict.onFront);
    EXPECT_FALSE(verdict.withinNoise);
    EXPECT_EQ(verdict.faster, "fast");
    EXPECT_EQ(verdict.better, "fine");
    EXPECT_DOUBLE_EQ(verdict.timeSaved, 0.5);
    EXPECT_DOUBLE_EQ(verdict.errorSaved, 0.75);
    EXPECT_TRUE(verdictOf(ways, 0).onFront);
    EXPECT_THAT(frontText(ways), HasSubstr("usual, is not on the front: fast takes 50.0 % less time"));
}

TEST(Pareto, ATieIsOnTheFront) {
    const std::vector<Way> ways{way("a", 1, 1, true), way("b", 1, 1)};
    EXPECT_TRUE(verdictOf(ways, 0).onFront);
    EXPECT_TRUE(verdictOf(ways, 1).onFront);
}

TEST(Pareto, LittleLessTimeIsNoise) {
    const std::vector<Way> ways{way("usual", 1.05, 1, true), way("other", 1, 0.995)};
    const ParetoVerdict verdict = verdictOf(ways, 0);
    EXPECT_FALSE(verdict.onFront);
    EXPECT_TRUE(verdict.withinNoise);
    EXPECT_THAT(frontText(ways), HasSubstr("within the spread of repeats"));
}

}  // namespace
}  // namespace stereonav
