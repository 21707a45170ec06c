// The threads beside the window's: one loads the scene, and others in its place later on; one makes the
// newest frame that was asked for. The window asks, polls and draws; it never waits for them until it
// closes.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/command/commands.h"
#include "engine/base/progress.h"
#include "engine/camera/recorded_path.h"
#include "engine/camera/stereo_rig.h"
#include "engine/frame/frame_maker.h"
#include "engine/image/stereo_compose.h"
#include "engine/nav/flight.h"
#include "engine/stereo/room_seen.h"
#include "engine/volume/volume.h"

namespace stereonav {

// The grey values behind a scene, for pictures of its slices.
struct SliceStudy {
    GreyVolume grey;
    double windowWidth = 1500, windowLevel = -200;  // values shown from black to white, and their middle
};

// Where the sun stands, radians: clockwise from north, above the horizon; or how far a sky is turned
// clockwise and tilted.
struct SunPlace {
    double azimuth = 0, elevation = 0;
    bool operator==(const SunPlace&) const = default;
};

// How what surrounds a volume's voxels lights them and takes their opacity (app/scene/volume_ambient.h).
struct ViewAmbient {
    bool lit = false;           // ambient light in place of the lamp's
    std::string method;         // that estimates openness, as --ambient-method; "": gaussian
    double radius = 0;          // metres, of ambient light
    std::string modulate;       // opacity by this: variance, gradient; "": not modulated
    double modulateRadius = 0;  // metres
    double sigma = 0;           // from where on opacity stays whole; 0: chosen
    bool operator==(const ViewAmbient&) const = default;
};

struct PlaceOnLine {
    double along = 0, length = 0;  // metres
};

// A scene as the viewer needs it, whatever it shows. Read by both threads; what changes behind it (light, the
// sun, a medium's model) is changed on the thread that makes frames.
struct ViewScene {
    std::shared_ptr<const void> owner;  // of all that the rest refers to
    FrameMaker* frames = nullptr;       // used on the thread that makes frames alone
    std::function<std::unique_ptr<Flight>()> makeFlight;
    RecordedPath path;  // the scene's own flight
    Lens lens;
    StereoSetting stereo;
    FrameWay way;  // as planned when the scene was opened; its method has a name

    // Of media: the models to choose from, and the choice before a frame, on the thread that makes frames.
    std::vector<std::string> models;
    int model = 0;
    std::function<void(int model)> setModel;
    std::function<std::string()> sweepName;  // after a frame, there: where it was swept; may be empty
    bool animated = false;                   // moves by itself, on FrameRequest::time

    // Of terrain under baked light and of media: turns the sun before a frame, on the thread that makes
    // frames. Cheap where it stands there already. Of volumes under baked transfer: the sky.
    std::function<void(const SunPlace&)> moveSun;
    SunPlace sun;
    bool turnsSky = false;   // elevation is then how far the sky is tilted
    std::string lightStays;  // why, where moveSun is empty

    // Of light that is worked out while one flies: told what each frame saw; counts changes, after which the
    // last frame is drawn again. Both called on the thread that makes frames.
    std::function<void(const EyeView& view, const EyeImage& image)> seen;
    std::function<std::uint64_t()> lightChanges;

    // Of volumes; empty where they make no sense.
    double largestSeparation = std::numeric_limits<double>::infinity();     // metres, by hand
    std::function<StereoFollower(const StereoSetting& from)> makeFollower;  // to let eyes suit the room
    bool followsAtStart = true;
    std::function<PlaceOnLine(const glm::dvec3& world)> placeOnLine;
    std::optional<double> isovalue;  // of a surface that can be moved
    double isovalueStep = 0;
    bool canBeTranslucent = false, translucent = false;
    std::vector<std::string> transfers;  // functions to choose from; "": that of the options
    std::string transfer;                // of them: where translucent
    // Of volumes seen from outside; none for others.
    std::optional<ViewAmbient> ambient;
    std::vector<std::string> ambientMethods;       // to choose from
    double smallestRadius = 0, largestRadius = 0;  // metres
    double largestSigma = 0;                       // by variance
    double chosenSigma = 0;                        // where ambient->sigma is 0 and opacity is modulated
    // Of volumes that are cast: the same study seen as other options say, made from what is there; on the
    // thread that loads. Throws Error, Cancelled. Empty: it is to be loaded again.
    std::function<ViewScene(const SceneOptions& options, Progress&)> change;
    bool changed = false;  // made so
    // Reads the study again for its slices; takes seconds, on a thread of the caller's.
    std::function<std::shared_ptr<const SliceStudy>(Progress&)> readSlices;
    const MaskVolume* lumen = nullptr;  // to be outlined in the slices
    std::vector<glm::dvec3> seeds;      // world: that the lumen was found from
};

// All that a frame depends on: one value, taken at the start of a frame.
struct FrameRequest {
    long long version = 0;
    Pose pose;
    Lens lens;
    StereoSetting stereo;
    FrameWay way;
    int model = 0;                       // of ViewScene::models
    double time = 0;                     // seconds, where the scene is animated
    SunPlace sun;                        // where it can be moved
    bool twoEyes = true;                 // false: one eye, from the head itself
    OutputMode mode = OutputMode::Left;  // that the eyes' size was chosen for
};

struct ViewFrame : EyePair {
    FrameRequest request;
    std::string sweep;  // where they were swept, "" where nobody tells
    // Parallax of the nearest and the farthest thing, as shares of the width; positive is behind the screen.
    double nearParallax = 0, farParallax = 0;
    double depthAhead = 0;  // metres: typical of the picture's middle; infinite where nothing is there
};

class ViewWorker {
public:
    // load runs on a thread of the worker's and may report progress; wake is called from there when there
    // is something new.
    using Load = std::function<ViewScene(Progress&)>;
    ViewWorker(Load load, std::function<void()> wake);
    ~ViewWorker();  // stops loading, and ends after the frame at work

    // Loads another scene while the present one is shown; it takes its place when it is there. The newest
    // wish replaces one that is not done.
    void reload(Load load);
    // Makes a scene from the newest one, after what is being loaded. The newest wish replaces one that is not
    // begun; one at work is finished first, so that a key held down shows every scene that there is time for.
    using Change = std::function<ViewScene(const ViewScene& now, Progress&)>;
    void change(Change change);

    struct Loading {
        bool busy = true;
        double fraction = 0;
        std::string what;
    };
    Loading loading() const;
    // What the last reload failed with, "" when it did not; told once.
    std::string takeReloadProblem();

    // The newest scene, null until one is loaded. Throws here what the first load or rendering threw there.
    std::shared_ptr<const ViewScene> scene() const;
    // The newest request replaces one that was not begun.
    void request(const FrameRequest& request);
    // The newest frame, null when there is none since the last call. Throws as scene() does.
    std::shared_ptr<const ViewFrame> takeFrame();

private:
    class FramePool;
    struct Job {
        FrameRequest request;
        std::shared_ptr<const ViewScene> scene;
    };
    void loadScenes();
    std::optional<Load> nextLoad();
    Load takeWish();
    void loadOne(const Load& load);
    void renderFrames();
    // last: what was drawn last, under the light of that many changes.
    std::optional<Job> nextJob(const std::optional<Job>& last, std::uint64_t changes);
    void fail(std::exception_ptr failure);

    std::function<void()> mWake;
    std::shared_ptr<FramePool> mPool;
    mutable std::mutex mMutex;  // guards what follows
    std::condition_variable mAsked;
    std::optional<Load> mLoad;            // not begun
    std::optional<Change> mChange;        // not begun; after mLoad
    std::shared_ptr<Progress> mProgress;  // of the load at work
    Loading mLoading;
    std::string mReloadProblem;
    std::shared_ptr<const ViewScene> mScene;
    std::exception_ptr mFailure;
    std::optional<FrameRequest> mRequest;
    std::shared_ptr<const ViewFrame> mNewest;
    bool mStop = false;
    std::thread mLoader, mRenderer;  // last: they start when all else is there
};

}  // namespace stereonav
