// Pictures for the present moment while frames take longer than a refresh: the newest frame, warped to where
// the eyes are now (engine/late/late_warp.h). No window and no clock.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "app/view/worker.h"
#include "engine/image/plane.h"

namespace stereonav {

// Whether a frame that was made for `a` is what `b` asks for, as far as where it is seen from goes.
bool sameView(const FrameRequest& a, const FrameRequest& b);

// That is cast, of what is shown.
double areaOf(const FrameRequest& request);

class LateView {
public:
    using Eyes = std::array<Plane<PackedColor>, 2>;  // the second is empty of one eye

    // Whether the frame can be seen from where `now` is: its depths are known, and it has the eyes that are
    // asked for. Truths (TruthView) are shown as they are.
    static bool fits(const ViewFrame& frame, const FrameRequest& now);
    // How far the eyes see beyond what was to be shown of the frame (engine/late/late_guard.h). fits() holds.
    static glm::dvec2 seenBeyond(const ViewFrame& frame, const FrameRequest& now);
    // Warped. fits() holds.
    std::shared_ptr<const Eyes> warp(const ViewFrame& frame, const FrameRequest& now);

private:
    std::vector<std::shared_ptr<Eyes>> mEyes;  // used again when nobody looks at them
};

// How long after it was asked for a picture is looked at, in the mean. Seconds.
class LateLead {
public:
    // Something begins to move, and a picture is expected to take so long: what was learned is older.
    void begin(double expected);
    // A picture that was asked for then is there now.
    void came(double asked, double now);
    double seconds() const { return mDelay + 0.5 * mBetween; }

private:
    double mDelay = 0, mBetween = 0, mLast = -1;
};

// When the next picture is due. Seconds.
class LatePace {
public:
    // refresh: of the monitor; wanted: 0 is none, the pace follows what a picture costs.
    double period(double refresh, double wanted) const;
    void took(double seconds);  // a picture was warped and drawn

private:
    double mCost = 0;  // mean
};

}  // namespace stereonav
