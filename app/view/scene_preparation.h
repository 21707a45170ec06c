// Prepares beside the window the data that a StandIn is shown for: the tiles of a large ground. Does nothing
// for other scenes. Functions are called by the window's thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/view/beside_work.h"
#include "app/view/view_frame.h"
#include "engine/scene/live_paint.h"

namespace stereonav {

class ScenePreparation {
public:
    // wake: called from another thread when it is done.
    explicit ScenePreparation(std::function<void()> wake) : mWake(std::move(wake)) {}

    // Begins for a scene that is shown, and ends for one that is no longer shown. Work that was cancelled or
    // failed is not begun again.
    void follow(const std::shared_ptr<const OpenScene>& shown);
    // Returns true once the work for the last scene of follow() is done: it has to be loaded again. Throws
    // the exceptions of the work; Cancelled after cancel().
    bool take();
    std::optional<PaintWork> work() const;
    void cancel() { mWork.cancel(); }

private:
    std::function<void()> mWake;
    std::string mName, mEnded;  // StandIn::name() of the present work, and of work that is not begun again
    std::string mWhat;
    bool mDropped = false;
    BesideWork<bool> mWork;
};

}  // namespace stereonav
