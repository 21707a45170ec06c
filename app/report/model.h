// What `report` found, before it becomes a page, JSON or CSV: sections of charts, tables and pictures, and
// the flat list of every figure, which later runs are compared by.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/report/paper_rows.h"
#include "engine/metrics/pareto_verdict.h"
#include "engine/metrics/svg_chart.h"

namespace stereonav {

// One number. Two runs' figures of the same id and setting may be compared.
struct ReportFigure {
    enum class Kind { Time, Error, Other };  // Other: told, never judged
    std::string id, unit, setting;
    Kind kind = Kind::Other;
    Spread value;
};

// Error against time of one approximation.
struct WayPoint {
    Way way;                // its name also ends the figures' ids
    std::string detail;     // what is set, in words
    double worstError = 0;  // of the frames, or of the texels
    std::vector<std::pair<std::string, double>>
        others;  // further columns of the table; the same for all points
};
struct WayChart {
    std::string id, title, text;  // text: what was measured, how, and against what
    std::string setting;          // what figures must share to be compared: "500x400, 4 frames, 2 threads"
    std::string timeLabel, timeUnit, errorLabel, errorUnit;
    std::vector<WayPoint> points;
    bool front =
        true;         // these are choices: less is better in both; else points of one choice in several cases
    std::string why;  // of a default that is not on the front: why it is kept
};

// Any other chart.
struct LineChart {
    Chart chart;
    std::string text;
};
struct ReportTable {
    std::string title, text;
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;
    // Of each row, or none at all: what is said below it, once for rows that share it. Such rows' first cells
    // are drawn once where they are equal, too.
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

// Of the run, by name, as the page shows it.
using ReportFacts = std::vector<std::pair<std::string, std::string>>;

struct Report {
    bool quick = false;
    ReportFacts machine;
    std::vector<std::string> warnings;  // shown on top: a noisy machine, what was not measured
    std::vector<ReportSection> sections;
    std::vector<ReportFigure> figures;
    std::vector<PaperRow> papers;  // beside the papers' own
};

// Puts a chart with its figures (ID/NAME/time and so on) into the report.
void addChart(Report& report, ReportSection& section, WayChart chart);
void addFigure(Report& report, ReportFigure figure);

}  // namespace stereonav
