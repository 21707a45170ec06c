// What is done with a picture that rests: full casts of both eyes with their rays at other places in the
// pixels, averaged, until the picture is as good as the truth.
#pragma once

#include <memory>

#include "app/view/worker.h"
#include "engine/frame/refined_frames.h"

namespace stereonav {

// For one thread at a time, the one that makes frames.
class RestRefiner {
public:
    // Begins anew with a picture that was drawn; none where its request does not ask for that, or its right
    // eye shows something else than itself.
    void start(std::shared_ptr<const ViewFrame> drawn);
    bool wantsMore() const { return mDrawn != nullptr; }

    // Adds a frame. True where the mean is now worth showing: `shown` becomes what was drawn, with its
    // colours. Throws what making a frame throws; nothing more is wanted then.
    bool step(const Scene& scene, ViewFrame& shown);

    // Steps of 255 that the mean is expected to be away from the truth, root mean square: 60 dB.
    static constexpr double kEnough_levels = 0.25;
    // Frames that take longer are left as they are: what a person does next would wait for them.
    static constexpr double kLongest_ms = 1000;

private:
    std::shared_ptr<const ViewFrame> mDrawn;
    RefinedFrames mRefined;
};

}  // namespace stereonav
