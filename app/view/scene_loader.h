// Loads and changes scenes on a thread of its own; the window asks and polls, and never waits.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/view/view_frame.h"
#include "engine/base/progress.h"

namespace stereonav {

class SceneLoader {
public:
    // A load runs on the loader's thread and may report progress.
    using Load = std::function<OpenScene(Progress&)>;
    using Show = std::function<void(const std::shared_ptr<const OpenScene>&)>;
    // show: called from the thread with each scene that is there, before newest() returns it. wake: called
    // from there when there is something new.
    SceneLoader(Load first, Show show, std::function<void()> wake);
    ~SceneLoader();  // stops loading

    // Loads another scene while the present one is shown, which it replaces. The newest wish replaces one
    // that is not done.
    void reload(Load load);
    // Makes a scene from the newest one, after loading. The newest wish replaces one that is not begun; one
    // in progress is finished first, so that a held key shows as many scenes as there is time for.
    using Change = std::function<OpenScene(const OpenScene& now, Progress&)>;
    void change(Change change);
    // Cancels loading, also of scenes that wait; the present scene stays.
    void cancel();

    struct Loading {
        bool busy = true;
        double fraction = 0;
        std::string what;
    };
    Loading loading() const;
    // Returns once why the last reload or change failed, "" where it did not, or another one was asked for
    // since.
    std::string takeProblem();
    // Returns the newest scene, null until one is loaded. Throws the exceptions of the first load.
    std::shared_ptr<const OpenScene> newest() const;

private:
    void run();
    std::optional<Load> next();
    Load takeWish();
    void loadOne(const Load& load);

    Show mShow;
    std::function<void()> mWake;
    mutable std::mutex mMutex;  // guards the members below
    std::condition_variable mWished;
    std::optional<Load> mLoad;            // not begun
    std::optional<Change> mChange;        // not begun; after mLoad
    std::shared_ptr<Progress> mProgress;  // progress of the present load
    Loading mLoading;
    std::string mProblem;
    std::shared_ptr<const OpenScene> mScene;
    std::exception_ptr mFailure;  // why the first load failed
    bool mStop = false;
    std::jthread mThread;  // last: it starts when all other members exist
};

}  // namespace stereonav
