// The thread beside the window's: loads the scene, then makes the newest frame that was asked for.
// The window asks, polls and draws; it never waits for this thread until it closes.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/base/progress.h"
#include "engine/camera/recorded_path.h"
#include "engine/camera/stereo_rig.h"
#include "engine/image/stereo_compose.h"
#include "engine/nav/navigator.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

// A scene as the viewer needs it, whatever it shows. Immutable, read by both threads.
struct ViewScene {
    std::shared_ptr<const void> owner;  // of all that the rest refers to
    const EyeRenderer* renderer = nullptr;
    GroundHeight ground;
    Pose start;
    RecordedPath path;  // the scene's own flight
    Lens lens;
    StereoSetting stereo;
    RightEyeMethod method = kDefaultRightEyeMethod;
    double clearance = 2.0;    // metres
    double extent = 1000.0;    // metres: what speeds are chosen from
    double groundStep = 10.0;  // metres: half of the ground's sample spacing
};

// All that a frame depends on: one value, taken at the start of a frame.
struct FrameRequest {
    long long version = 0;
    Pose pose;
    Lens lens;
    StereoSetting stereo;
    WarpSetting warp;
    bool twoEyes = true;                 // false: one eye, from the head itself
    OutputMode mode = OutputMode::Left;  // that the eyes' size was chosen for
};

struct ViewFrame {
    FrameRequest request;
    EyeImage left, right;  // right.color is empty with one eye
    double left_ms = 0;
    RightEyeTimings rightTimings;
    // Parallax of the nearest and the farthest thing, as shares of the width; positive is behind the screen.
    double nearParallax = 0, farParallax = 0;
};

class ViewWorker {
public:
    // load runs on the worker's thread and may report progress; wake is called from there when there
    // is something new.
    using Load = std::function<ViewScene(Progress&)>;
    ViewWorker(Load load, std::function<void()> wake);
    ~ViewWorker();  // stops loading or ends after the frame at work

    struct Loading {
        double fraction = 0;
        std::string what;
    };
    Loading loading() const;

    // Null until the scene is loaded. Throws here what loading or rendering threw there.
    const ViewScene* scene() const;
    // The newest request replaces one that was not begun.
    void request(const FrameRequest& request);
    // The newest frame, null when there is none since the last call. Throws as scene() does.
    std::shared_ptr<const ViewFrame> takeFrame();

private:
    class FramePool;
    void run();
    void work(const ViewScene& scene);
    std::optional<FrameRequest> nextRequest();

    Load mLoad;
    std::function<void()> mWake;
    Progress mProgress;
    std::shared_ptr<FramePool> mPool;
    mutable std::mutex mMutex;  // guards what follows
    std::condition_variable mAsked;
    Loading mLoading;
    std::unique_ptr<ViewScene> mScene;
    std::exception_ptr mFailure;
    std::optional<FrameRequest> mRequest;
    std::shared_ptr<const ViewFrame> mNewest;
    bool mStop = false;
    std::thread mThread;  // last: starts when all else is there
};

}  // namespace stereonav
