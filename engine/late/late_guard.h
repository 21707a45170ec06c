// A guard around pictures that will be seen from elsewhere: they are cast somewhat wider than they are shown,
// so that what comes into view is there. No clock.
#pragma once

#include <array>
#include <deque>
#include <glm/vec2.hpp>

#include "engine/camera/stereo_rig.h"
#include "engine/late/late_warp.h"

namespace stereonav {

// Returns a lens with the same pixels, and `guard` more of them at each side: what lies in the middle of
// either eye stays there.
Lens guarded(const Lens& lens, const glm::ivec2& guard);

// Returns how far `to` sees beyond what was to be shown of a picture, as shares of its width and height: by
// the depths at its borders, at most 1. guard: pixels at each side that the picture was cast with.
glm::dvec2 seenBeyond(const LateEye& eye, const glm::ivec2& guard, const EyeView& to);

// The width of the guard, from what the last pictures saw beyond theirs. It grows at once and shrinks slowly,
// and it goes by steps: frames of one size use memory again.
class GuardBand {
public:
    static constexpr double kStep = 0.03, kMost = 0.12;  // shares of the width or the height, at each side
    static constexpr double kRemembered_s = 1;           // how long what was seen counts
    static constexpr double kHold_s = 2;                 // less has been enough for so long before it shrinks

    // Notes a picture that was shown: seenBeyond() of it, at `now_s` of a clock that never goes back.
    void saw(const glm::dvec2& beyond, double now_s);
    // Starts over without a guard: nothing moves any more.
    void forget();
    // The guard at each side, as shares of the width and the height.
    glm::dvec2 shares() const { return glm::dvec2(mSteps) * kStep; }

private:
    struct Seen {
        double at = 0;           // seconds
        glm::dvec2 beyond{0.0};  // shares of the width and the height
    };
    std::deque<Seen> mSeen;
    // steps at each side; those that would have been enough since mLowerSince
    glm::ivec2 mSteps{0}, mLower{0};
    glm::dvec2 mLowerSince{0.0};  // seconds
};

}  // namespace stereonav
