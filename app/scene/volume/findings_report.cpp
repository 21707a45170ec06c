// Findings as a DICOM structured report, for the command and the window.
#include "colon/instruments/findings_report.h"

#include <fmt/format.h>

#include <ctime>

#include "app/options/built_without.h"
#include "app/scene/volume/findings_words.h"
#include "engine/base/error.h"

namespace stereonav {

// A study that is not DICOM is identified by its content, the built-in colon by the parameters it was made
// with.
std::string findingsReport(const ColonOptions& reading, const std::vector<Finding>& findings) {
    if (cradsClassOf(findings).empty())
        throw Error("report", "", "expected a finding that a person kept, found candidates alone",
                    "give those that are polyps with --at x,y,z");
    std::optional<StudySource> source;
    if (!reading.study.empty()) source = sourceOf(reading.study, reading.reading);
    std::string study = fmt::format("built-in colon {}", reading.builtIn.seed);
    if (!reading.study.empty() && (!source || source->study.empty()))
        study = fmt::format("{:016x}", studyKey(reading.study, reading.reading));
    return structuredReportFile(
        reportOf(study, source, findings, std::string("stereonav ") + versionNumber(), std::time(nullptr)));
}

}  // namespace stereonav
