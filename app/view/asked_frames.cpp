#include "app/view/asked_frames.h"

#include <algorithm>
#include <utility>

#include "engine/scene/capabilities.h"

namespace stereonav {

void AskedFrames::begin(ViewSession& session) {
    session.continueVersions(mAsked);
    mSince = mAsked;
    mGovernor.forget();
    mRestSize.reset();
}

std::optional<FrameRequest> AskedFrames::next(ViewSession& session, Screenshots& screenshots,
                                              const ViewOptions& options, const glm::ivec2& composed,
                                              double refresh, double now) {
    const bool screenshot = session.takeScreenshotWish();
    session.driftAtRest(!options.refine);
    const bool saves = screenshot || screenshots.waiting();
    const auto [scale, effort] = sizeNow(session, saves, options, refresh);
    const bool late = options.lateWarp && session.flying() && !saves;
    if (late && !mPresent.flying) mLead.begin(mGovernor.usual_ms() / 1000);
    const double ahead = late ? mLead.seconds() : 0;
    if (!late) mGuard.forget();
    FrameRequest request = session.requestFor(composed.x, composed.y, ahead, scale, mGuard.shares());
    request.late = options.lateWarp;
    request.refines = options.refine;
    request.flying = late;
    request.effort = effort;
    request.asked_s = request.version == mPresent.version ? mPresent.asked_s : now;
    request.ahead_s = ahead;
    const bool fresh = request.version != mAsked;
    mAsked = request.version;
    if (screenshot) screenshots.wish(mAsked);
    setPresent(request, session, composed);
    return fresh ? std::optional(std::move(request)) : std::nullopt;
}

void AskedFrames::setPresent(FrameRequest request, const ViewSession& session, const glm::ivec2& composed) {
    const double ahead = request.ahead_s;
    mPresent = std::move(request);
    mPresent.pose = session.pose();
    if (ahead > 0) mPresent.time = session.time();
    const auto [width, height] = eyeSizeFor(mPresent.mode, composed.x, composed.y);
    mPresent.lens.width = width;
    mPresent.lens.height = height;
    mPresent.ahead_s = 0;
    mPresent.guard = {0, 0};
    mPresent.scale = mPresent.effort = 1;
}

// Returns the size of the next frame. Truths and pictures that are saved are whole. saves: one of those is
// asked for or waits.
FrameGovernor::Size AskedFrames::sizeNow(ViewSession& session, bool saves, const ViewOptions& options,
                                         double refresh) {
    constexpr double kMost = 40;   // milliseconds: frames that take longer lag visibly
    constexpr double kMedium = 4;  // factor: a smaller picture of a medium saves less
    constexpr double kFirst =
        800;  // milliseconds of a frame at rest: scenes that need more time first show a smaller one
    const Scene& scene = *session.open().scene;
    const bool swept = scene.offered<SweepPlace>() != nullptr;
    mGovernor.setMedium(swept, scene.offered<FrameEffort>() != nullptr);
    const double usual = std::min(2000 * refresh, kMost) * (swept ? kMedium : 1);
    mGovernor.setTarget(options.target_ms.value_or(usual));
    const glm::dvec2 wide = 1.0 + 2.0 * mGuard.shares();
    mGovernor.setArea(session.flying() ? wide.x * wide.y : 1);
    const bool whole = saves || session.truth() != TruthView::None;
    if (session.flying()) mRestSize.reset();
    if (!options.lateWarp || whole) return {};
    if (session.flying()) return {mGovernor.scale(), mGovernor.effort()};
    if (!swept) return {};
    if (!mRestSize) mRestSize = mGovernor.sizeWithin(kFirst);  // kept until something moves again
    return *mRestSize;
}

void AskedFrames::came(const ViewFrame& frame, double now) {
    mLead.came(frame.request.asked_s, now);
    mGovernor.took({frame.request.scale, frame.request.effort}, frame.made_ms, areaOf(frame.request));
}

bool AskedFrames::warps(const ViewFrame* frame, bool lateWarp) const {
    return lateWarp && frame && ofSession(*frame) && !sameView(frame->request, mPresent) &&
           LateView::fits(*frame, mPresent);
}

}  // namespace stereonav
