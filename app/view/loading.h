// Scenes for the viewer: loading, measuring, and loading again with changes made in the window.
#pragma once

#include <functional>
#include <memory>

#include "app/options/view_options.h"
#include "app/scene/scene_loading.h"
#include "app/view/beside_work.h"
#include "app/view/session.h"
#include "app/view/view_frame.h"

namespace stereonav {

class ViewSweep;

// measure: whether to choose the method of the right eye by measuring, where the options leave it open;
// otherwise it is the scene's default. window: its size in pixels. sweep: for media, null for other scenes.
// Throws Error, Cancelled.
OpenScene openScene(const ViewOptions& options, bool measure, const SizeOption& window, ViewSweep* sweep,
                    Progress& progress);
// Returns a changed copy of a scene that offers SurfaceChoices; on the thread that loads. Throws Error,
// Cancelled.
OpenScene changedScene(const OpenScene& now, const SurfaceChange& change, const ViewOptions& options,
                       Progress& progress);

// Applies a change in the window to `options`, which were made from `first`.
void applyChange(const SceneChange& change, const SceneOptions& first, SceneOptions& options);

// Reads the slices of a scene beside the window's thread.
class SliceReading {
public:
    bool busy() const { return mReading.busy(); }
    double fraction() const { return mReading.fraction(); }  // progress of the reading
    void cancel() { mReading.cancel(); }                     // take() then throws Cancelled soon
    void abandon();  // for a scene that is gone: take() returns nothing of it
    // Does nothing while busy, or for a scene without slices. wake: called when it is done.
    void start(std::shared_ptr<const OpenScene> scene, std::function<void()> wake);
    // Returns null while it is not done; throws the exceptions of reading.
    std::shared_ptr<const SliceStudy> take();

private:
    bool mAbandoned = false;
    BesideWork<std::shared_ptr<const SliceStudy>> mReading;  // last: its end is waited for first
};

}  // namespace stereonav
