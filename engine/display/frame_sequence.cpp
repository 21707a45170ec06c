#include "engine/display/frame_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

constexpr double kUsualRate = 60;                 // Hz
constexpr double kSlowest = 10, kFastest = 1000;  // Hz of displays
constexpr double kPhaseGain = 0.1;                // share of what a swap's time differs by
constexpr double kPeriodGain = 0.0025;            // a quarter of the square of that: no overshoot
constexpr double kPeriodReach = 0.02;    // share by which a told rate may be wrong: 59.94 is told as 60
constexpr int kLooked = 64;              // swaps that are judged together
constexpr int kManyEarly = kLooked / 4;  // more than jitter makes
constexpr int kManyLate = kLooked / 16;
constexpr double kLongest = 1e6;  // refreshes between two swaps that are counted

}  // namespace

FrameSequence::FrameSequence(double refreshRate) : mTold(refreshRate), mRate(refreshRate) {
    if (!(refreshRate >= kSlowest && refreshRate <= kFastest)) mRate = 0;
    mNominal = mPeriod = 1 / (mRate > 0 ? mRate : kUsualRate);
}

void FrameSequence::swapped(double seconds) {
    if (!std::isfinite(seconds)) return;
    const double passed = mStarted ? (seconds - mPhase) / mPeriod : 0;
    if (!mStarted || passed < -1 || passed > kLongest) {  // the first one, or another clock
        mStarted = true;
        mPhase = seconds;
        ++mRefresh;
        return;
    }
    // No refresh passes where the swap before was taken for a later refresh than it was: then the count is
    // right again.
    const double whole = std::max(std::round(passed), 0.0);
    const double error = (passed - whole) * mPeriod;
    mRefresh += static_cast<long long>(whole);
    mPhase += whole * mPeriod + kPhaseGain * error;
    if (whole > 0)
        mPeriod = std::clamp(mPeriod + kPeriodGain * error / whole, mNominal * (1 - kPeriodReach),
                             mNominal * (1 + kPeriodReach));
    count(whole == 0, std::max(static_cast<long long>(whole) - 1, 0LL));
}

void FrameSequence::count(bool early, long long late) {
    mDropped += late;
    mEarly += early;
    mLate += late > 0;
    if (++mSwaps < kLooked) return;
    // For good: while the clock stands in, swaps come as if they waited.
    if (mEarly > kManyEarly) mSynchronised = false;
    mTooLate = mLate > kManyLate;
    mSwaps = mEarly = mLate = 0;
}

double FrameSequence::wait(double seconds) const {
    if (mSynchronised || !mStarted || !std::isfinite(seconds)) return 0;
    // Into the next refresh, so that its turn is told from this one's.
    return std::clamp(mPhase + mPeriod - seconds, 0.0, mPeriod);
}

std::optional<std::string> FrameSequence::takeProblem() {
    if (!mToldRate && mStarted && mRate < kSteadyRefresh) {
        mToldRate = true;
        if (mRate == 0)
            return "the monitor does not tell its refresh rate: 60 Hz are assumed, and the eyes may change "
                   "places";
        return fmt::format("the monitor has {:.0f} Hz: with {:.0f} or more the eyes' turns do not flicker",
                           mRate, kSteadyRefresh);
    }
    if (!mToldFree && !mSynchronised) {
        mToldFree = true;
        return "pictures do not wait for the monitor's refresh: switch vertical synchronisation on in the "
               "graphics driver, or the eyes may change places";
    }
    if (!mToldLate && mTooLate && mSynchronised) {
        mToldLate = true;
        return fmt::format("pictures come too late for the monitor: {} of {} refreshes without one", mDropped,
                           mRefresh);
    }
    return std::nullopt;
}

}  // namespace stereonav
