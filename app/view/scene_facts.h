// What a scene says of itself, collected beside the frames by the thread that makes them.
#pragma once

#include <memory>

#include "app/view/worker.h"
#include "engine/scene/facts.h"

namespace stereonav {

class SceneFacts {
public:
    // Asks for them where they were not; null until they are there.
    const Facts* of(ViewWorker& worker);
    // The scene is another one, or shows something else.
    void forget() { mWish.reset(); }

private:
    struct Wish;
    std::shared_ptr<Wish> mWish;
};

}  // namespace stereonav
