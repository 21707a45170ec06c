#include "app/scene/volume/colon_findings.h"

#include <fmt/format.h>

#include "app/scene/volume/colon_of.h"
#include "app/scene/volume/findings_words.h"
#include "colon/instruments/polyp_view.h"
#include "engine/base/module.h"

namespace stereonav {
namespace {

struct OwnFinding final : SurfaceFinding::Own {
    explicit OwnFinding(Finding made) : finding(std::move(made)) {}
    Finding finding;
};

// Returns the findings for output: with their comments, and with notes on several findings of one polyp.
std::vector<Finding> findingsOf(const FindingRefs& list) {
    std::vector<Finding> findings;
    for (const SurfaceFinding* const one : list) {
        findings.push_back(static_cast<const OwnFinding&>(*one->own).finding);
        findings.back().comment = one->comment;
        findings.back().candidate = false;  // a person has listed it
    }
    noteDoubles(findings);
    return findings;
}

std::vector<std::string> linesOf(const Finding& finding) {
    std::vector<std::string> lines;
    if (finding.polyp) {
        const MeasuredPolyp& polyp = *finding.polyp;
        lines.push_back(fmt::format("{:.1f} mm in the {} slice", 1e3 * polyp.widestInSlice.length,
                                    nameOfSlice(polyp.sliceAxis)));
        lines.push_back(fmt::format("{:.0f} mm\u00b3", 1e9 * polyp.volume));
        lines.back() += finding.values
                            ? fmt::format(", {:.0f} \u00b1 {:.0f} HU of {} voxels", finding.values->mean,
                                          finding.values->sigma, finding.values->voxels)
                            : ", HU not told";
    }
    lines.push_back(fmt::format("{:.0f} mm from the rectum", 1e3 * finding.along));
    if (!finding.segment.empty()) lines.back() += ", " + finding.segment;
    return lines;
}

}  // namespace

SurfaceFinding ColonFindings::at(const glm::dvec3& place, const std::string& comment) const {
    Finding finding;
    finding.asked = place;
    finding.comment = comment;
    SurfaceFinding made;
    made.asked = made.middle = place;
    made.comment = comment;
    made.own = std::make_shared<OwnFinding>(std::move(finding));
    return made;
}

// Returns the tool, made at the first call. The mutex has to be held.
FindingTool& ColonFindings::tool(const std::shared_ptr<const SliceStudy>& study, Progress& progress) const {
    progress.report(0, "making the wall's mesh");
    if (!mTool) mTool = std::make_unique<FindingTool>(mColon, mWall.get(progress));
    progress.report(1, "making the wall's mesh");
    if (study && study != mStudy && !study->ofMask) {
        mTool->useStudy(study->grey);
        mStudy = study;
    }
    return *mTool;
}

SurfaceFinding ColonFindings::shown(Finding finding) const {
    SurfaceFinding made = at(finding.asked, finding.comment);
    made.measured = true;
    made.found = finding.polyp.has_value();
    made.note = finding.problem;
    made.diameter = finding.diameter();
    made.lines = linesOf(finding);
    if (finding.polyp) {
        const LineOfSight sight(mColon.volume.field, mColon.volume.cells, mColon.lumen.isovalue);
        made.middle = finding.polyp->middle;
        made.outline = finding.polyp->outline;
        made.across = widestOnWall(*finding.polyp, sight, mColon.lumen.isovalue);
        made.view = eyeBeside(*finding.polyp, sight, 0);
    }
    made.own = std::make_shared<OwnFinding>(std::move(finding));
    return made;
}

SurfaceFinding ColonFindings::measured(const SurfaceFinding& finding,
                                       const std::shared_ptr<const SliceStudy>& study,
                                       Progress& progress) const {
    const std::lock_guard lock(mMutex);
    Progress beginning(progress, 0, 0.9);
    Finding made = tool(study, beginning).at(finding.asked);
    made.comment = finding.comment;
    progress.report(1, "measuring");
    return shown(std::move(made));
}

std::vector<SurfaceFinding> ColonFindings::candidates(const std::shared_ptr<const SliceStudy>& study,
                                                      Progress& progress) const {
    const std::lock_guard lock(mMutex);
    std::vector<SurfaceFinding> list;
    Progress beginning(progress, 0, 0.3), looking(progress, 0.3, 1);
    FindingTool& made = tool(study, beginning);
    for (Finding& finding : made.candidates(looking)) list.push_back(shown(std::move(finding)));
    return list;
}

std::vector<std::string> ColonFindings::notesOn(const FindingRefs& list) const {
    std::vector<std::string> notes;
    for (const Finding& finding : findingsOf(list)) notes.push_back(finding.problem);
    return notes;
}

std::string ColonFindings::summaryOf(const FindingRefs& list) const {
    return cradsWords(findingsOf(list));
}

std::string ColonFindings::notice() const {
    return kNoMedicalDevice;
}

std::string ColonFindings::documentOf(const FindingRefs& list) const {
    return findingsDocument(mColon.name, findingsOf(list));
}

std::vector<SurfaceFinding> ColonFindings::listOf(const std::string& document,
                                                  const std::filesystem::path& name) const {
    std::vector<SurfaceFinding> list;
    for (const KeptFinding& kept : findingsIn(document, name)) list.push_back(at(kept.place, kept.comment));
    return list;
}

std::string ColonFindings::pageOf(const FindingRefs& list, const std::shared_ptr<const SliceStudy>& study,
                                  Progress& progress) const {
    const GreyVolume none;
    const bool values = study && !study->ofMask;
    return findingsPage(mColon, values ? study->grey : none, findingsOf(list), progress);
}

std::string ColonFindings::whyNoReport() const {
    if (mColon.format != "DICOM") return "the study is not DICOM: a report could not name the patient";
    if (!hasModule("dcmtk")) return "the module stereonav_dcmtk is not installed";
    return "";
}

std::string ColonFindings::reportOf(const FindingRefs& list) const {
    return findingsReport(mReading, findingsOf(list));
}

}  // namespace stereonav
