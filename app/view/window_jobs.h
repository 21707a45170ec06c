// Movies, pictures and bakes that the window asks for: made by the program's own commands in a process of
// their own, one at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/job.h"
#include "app/view/measured_line.h"
#include "app/view/scene_settings.h"
#include "engine/base/new_file.h"

namespace stereonav {

class Notices;

struct MovieWish {
    std::string file;                // .mp4, .mkv, .avi; or a folder's name, for pictures
    int width = 1280, height = 720;  // pixels of an eye
    double fps = 25;
};

struct PictureWish {
    std::string file;                // .png, .jps, .mpo
    int width = 1280, height = 720;  // pixels of an eye
};

// What fails is told.
class WindowJobs {
public:
    // All of them outlive this.
    WindowJobs(std::optional<ViewSession>& session, const SceneSettings& settings, Notices& notices)
        : mSession(session), mSettings(settings), mNotices(notices) {}

    // The one at work, or the last one; null before the first.
    const Job* job() const { return mJob.get(); }
    bool busy() const { return mJob && mJob->running(); }
    void cancel();
    // The path that Play plays, as the window is set.
    void makeMovie(const MovieWish& movie);
    // What is seen, as the window is set.
    void savePicture(const PictureWish& picture);
    // Whether the scene has light to bake, and whether `bake` takes this option of it.
    bool bakes() const;
    bool bakeTakes(const std::string& key, const std::string& value) const;
    // The scene's light, to be shown when it is done.
    void bakeLight(const std::string& what, double minutes);
    // Writes what is measured, by the file's name: .csv and .svg of the profile, .geojson.
    void saveMeasured(const MeasuredLine& line, const std::string& file);

    // Each turn: tells what came of it. Baked light that is to be shown now; none mostly.
    std::optional<std::string> look();
    // What would end with the window, and what becomes of it; "": nothing.
    std::string atWork() const;

private:
    void checkNone() const;
    std::string modeOfFiles() const;
    // place: of the file that it makes, where that is to be a new one.
    void start(const std::string& what, const std::vector<std::string>& words,
               std::unique_ptr<HeldPlace> place = nullptr);

    std::optional<ViewSession>& mSession;
    const SceneSettings& mSettings;
    Notices& mNotices;
    std::unique_ptr<JobFile> mPath;     // the flight that the job plays; goes after it
    std::unique_ptr<HeldPlace> mPlace;  // of the file that it makes; the same
    std::unique_ptr<Job> mJob;
    std::string mBaked, mBakedScene;  // the file of a bake at work, and the scene that it belongs to
};

}  // namespace stereonav
