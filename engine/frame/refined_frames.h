// A picture that becomes the truth: frames of one pose, each with its rays at other places in the pixels,
// averaged in linear light; of a medium its slices at other places too. Whatever a FrameMaker makes can be
// refined; each frame is made as one of one ray a pixel is, at its cost.
#pragma once

#include "engine/frame/frame_maker.h"

namespace stereonav {

constexpr int kMostRays = 256;       // a pixel, where there is a limit
constexpr int kMostRaysAtRest = 64;  // the same, in the window

// Gathers frames of one pose and gives their mean.
class RefinedFrames {
public:
    // Forgets what was gathered, and keeps its memory.
    void restart() { mCount = 0; }

    // Makes another frame of the same views, time and way, and puts it into the mean. Throws Error as
    // FrameMaker::make does; what was gathered before stays then.
    void add(FrameMaker& frames, const StereoViews& views, double time, const FrameWay& way);
    // Adds the same of one eye, by FrameMaker::makeOne.
    void addOne(FrameMaker& frames, const EyeView& view, double time);

    // Takes in place of the first frame one that was made of these views, with its rays through the centres.
    void begin(const EyePair& made);

    // Returns the mean colours of all frames since the last restart, at least one. All other planes, and the
    // record of which method made them, are those of the first frame, whose rays go through the centres of
    // pixels. Times are those of the last frame. Computed when asked for.
    EyePair& mean();
    const FrameTimings& timings() const { return mMean.timings; }  // the last frame's
    int count() const { return mCount; }                           // frames, which is rays a pixel

    // How far the mean is expected to be from that of very many rays: the root mean square over channels and
    // pixels of both eyes, in steps of 255 of their square roots, which are about those of sRGB bytes. Half
    // of the difference of two halves of the frames: what it would be if rays lay at random. Places that
    // cover the pixel evenly do better: against 256 rays the true error was 0.35 to 0.9 of it wherever edges
    // were seen. Without any, 0.1 of a step and less, it says less than there is, since frames are rounded.
    // Infinite before the second frame.
    double error_levels() const;
    // Returns error_levels() as a PSNR; 0 before the second frame, kMostPsnr_db at most.
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
