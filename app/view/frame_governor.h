// Limits the cost of a frame while something moves: frames are made smaller, and enlarged by the late warp,
// so that each keeps to its time. Needs no window and no clock. The model of a frame's cost has a constant
// part, and one in proportion to the pixels. The size changes by steps: when frames are clearly too slow, or
// clearly fast enough for a larger size, which is tried after longer and longer waits where it did not last,
// so that pictures do not pump.
#pragma once

#include <array>
#include <deque>

namespace stereonav {

class FrameGovernor {
public:
    // Scales of width and height; from step to step the number of pixels drops by a quarter to a third. The
    // last steps are for media only.
    static constexpr std::size_t kSizes = 9;
    static constexpr std::array<double, 12> kScales{1,   0.86, 0.74, 0.64, 0.55, 0.47,
                                                    0.4, 0.34, 0.29, 0.29, 0.29, 0.29};

    // Effort for media: share of the work of a picture of this size (FrameEffort). Pixels are left out first:
    // translucent objects have few edges, and missing slices are visible everywhere (docs/measured.md).
    static constexpr std::array<double, 12> kEfforts{1, 1, 1, 1, 1, 1, 1, 1, 1, 0.75, 0.5, 0.35};

    struct Size {
        double scale = 1, effort = 1;
    };

    explicit FrameGovernor(double target_ms = 33) : mTarget(target_ms) {}
    void setTarget(double ms) { mTarget = ms; }
    // Sets the area of frames, guard included, as a multiple of the picture's (engine/late/late_guard.h): the
    // size is reduced for it.
    void setArea(double area);

    // Notes the time of a frame of this size. Frames of another size than the present one are ignored.
    void took(const Size& size, double ms, double area = 1);
    // Return the size of the next frame while something moves.
    double scale() const { return kScales[mStep]; }
    double effort() const { return mEfforts ? kEfforts[mStep] : 1; }
    // Lets media begin with the least work: a whole frame may take seconds, and more than one is asked for
    // until the first is there. efforts: whether effort can be reduced.
    void setMedium(bool medium, bool efforts);
    // Forgets what was learned, for another scene, method or window; the size stays.
    void forget();
    // Returns the expected time of a frame in the present size; 0: not known.
    double usual_ms() const;
    // Returns the largest size that is expected to take no longer; the smallest where nothing is known.
    Size sizeWithin(double ms) const;

private:
    double predicted(std::size_t step) const;
    std::size_t steps() const { return mEfforts ? kScales.size() : kSizes; }
    double shareOf(std::size_t step) const;  // share of a full frame's work
    void learn(double share, double ms);
    void step(std::size_t to);

    // Returns the time of a frame of area 1 as a share of that of a frame of this area.
    double partOf(double area, std::size_t step) const;
    // Returns the time that a frame of area 1 may take, so that present frames keep to the target.
    double targetOf(std::size_t step) const { return mTarget * partOf(mArea, step); }
    void stepDown();
    // Returns how many more frames to look at: one for each `each` of noise, at most `most`.
    std::size_t moreLooks(double each, std::size_t most) const;
    double known_ms() const;  // time of a frame in the present size

    double mTarget, mArea = 1;
    std::size_t mStep = 0;
    std::deque<double> mLast;              // milliseconds in this size at area 1, newest last
    double mNoise = 0;                     // mean difference of neighbours in mLast, as a share of the larger
    double mFixed = 0;                     // share of a full frame's cost that does not depend on the size
    double mShareBefore = 0, mBefore = 0;  // the size before the present one, and its cost
    int mSinceStep = 0, mHold = 0;         // in frames
    bool mWentUp = false, mMedium = false, mEfforts = false;
    int mBackOff = 1;
};

}  // namespace stereonav
