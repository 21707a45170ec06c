// The window's list of findings: what a person clicked on the surface, what the scene measures there, and
// candidates that it proposes; pages and reports of it. Measured beside the window, and kept for the scene's
// file as it is made.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/progress.h"
#include "engine/scene/scene.h"
#include "engine/scene/surface_findings.h"

namespace stereonav {

class FindingList {
public:
    static constexpr std::size_t kMost = 500;
    static constexpr std::size_t kMostComment = 1000;  // bytes

    struct Row {
        int id = 0;  // of this list alone, never used twice
        SurfaceFinding finding;
        bool withValues = false;  // it was measured while a study was there
        std::string note;         // in this list; "": none. Of a candidate: which finding it is
    };

    // wake: called from another thread when something is done.
    explicit FindingList(std::function<void()> wake) : mWake(std::move(wake)) {}
    ~FindingList() { cancel(); }  // and waits for the end

    // Of that scene from now on, with what was kept in `file`, which nothing is measured of yet; "" keeps
    // nothing. A file that is being written of the scene before is written to its end.
    void open(std::shared_ptr<const Scene> scene, const std::filesystem::path& file);
    // The same file, shown by another scene: what was measured stays.
    void replaceScene(std::shared_ptr<const Scene> scene);

    // What the scene offers; null: it measures no findings.
    const SurfaceFindings* maker() const { return mScene ? mScene->offered<SurfaceFindings>() : nullptr; }
    const std::filesystem::path& file() const { return mFile; }
    bool clicks() const { return mClicks; }  // on the picture and in slices add findings
    void setClicks(bool on) { mClicks = on; }

    const std::vector<Row>& rows() const { return mRows; }
    const std::vector<Row>& candidates() const { return mCandidates; }
    // In one line; "" while something is not measured.
    const std::string& summary() const { return mSummary; }

    // From now on what is listed is measured.
    void use() { mUsed = !mStopped; }
    // It was cancelled or failed, and waits for goOn() or the next finding.
    bool stopped() const { return mStopped; }
    void goOn() { mStopped = mEnds = false, mUsed = true; }
    // World. False: the list is full, or the scene measures none.
    bool add(const glm::dvec3& place);
    void remove(int id);
    bool canPutBack() const { return !mRemoved.empty(); }
    void putBack();  // what was removed last, at its place
    void comment(int id, const std::string& text);
    void findCandidates() { mFindsCandidates = true; }
    void dropCandidates() { mCandidates.clear(); }
    void keep(int id);  // a candidate becomes a finding
    // An .html file; where one is there already the new one gets a number. Throws Error where it can not be.
    void writePage(const std::filesystem::path& file);
    // A DICOM structured report, a .dcm file. Throws Error where it can not be.
    void writeReport(const std::filesystem::path& file);

    // Looks whether something is done, and begins the next. study: whose values are told, null while it is
    // not there. True: there is something new.
    bool poll(const std::shared_ptr<const SliceStudy>& study);
    bool busy() const { return mWork.valid(); }
    const std::string& doing() const { return mDoing; }  // while busy
    bool writes() const { return busy() && mWrites; }    // a file, which is not begun again
    double fraction() const { return *mFraction; }       // of it
    void cancel();
    const std::string& told() const { return mTold; }        // of what was done last: "written to ..."
    const std::string& problem() const { return mProblem; }  // "": none

private:
    struct Outcome {
        std::vector<std::pair<int, SurfaceFinding>> measured;
        std::vector<SurfaceFinding> candidates;
        bool looked = false;  // for candidates
        bool withValues = false;
        std::string told, problem;
    };
    using Job = std::function<void(const SurfaceFindings&, Progress&, Outcome&)>;
    FindingRefs refs() const;
    std::vector<SurfaceFinding> findings() const;
    std::vector<std::pair<int, SurfaceFinding>> unmeasured(bool values) const;
    bool begin(const std::shared_ptr<const SliceStudy>& study);
    void start(const std::string& doing, bool values, Job job, bool writes = false);
    void take(Outcome outcome);
    bool beginPage(const std::shared_ptr<const SliceStudy>& study);
    bool beginReport();
    void judge();
    void changed();

    std::function<void()> mWake;
    std::shared_ptr<const Scene> mScene;
    std::filesystem::path mFile, mPage, mReport;
    std::vector<Row> mRows, mCandidates;
    std::vector<std::pair<std::size_t, Row>> mRemoved;  // with the places that they had
    int mNext = 1, mOpened = 0, mWorksFor = 0;
    bool mUsed = false, mStopped = false, mClicks = false, mFindsCandidates = false;
    bool mWrites = false;  // what is at work writes a file
    bool mEnds = false;    // what is at work was cancelled, and nothing was asked for since
    std::string mSummary, mTold, mProblem, mDoing;
    std::shared_ptr<std::atomic<double>> mFraction = std::make_shared<std::atomic<double>>(0);
    std::shared_ptr<Progress> mProgress;
    std::future<Outcome> mWork;  // last: it is waited for at the end
};

// Where the findings of a scene are kept whose places are kept in that file (Bookmarks::file()); "" for "".
std::filesystem::path findingsFile(const std::filesystem::path& places);

}  // namespace stereonav
