// Charts as pictures: the front by a second way, and that every part is there.
#include "engine/metrics/chart_picture.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "engine/metrics/pareto_verdict.h"

namespace stereonav {
namespace {

TEST(ParetoFront, HandWorked) {
    EXPECT_EQ(paretoFront({{5, 1}, {1, 4}, {3, 4}, {3, 2}, {6, 1}}), (std::vector<std::size_t>{1, 3, 0}));
}

// A second way: sweep by rising time and keep what lowers the least error so far.
TEST(ParetoFront, AgreesWithASweepOnRandomPoints) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> value(1, 30);
    for (int round = 0; round < 200; ++round) {
        std::vector<glm::dvec2> points(1 + round % 12);
        std::set<std::pair<double, double>> seen;
        for (glm::dvec2& point : points) do {
                point = {value(random), value(random)};
            } while (!seen.insert({point.x, point.y}).second);
        std::vector<std::pair<double, double>> sweep, front;
        double least = 1e9;
        for (const auto& [time, error] : seen)
            if (error < least) {
                sweep.emplace_back(time, error);
                least = error;
            }
        for (const std::size_t k : paretoFront(points)) front.emplace_back(points[k].x, points[k].y);
        ASSERT_EQ(front, sweep) << "round " << round;
    }
}

long long inkOf(const Plane<PackedColor>& plot) {
    long long ink = 0;
    for (int y = 0; y < plot.height(); ++y)
        for (int x = 0; x < plot.width(); ++x) ink += plot.at(x, y) != 0x3fffffffu;
    return ink;
}

Plane<PackedColor> pictureWith(const std::vector<glm::dvec2>& points, int charts = 1) {
    Chart chart{"title", "time in ms", "error", ChartScale::Kind::Linear, ChartScale::Kind::Logarithmic,
                {{}}};
    for (const glm::dvec2& p : points) chart.series[0].points.push_back({"name", exactly(p.x), exactly(p.y)});
    return chartPicture(sideBySide(std::vector<Chart>(static_cast<std::size_t>(charts), chart), "caption"));
}

TEST(ChartPicture, HasTheSizeOfItsChartsAndMoreInkWithMorePoints) {
    const auto single = pictureWith({{1, 0.5}});
    const auto three = pictureWith({{1, 0.5}, {2, 0.25}, {4, 0}});
    const auto wide = pictureWith({{1, 0.5}, {2, 0.25}, {4, 0}}, 2);
    EXPECT_EQ(single.width(), 760);
    EXPECT_EQ(wide.width(), 1520);
    EXPECT_EQ(wide.height(), single.height());
    EXPECT_GT(inkOf(three), inkOf(single));
    EXPECT_GT(inkOf(wide), inkOf(three) * 3 / 2);
}

TEST(ChartPicture, DegenerateInput) {
    EXPECT_GT(inkOf(pictureWith({{0, 0}})), 0);
    EXPECT_GT(inkOf(pictureWith({{1e-6, 1e-9}, {1e6, 1e9}})), 0);
    EXPECT_GT(inkOf(pictureWith({{NAN, 1}})), 0);
}

}  // namespace
}  // namespace stereonav
