// Prepares beside the window what a StandIn is shown for: the tiles of a large ground. Nothing is there for
// other scenes. The window's thread calls it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/view/beside_work.h"
#include "app/view/worker.h"
#include "engine/scene/live_paint.h"

namespace stereonav {

class ScenePreparation {
public:
    // wake: called from another thread when it is done.
    explicit ScenePreparation(std::function<void()> wake) : mWake(std::move(wake)) {}

    // Begins for a scene that is shown, ends for one that is not any more. What was cancelled or failed is
    // not begun again.
    void follow(const std::shared_ptr<const OpenScene>& shown);
    // True once it is done for the scene that was followed last, which then is to be loaded again. Throws
    // what preparing threw, Cancelled where cancel() ended it.
    bool take();
    std::optional<PaintWork> work() const;
    void cancel() { mWork.cancel(); }

private:
    std::function<void()> mWake;
    std::string mName, mEnded;  // StandIn::name() of the work, and of what is not begun again
    std::string mWhat;
    bool mDropped = false;
    BesideWork<bool> mWork;
};

}  // namespace stereonav
