// Instruments in the picture: a line on the surface, coverage of the wall, findings, and paint on the ground;
// which of them a click is for; and what each keeps for the scene's file.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/view/asked_frames.h"
#include "app/view/finding_list.h"
#include "app/view/live_coverage.h"
#include "app/view/measured_line.h"
#include "app/view/session.h"
#include "app/view/study_reading.h"
#include "engine/base/stopwatch.h"
#include "engine/scene/flat_wall.h"
#include "engine/scene/live_paint.h"

namespace stereonav {

class Instruments {
public:
    // session and study must outlive this object. wake: called from other threads when something is done.
    Instruments(std::optional<ViewSession>& session, StudyReading& study, const std::function<void()>& wake)
        : mSession(session), mStudy(study), mMeasured(wake), mCoverage(wake), mFindings(wake) {}

    // Begins a scene, before its first picture. places: the file of the scene's places (Bookmarks::file()).
    void open(const std::shared_ptr<const Scene>& scene, const std::filesystem::path& places);
    // Goes on in another scene of the same file.
    void replaceScene(const std::shared_ptr<const Scene>& scene);
    // Takes results; to be called each turn. Returns true where something has changed.
    bool follow();
    // Takes results of paint on the ground; to be called each turn. Returns true where something has changed.
    // failed: called with the reason where paint is not possible.
    bool followPaint(const std::function<void(const std::string&)>& failed);
    // Notes that a picture was shown: its wall has been seen.
    void see(const ViewFrame& frame, const AskedFrames& asked);

    // Returns the measured line; null before there is a scene, or where it can not be measured.
    MeasuredLine* measured() { return mSession ? &mMeasured : nullptr; }
    LiveCoverage* coverage() { return mSession && mCoverage.can() ? &mCoverage : nullptr; }
    FindingList* findings() { return mSession && mFindings.maker() ? &mFindings : nullptr; }
    const MeasuredLine& line() const { return mMeasured; }
    const FindingList& findingList() const { return mFindings; }

    // Return what clicks on the picture do, while it rests: add places to the line, add findings, or paint
    // the ground seen from a height (empty: off). At most one of the first two.
    bool measuring() const { return mMeasuring; }
    void measure(bool on);
    void clickFindings(bool on);
    const std::optional<double>& seesFrom() const { return mSeesFrom; }
    void seeFrom(const std::optional<double>& height) { mSeesFrom = height; }
    bool takesClicks() const { return mMeasuring || mSeesFrom || mFindings.clicks(); }
    // Handles a click. world: the place under the pointer; empty where there is none.
    void click(const std::optional<glm::dvec3>& world);
    void measureAt(const std::optional<glm::dvec3>& world);
    void findAt(const std::optional<glm::dvec3>& world);
    void addFinding(const glm::dvec3& place);

    void toggleCoverage(const ViewFrame* frame, const AskedFrames& asked);
    void flyToUnseen(int step);

    // Returns a place that is marked in the picture; empty: none.
    const std::optional<glm::dvec3>& marked() const { return mMarked; }
    void mark(const std::optional<glm::dvec3>& world) { mMarked = world; }
    // Returns the marks on the unfolded wall.
    std::vector<FlatMark> flatMarks() const;
    // Returns the work on paint, once it takes long enough to be noticed.
    std::optional<PaintWork> painting() const;
    // Panels to open, returned once.
    enum class Shows { Nothing, Left, Findings };
    Shows takeShows() { return std::exchange(mShows, Shows::Nothing); }

private:
    LivePaint* paint() const;

    std::optional<ViewSession>& mSession;
    StudyReading& mStudy;
    MeasuredLine mMeasured;
    LiveCoverage mCoverage;
    FindingList mFindings;
    bool mMeasuring = false;
    std::optional<double> mSeesFrom;  // metres above the ground
    std::optional<glm::dvec3> mMarked;
    Shows mShows = Shows::Nothing;
    long long mPaintSeen = 0;  // LivePaint::version()
    Stopwatch mPaintWatch;     // time since paint was last complete
};

}  // namespace stereonav
