#include "colon/instruments/findings_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "colon/study/dicom_uid.h"

namespace stereonav {
namespace {

MmPlace millimetresOfPlace(const glm::dvec3& world) {
    return {1e3 * world.x, 1e3 * world.y, 1e3 * world.z};
}

const char* planeOf(int axis) {
    return axis == 0 ? "sagittal" : axis == 1 ? "coronal" : "axial";
}

std::string notesOf(const Finding& finding) {
    std::string notes = finding.comment;
    const auto add = [&notes](const std::string& note) {
        if (!note.empty()) notes += (notes.empty() ? "" : "; ") + note;
    };
    add(finding.problem);
    if (finding.polyp)
        add(fmt::format("long axis in the {} slice at {:.1f} mm", planeOf(finding.polyp->sliceAxis),
                        1e3 * finding.polyp->slice));
    if (finding.values) add(fmt::format("HU of {} voxels", finding.values->voxels));
    if (finding.truth) add(fmt::format("true diameter {:.1f} mm", 1e3 * finding.truth->diameter));
    return notes;
}

ReportedFinding reportedOf(const Finding& finding, std::size_t number, const std::string& study) {
    ReportedFinding one;
    one.label = std::to_string(number);
    one.polyp = finding.polyp.has_value();
    one.place_mm = millimetresOfPlace(one.polyp ? finding.polyp->middle : finding.asked);
    one.uid = uidOfText(fmt::format("finding in {} at {:.1f} {:.1f} {:.1f}", study, one.place_mm[0],
                                    one.place_mm[1], one.place_mm[2]));
    one.fromRectum_mm = 1e3 * finding.along;
    one.segment = finding.segment;
    one.note = notesOf(finding);
    if (finding.values) one.huMean = finding.values->mean, one.huSigma = finding.values->sigma;
    if (!one.polyp) return one;
    const MeasuredPolyp& polyp = *finding.polyp;
    one.longest_mm = 1e3 * polyp.widest.length;
    one.longestEnds_mm = {millimetresOfPlace(polyp.widest.from), millimetresOfPlace(polyp.widest.to)};
    one.inSlice_mm = 1e3 * polyp.widestInSlice.length;
    one.volume_mm3 = 1e9 * polyp.volume;
    return one;
}

// Returns all in which two reports can differ, as text.
std::string wordsOf(const StructuredReport& report) {
    std::string words = fmt::format("{} {} {} {} {} {}", report.study, report.software, report.date,
                                    report.time, report.notice, report.crads);
    if (report.source) words += report.source->study + " " + report.source->series;
    for (const ReportedFinding& f : report.findings)
        words += fmt::format("\n{} {} {} {} {} {} {} {} {} {}", f.label, f.uid, f.fromRectum_mm,
                             f.longest_mm.value_or(-1), f.inSlice_mm.value_or(-1), f.volume_mm3.value_or(-1),
                             f.huMean.value_or(0), f.huSigma.value_or(-1), f.segment, f.note);
    return words;
}

}  // namespace

StructuredReport reportOf(const std::string& study, const std::optional<StudySource>& source,
                          const std::vector<Finding>& findings, const std::string& software,
                          std::time_t now) {
    StructuredReport report;
    report.source = source;
    report.study = uidOfText("study " + study);
    report.software = software;
    const std::tm local = fmt::localtime(now);
    report.date = fmt::format("{:%Y%m%d}", local);
    report.time = fmt::format("{:%H%M%S}", local);
    const std::string crads = cradsClassOf(findings);
    report.crads = crads[1] - '0';
    report.notice = fmt::format(
        "stereonav is not a medical device. Sizes are computed and may be wrong; nothing here is a "
        "diagnosis, and "
        "no physician has verified it. C-RADS {} by size and count alone: C0, and what lies outside the "
        "colon, are "
        "left to the reader. Distances are along the centreline from its end in the rectum.",
        crads);
    const bool named = source && !source->study.empty();
    for (std::size_t n = 0; n < findings.size(); ++n)
        if (!findings[n].doubled && !findings[n].candidate)
            report.findings.push_back(reportedOf(findings[n], n + 1, named ? source->study : report.study));
    const std::string words = wordsOf(report);
    report.document = uidOfText("document " + words);
    report.series = uidOfText("series " + words);
    report.device = uidOfText("stereonav");
    return report;
}

}  // namespace stereonav
