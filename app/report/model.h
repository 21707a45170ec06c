// Results of `report`, before they become a page, JSON or CSV: sections of charts, tables and pictures, and
// the list of all figures, by which later runs are compared.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/report/paper_rows.h"
#include "engine/metrics/pareto_verdict.h"
#include "engine/metrics/svg_chart.h"

namespace stereonav {

// One number. Figures of two runs with the same id and setting can be compared.
struct ReportFigure {
    enum class Kind { Time, Error, Other };  // Other: shown, but not compared
    std::string id, unit, setting;
    Kind kind = Kind::Other;
    Spread value;
};

// Error and time of one approximation.
struct WayPoint {
    Way way;                // the way's name is also the end of the figures' ids
    std::string detail;     // settings, in words
    double worstError = 0;  // worst of the frames, or of the texels
    std::vector<std::pair<std::string, double>> others =
        {};  // further columns of the table; the same for all points
};
struct WayChart {
    std::string id, title, text;  // text: what was measured, how, and against which reference
    std::string setting;          // conditions that comparable figures share: "500x400, 4 frames, 2 threads"
    std::string timeLabel, timeUnit = "ms", errorLabel = "RMS error, 8-bit levels", errorUnit = "levels";
    std::vector<WayPoint> points;
    bool front =
        true;         // the points are alternatives: less is better in both; false: cases of a single choice
    std::string why;  // reason for a default that is not on the front
};

// A chart of another kind.
struct LineChart {
    Chart chart;
    std::string text;
};
struct ReportTable {
    std::string title, text;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
    // Notes for each row, or none: shown below the row, once for successive rows with the same note. In such
    // rows equal first cells are shown once, too.
    std::vector<std::string> notes = {};
};
struct ReportPicture {
    std::string title;
    std::vector<unsigned char> png;
};
struct ReportPictures {
    std::string title, text;
    std::vector<ReportPicture> pictures;
};
struct ReportText {
    std::string text;
};
using ReportBlock = std::variant<WayChart, LineChart, ReportTable, ReportPictures, ReportText>;

struct ReportSection {
    std::string id, title, text;
    std::vector<ReportBlock> blocks;
};

// Facts of the run by name, in the order of the page.
using ReportFacts = std::vector<std::pair<std::string, std::string>>;

struct Report {
    bool quick = false;
    ReportFacts machine;
    std::vector<std::string> warnings;  // shown on top: a noisy machine, parts that were not measured
    std::vector<ReportSection> sections;
    std::vector<ReportFigure> figures;
    std::vector<PaperRow> papers;  // our figures beside those of the papers
};

// Adds a chart and its figures (ID/NAME/time and so on) to the report.
void addChart(Report& report, ReportSection& section, WayChart chart);
void addFigure(Report& report, ReportFigure figure);

}  // namespace stereonav
