// Which eye's turn it is on a display that shows one eye at each refresh. Shutter glasses go on alternating
// when a picture comes too late for its refresh; who simply alternated swaps would then show each eye the
// other one's pictures from there on. So refreshes are counted by the clock: a phase-locked loop follows the
// times of the swaps, and the eye is that of the refresh which comes next. No OpenGL.
#pragma once

#include <optional>
#include <string>

namespace stereonav {

constexpr double kSteadyRefresh = 100;  // Hz: below that, each eye's half of them flickers

class FrameSequence {
public:
    // Takes Hz, as the monitor tells it, to a whole number mostly; 0 or nonsense: unknown, 60 is assumed.
    explicit FrameSequence(double refreshRate);

    // The eye to be drawn for the next refresh: 0 the one that comes first, 1 the other one.
    int eye() const { return static_cast<int>((mRefresh + 1) & 1); }
    // Notes that a swap was done at this time, seconds of a steady clock.
    void swapped(double seconds);
    // Returns seconds from `seconds` until a picture for the next refresh may be drawn. 0 while swaps wait
    // for the refresh themselves; where they do not, the clock stands in for it.
    double wait(double seconds) const;

    long long refreshes() const { return mRefresh; }     // refreshes since the first swap
    long long dropped() const { return mDropped; }       // refreshes without a swap
    bool synchronised() const { return mSynchronised; }  // swaps wait for the refresh
    double toldRate() const { return mTold; }            // Hz, as given
    double period() const { return mPeriod; }            // seconds, as measured

    // Returns each problem once: a display that is too slow, swaps that do not wait, pictures that come too
    // late.
    std::optional<std::string> takeProblem();

private:
    void count(bool early, long long late);

    double mNominal, mPeriod;  // seconds
    double mTold, mRate;       // Hz; the second is 0 where the first is nonsense
    double mPhase = 0;         // seconds: when the refresh mRefresh was
    bool mStarted = false, mSynchronised = true;
    long long mRefresh = -1, mDropped = 0;
    int mSwaps = 0, mEarly = 0, mLate = 0;  // counts of the present second or so
    bool mTooLate = false;
    bool mToldRate = false, mToldFree = false, mToldLate = false;
};

}  // namespace stereonav
