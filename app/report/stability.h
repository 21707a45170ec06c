// The stability table: rows that the tests of tests/stability wrote, one JSON object a line, so that the page
// can not say what no test showed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/report/model.h"

namespace stereonav {

// The section of rows in `text`, read from `source` (named in errors with the line). Throws Error for lines
// that are no rows.
ReportSection stabilitySection(std::string_view text, const std::string& source);
// Where there are none: what to do.
ReportSection noStabilitySection();

// The rows that lie beside this build's program, "" where there are none.
std::filesystem::path stabilityRowsOfThisBuild();

}  // namespace stereonav
