// Chooses which frames to ask for: where the eyes will be when a frame is seen, how large it is cast, and how
// far beyond the picture. Learns from the frames that came. Needs no window and no clock.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "app/options/view_options.h"
#include "app/view/frame_governor.h"
#include "app/view/late_view.h"
#include "app/view/screenshots.h"
#include "app/view/session.h"
#include "engine/late/late_guard.h"

namespace stereonav {

class AskedFrames {
public:
    // Begins another session: frames that were asked for earlier belong to the one before.
    void begin(ViewSession& session);

    // Returns the frame that the session needs, unless it has already been asked for. composed: pixels of the
    // picture of both eyes; refresh: of the monitor; now: seconds.
    std::optional<FrameRequest> next(ViewSession& session, Screenshots& screenshots,
                                     const ViewOptions& options, const glm::ivec2& composed, double refresh,
                                     double now);

    // Notes a frame of this session that has come.
    void came(const ViewFrame& frame, double now);
    // Notes how far the eyes saw beyond a frame that was warped (LateView::seenBeyond).
    void saw(const glm::dvec2& beyond, double now) { mGuard.saw(beyond, now); }

    // Returns the request for the present moment, in full size, which frames are warped to.
    const FrameRequest& present() const { return mPresent; }
    bool ofSession(const ViewFrame& frame) const { return frame.request.version > mSince; }
    bool isNewest(const ViewFrame& frame) const { return frame.request.version == mAsked; }
    // Returns whether a frame is not of this moment, but can be warped to the present place of the eyes.
    bool warps(const ViewFrame* frame, bool lateWarp) const;

private:
    FrameGovernor::Size sizeNow(ViewSession& session, bool saves, const ViewOptions& options, double refresh);
    void setPresent(FrameRequest request, const ViewSession& session, const glm::ivec2& composed);

    FrameRequest mPresent;
    LateLead mLead;
    FrameGovernor mGovernor;
    GuardBand mGuard;
    std::optional<FrameGovernor::Size> mRestSize;  // size of the first picture at rest
    long long mAsked = 0, mSince = 0;              // versions: asked for last, last before this session
};

}  // namespace stereonav
