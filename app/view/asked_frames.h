// Which frames are asked for: where the eyes will be when a frame is seen, how large it is cast, and how far
// beyond what is shown. Learns from the frames that came. No window and no clock.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "app/options/picture_options.h"
#include "app/view/frame_governor.h"
#include "app/view/late_view.h"
#include "app/view/screenshots.h"
#include "app/view/session.h"
#include "engine/late/late_guard.h"

namespace stereonav {

class AskedFrames {
public:
    // Another session has begun: frames that were asked for before are not its own.
    void begin(ViewSession& session);

    // What the session wants to see. composed: pixels of the picture of both eyes; refresh: of the monitor;
    // now: seconds. Returns what was not asked for yet; none mostly.
    std::optional<FrameRequest> next(ViewSession& session, Screenshots& screenshots,
                                     const ViewOptions& options, const glm::ivec2& composed, double refresh,
                                     double now);

    // A frame of this session has come.
    void came(const ViewFrame& frame, double now);
    // The eyes saw so far beyond a frame that was warped (LateView::seenBeyond).
    void saw(const glm::dvec2& beyond, double now) { mGuard.saw(beyond, now); }

    // The picture for now, in full, which a frame is warped to.
    const FrameRequest& present() const { return mPresent; }
    bool ofSession(const ViewFrame& frame) const { return frame.request.version > mSince; }
    bool isNewest(const ViewFrame& frame) const { return frame.request.version == mAsked; }
    // Whether a frame is not of this moment, and can be seen from where the eyes are now.
    bool warps(const ViewFrame* frame, bool lateWarp) const;

private:
    FrameGovernor::Size sizeNow(ViewSession& session, bool saves, const ViewOptions& options, double refresh);
    void setPresent(FrameRequest request, const ViewSession& session, const glm::ivec2& composed);

    FrameRequest mPresent;
    LateLead mLead;
    FrameGovernor mGovernor;
    GuardBand mGuard;
    std::optional<FrameGovernor::Size> mRestSize;  // of the first picture at rest
    long long mAsked = 0, mSince = 0;              // versions: asked for last, and before this session
};

}  // namespace stereonav
