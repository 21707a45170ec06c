// Charts as SVG: well-formed whatever is drawn, scales that hold their values, labels that do not meet.
#include "engine/metrics/svg_chart.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/xml_check.h"

namespace stereonav {
namespace {

using testing::HasSubstr;
using testing::Not;
using Kind = ChartScale::Kind;

std::size_t countOf(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

const std::vector<std::vector<double>> kHardValues{{},
                                                   {0},
                                                   {3},
                                                   {5, 5, 5},
                                                   {0, 0},
                                                   {-2, 3},
                                                   {1e-300, 1e300},
                                                   {1, 1 + 1e-12},
                                                   {NAN, 2},
                                                   {INFINITY, 1, 2},
                                                   {-1e9, -1e8},
                                                   {std::numeric_limits<double>::denorm_min(), 1}};

TEST(ChartScale, HoldsItsValuesAndHasTicks) {
    for (const auto& values : kHardValues)
        for (const Kind kind : {Kind::Linear, Kind::Logarithmic, Kind::Automatic, Kind::Around}) {
            const ChartScale scale(values, kind);
            for (const double v : values) {
                const double place = scale.place(v);
                EXPECT_GE(place, 0) << v;
                EXPECT_LE(place, 1) << v;
            }
            const auto ticks = scale.ticks();
            EXPECT_GE(ticks.size(), 1u);
            EXPECT_LE(ticks.size(), 9u);
            for (const ChartScale::Tick& tick : ticks) {
                EXPECT_TRUE(std::isfinite(tick.value));
                EXPECT_FALSE(tick.text.empty());
            }
        }
}

TEST(ChartScale, GrowsWithItsValues) {
    for (const Kind kind : {Kind::Linear, Kind::Logarithmic}) {
        const ChartScale scale({1, 10, 100}, kind);
        EXPECT_LT(scale.place(1), scale.place(10));
        EXPECT_LT(scale.place(10), scale.place(100));
    }
    const ChartScale log({1, 10, 100}, Kind::Logarithmic);
    EXPECT_NEAR(log.place(10) - log.place(1), log.place(100) - log.place(10), 1e-12);
    const ChartScale linear({0, 50, 100}, Kind::Linear);
    EXPECT_NEAR(linear.place(50) - linear.place(0), linear.place(100) - linear.place(50), 1e-12);
}

TEST(ChartScale, EqualValuesLieWithin) {
    for (const Kind kind : {Kind::Linear, Kind::Logarithmic}) {
        const ChartScale scale({5, 5}, kind);
        EXPECT_GT(scale.place(5), 0.2);
        EXPECT_LT(scale.place(5), 0.98);
    }
}

Chart chartOf(const std::vector<double>& xs, const std::vector<double>& ys, Kind kind) {
    Chart chart{"a <title> & more", "time \"ms\"", "error's", kind, kind, {}, true};
    ChartSeries series{"one", {}, true};
    for (std::size_t n = 0; n < std::min(xs.size(), ys.size()); ++n)
        series.points.push_back({"point <" + std::to_string(n) + ">",
                                 {xs[n], xs[n], xs[n], 1},
                                 {ys[n], ys[n], ys[n], 1},
                                 n == 0});
    chart.series.push_back(series);
    return chart;
}

TEST(SvgChart, IsWellFormedWhateverIsDrawn) {
    for (const auto& xs : kHardValues)
        for (const auto& ys : kHardValues)
            for (const Kind kind : {Kind::Linear, Kind::Logarithmic}) {
                const std::string svg = svgOf(chartOf(xs, ys, kind));
                EXPECT_EQ(test::xmlProblem(svg), "");
                EXPECT_THAT(svg, Not(HasSubstr("nan")));
                EXPECT_THAT(svg, Not(HasSubstr("\"inf")));
            }
}

TEST(SvgChart, DrawsEveryPointOnceAndRingsTheDefault) {
    const std::string svg = svgOf(chartOf({1, 2, 3}, {3, 2, 0}, Kind::Logarithmic));
    EXPECT_EQ(countOf(svg, "class=\"dot s0"), 3u);
    EXPECT_EQ(countOf(svg, "class=\"default\""), 1u);
    EXPECT_EQ(countOf(svg, "class=\"front\""), 1u);
    for (const char* name : {"point &lt;0&gt;", "point &lt;1&gt;", "point &lt;2&gt;"})
        EXPECT_EQ(countOf(svg, name), 2u) << name;  // its label and its title
}

TEST(SvgChart, LeavesOutWhatWasNotMeasured) {
    Chart chart = chartOf({1, 2}, {1, 2}, Kind::Linear);
    chart.series[0].points[1].y.count = 0;
    EXPECT_EQ(countOf(svgOf(chart), "class=\"dot s0"), 1u);
}

TEST(SvgChart, ManySeriesHaveALegendAndStayWellFormed) {
    Chart chart = chartOf({1, 2}, {1, 2}, Kind::Linear);
    for (int n = 0; n < 9; ++n) {
        chart.series.push_back(chart.series[0]);
        chart.series.back().name = "series " + std::to_string(n);
    }
    const std::string svg = svgOf(chart);
    EXPECT_EQ(test::xmlProblem(svg), "");
    for (int n = 0; n < 9; ++n) EXPECT_THAT(svg, HasSubstr("series " + std::to_string(n)));
}

TEST(SvgChart, LongNamesInTheLegendLoseTheirMiddle) {
    Chart chart = chartOf({1, 2}, {1, 2}, Kind::Linear);
    chart.series.push_back(chart.series[0]);
    for (const char* letter : {"a", "\u00f6"}) {
        chart.series[1].name = "begin";
        for (int n = 0; n < 60; ++n) chart.series[1].name += letter;
        chart.series[1].name += "end";
        const std::string svg = svgOf(chart);
        EXPECT_EQ(test::xmlProblem(svg), "");
        EXPECT_THAT(svg, Not(HasSubstr(chart.series[1].name)));
        EXPECT_THAT(svg, HasSubstr(">begin"));
        EXPECT_THAT(svg, HasSubstr(std::string(letter) + "end<"));
    }
}

TEST(SvgChart, ACurveIsInterruptedWhereNothingIsKnown) {
    Chart chart{"ground", "distance", "height", Kind::Linear, Kind::Around};
    chart.series.push_back({"", {}, false, {{0, 5}, {1, 6}, {2, NAN}, {3, 7}, {4, 8}, {5, NAN}, {6, 5}}});
    chart.titled = true;
    const std::string svg = svgOf(chart, true);
    EXPECT_EQ(test::xmlProblem(svg), "");
    EXPECT_EQ(countOf(svg, "class=\"curve\""), 2u);
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_EQ(countOf(svg, ">ground<"), 2u) << "drawn, and said by readers of screens";
}

TEST(SvgChart, LabelsNeverMeet) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> x(62, 400), y(12, 270);
    const LabelBox frame{60, 10, 350, 270};
    for (int round = 0; round < 30; ++round) {
        std::vector<LabelWish> wishes;
        for (int n = 0; n < 25; ++n) wishes.push_back({"name " + std::to_string(n), x(random), y(random)});
        const std::vector<LabelBox> boxes = placeLabels(wishes, frame);
        ASSERT_EQ(boxes.size(), wishes.size());
        EXPECT_GT(boxes.front().width, 0);
        for (std::size_t a = 0; a < boxes.size(); ++a) {
            if (boxes[a].width == 0) continue;
            EXPECT_GE(boxes[a].x, frame.x);
            EXPECT_LE(boxes[a].x + boxes[a].width, frame.x + frame.width);
            EXPECT_GE(boxes[a].y, frame.y);
            EXPECT_LE(boxes[a].y + boxes[a].height, frame.y + frame.height);
            for (std::size_t b = 0; b < a; ++b)
                if (boxes[b].width > 0) {
                    EXPECT_FALSE(boxes[a].overlaps(boxes[b]));
                }
        }
    }
}

TEST(SvgChart, LabelsStandOffWhatIsAvoidedWhereTheyCan) {
    const LabelBox frame{60, 10, 350, 270}, line{100, 99, 300, 2};  // from the point to the right
    const LabelWish wish{"name", 100, 100};
    EXPECT_TRUE(placeLabels({wish}, frame)[0].overlaps(line)) << "the test shows nothing";
    const LabelBox found = placeLabels({wish}, frame, {line})[0];
    EXPECT_GT(found.width, 0);
    EXPECT_FALSE(found.overlaps(line));
    EXPECT_GT(placeLabels({wish}, frame, {frame})[0].width, 0) << "a name is worth more than a line";
}

TEST(Xml, EscapesWhatMeansSomething) {
    EXPECT_EQ(escapedXml("<a b=\"c\" d='e'>&"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;");
    EXPECT_EQ(escapedXml("\x01x\x7f\xff\u009b\n"), "\\x01x\\x7f\\xff\\xc2\\x9b\n");
    EXPECT_EQ(escapedXml("Höhe"), "Höhe");
}

}  // namespace
}  // namespace stereonav
