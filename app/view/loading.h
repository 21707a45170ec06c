// Scenes for the viewer: loaded, measured, and loaded again with what the user changed in the window.
#pragma once

#include <future>

#include "app/command/commands.h"
#include "app/scene/scene_loading.h"
#include "app/view/session.h"
#include "app/view/worker.h"

namespace stereonav {

class ViewSweep;

// measure: whether to find out by measuring how the right eye is made best, where the options leave it
// open; else it is the scene's default. window: its pixels. sweep: of media, null for other scenes. Throws
// Error, Cancelled.
OpenScene openScene(const ViewOptions& options, bool measure, const SizeOption& window, ViewSweep* sweep,
                    Progress& progress);
// One that offers SurfaceChoices, so changed; on the thread that loads. Throws Error, Cancelled.
OpenScene changedScene(const OpenScene& now, const SurfaceChange& change, const ViewOptions& options,
                       Progress& progress);

// What the user changed in the window, into `options`, which were made from `first`.
void applyChange(const SceneChange& change, const SceneOptions& first, SceneOptions& options);

// Reads the slices of a scene beside the window's thread.
class SliceReading {
public:
    ~SliceReading() { cancel(); }  // and waits for the end

    bool busy() const { return mReading.valid(); }
    void cancel();  // take() throws Cancelled soon
    // Of what is shown no longer: take() says nothing of it.
    void forget();
    // Nothing while busy, or for a scene without slices. wake: called when it is done.
    void start(std::shared_ptr<const OpenScene> scene, std::function<void()> wake);
    // Null while it is not done; throws what reading threw.
    std::shared_ptr<const SliceStudy> take();

private:
    std::shared_ptr<Progress> mProgress;  // of the one at work, or the last
    bool mForgotten = false;
    std::future<std::shared_ptr<const SliceStudy>> mReading;
};

}  // namespace stereonav
