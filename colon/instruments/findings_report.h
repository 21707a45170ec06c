// Findings as the content of a DICOM structured report.
#pragma once

#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "colon/instruments/finding.h"
#include "colon/study/structured_report.h"

namespace stereonav {

// Returns the report, without findings that show a polyp before them in the list. UIDs are hashes
// (dicom_uid.h). The document's and its series': of all that is in them, the time to the second too. A
// finding's: of its study and its place to a tenth of a millimetre, so that it keeps its own from report to
// report. A study's without one: of `study`, a text that is its own. Times are those of the place where it
// runs.
StructuredReport reportOf(const std::string& study, const std::optional<StudySource>& source,
                          const std::vector<Finding>& findings, const std::string& software, std::time_t now);

}  // namespace stereonav
