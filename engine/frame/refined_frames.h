// A picture that converges to the truth: frames of one pose, each with its rays at other places in the
// pixels, and for a medium with its slices at other places, averaged in linear light. Every FrameMaker's
// frames can be refined; each of them costs as much as a frame with one ray per pixel.
#pragma once

#include "engine/frame/frame_maker.h"

namespace stereonav {

constexpr int kMostRays = 256;       // rays per pixel, where there is a limit
constexpr int kMostRaysAtRest = 64;  // the same, in the window

// Collects frames of one pose and returns their mean.
class RefinedFrames {
public:
    // Forgets all frames; keeps the memory.
    void restart() { mCount = 0; }

    // Makes another frame with the same views, time and way, and adds it to the mean. Throws Error as
    // FrameMaker::make does; earlier frames then stay.
    void add(FrameMaker& frames, const StereoViews& views, double time, const FrameWay& way);
    // Adds a frame of one eye, made by FrameMaker::makeOne.
    void addOne(FrameMaker& frames, const EyeView& view, double time);

    // Begins with a frame that was already made with these views, with its rays through the centres of
    // pixels.
    void begin(const EyePair& made);

    // Returns the mean colours of all frames since the last restart, at least one. All other planes, and the
    // record of which method made them, are those of the first frame, whose rays go through the centres of
    // pixels. Times are those of the last frame. Computed in this call.
    EyePair& mean();
    const FrameTimings& timings() const { return mMean.timings; }  // the last frame's
    int count() const { return mCount; }                           // frames, which is rays a pixel

    // Returns the expected distance of the mean from that of very many rays: the root mean square over
    // channels and pixels of both eyes, in steps of 255 of their square roots, which are close to those of
    // sRGB bytes. It is half of the difference of the means of two halves of the frames, which is right for
    // random rays. Evenly spread rays do better: against 256 rays the true error was 0.35 to 0.9 of it
    // wherever edges were seen. Without edges, at 0.1 of a step and less, it is too small, since frames are
    // rounded. Infinite before the second frame.
    double error_levels() const;
    // Returns error_levels() as a PSNR; 0 before the second frame, at most kMostPsnr_db.
    double error_db() const;

private:
    // Sums of linear light.
    struct Sums {
        Plane<float> even, odd;  // sums of frames 0, 2, 4 .. and 1, 3, 5 ..
    };
    EyePair& next() { return mCount == 0 ? mMean : mMade; }
    void gather();

    int mCount = 0;
    Sums mLeft, mRight;
    EyePair mMean, mMade;
};

}  // namespace stereonav
