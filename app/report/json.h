// A report's figures as JSON and CSV, and the comparison of two reports: changes beyond the noise of both.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/report/model.h"

namespace stereonav {

std::string figuresJson(const Report& report);
std::string figuresCsv(const Report& report);

// The figures of an earlier run, as written by figuresJson.
struct EarlierReport {
    bool quick = false;
    ReportFacts machine;
    std::vector<ReportFigure> figures;
};
// Throws Error where the file is no report, or of another version.
EarlierReport readEarlierReport(const std::filesystem::path& file);

struct ReportChange {
    enum class Verdict { Same, Better, Worse };
    std::string id, unit;
    Spread before, after;
    double bound = 0;  // share of the earlier value within which a figure counts as unchanged
    Verdict verdict = Verdict::Same;
};
struct ReportComparison {
    std::vector<ReportChange> changes;     // times and errors with the same setting in both; the worst first
    std::vector<std::string> gone, added;  // ids of times and errors that only one of the reports has
    std::vector<std::string> otherwise;    // ids measured with another setting
    bool worse() const;
};

// Bounds of changes. For times: the spread of repeats in both runs, and the spread of the same work at
// different moments of both, but at least kLeastTimeBound. Errors are reproducible: kErrorBound.
constexpr double kLeastTimeBound = 0.15, kErrorBound = 0.02;
constexpr double kLeastError = 1e-6;  // changes of errors from 0 to this are ignored
// The time whose spread measures how steady the machine is.
constexpr const char* kMoodFigure = "machine/mood/time";

ReportComparison compareReports(const EarlierReport& before, const Report& after);

// Returns the section of the page.
ReportSection comparisonSection(const ReportComparison& comparison, const EarlierReport& before,
                                const std::string& file);

}  // namespace stereonav
