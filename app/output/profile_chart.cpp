#include "app/output/profile_chart.h"

#include "engine/metrics/svg_chart.h"

namespace stereonav {

std::string profileChart(const std::vector<LinePoint>& points, const std::string& title) {
    const bool inKilometres = points.back().distance >= 2000;
    ChartSeries ground;
    for (const LinePoint& point : points)
        ground.curve.emplace_back(point.distance / (inKilometres ? 1000 : 1), point.height);
    Chart chart{title, inKilometres ? "distance over the plan, km" : "distance over the plan, m",
                "height, m"};
    chart.xKind = ChartScale::Kind::Linear;
    chart.yKind = ChartScale::Kind::Around;
    chart.series.push_back(std::move(ground));
    chart.front = false;
    chart.titled = true;
    chart.width = 1000;
    return svgOf(chart, true);
}

}  // namespace stereonav
