#include "app/view/scene_preparation.h"

#include "engine/base/error.h"
#include "engine/base/thread_priority.h"
#include "engine/scene/capabilities.h"

namespace stereonav {

void ScenePreparation::follow(const std::shared_ptr<const OpenScene>& shown) {
    const auto* const standIn = shown->scene->offered<const StandIn>();
    const std::string name = standIn ? standIn->name() : "";
    if (mWork.busy()) {
        if (name == mName) return;
        mDropped = true;
        return mWork.cancel();
    }
    if (!standIn || name == mEnded) return;
    mName = name;
    mWhat = standIn->what();
    mDropped = false;
    mWork.start(
        [shown, standIn](Progress& progress) {
            stepBehindTheWindow();
            standIn->prepare(progress);
            return true;
        },
        mWake);
}

bool ScenePreparation::take() {
    try {
        if (!mWork.take()) return false;
    } catch (const std::exception&) {
        if (mDropped) return false;
        mEnded = mName;
        throw;
    }
    // A scene that is shown again finds the work done.
    if (mDropped) return false;
    mEnded = mName;
    return true;
}

std::optional<PaintWork> ScenePreparation::work() const {
    if (!mWork.busy() || mDropped) return std::nullopt;
    return PaintWork{mWork.fraction(), mWhat};
}

}  // namespace stereonav
