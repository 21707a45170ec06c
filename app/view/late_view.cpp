#include "app/view/late_view.h"

#include <algorithm>

#include "app/view/frame_views.h"
#include "engine/base/parallel.h"
#include "engine/late/late_guard.h"

namespace stereonav {
namespace {

constexpr int kFewThreads = 3;      // with no more, all cast, and the window's thread warps
constexpr double kShare = 0.7;      // largest share of the time for showing pictures
constexpr double kSlowest = 0.026;  // seconds between pictures: slower ones are seen one by one
constexpr double kWeight = 0.1;     // weight of the newest cost in the mean

}  // namespace

bool sameView(const FrameRequest& a, const FrameRequest& b) {
    return a.pose.position == b.pose.position && a.pose.orientation == b.pose.orientation &&
           a.lens == b.lens && a.stereo == b.stereo && a.twoEyes == b.twoEyes && a.guard == b.guard;
}

double areaOf(const FrameRequest& request) {
    const glm::dvec2 shown(request.lens.width, request.lens.height);
    const glm::dvec2 cast = shown + 2.0 * glm::dvec2(request.guard);
    return cast.x * cast.y / std::max(shown.x * shown.y, 1.0);
}

bool LateView::fits(const ViewFrame& frame, const FrameRequest& now) {
    return frame.late[0].ready() && (!now.twoEyes || frame.late[1].ready()) &&
           now.twoEyes == frame.request.twoEyes && now.truth == TruthView::None &&
           frame.request.truth == TruthView::None;
}

glm::dvec2 LateView::seenBeyond(const ViewFrame& frame, const FrameRequest& now) {
    const StereoViews views = viewsOf(now);
    const glm::dvec2 left = stereonav::seenBeyond(frame.late[0], frame.request.guard, views.left);
    if (!now.twoEyes) return left;
    return glm::max(left, stereonav::seenBeyond(frame.late[1], frame.request.guard, views.right));
}

std::shared_ptr<const LateView::Eyes> LateView::warp(const ViewFrame& frame, const FrameRequest& now) {
    auto free =
        std::find_if(mEyes.begin(), mEyes.end(), [](const auto& eyes) { return eyes.use_count() == 1; });
    if (free == mEyes.end()) free = mEyes.insert(free, std::make_shared<Eyes>());
    Eyes& eyes = **free;
    const StereoViews views = viewsOf(now);
    const bool parallel = threadCount() > kFewThreads;
    frame.late[0].warp(frame.left.color, views.left, eyes[0], nullptr, parallel);
    if (now.twoEyes)
        frame.late[1].warp(frame.right.color, views.right, eyes[1], nullptr, parallel);
    else
        eyes[1] = {};
    return *free;
}

void LateLead::begin(double expected) {
    if (!(expected > 0)) return;
    mDelay = mBetween = expected;
    mLast = -1;
}

void LateLead::came(double asked, double now) {
    constexpr double kNewest = 0.3;  // weight of the newest delay in the mean
    constexpr double kLongest = 2;   // seconds: longer intervals are rests or loads
    const double delay = now - asked, between = now - mLast;
    if (mLast >= 0 && between <= kLongest) mBetween += kNewest * (between - mBetween);
    if (delay <= kLongest) mDelay += kNewest * (delay - mDelay);
    mLast = now;
}

double LatePace::period(double refresh, double wanted) const {
    if (wanted > 0) return wanted;
    return std::clamp(mCost / kShare, refresh, std::max(refresh, kSlowest));
}

void LatePace::took(double seconds) {
    mCost = mCost > 0 ? mCost + kWeight * (seconds - mCost) : seconds;
}

}  // namespace stereonav
