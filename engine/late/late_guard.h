// A guard band around pictures for the late warp: they are cast somewhat wider than they are shown, so that
// parts are there that come into view meanwhile. Uses no clock.
#pragma once

#include <array>
#include <deque>
#include <glm/vec2.hpp>

#include "engine/camera/stereo_rig.h"
#include "engine/late/late_warp.h"

namespace stereonav {

// Returns the lens with the same pixels and `guard` more of them at each side; the middle of either eye's
// picture stays in the middle.
Lens guarded(const Lens& lens, const glm::ivec2& guard);

// Returns how far the view `to` sees beyond the visible part of a picture, as shares of its width and height:
// from the depths at its borders, at most 1. guard: pixels at each side that the picture was cast with.
glm::dvec2 seenBeyond(const LateEye& eye, const glm::ivec2& guard, const EyeView& to);

// The width of the guard band, chosen by how far the last pictures saw beyond theirs. It grows at once and
// shrinks slowly, and it changes by steps, so that frames of the same size can reuse memory.
class GuardBand {
public:
    static constexpr double kStep = 0.03, kMost = 0.12;  // shares of the width or the height, at each side
    static constexpr double kRemembered_s = 1;           // seconds for which an observation counts
    // Seconds for which less must have been enough before it shrinks.
    static constexpr double kHold_s = 2;

    // Notes a picture that was shown. beyond: seenBeyond() of it; now_s: seconds of a clock that never goes
    // back.
    void saw(const glm::dvec2& beyond, double now_s);
    // Starts over without a guard band, when nothing moves any more.
    void forget();
    // Returns the guard band at each side, as shares of the width and the height.
    glm::dvec2 shares() const { return glm::dvec2(mSteps) * kStep; }

private:
    struct Seen {
        double at = 0;           // seconds
        glm::dvec2 beyond{0.0};  // shares of the width and the height
    };
    std::deque<Seen> mSeen;
    // Steps at each side; steps that would have been enough since mLowerSince.
    glm::ivec2 mSteps{0}, mLower{0};
    glm::dvec2 mLowerSince{0.0};  // seconds
};

}  // namespace stereonav
