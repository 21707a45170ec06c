#include "app/report/model.h"

#include <fmt/format.h>

#include "engine/base/error.h"

namespace stereonav {

void addFigure(Report& report, ReportFigure figure) {
    for (const ReportFigure& other : report.figures)
        if (other.id == figure.id)
            throw Error("", figure.id, "expected each figure once in a report, got it twice",
                        "this is a mistake in the program: please report it");
    report.figures.push_back(std::move(figure));
}

void addChart(Report& report, ReportSection& section, WayChart chart) {
    using Kind = ReportFigure::Kind;
    for (const WayPoint& point : chart.points) {
        const std::string id = fmt::format("{}/{}/", chart.id, point.way.name);
        addFigure(report, {id + "time", chart.timeUnit, chart.setting, Kind::Time, point.way.time});
        addFigure(report,
                  {id + "error", chart.errorUnit, chart.setting, Kind::Error, exactly(point.way.error)});
        addFigure(report,
                  {id + "worst", chart.errorUnit, chart.setting, Kind::Other, exactly(point.worstError)});
        for (const auto& [name, value] : point.others)
            addFigure(report, {id + name, "", chart.setting, Kind::Other, exactly(value)});
    }
    section.blocks.emplace_back(std::move(chart));
}

}  // namespace stereonav
