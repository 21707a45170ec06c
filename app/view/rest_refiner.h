// What is done with a picture that rests: full casts of both eyes with their rays at other places in the
// pixels, averaged, until the picture is as good as the truth. Of media first more and more slices and texels
// of light.
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

    // Adds a frame. True where what there is now is worth showing: `shown` becomes what was drawn, with its
    // colours. Throws what making a frame throws; nothing more is wanted then.
    bool step(const Scene& scene, ViewFrame& shown);

    // Steps of 255 that the mean is expected to be away from the truth, root mean square: 60 dB.
    static constexpr double kEnough_levels = 0.25;
    // Of media: half a step, 54 dB; and the most work that a frame of theirs may be, of the scene's own.
    static constexpr double kEnoughOfMedium_levels = 0.5, kMostEffort = 4;
    // Frames that take longer are left as they are, but for media, which are left at any time: what a person
    // does next would wait for them.
    static constexpr double kLongest_ms = 1000, kLongestOfMedium_ms = 10'000;

private:
    // More work in each frame, twice as much as in the one before; false once that is enough.
    bool stepEffort(const Scene& scene, const ViewFrame& drawn, ViewFrame& shown);
    bool stepMean(const Scene& scene, const std::shared_ptr<const ViewFrame>& drawn, bool swept,
                  ViewFrame& shown);

    std::shared_ptr<const ViewFrame> mDrawn;
    RefinedFrames mRefined;
    double mEffort = 1;           // of the finest frame of a medium
    double mApart_levels = 0;     // that one from the one of half as much; 0: none yet
    double mExpected_levels = 0;  // from the truth, by its slices
    EyePair mFinest;
    bool mFineEnough = false, mEnds = false;  // the slices; all of it, as frames take too long
};

}  // namespace stereonav
