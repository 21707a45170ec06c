// Makes the content of a DICOM structured report from findings.
#pragma once

#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "colon/instruments/finding.h"
#include "colon/study/structured_report.h"

namespace stereonav {

// Returns the report, without findings that show the same polyp as an earlier one. UIDs are hashes
// (dicom_uid.h). Those of the document and its series depend on all of the content, including the time to the
// second. A finding's UID depends on its study and its place to a tenth of a millimetre, so that it is the
// same in every report. For a study without a UID it is made of `study`, a text that identifies it. Times are
// local.
StructuredReport reportOf(const std::string& study, const std::optional<StudySource>& source,
                          const std::vector<Finding>& findings, const std::string& software, std::time_t now);

}  // namespace stereonav
