// Facts of a scene, collected beside the frames by the thread that makes them.
#pragma once

#include <memory>

#include "app/view/worker.h"
#include "engine/scene/facts.h"

namespace stereonav {

class SceneFacts {
public:
    // Returns the facts, and asks for them where they were not; null until they are there.
    const Facts* of(ViewWorker& worker);
    // Forgets the facts, since the scene is another one or shows something else.
    void forget() { mWish.reset(); }

private:
    struct Wish;
    std::shared_ptr<Wish> mWish;
};

}  // namespace stereonav
