// Scenes for the viewer: loaded, measured, and loaded again with what the user changed in the window.
#pragma once

#include <functional>
#include <memory>

#include "app/options/picture_options.h"
#include "app/scene/scene_loading.h"
#include "app/view/beside_work.h"
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
    bool busy() const { return mReading.busy(); }
    double fraction() const { return mReading.fraction(); }  // of what is being read
    void cancel() { mReading.cancel(); }                     // take() throws Cancelled soon
    void abandon();  // of a scene that is gone: take() will tell nothing of it
    // Nothing while busy, or for a scene without slices. wake: called when it is done.
    void start(std::shared_ptr<const OpenScene> scene, std::function<void()> wake);
    // Null while it is not done; throws what reading threw.
    std::shared_ptr<const SliceStudy> take();

private:
    bool mAbandoned = false;
    BesideWork<std::shared_ptr<const SliceStudy>> mReading;  // last: its end is waited for first
};

}  // namespace stereonav
