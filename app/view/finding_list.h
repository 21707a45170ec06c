// The window's list of findings: places that the user clicked on the surface, with the scene's measurements,
// and candidates that it proposes; pages and reports of them. Measured beside the window, and kept for the
// scene's file.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/view/beside_work.h"
#include "engine/scene/scene.h"
#include "engine/scene/surface_findings.h"

namespace stereonav {

class FindingList {
public:
    static constexpr std::size_t kMost = 500;
    static constexpr std::size_t kMostComment = 1000;  // bytes

    struct Row {
        int id = 0;  // unique in this list, never used again
        SurfaceFinding finding;
        bool withValues = false;  // whether a study's values were measured, too
        std::string note;         // "": none; for a candidate: the finding that it equals
    };

    // wake: called from another thread when something is done.
    explicit FindingList(std::function<void()> wake) : mWake(std::move(wake)) {}

    // Begins a scene, with the findings kept in `file`, which are not measured yet; "" keeps nothing. A file
    // that is being written for the scene before is completed.
    void open(std::shared_ptr<const Scene> scene, const std::filesystem::path& file);
    // Goes on in another scene of the same file: measurements stay.
    void replaceScene(std::shared_ptr<const Scene> scene);

    // Returns the scene's instrument; null: it measures no findings.
    const SurfaceFindings* maker() const { return mScene ? mScene->offered<SurfaceFindings>() : nullptr; }
    const std::filesystem::path& file() const { return mFile; }
    bool clicks() const { return mClicks; }  // whether clicks on the picture and in slices add findings
    void setClicks(bool on) { mClicks = on; }

    const std::vector<Row>& rows() const { return mRows; }
    const std::vector<Row>& candidates() const { return mCandidates; }
    // Returns the summary in one line; "" while something is not measured.
    const std::string& summary() const { return mSummary; }

    // Starts measuring the listed findings.
    void use() { mUsed = !mStopped; }
    // Returns whether work was cancelled or failed; it then waits for goOn() or the next finding.
    bool stopped() const { return mStopped; }
    void goOn() { mStopped = mEnds = false, mUsed = true; }
    // Adds a finding at a place of the world. Returns false where the list is full, or the scene measures
    // none.
    bool add(const glm::dvec3& place);
    void remove(int id);
    bool canPutBack() const { return !mRemoved.empty(); }
    void putBack();  // restores the last one that was removed, at its position
    void comment(int id, const std::string& text);
    void findCandidates() { mFindsCandidates = true; }
    void dropCandidates() { mCandidates.clear(); }
    void keep(int id);  // turns a candidate into a finding
    // Writes an .html file; where the name is taken the new file gets a number. Throws Error where it can not
    // be written.
    void writePage(const std::filesystem::path& file);
    // Writes a DICOM structured report, a .dcm file. Throws Error where it can not be written.
    void writeReport(const std::filesystem::path& file);

    // Takes finished work and begins the next. study: source of values, null while it is not there. Returns
    // true where something has changed.
    bool poll(const std::shared_ptr<const SliceStudy>& study);
    bool busy() const { return mWork.busy(); }
    const std::string& doing() const { return mDoing; }  // name of the present work
    bool writes() const { return busy() && mWrites; }    // whether it writes a file, which is not begun again
    double fraction() const { return mWork.fraction(); }  // progress of the work
    void cancel();
    const std::string& told() const { return mTold; }        // result of the last work: "written to ..."
    const std::string& problem() const { return mProblem; }  // last failure; "": none

private:
    struct Outcome {
        std::vector<std::pair<int, SurfaceFinding>> measured;
        std::vector<SurfaceFinding> candidates;
        bool looked = false;  // whether candidates were searched
        bool withValues = false;
        std::string told, problem;
    };
    using Job = std::function<void(const SurfaceFindings&, Progress&, Outcome&)>;
    FindingRefs refs() const;
    std::vector<SurfaceFinding> findings() const;
    std::vector<std::pair<int, SurfaceFinding>> unmeasured(bool values) const;
    bool begin(const std::shared_ptr<const SliceStudy>& study);
    void start(const std::string& doing, bool values, Job job, bool writes = false);
    bool take();
    bool beginPage(const std::shared_ptr<const SliceStudy>& study);
    bool beginReport();
    void judge();
    void changed();

    std::function<void()> mWake;
    std::shared_ptr<const Scene> mScene;
    std::filesystem::path mFile, mPage, mReport;
    std::vector<Row> mRows, mCandidates;
    std::vector<std::pair<std::size_t, Row>> mRemoved;  // with their positions in the list
    int mNext = 1, mOpened = 0, mWorksFor = 0;
    bool mUsed = false, mStopped = false, mClicks = false, mFindsCandidates = false;
    bool mWrites = false;  // the present work writes a file
    bool mEnds = false;    // the present work was cancelled, and nothing was asked for since
    std::string mSummary, mTold, mProblem, mDoing;
    Outcome mOutcome;        // result of the present work, whose thread writes it
    BesideWork<bool> mWork;  // last: it is cancelled, and its end waited for, first
};

}  // namespace stereonav
