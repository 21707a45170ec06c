// The path of a session: recording, playing and editing it with undo, and saving it in a file.
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
#include "app/view/view_frame.h"
#include "engine/nav/flight.h"

namespace stereonav {

class SessionPath {
public:
    // scene, flight and notice must outlive this object. path: the one to play at first; empty: the scene's
    // own. folder: for recordings.
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
    long long version() const { return mVersion; }  // differs for every path
    // Replaces the path by an edited one; failures become notices. Recent ones can be restored.
    void edit(const std::function<RecordedPath(const RecordedPath&)>& edit);
    void open(RecordedPath path);  // the same, with a path from a file
    void undo();
    void save();
    // Replaces the path without undo or a notice: for one that is being edited.
    void set(RecordedPath path);
    // Ends a recording before the session ends, and saves it, or a path that was changed and not saved.
    // Returns a notice; "" where there is neither.
    std::string keepWork();
    // Goes on in another scene. raised: its ground has other heights; then a recording was saved before.
    void replaceScene(const std::optional<RaisedGround>& raised);

    void toggleRecording();
    void endRecording() { saveFlight(); }  // requires recording()
    bool recording() const { return mRecorder.recording(); }
    double recorded() const { return mRecorder.duration(); }  // in seconds
    // Adds the pose dt seconds later to the recording.
    void record(double dt, const Pose& pose) { mRecorder.step(dt, pose); }
    // Returns once why the recording can not be saved; "": it can.
    std::string takeProblem() { return mRecorder.takeProblem(); }

    void togglePlaying();
    void stop();           // the flight goes on where playing has stopped
    void step(double dt);  // to be called while it plays
    bool playing() const { return mPlaying; }
    double time() const { return mTime; }  // seconds since the path's start
    const Pose& played() const { return mPlayed; }
    Pose ahead(double seconds) const;  // pose after so many seconds

private:
    enum class Is { InFile, Unsaved };
    struct Before {
        RecordedPath path;
        bool own;  // the scene's own: when restored, it is that of the present scene
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
    bool mOwn;            // whether it is the scene's own
    long long mVersion = 0;
    std::vector<Before> mBefore;
    bool mPlaying = false;
    double mTime = 0;  // seconds since the path's start
    Pose mPlayed;
};

}  // namespace stereonav
