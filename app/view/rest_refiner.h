// Refinement of a picture that rests: full casts of both eyes with rays at different places in the pixels,
// averaged until the picture is as good as the truth. For media first more and more slices and texels of
// light.
#pragma once

#include <memory>

#include "app/view/view_frame.h"
#include "engine/frame/refined_frames.h"

namespace stereonav {

// For one thread at a time: the one that makes frames.
class RestRefiner {
public:
    // Begins with a picture that was drawn; does nothing where its request does not ask for refinement, or
    // its right eye shows something else.
    void start(std::shared_ptr<const ViewFrame> drawn);
    bool wantsMore() const { return mDrawn != nullptr; }

    // Adds a frame. Returns true where the result is worth showing: `shown` becomes the drawn picture with
    // new colours. Throws the exceptions of making a frame; nothing more is wanted then.
    bool step(const Scene& scene, ViewFrame& shown);

    // Expected distance of the mean from the truth that is enough: root mean square in steps of 255, 60 dB.
    static constexpr double kEnough_levels = 0.25;
    // Expected distance that is enough for media: half a step, 54 dB; and the largest effort of their frames,
    // as a multiple of the scene's own.
    static constexpr double kEnoughOfMedium_levels = 0.5, kMostEffort = 4;
    // Longest time of a frame: slower scenes are not refined, as the user's next action would have to wait.
    // Media can be interrupted at any time.
    static constexpr double kLongest_ms = 1000, kLongestOfMedium_ms = 10'000;

private:
    // Doubles the effort of frames; returns false once it is enough.
    bool stepEffort(const Scene& scene, const ViewFrame& drawn, ViewFrame& shown);
    bool stepMean(const Scene& scene, const std::shared_ptr<const ViewFrame>& drawn, bool swept,
                  ViewFrame& shown);

    std::shared_ptr<const ViewFrame> mDrawn;
    RefinedFrames mRefined;
    double mEffort = 1;           // effort of the finest frame of a medium
    double mApart_levels = 0;     // distance of that frame from one with half its effort; 0: not known
    double mExpected_levels = 0;  // expected distance from the truth, by the number of slices
    EyePair mFinest;
    bool mFineEnough = false, mEnds = false;  // enough slices; frames take too long
};

}  // namespace stereonav
