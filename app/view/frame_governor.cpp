#include "app/view/frame_governor.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stereonav {
namespace {

constexpr double kTooSlow = 1.15;    // multiple of the target at which the size goes down
constexpr double kFarTooSlow = 1.5;  // multiple at which two frames are enough for it
constexpr double kHopeless = 8;      // multiple at which one frame is enough; kSlowMedium for media
constexpr double kSlowMedium = 2.5;
constexpr double kRoom = 0.95;      // share of the target that a larger size may cost
constexpr std::size_t kLooked = 3;  // frames that decide
// Noise, such as another program's use of the processor: less than kQuiet changes nothing; each kMoreDown or
// kMoreUp of it requires one more frame before the size goes down or up.
constexpr double kQuiet = 0.15, kMoreDown = 0.06, kMoreUp = 0.015;
constexpr std::size_t kMostMoreDown = 5, kMostMoreUp = 27;
constexpr double kNewestNoise = 0.06;  // weight of the newest difference in the mean
constexpr double kFits = 0.85;         // share of the frames that have to fit into the larger size
constexpr int kFirstHold = 2;          // frames before the size goes up
constexpr int kMostBackOff = 64;
constexpr int kSteadyFrames = 120;  // duration of a larger size after which failed attempts are forgotten
constexpr double kMostFixed = 0.8;
constexpr double kSameScale = 1e-3;

double middleOf(std::deque<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

double FrameGovernor::shareOf(std::size_t step) const {
    return kScales[step] * kScales[step] * (mEfforts ? kEfforts[step] : 1);
}

std::size_t FrameGovernor::moreLooks(double each, std::size_t most) const {
    return std::min(most, static_cast<std::size_t>(std::max(0.0, mNoise - kQuiet) / each));
}

double FrameGovernor::known_ms() const {
    const std::size_t count = std::min(mLast.size(), kLooked + moreLooks(kMoreDown, kMostMoreDown));
    return middleOf({mLast.end() - static_cast<std::ptrdiff_t>(count), mLast.end()});
}

double FrameGovernor::predicted(std::size_t step) const {
    const double known = mLast.empty() ? mBefore : known_ms();
    const double here = mFixed + (1 - mFixed) * (mLast.empty() ? mShareBefore : shareOf(mStep));
    const double there = mFixed + (1 - mFixed) * shareOf(step);
    return known * there / here;
}

double FrameGovernor::partOf(double area, std::size_t step) const {
    const double share = (1 - mFixed) * shareOf(step);
    return (mFixed + share) / (mFixed + share * area);
}

double FrameGovernor::usual_ms() const {
    return mLast.empty() && !(mBefore > 0) ? 0 : predicted(mStep) / partOf(mArea, mStep);
}

// Learns the constant part from two sizes: cost = full * (fixed + (1 - fixed) * share).
void FrameGovernor::learn(double share, double ms) {
    if (!(mBefore > 0) || std::abs(share - mShareBefore) < 0.05) return;
    const double slope = (mBefore - ms) / (mShareBefore - share), none = ms - slope * share;
    const double full = none + slope;
    const double fixed = full > 0 && slope > 0 ? std::clamp(none / full, 0.0, kMostFixed) : mFixed;
    mFixed += 0.5 * (fixed - mFixed);
}

void FrameGovernor::step(std::size_t to) {
    mWentUp = to < mStep;
    mShareBefore = shareOf(mStep);
    mBefore = known_ms();
    mStep = to;
    mSinceStep = 0;
    mHold = kFirstHold * mBackOff;
    mLast.clear();
}

void FrameGovernor::setMedium(bool medium, bool efforts) {
    if (medium == mMedium && efforts == mEfforts) return;
    mMedium = medium;
    mEfforts = efforts;
    forget();
    mStep = medium ? steps() - 1 : std::min(mStep, steps() - 1);
}

FrameGovernor::Size FrameGovernor::sizeWithin(double ms) const {
    const bool known = !mLast.empty() || mBefore > 0;
    std::size_t at = 0;
    while (at + 1 < steps() && (!known || predicted(at) > ms)) ++at;
    return {kScales[at], mEfforts ? kEfforts[at] : 1};
}

void FrameGovernor::stepDown() {
    std::size_t to = mStep + 1;
    while (to + 1 < steps() && predicted(to) > targetOf(to)) ++to;
    step(to);
}

// Sets the area before frames of this size come too late.
void FrameGovernor::setArea(double area) {
    const bool more = area > mArea;
    mArea = area;
    if (more && !mLast.empty() && mStep + 1 < steps() && predicted(mStep) > kTooSlow * targetOf(mStep))
        stepDown();
}

void FrameGovernor::took(const Size& size, double ms, double area) {
    if (!(ms > 0) || std::abs(size.scale - scale()) > kSameScale ||
        (mEfforts && std::abs(size.effort - effort()) > kSameScale))
        return;
    ms *= partOf(area, mStep);
    if (!mLast.empty())
        mNoise += kNewestNoise * (std::abs(ms - mLast.back()) / std::max(ms, mLast.back()) - mNoise);
    mLast.push_back(ms);
    if (mLast.size() > kLooked + kMostMoreUp) mLast.pop_front();
    ++mSinceStep;
    if (mSinceStep == 1) learn(shareOf(mStep), ms);
    if (mWentUp && mSinceStep > kSteadyFrames) mBackOff = 1;
    const auto least = [&](std::size_t count) {  // least of the newest frames
        return *std::min_element(mLast.end() - static_cast<std::ptrdiff_t>(count), mLast.end());
    };
    const double target = targetOf(mStep);
    const std::size_t more = moreLooks(kMoreDown, kMostMoreDown);
    const bool slow = least(1) > (mMedium ? kSlowMedium : kHopeless) * target ||
                      (mLast.size() >= 2 + more && least(2 + more) > kFarTooSlow * target) ||
                      (mLast.size() >= kLooked + more && known_ms() > kTooSlow * target &&
                       least(kLooked) > kTooSlow * target);
    if (slow && mStep + 1 < steps()) {
        if (mWentUp) mBackOff = std::min(2 * mBackOff, kMostBackOff);
        return stepDown();
    }
    // After a step up the first frame has been looked at already.
    const std::size_t first = mWentUp && mSinceStep < static_cast<int>(kLooked) ? kLooked - 1 : kLooked;
    const std::size_t enough = first + moreLooks(kMoreUp, kMostMoreUp);
    if (mLast.size() < enough || mSinceStep < mHold || mStep == 0) return;
    // The slowest of these frames decides, except for a few outliers.
    std::vector<double> looked(mLast.end() - static_cast<std::ptrdiff_t>(enough), mLast.end());
    std::sort(looked.begin(), looked.end());
    const double rank = std::ceil(kFits * static_cast<double>(enough));
    const double spread = looked[static_cast<std::size_t>(rank) - 1] / known_ms();
    std::size_t to = mStep;
    while (to > 0 && spread * predicted(to - 1) <= kRoom * targetOf(to - 1)) --to;
    if (to < mStep) step(to);
}

void FrameGovernor::forget() {
    mLast.clear();
    mNoise = 0;
    mBefore = mFixed = 0;
    mSinceStep = mHold = 0;
    mBackOff = 1;
    mWentUp = false;
}

}  // namespace stereonav
