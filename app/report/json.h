// A report's figures as JSON and CSV, and the comparison of two: what moved beyond the noise of both.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/report/model.h"

namespace stereonav {

std::string figuresJson(const Report& report);
std::string figuresCsv(const Report& report);

// What figuresJson wrote, of an earlier run.
struct EarlierReport {
    bool quick = false;
    ReportFacts machine;
    std::vector<ReportFigure> figures;
};
// Throws Error where the file is none, or of another version.
EarlierReport readEarlierReport(const std::filesystem::path& file);

struct ReportChange {
    enum class Verdict { Same, Better, Worse };
    std::string id, unit;
    Spread before, after;
    double bound = 0;  // share of the value before within which nothing is said to have moved
    Verdict verdict = Verdict::Same;
};
struct ReportComparison {
    std::vector<ReportChange> changes;     // of all times and errors of the same setting; the worst first
    std::vector<std::string> gone, added;  // ids of times and errors that only one of them has
    std::vector<std::string> otherwise;    // measured in another setting
    bool worse() const;
};

// Times: what repeats of both spread by, and what the same work took at different moments of both runs, at
// least kLeastTimeBound. Errors repeat: kErrorBound.
constexpr double kLeastTimeBound = 0.15, kErrorBound = 0.02;
constexpr double kLeastError = 1e-6;  // of errors: from nothing to this is no change
// The figure whose spread is the machine's own mood; a time.
constexpr const char* kMoodFigure = "machine/mood/time";

ReportComparison compareReports(const EarlierReport& before, const Report& after);

// The section of the page.
ReportSection comparisonSection(const ReportComparison& comparison, const EarlierReport& before,
                                const std::string& file);

}  // namespace stereonav
