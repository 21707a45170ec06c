// What a frame may cost while something moves: frames are made smaller, and enlarged by the late warp, so
// that each takes the time that it is given. No window and no clock.
//
// A frame's cost is taken for a part that no size changes and one that goes with the pixels. The size moves
// by steps; one is left when frames are clearly too slow for it, or clearly fast enough for a larger one, and
// the larger one only after longer and longer waits where it did not last: pictures do not pump.
#pragma once

#include <array>
#include <deque>

namespace stereonav {

class FrameGovernor {
public:
    // Of the full width and height; shares of the pixels go down by a quarter to a third each. The last ones
    // are of media alone.
    static constexpr std::size_t kSizes = 9;
    static constexpr std::array<double, 12> kScales{1,   0.86, 0.74, 0.64, 0.55, 0.47,
                                                    0.4, 0.34, 0.29, 0.29, 0.29, 0.29};

    // Of media: of the work of a picture in that size (FrameEffort). Pixels are left out first: what is
    // translucent has few edges, and slices that are missing are seen everywhere (docs/measured.md).
    static constexpr std::array<double, 12> kEfforts{1, 1, 1, 1, 1, 1, 1, 1, 1, 0.75, 0.5, 0.35};

    struct Size {
        double scale = 1, effort = 1;
    };

    explicit FrameGovernor(double target_ms = 33) : mTarget(target_ms) {}
    void setTarget(double ms) { mTarget = ms; }
    double target_ms() const { return mTarget; }
    // Frames are cast so many times as large as their size says (engine/late/late_guard.h): the size pays.
    void setArea(double area);

    // A frame of this size took so long. Those of another size than is asked for now are not counted.
    void took(double scale, double ms) { took({scale, 1}, ms); }
    void took(const Size& size, double ms, double area = 1);
    // Of the next frame while something moves.
    double scale() const { return kScales[mStep]; }
    double effort() const { return mEfforts ? kEfforts[mStep] : 1; }
    // A medium begins with the least work: a whole frame may take seconds, and more than one is asked for
    // until the first is there. efforts: they may be lowered.
    void setMedium(bool medium, bool efforts);
    // Another scene, method or window: what was learned holds no longer; the size stays.
    void forget();
    // Of a frame in full size, as the last ones tell; 0: nothing is known.
    double predicted_ms() const;
    // Of a frame in the size of now; 0: nothing is known.
    double usual_ms() const;
    // The largest that is expected to take no longer; the smallest where nothing is known.
    Size sizeWithin(double ms) const;

private:
    double predicted(std::size_t step) const;
    std::size_t steps() const { return mEfforts ? kScales.size() : kSizes; }
    double shareOf(std::size_t step) const;  // of a full frame's work
    void learn(double share, double ms);
    void step(std::size_t to);

    // Of the time of a frame of that area: what one of area 1 takes.
    double partOf(double area, std::size_t step) const;
    // What a frame of area 1 may take, so that those of now keep to the target.
    double targetOf(std::size_t step) const { return mTarget * partOf(mArea, step); }
    void stepDown();
    // More frames than usual that are looked at, where they cost now this and now that.
    std::size_t moreLooks(double each, std::size_t most) const;
    double known_ms() const;  // of a frame in this size

    double mTarget, mArea = 1;
    std::size_t mStep = 0;
    std::deque<double> mLast;              // milliseconds at this size and area 1, newest last
    double mNoise = 0;                     // mean difference of neighbours in it, of the larger one
    double mFixed = 0;                     // share of a full frame's cost that no size changes
    double mShareBefore = 0, mBefore = 0;  // the size before this one, and its cost
    int mSinceStep = 0, mHold = 0;         // frames
    bool mWentUp = false, mMedium = false, mEfforts = false;
    int mBackOff = 1;
};

}  // namespace stereonav
