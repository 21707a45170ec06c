// A session's path: what is recorded, plays and is changed, and its steps back; and that it gets into a file.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/flight_recording.h"
#include "app/view/passing_notice.h"
#include "app/view/raised_ground.h"
#include "app/view/worker.h"
#include "engine/nav/flight.h"

namespace stereonav {

class SessionPath {
public:
    // scene, flight, notice: outlive this. path: what plays at first; none: the scene's own. folder: of
    // recordings.
    SessionPath(const std::shared_ptr<const OpenScene>& scene, const std::unique_ptr<Flight>& flight,
                PassingNotice& notice, const std::optional<RecordedPath>& path,
                const std::filesystem::path& folder)
        : mScene(scene),
          mFlight(flight),
          mNotice(notice),
          mRecorder(folder),
          mPath(path ? *path : scene->scene->path),
          mOwn(!path) {}

    const RecordedPath& path() const { return mPath; }
    long long version() const { return mVersion; }  // another one with every other path
    // Puts another one in its place; what fails is told. The last ones can be had back.
    void edit(const std::function<RecordedPath(const RecordedPath&)>& edit);
    void open(RecordedPath path);  // the same, with one that lies in a file
    void undo();
    void save();
    // In its place without a step back or a word: one that is being worked on.
    void set(RecordedPath path);
    // Before the session ends: what is being recorded ends, and it or a path that was changed and not saved
    // goes into a file. What to tell of that; "" where there is neither.
    std::string keepWork();
    // Another scene is shown. raised: its ground was raised; then what was recorded was kept before.
    void replaceScene(const std::optional<RaisedGround>& raised);

    void toggleRecording();
    void endRecording() { saveFlight(); }  // recording() holds
    bool recording() const { return mRecorder.recording(); }
    double recorded() const { return mRecorder.duration(); }  // seconds
    // dt seconds later one is here.
    void record(double dt, const Pose& pose) { mRecorder.step(dt, pose); }
    // Why it can not be kept as it is made, told once; "": it can.
    std::string takeProblem() { return mRecorder.takeProblem(); }

    void togglePlaying();
    void stop();           // the flight goes on where it was played to
    void step(double dt);  // while it plays
    bool playing() const { return mPlaying; }
    double time() const { return mTime; }  // seconds since the path's start
    const Pose& played() const { return mPlayed; }
    Pose ahead(double seconds) const;  // where it will be then

private:
    enum class Is { InFile, Unsaved };
    struct Before {
        RecordedPath path;
        bool own;  // the scene's: given back, it is that of the scene that is shown then
        Is where;
    };
    void saveFlight();
    void writtenTo(const std::function<std::filesystem::path()>& write);
    void put(const std::function<RecordedPath(const RecordedPath&)>& edit, Is where);
    void take(RecordedPath path, Is where);
    void dropOldest();

    const std::shared_ptr<const OpenScene>& mScene;
    const std::unique_ptr<Flight>& mFlight;
    PassingNotice& mNotice;
    FlightRecording mRecorder;
    RecordedPath mPath;
    Is mIs = Is::InFile;  // the scene's own needs no file
    bool mOwn;            // it is the scene's own
    long long mVersion = 0;
    std::vector<Before> mBefore;
    bool mPlaying = false;
    double mTime = 0;  // seconds since the path's start
    Pose mPlayed;
};

}  // namespace stereonav
