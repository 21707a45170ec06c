// What measures in the picture: a line on the surface, coverage of the wall, findings, and what is painted on
// the ground; which of them a click means; and what each keeps for the scene's file.
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
    // session, study: outlive this. wake: called from other threads when something is done.
    Instruments(std::optional<ViewSession>& session, StudyReading& study, const std::function<void()>& wake)
        : mSession(session), mStudy(study), mMeasured(wake), mCoverage(wake), mFindings(wake) {}

    // Before a scene's first picture. places: the file that keeps the scene's places (Bookmarks::file()).
    void open(const std::shared_ptr<const Scene>& scene, const std::filesystem::path& places);
    // The same file, shown by another scene.
    void replaceScene(const std::shared_ptr<const Scene>& scene);
    // Each turn. True: there is something new to show.
    bool follow();
    // The same of what is painted on the ground; failed: called with what could not be had.
    bool followPaint(const std::function<void(const std::string&)>& failed);
    // A picture was shown: its wall was looked at.
    void see(const ViewFrame& frame, const AskedFrames& asked);

    // Null before a scene is there, or where it has nothing to measure so.
    MeasuredLine* measured() { return mSession ? &mMeasured : nullptr; }
    LiveCoverage* coverage() { return mSession && mCoverage.can() ? &mCoverage : nullptr; }
    FindingList* findings() { return mSession && mFindings.maker() ? &mFindings : nullptr; }
    const MeasuredLine& line() const { return mMeasured; }
    const FindingList& findingList() const { return mFindings; }

    // What clicks on the picture do, while it stands still: places of the line, findings, or ground that is
    // painted as seen from so high above it (none: it is not). One of the first two.
    bool measuring() const { return mMeasuring; }
    void measure(bool on);
    void clickFindings(bool on);
    const std::optional<double>& seesFrom() const { return mSeesFrom; }
    void seeFrom(const std::optional<double>& height) { mSeesFrom = height; }
    bool takesClicks() const { return mMeasuring || mSeesFrom || mFindings.clicks(); }
    // world: what is under the pointer; none where nothing is.
    void click(const std::optional<glm::dvec3>& world);
    void measureAt(const std::optional<glm::dvec3>& world);
    void findAt(const std::optional<glm::dvec3>& world);
    void addFinding(const glm::dvec3& place);

    void toggleCoverage(const ViewFrame* frame, const AskedFrames& asked);
    void flyToUnseen(int step);

    // A place that is marked in the picture, world; none: nothing is.
    const std::optional<glm::dvec3>& marked() const { return mMarked; }
    void mark(const std::optional<glm::dvec3>& world) { mMarked = world; }
    // What is marked on the wall that lies flat.
    std::vector<FlatMark> flatMarks() const;
    // Paint that is being worked out, once one waits for it.
    std::optional<PaintWork> painting() const;
    // Panels that are to be opened, told once.
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
    Stopwatch mPaintWatch;     // since nothing was worked out
};

}  // namespace stereonav
