// Pictures for the present moment while frames take longer than a refresh: the newest frame, warped to the
// present place of the eyes (engine/late/late_warp.h). Needs no window and no clock.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "app/view/view_frame.h"
#include "engine/image/plane.h"

namespace stereonav {

// Returns whether two requests have the same views.
bool sameView(const FrameRequest& a, const FrameRequest& b);

// Returns the area that is cast, relative to the area that is shown.
double areaOf(const FrameRequest& request);

class LateView {
public:
    using Eyes = std::array<Plane<PackedColor>, 2>;  // the second is empty for one eye

    // Returns whether the frame can be seen from `now`: its depths are known, and it has the eyes that are
    // asked for. Truths (TruthView) are shown as they are.
    static bool fits(const ViewFrame& frame, const FrameRequest& now);
    // Returns how far the eyes see beyond the frame's picture (engine/late/late_guard.h). Requires fits().
    static glm::dvec2 seenBeyond(const ViewFrame& frame, const FrameRequest& now);
    // Returns the warped frame. Requires fits().
    std::shared_ptr<const Eyes> warp(const ViewFrame& frame, const FrameRequest& now);

private:
    std::vector<std::shared_ptr<Eyes>> mEyes;  // reused when nobody reads them any more
};

// The mean time in seconds from asking for a picture until it is seen.
class LateLead {
public:
    // Begins when something begins to move, with the expected time of a picture: what was learned is
    // outdated.
    void begin(double expected);
    // Notes a picture that was asked for at `asked` and is there now.
    void came(double asked, double now);
    double seconds() const { return mDelay + 0.5 * mBetween; }

private:
    double mDelay = 0, mBetween = 0, mLast = -1;
};

// The time when the next picture is due, in seconds.
class LatePace {
public:
    // refresh: of the monitor; wanted: 0 for none: the pace follows the cost of a picture.
    double period(double refresh, double wanted) const;
    void took(double seconds);  // notes the time of warping and drawing a picture

private:
    double mCost = 0;  // mean cost
};

}  // namespace stereonav
