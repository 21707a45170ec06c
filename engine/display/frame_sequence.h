// Which eye to show next on a display that shows one eye per refresh. Shutter glasses go on alternating when
// a picture comes too late for its refresh; a program that simply alternated its swaps would from then on
// show each eye the other one's pictures. So refreshes are counted by the clock: a phase-locked loop follows
// the times of the swaps, and the eye is that of the next refresh. Uses no OpenGL.
#pragma once

#include <optional>
#include <string>

namespace stereonav {

constexpr double kSteadyRefresh = 100;  // Hz: below that, each eye's half of them flickers

class FrameSequence {
public:
    // refreshRate: Hz, as the monitor reports it, mostly a whole number; 0 or an implausible one: unknown, 60
    // is assumed.
    explicit FrameSequence(double refreshRate);

    // Returns the eye to draw for the next refresh: 0 the one that comes first, 1 the other one.
    int eye() const { return static_cast<int>((mRefresh + 1) & 1); }
    // Notes that a swap was done at this time, seconds of a steady clock.
    void swapped(double seconds);
    // Returns the seconds from `seconds` until a picture for the next refresh may be drawn. 0 while swaps
    // wait for the refresh; where they do not, the clock replaces that.
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
    double mTold, mRate;       // Hz; mRate: 0 where mTold is implausible
    double mPhase = 0;         // seconds: time of refresh number mRefresh
    bool mStarted = false, mSynchronised = true;
    long long mRefresh = -1, mDropped = 0;
    int mSwaps = 0, mEarly = 0, mLate = 0;  // counts within about a second
    bool mTooLate = false;
    bool mToldRate = false, mToldFree = false, mToldLate = false;
};

}  // namespace stereonav
