// The threads beside the window's: one loads the scene, and others in its place later on; one makes the
// newest frame that was asked for. The window asks, polls and draws; it never waits for them until it
// closes.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/options/scene_options.h"
#include "app/view/frame_truth.h"
#include "engine/base/progress.h"
#include "engine/camera/stereo_rig.h"
#include "engine/frame/frame_maker.h"
#include "engine/image/stereo_compose.h"
#include "engine/late/late_warp.h"
#include "engine/render/eye_painter.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/live_paint.h"
#include "engine/scene/scene.h"
#include "engine/stereo/parallax_histogram.h"

namespace stereonav {

// A scene as the window shows it. What changes behind it (light, the sun, a medium's model) is changed on the
// thread that makes frames.
struct OpenScene {
    std::shared_ptr<Scene> scene;
    FrameWay way;  // as planned when the scene was opened; its method has a name
    SunPlace sun;  // as it begins: where its light stands, if that turns, and its model
    int model = 0;
    bool changed = false;  // made from the one before, which showed the same (SurfaceChoices::changed)
};

// All that a frame depends on: one value, taken at the start of a frame.
struct FrameRequest {
    long long version = 0;
    double asked_s = 0;  // when that was: seconds of the window's clock
    double ahead_s = 0;  // it is of so much later
    Pose pose;
    Lens lens;
    StereoSetting stereo;
    FrameWay way;
    int model = 0;                       // of LightModels::names()
    double time = 0;                     // seconds, where the scene is animated
    SunPlace sun;                        // where it can be moved
    long long paint = 0;                 // LivePaint::version(), where it is offered
    bool twoEyes = true;                 // false: one eye, from the head itself
    OutputMode mode = OutputMode::Left;  // that the eyes' size was chosen for
    // The eyes may be changed to be comfortable in this picture (comfortableEyes): its own request says to
    // what.
    bool fitEyes = false;
    TruthView truth = TruthView::None;            // in the place of the right eye
    double scale = 1;                             // of the eyes' full size: less while something moves
    glm::ivec2 guard{0};                          // pixels that are cast beyond the lens's, at each side
    glm::ivec2 whole{0};                          // that size; 0: the lens's
    double effort = 1;                            // FrameEffort, where it is offered
    bool flying = false;                          // something moves: a newer one comes soon
    bool late = false;                            // it will be seen from elsewhere too (ViewFrame::late)
    bool refines = false;                         // while it rests (rest_refiner.h)
    std::shared_ptr<const EyePainter> paintOver;  // over what the scene is painted with; null: nothing
};

struct ViewFrame : EyePair {
    FrameRequest request;
    std::string sweep;  // where they were swept, "" where nobody tells
    // Parallax of the nearest and the farthest thing, as shares of the width; positive is behind the screen.
    // Of every pixel of the left eye, by its view depth: of what is translucent, and of a medium, that of
    // what its ray first met, however little of that is seen.
    double nearParallax = 0, farParallax = 0;
    ParallaxHistogram parallax;  // of all pixels; empty of one eye
    double depthAhead = 0;       // metres: typical of the picture's middle; infinite where nothing is there
    // Why the right eye does not show what request.truth asks for, or what it is held against; "" mostly.
    std::string truthNote;
    std::optional<PictureError> truthError;  // of the right eye as made, where the difference is shown
    double made_ms = 0;                      // all that the frame took
    // A picture that rested: rays a pixel of each eye, and the PSNR against very many that is expected; 0 of
    // one.
    int rays = 1;
    double effort = 1;  // of a medium: times the slices that the scene asks for
    double expected_db = 0;
    bool lacksDetail = false;     // that comes later (LateDetail)
    std::array<LateEye, 2> late;  // to be warped; not ready where nobody asked for that
};

class RestRefiner;

class FramePool;

class ViewWorker {
public:
    // load runs on a thread of the worker's and may report progress; wake is called from there when there
    // is something new.
    using Load = std::function<OpenScene(Progress&)>;
    ViewWorker(Load load, std::function<void()> wake);
    ~ViewWorker();  // stops loading, and ends after the frame at work

    // Loads another scene while the present one is shown; it takes its place when it is there. The newest
    // wish replaces one that is not done.
    void reload(Load load);
    // Makes a scene from the newest one, after what is being loaded. The newest wish replaces one that is not
    // begun; one at work is finished first, so that a key held down shows every scene that there is time for.
    using Change = std::function<OpenScene(const OpenScene& now, Progress&)>;
    void change(Change change);

    struct Loading {
        bool busy = true;
        double fraction = 0;
        std::string what;
    };
    Loading loading() const;
    // What the last reload or change failed with, "" when it did not, or when another one is asked for since;
    // told once.
    std::string takeReloadProblem();

    // Ends what is being loaded, or is to be; the present scene stays.
    void cancelLoading();
    // Calls it once with the newest scene on the thread that makes frames, between two of them, or not at all
    // where the worker ends before. What it throws is dropped.
    using Task = std::function<void(const OpenScene&)>;
    void ask(Task task);

    // The newest scene, null until one is loaded. Throws here what the first load or rendering threw there.
    std::shared_ptr<const OpenScene> scene() const;
    // The newest request replaces one that was not begun.
    void request(const FrameRequest& request);
    // The newest frame, null when there is none since the last call. Throws as scene() does.
    std::shared_ptr<const ViewFrame> takeFrame();

    // While the newest frame rests, its right eye is held against its truth, once: what came out, none when
    // there is nothing new since the last call. A request ends that (TruthMaker::measure).
    std::optional<FrameTruth> takeTruth();
    void measureTruth(bool on);  // on at first
    static constexpr std::chrono::milliseconds kRest{300};
    // When nothing was drawn for so long, what frames and scenes left free goes back to the system.
    static constexpr std::chrono::milliseconds kLongRest{5000};

private:
    // What was drawn last.
    struct Drawn;
    struct Job {
        FrameRequest request;
        std::shared_ptr<const OpenScene> scene;
        Task task = nullptr;  // instead of a frame
        bool again = false;   // what rests, in full: any newer wish goes first
    };
    void loadScenes();
    std::optional<Load> nextLoad();
    Load takeWish();
    void loadOne(const Load& load);
    void renderFrames();
    void runTask(const Job& job);
    // None at the end. Where nothing is asked for, measures what was drawn.
    std::optional<Job> nextJob(Drawn& drawn);
    void draw(const Job& job, Drawn& drawn);
    bool renderUnlessDropped(const Job& job, ViewFrame& frame);  // false: it was dropped
    bool drops(const FrameRequest& request) const;               // the frame that is being made, for this
    void measure(Drawn& drawn);
    void refine(const Drawn& drawn);
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
    std::shared_ptr<const OpenScene> mScene;
    std::exception_ptr mFailure;
    std::optional<FrameRequest> mRequest;
    std::deque<Task> mTasks;
    std::shared_ptr<const ViewFrame> mNewest;
    std::optional<FrameTruth> mTruth;
    bool mMeasures = true;
    bool mStop = false;
    FrameRequest mAtWork;                  // the newest that was begun
    std::atomic<bool> mDrop = false;       // the picture that is being made
    std::atomic<bool> mInterrupt = false;  // what is measured: there is something else to do
    TruthMaker mTruthMaker;                // the frame maker's thread's own, as is
    std::unique_ptr<RestRefiner> mRefiner;
    std::thread mLoader, mRenderer;  // last: they start when all else is there
};

}  // namespace stereonav
