// The viewer's part of findings: which click adds one, and what reads the study's values for it. And what
// instruments keep for a scene.
#include "app/view/viewer.h"

namespace stereonav {

// Before a scene's first picture.
void Viewer::openInstruments() {
    mMeasured.open(mScene->scene, measuredFile(mPlaces->file()));
    mFindings.open(mScene->scene, findingsFile(mPlaces->file()));
    mCoverage.open(mScene->scene, coverageFile(mPlaces->file()));
    mMarked.reset();
}

void Viewer::followInstruments() {
    if (mMeasured.poll() || mMeasured.busy()) mLayoutDue = true;
    followCoverage();
    if (mFindings.poll(mSession->study()) || mFindings.busy()) mLayoutDue = true;
}

// A click means one thing.
void Viewer::measure(bool on) {
    mMeasuring = on;
    if (on) mFindings.setClicks(false);
}

void Viewer::findHere() {
    if (!mSession) return;
    if (!findings()) return mSession->notify("findings are measured in colons");
    const auto world = pointedWorld();
    if (!world) return mSession->notify("nothing is under the pointer");
    addFinding(*world);
}

void Viewer::addFinding(const glm::dvec3& place) {
    if (!mSession || !findings()) return;
    if (!mFindings.add(place)) return mSession->notify("no more findings can be kept");
    study();  // whose values are told once it is read
    mSession->notify("finding " + std::to_string(mFindings.rows().size()) + ": being measured");
    if (!mPanels.leftShown()) mPanels.showFindings();
    mLayoutDue = true;
}

std::vector<FlatMark> Viewer::flatMarks() const {
    std::vector<FlatMark> marks;
    for (const FindingList::Row& row : mFindings.rows()) {
        const SurfaceFinding& finding = row.finding;
        marks.push_back({finding.found ? finding.middle : finding.asked, std::to_string(marks.size() + 1)});
    }
    return marks;
}

void Viewer::writeFindingsPage(const std::filesystem::path& file) {
    mNotices.tryTo([&] { mFindings.writePage(file); });
}

void Viewer::writeFindingsReport(const std::filesystem::path& file) {
    mNotices.tryTo([&] { mFindings.writeReport(file); });
}

}  // namespace stereonav
