// What papers say beside what this program does: rows of one model, from which the page, report.json and
// papers.csv are printed.
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
    std::string table;  // "Table 2", "Section 5": where it says so
    std::string row, column;
    // Their figure, or in words what they say where they give none.
    std::optional<double> theirs;
    std::string said;
    // Ours, in the same unit; count 0: none, and `none` says why.
    Spread ours;
    std::string none;
    std::string unit;
    std::string measured;  // on what
    std::string how;       // "rate of 5 s on 1.2 %, scaled"; "": the whole of it
    std::string why;       // it differs
    enum class Kind { Time, Error, Other };
    Kind kind = Kind::Other;  // how later runs may judge it: less is better but for Other
};

// Their figure and ours as the page shows them.
std::string theirsText(const PaperRow& row);
std::string oursText(const PaperRow& row);
// Ours over theirs, of times the least; none where one of both is missing or theirs is 0.
std::optional<double> ratioToTheirs(const PaperRow& row);

// Adds the rows to the report and its figures ("papers/PAPER/TABLE/ROW/COLUMN"), and to the section a table
// for each of the papers' tables, in the order in which they come.
void addPaperRows(Report& report, ReportSection& section, std::vector<PaperRow> rows);

// One line a row.
std::string papersCsv(const std::vector<PaperRow>& rows);

}  // namespace stereonav
