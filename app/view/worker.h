// The threads beside the window's: one loads scenes, one makes the newest frame that was asked for. The
// window asks, polls and draws; it never waits for them until it closes.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "app/view/frame_pool.h"
#include "app/view/frame_truth.h"
#include "app/view/rest_refiner.h"
#include "app/view/scene_loader.h"
#include "app/view/view_frame.h"

namespace stereonav {

class ViewWorker {
public:
    // load: the first scene; see SceneLoader. wake: called from the threads when there is something new.
    ViewWorker(SceneLoader::Load load, std::function<void()> wake);
    ~ViewWorker();  // stops loading, and ends after the present frame

    SceneLoader& scenes() { return mLoader; }
    const SceneLoader& scenes() const { return mLoader; }

    // Calls the task once with the newest scene on the thread that makes frames, between two frames, or not
    // at all where the worker ends before. Its exceptions are dropped.
    using Task = std::function<void(const OpenScene&)>;
    void ask(Task task);

    // Asks for a frame; the newest request replaces one that was not begun.
    void request(const FrameRequest& request);
    // Returns the newest frame, null where there is none since the last call. Throws the exceptions of
    // rendering.
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
    void use(const std::shared_ptr<const OpenScene>& scene);
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
    std::mutex mMutex;  // guards the members below
    std::condition_variable mAsked;
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
    RestRefiner mRefiner;
    std::jthread mRenderer;  // after all members that it uses
    SceneLoader mLoader;     // last: it ends first
};

}  // namespace stereonav
