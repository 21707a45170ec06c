// Figures of papers beside those of this program: rows of one model, from which the page, report.json and
// papers.csv are written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/metrics/spread.h"

namespace stereonav {

struct Report;
struct ReportSection;

struct PaperRow {
    std::string paper;  // "Wan et al. 2004"
    std::string table;  // place in the paper: "Table 2", "Section 5"
    std::string row = {}, column = {};
    // The paper's figure, or its statement in words where it has no figure.
    std::optional<double> theirs = {};
    std::string said = {};
    // Our figure in the same unit; with count 0 there is none, and `none` gives the reason.
    Spread ours = {};
    std::string none = {};
    std::string unit = {};
    std::string measured = {};  // what was measured
    std::string how = {};       // "rate of 5 s on 1.2 %, scaled"; "": measured completely
    std::string why = {};       // reason for a difference
    enum class Kind { Time, Error, Other };
    Kind kind = Kind::Other;  // how later runs may compare it: less is better, except for Other
};

// Return the paper's figure and ours as shown on the page.
std::string theirsText(const PaperRow& row);
std::string oursText(const PaperRow& row);
// Returns our figure divided by the paper's, for times the least; empty where one is missing or the paper's
// is 0.
std::optional<double> ratioToTheirs(const PaperRow& row);

// Adds the rows to the report and its figures ("papers/PAPER/TABLE/ROW/COLUMN"), and to the section one table
// for each table of the papers, in the order of the rows.
void addPaperRows(Report& report, ReportSection& section, std::vector<PaperRow> rows);

// Returns one line per row.
std::string papersCsv(const std::vector<PaperRow>& rows);

}  // namespace stereonav
