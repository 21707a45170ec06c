#include "app/view/finding_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/options/output_place.h"
#include "app/view/kept_file.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/new_file.h"

namespace stereonav {
namespace {

constexpr const char* kCancelled = "cancelled";

auto rowOf(std::vector<FindingList::Row>& rows, int id) {
    return std::find_if(rows.begin(), rows.end(), [id](const auto& row) { return row.id == id; });
}

FindingRefs refsOf(const std::vector<SurfaceFinding>& list) {
    FindingRefs refs;
    for (const SurfaceFinding& finding : list) refs.push_back(&finding);
    return refs;
}

}  // namespace

void FindingList::open(std::shared_ptr<const Scene> scene, const std::filesystem::path& file) {
    const std::filesystem::path unwritten = mPage.empty() ? mReport : mPage;
    if (!writes()) cancel();
    ++mOpened;
    mScene = std::move(scene);
    mFile = maker() ? file : std::filesystem::path();
    mRows.clear();
    mCandidates.clear();
    mRemoved.clear();
    mPage.clear(), mReport.clear();
    mUsed = mStopped = mClicks = mFindsCandidates = false;
    mSummary.clear(), mTold.clear(), mProblem.clear();
    if (!unwritten.empty())
        mProblem = unwritten.string() + " was not written: another scene was opened before";
    if (mFile.empty()) return;
    try {
        if (const auto document = readKept(mFile))
            for (SurfaceFinding& kept : maker()->listOf(*document, mFile))
                mRows.push_back({mNext++, std::move(kept), false, ""});
    } catch (const Error& error) {
        const std::filesystem::path aside = setAside(mFile);
        mProblem = error.what();
        if (!aside.empty()) mProblem += "; it is kept as " + aside.filename().string();
    }
}

void FindingList::replaceScene(std::shared_ptr<const Scene> scene) {
    mScene = std::move(scene);
}

std::vector<SurfaceFinding> FindingList::findings() const {
    std::vector<SurfaceFinding> list;
    for (const Row& row : mRows) list.push_back(row.finding);
    return list;
}

FindingRefs FindingList::refs() const {
    FindingRefs refs;
    for (const Row& row : mRows) refs.push_back(&row.finding);
    return refs;
}

bool FindingList::add(const glm::dvec3& place) {
    if (!maker() || mRows.size() >= kMost) return false;
    goOn();
    mRows.push_back({mNext++, maker()->at(place, ""), false, ""});
    changed();
    return true;
}

void FindingList::remove(int id) {
    const auto row = rowOf(mRows, id);
    if (row == mRows.end()) return;
    mRemoved.emplace_back(row - mRows.begin(), std::move(*row));
    mRows.erase(row);
    changed();
}

void FindingList::putBack() {
    if (mRemoved.empty() || mRows.size() >= kMost) return;
    auto [place, row] = std::move(mRemoved.back());
    mRemoved.pop_back();
    mRows.insert(mRows.begin() + static_cast<std::ptrdiff_t>(std::min(place, mRows.size())), std::move(row));
    changed();
}

void FindingList::comment(int id, const std::string& text) {
    const auto row = rowOf(mRows, id);
    if (row == mRows.end()) return;
    const std::string kept = keptText(text, kMostComment);
    if (kept == row->finding.comment) return;
    row->finding.comment = kept;
    changed();
}

void FindingList::keep(int id) {
    const auto row = rowOf(mCandidates, id);
    if (row == mCandidates.end() || mRows.size() >= kMost) return;
    mRows.push_back(std::move(*row));
    mCandidates.erase(row);
    changed();
}

void FindingList::writePage(const std::filesystem::path& file) {
    if (file.extension() != ".html")
        throw Error("page", "", fmt::format("expected a file named .html, got \"{}\"", file.string()),
                    "name it findings.html");
    const std::filesystem::path place = std::filesystem::absolute(file).lexically_normal();
    checkOutputFile("page", place.string());
    mPage = place;
}

void FindingList::writeReport(const std::filesystem::path& file) {
    if (file.extension() != ".dcm")
        throw Error("report", "", fmt::format("expected a file named .dcm, got \"{}\"", file.string()),
                    "name it findings.dcm");
    const std::string why = maker() ? maker()->whyNoReport() : "findings are for colons";
    if (!why.empty()) throw Error("report", "", why, "write the page");
    if (!std::all_of(mRows.begin(), mRows.end(), [](const Row& row) { return row.finding.measured; }))
        throw Error("report", "", "expected findings that are measured", "let them be measured first");
    const std::filesystem::path place = std::filesystem::absolute(file).lexically_normal();
    checkOutputFile("report", place.string());
    mReport = place;
}

void FindingList::changed() {
    mProblem.clear();
    mTold.clear();
    judge();
    if (mFile.empty() || !maker()) return;
    try {  // failures must not end the window
        writeKept(mFile, maker()->documentOf(refs()));
    } catch (const Error& error) {
        mProblem = error.what();
    }
}

// Sets notes and the summary of measured findings. Candidates are judged after findings, as one may be equal
// to a finding.
void FindingList::judge() {
    mSummary.clear();
    if (!maker()) return;
    FindingRefs all = refs();
    for (const Row& row : mCandidates) all.push_back(&row.finding);
    const std::vector<std::string> notes = maker()->notesOn(all);
    for (std::size_t n = 0; n < mRows.size(); ++n) mRows[n].note = notes[n];
    for (std::size_t n = 0; n < mCandidates.size(); ++n) mCandidates[n].note = notes[mRows.size() + n];
    const bool known =
        std::all_of(mRows.begin(), mRows.end(), [](const Row& row) { return row.finding.measured; });
    if (known && !mRows.empty()) mSummary = maker()->summaryOf(refs());
}

void FindingList::cancel() {
    mWork.cancel();
    mEnds = true;
    mFindsCandidates = false;
    mPage.clear(), mReport.clear();
}

// Returns the findings to measure: new ones, or all again for the values of a study that has come.
std::vector<std::pair<int, SurfaceFinding>> FindingList::unmeasured(bool values) const {
    std::vector<std::pair<int, SurfaceFinding>> due;
    for (const Row& row : mRows)
        if (!row.finding.measured || (values && !row.withValues && row.finding.found))
            due.emplace_back(row.id, row.finding);
    return due;
}

void FindingList::start(const std::string& doing, bool values, Job job, bool writes) {
    mDoing = doing;
    mWrites = writes;
    mWorksFor = mOpened;
    mEnds = false;
    mOutcome = {};
    mOutcome.withValues = values;
    mWork.start(
        [scene = mScene, &outcome = mOutcome, job = std::move(job)](Progress& progress) {
            job(*scene->offered<SurfaceFindings>(), progress, outcome);
            return true;
        },
        mWake);
}

// Begins the next work, if there is any. Returns whether there was.
bool FindingList::begin(const std::shared_ptr<const SliceStudy>& study) {
    if (auto due = unmeasured(study != nullptr); mUsed && !due.empty()) {
        start("measuring", study != nullptr,
              [due = std::move(due), study](const SurfaceFindings& maker, Progress& progress,
                                            Outcome& outcome) {
                  for (const auto& [id, finding] : due)
                      outcome.measured.emplace_back(id, maker.measured(finding, study, progress));
              });
        return true;
    }
    if (std::exchange(mFindsCandidates, false)) {
        start("candidates", study != nullptr,
              [study](const SurfaceFindings& maker, Progress& progress, Outcome& outcome) {
                  outcome.candidates = maker.candidates(study, progress);
                  outcome.looked = true;
              });
        return true;
    }
    return beginPage(study) || beginReport();
}

bool FindingList::beginPage(const std::shared_ptr<const SliceStudy>& study) {
    if (mPage.empty()) return false;
    start(
        "the page", false,
        [list = findings(), study, page = std::exchange(mPage, {})](const SurfaceFindings& maker,
                                                                    Progress& progress, Outcome& outcome) {
            const std::string text = maker.pageOf(refsOf(list), study, progress);
            const std::filesystem::path place = freePlace(page);
            writeTextFile(place, text);
            outcome.told = "written to " + place.string();
        },
        true);
    return true;
}

bool FindingList::beginReport() {
    if (mReport.empty()) return false;
    start(
        "the DICOM report", false,
        [list = findings(), file = std::exchange(mReport, {})](const SurfaceFindings& maker, Progress&,
                                                               Outcome& outcome) {
            const std::string report = maker.reportOf(refsOf(list));
            const std::filesystem::path place = freePlace(file);
            writeTextFile(place, report);
            outcome.told = "written to " + place.string();
        },
        true);
    return true;
}

// Takes the outcome of work that has ended; returns false where there is none.
bool FindingList::take() {
    Outcome& outcome = mOutcome;
    try {
        if (!mWork.take()) return false;
    } catch (const Cancelled&) {
        // Work may finish in spite of a wish to cancel: a file that it wrote is there.
        const std::string written = outcome.told;
        outcome = {};
        outcome.told = written.empty() ? kCancelled : written;
    } catch (const std::exception& error) {
        outcome.problem = error.what();
    }
    if (mWorksFor != mOpened) {  // result of a scene that is gone
        if (mWrites) mProblem = outcome.problem;
        return true;
    }
    mTold = outcome.told;
    mProblem = outcome.problem;
    // Work that failed is not tried again.
    if (!mProblem.empty() || (mTold == kCancelled && mEnds)) mUsed = false, mStopped = true;
    for (auto& [id, finding] : outcome.measured) {
        const auto row = rowOf(mRows, id);
        if (row == mRows.end()) continue;
        finding.comment = row->finding.comment;  // the comment may have changed meanwhile
        row->finding = std::move(finding);
        row->withValues = outcome.withValues;
    }
    if (outcome.looked) {
        mCandidates.clear();
        for (SurfaceFinding& finding : outcome.candidates)
            mCandidates.push_back({mNext++, std::move(finding), outcome.withValues, ""});
        mTold = fmt::format("{} candidates", mCandidates.size());
        judge();
    }
    if (outcome.measured.empty()) return true;
    const std::string problem = mProblem;
    changed();
    if (mProblem.empty()) mProblem = problem;
    return true;
}

bool FindingList::poll(const std::shared_ptr<const SliceStudy>& study) {
    const bool isNew = take();
    if (mWork.busy() || !maker()) return isNew;
    return begin(study) || isNew;
}

}  // namespace stereonav
