// The threads beside the window's: one loads scenes, one makes the newest frame that was asked for. The
// window asks, polls and draws; it never waits for them until it closes.
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

// A scene as the window shows it. Changes behind it (light, the sun, a medium's model) are made on the thread
// that makes frames.
struct OpenScene {
    std::shared_ptr<Scene> scene;
    FrameWay way;  // planned when the scene was opened; names its method
    SunPlace sun;  // at the beginning: place of its light, if that turns, and its model
    int model = 0;
    bool changed = false;  // made from the scene before, which showed the same (SurfaceChoices::changed)
};

// Everything that a frame depends on: one value, read at the beginning of a frame.
struct FrameRequest {
    long long version = 0;
    double asked_s = 0;  // time of asking, in seconds of the window's clock
    double ahead_s = 0;  // seconds after that for which it is made
    Pose pose;
    Lens lens;
    StereoSetting stereo;
    FrameWay way;
    int model = 0;                       // one of LightModels::names()
    double time = 0;                     // seconds, for animated scenes
    SunPlace sun;                        // for scenes whose sun can be moved
    long long paint = 0;                 // LivePaint::version(), where the scene offers it
    bool twoEyes = true;                 // false: one eye, at the head itself
    OutputMode mode = OutputMode::Left;  // mode that the eyes' size was chosen for
    // Whether the eyes may be changed to be comfortable in this picture (comfortableEyes); the frame's
    // request has the result.
    bool fitEyes = false;
    TruthView truth = TruthView::None;            // picture instead of the right eye
    double scale = 1;                             // share of the full size: less while something moves
    glm::ivec2 guard{0};                          // pixels that are cast outside the lens's, on each side
    glm::ivec2 whole{0};                          // the full size; 0: the lens's
    double effort = 1;                            // FrameEffort, where the scene offers it
    bool flying = false;                          // something moves: a newer request comes soon
    bool late = false;                            // it will also be seen from elsewhere (ViewFrame::late)
    bool refines = false;                         // whether it is refined while it rests (rest_refiner.h)
    std::shared_ptr<const EyePainter> paintOver;  // over the scene's own paint; null: nothing
};

struct ViewFrame : EyePair {
    FrameRequest request;
    std::string sweep;  // processor of the sweep, "" where it is not known
    // Parallax of the nearest and the farthest object, as shares of the width; positive is behind the screen.
    // Measured for every pixel of the left eye by its view depth: for translucent objects and media that of
    // the first hit, however faint.
    double nearParallax = 0, farParallax = 0;
    ParallaxHistogram parallax;  // for all pixels; empty for one eye
    double depthAhead = 0;       // metres: typical for the picture's middle; infinite where it is empty
    // Why the right eye does not show request.truth, or an explanation of it; mostly "".
    std::string truthNote;
    std::optional<PictureError> truthError;  // error of the right eye as made, where the difference is shown
    double made_ms = 0;                      // time of the whole frame
    // Rays per pixel of a picture that rested, and its expected PSNR against very many; 0 for one ray.
    int rays = 1;
    double effort = 1;  // for media: multiple of the scene's slices
    double expected_db = 0;
    bool lacksDetail = false;     // detail comes later (LateDetail)
    std::array<LateEye, 2> late;  // planes for the late warp; not ready where nobody asked for it
};

class RestRefiner;

class FramePool;

class ViewWorker {
public:
    // load runs on a thread of the worker and may report progress; wake is called from there when there is
    // something new.
    using Load = std::function<OpenScene(Progress&)>;
    ViewWorker(Load load, std::function<void()> wake);
    ~ViewWorker();  // stops loading, and ends after the present frame

    // Loads another scene while the present one is shown, which it replaces. The newest wish replaces one
    // that is not done.
    void reload(Load load);
    // Makes a scene from the newest one, after loading. The newest wish replaces one that is not begun; one
    // in progress is finished first, so that a held key shows as many scenes as there is time for.
    using Change = std::function<OpenScene(const OpenScene& now, Progress&)>;
    void change(Change change);

    struct Loading {
        bool busy = true;
        double fraction = 0;
        std::string what;
    };
    Loading loading() const;
    // Returns once why the last reload or change failed, "" where it did not, or another one was asked for
    // since.
    std::string takeReloadProblem();

    // Cancels loading, also of scenes that wait; the present scene stays.
    void cancelLoading();
    // Calls the task once with the newest scene on the thread that makes frames, between two frames, or not
    // at all where the worker ends before. Its exceptions are dropped.
    using Task = std::function<void(const OpenScene&)>;
    void ask(Task task);

    // Returns the newest scene, null until one is loaded. Throws the exceptions of the first load, and of
    // rendering.
    std::shared_ptr<const OpenScene> scene() const;
    // Asks for a frame; the newest request replaces one that was not begun.
    void request(const FrameRequest& request);
    // Returns the newest frame, null where there is none since the last call. Throws like scene().
    std::shared_ptr<const ViewFrame> takeFrame();

    // Returns the result of comparing the right eye with its truth, once while the newest frame rests; empty
    // where there is nothing new since the last call. A request ends the comparison (TruthMaker::measure).
    std::optional<FrameTruth> takeTruth();
    static constexpr std::chrono::milliseconds kRest{300};
    // Time without drawing after which free memory of frames and scenes is returned to the system.
    static constexpr std::chrono::milliseconds kLongRest{5000};

private:
    // The frame that was drawn last.
    struct Drawn;
    struct Job {
        FrameRequest request;
        std::shared_ptr<const OpenScene> scene;
        Task task = nullptr;  // done instead of a frame
        bool again = false;   // the resting picture in full: any newer wish goes first
    };
    void loadScenes();
    std::optional<Load> nextLoad();
    Load takeWish();
    void loadOne(const Load& load);
    void renderFrames();
    void runTask(const Job& job);
    // Returns the next job; empty at the end. Where nothing is asked for, measures the last frame.
    std::optional<Job> nextJob(Drawn& drawn);
    void draw(const Job& job, Drawn& drawn);
    bool renderUnlessDropped(const Job& job, ViewFrame& frame);  // false: it was dropped
    bool drops(const FrameRequest& request) const;               // whether to drop the present frame
    void measure(Drawn& drawn);
    void refine(const Drawn& drawn);
    void fail(std::exception_ptr failure);

    std::function<void()> mWake;
    std::shared_ptr<FramePool> mPool;
    mutable std::mutex mMutex;  // guards the members below
    std::condition_variable mAsked;
    std::optional<Load> mLoad;            // not begun
    std::optional<Change> mChange;        // not begun; after mLoad
    std::shared_ptr<Progress> mProgress;  // progress of the present load
    Loading mLoading;
    std::string mReloadProblem;
    std::shared_ptr<const OpenScene> mScene;
    std::exception_ptr mFailure;
    std::optional<FrameRequest> mRequest;
    std::deque<Task> mTasks;
    std::shared_ptr<const ViewFrame> mNewest;
    std::optional<FrameTruth> mTruth;
    bool mStop = false;
    FrameRequest mAtWork;                  // newest request that was begun
    std::atomic<bool> mDrop = false;       // drops the picture that is being made
    std::atomic<bool> mInterrupt = false;  // ends measuring: there is something else to do
    TruthMaker mTruthMaker;                // only for the thread that makes frames, like mRefiner
    std::unique_ptr<RestRefiner> mRefiner;
    std::thread mLoader, mRenderer;  // last: they start when all other members exist
};

}  // namespace stereonav
