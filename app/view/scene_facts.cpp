#include "app/view/scene_facts.h"

#include <mutex>
#include <optional>

namespace stereonav {

struct SceneFacts::Wish {
    std::mutex mutex;
    std::optional<Facts> facts;
};

const Facts* SceneFacts::of(ViewWorker& worker) {
    if (!mWish) {
        mWish = std::make_shared<Wish>();
        worker.ask([wish = mWish](const OpenScene& open) {
            Facts facts = open.scene->describe();
            const std::lock_guard lock(wish->mutex);
            wish->facts = std::move(facts);
        });
        return nullptr;
    }
    const std::lock_guard lock(mWish->mutex);
    return mWish->facts ? &*mWish->facts : nullptr;
}

}  // namespace stereonav
