// Movies, pictures and bakes that the user asks for in the window: made by commands of the program in a
// process of their own, one at a time.
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
    std::string file;                // .mp4, .mkv, .avi; or the name of a folder, for pictures
    int width = 1280, height = 720;  // size of an eye
    double fps = 25;
};

struct PictureWish {
    std::string file;                // .png, .jps, .mpo
    int width = 1280, height = 720;  // size of an eye
};

// Failures become notices.
class WindowJobs {
public:
    // The arguments must outlive this object.
    WindowJobs(std::optional<ViewSession>& session, const SceneSettings& settings, Notices& notices)
        : mSession(session), mSettings(settings), mNotices(notices) {}

    // Returns the present job, or the last one; null before the first.
    const Job* job() const { return mJob.get(); }
    bool busy() const { return mJob && mJob->running(); }
    void cancel();
    // Makes a movie of the path that Play plays, with the window's settings.
    void makeMovie(const MovieWish& movie);
    // Saves the present view, with the window's settings.
    void savePicture(const PictureWish& picture);
    // Return whether the scene has light to bake, and whether `bake` takes this option for it.
    bool bakes() const;
    bool bakeTakes(const std::string& key, const std::string& value) const;
    // Bakes the scene's light, and shows it when it is done.
    void bakeLight(const std::string& what, double minutes);
    // Writes measurements in the format of the file's extension: .csv and .svg for the profile, .geojson.
    void saveMeasured(const MeasuredLine& line, const std::string& file);

    // Return whether the command makes a file of this kind of scene; and run it, with the window's settings.
    bool exports(const std::string& command) const;
    void exportFile(const std::string& command, const std::string& file);

    // Reports a finished job; to be called each turn. Returns baked light that is to be shown now, if any.
    std::optional<std::string> look();
    // Returns the work that would end with the window, with the consequences; "": none.
    std::string atWork() const;

private:
    void checkNone() const;
    std::string modeOfFiles() const;
    // place: of the file to make, where it has to be a new one.
    void start(const std::string& what, const std::vector<std::string>& words,
               std::unique_ptr<HeldPlace> place = nullptr);

    std::optional<ViewSession>& mSession;
    const SceneSettings& mSettings;
    Notices& mNotices;
    std::unique_ptr<JobFile> mPath;     // flight that the job plays; destroyed after it
    std::unique_ptr<HeldPlace> mPlace;  // place of the file that it makes; destroyed after it
    std::unique_ptr<Job> mJob;
    std::string mBaked, mBakedScene;  // file of the bake in progress, and its scene
};

}  // namespace stereonav
