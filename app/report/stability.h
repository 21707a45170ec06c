// The stability table: rows that tests/stability writes, one JSON object per line, so that the page shows
// only what a test has shown.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/report/model.h"

namespace stereonav {

// Returns the section with the rows in `text`, read from `source` (named in errors with the line). Throws
// Error for lines that are no rows.
ReportSection stabilitySection(std::string_view text, const std::string& source);
// Returns a section that says how to make the rows, where there are none.
ReportSection noStabilitySection();

// Returns the file with rows next to this build's program, "" where there is none.
std::filesystem::path stabilityRowsOfThisBuild();

}  // namespace stereonav
