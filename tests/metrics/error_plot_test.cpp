// The plot: its front by a second way, and that every part of it is there.
#include "engine/metrics/error_plot.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "engine/base/error.h"

namespace stereonav {
namespace {

TEST(ParetoFront, HandWorked) {
    const std::vector<PlotPoint> points{{"a", 5, 1}, {"b", 1, 4}, {"c", 3, 4}, {"d", 3, 2}, {"e", 6, 1}};
    EXPECT_EQ(paretoFront(points), (std::vector<std::size_t>{1, 3, 0}));
}

// A second way: sweep by rising time and keep what lowers the least error so far.
TEST(ParetoFront, AgreesWithASweepOnRandomPoints) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> value(1, 30);
    for (int round = 0; round < 200; ++round) {
        std::vector<PlotPoint> points(1 + round % 12);
        std::set<std::pair<double, double>> seen;
        for (PlotPoint& point : points) do {
                point.time_ms = value(random);
                point.error = value(random);
            } while (!seen.insert({point.time_ms, point.error}).second);
        std::vector<std::pair<double, double>> sweep, front;
        double least = 1e9;
        for (const auto& [time, error] : seen)
            if (error < least) {
                sweep.emplace_back(time, error);
                least = error;
            }
        for (const std::size_t k : paretoFront(points))
            front.emplace_back(points[k].time_ms, points[k].error);
        ASSERT_EQ(front, sweep) << "round " << round;
    }
}

long long inkOf(const Plane<PackedColor>& plot) {
    long long ink = 0;
    for (int y = 0; y < plot.height(); ++y)
        for (int x = 0; x < plot.width(); ++x) ink += plot.at(x, y) != 0x3fffffffu;
    return ink;
}

TEST(ErrorPlot, HasTheSizeOfItsPanelsAndMoreInkWithMorePoints) {
    PlotPanel panel{"title", "time in ms", "error", {{"one", 1.0, 0.5}}};
    const auto single = drawErrorPlot({panel}, "caption");
    panel.points.push_back({"two", 2.0, 0.25});
    panel.points.push_back({"exact", 4.0, 0.0});
    const auto three = drawErrorPlot({panel}, "caption");
    const auto wide = drawErrorPlot({panel, panel}, "caption");
    EXPECT_EQ(single.width(), 760);
    EXPECT_EQ(wide.width(), 1520);
    EXPECT_EQ(wide.height(), single.height());
    EXPECT_GT(inkOf(three), inkOf(single));
    EXPECT_GT(inkOf(wide), inkOf(three) * 3 / 2);
}

TEST(ErrorPlot, DegenerateAndEmptyInput) {
    EXPECT_GT(inkOf(drawErrorPlot({{"t", "x", "y", {{"all exact", 0.0, 0.0}}}}, "")), 0);
    EXPECT_GT(inkOf(drawErrorPlot({{"t", "x", "y", {{"tiny", 1e-6, 1e-9}, {"huge", 1e6, 1e9}}}}, "")), 0);
    EXPECT_THROW(drawErrorPlot({}, ""), Error);
    EXPECT_THROW(drawErrorPlot({{"t", "x", "y", {}}}, ""), Error);
}

}  // namespace
}  // namespace stereonav
