// Truth of the right eye: cast, or swept, separately. Shown instead of the right eye, as a whole, as the
// difference, or as the pixels that were cast anyway; and measured while a picture rests.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "engine/camera/stereo_rig.h"
#include "engine/frame/frame_maker.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Picture that is shown instead of the right eye.
enum class TruthView {
    None,        // the right eye as it was made
    FullCast,    // the truth: cast in full, or swept separately
    Difference,  // five times the error in each channel of the sRGB bytes; black where there is none
    Holes,       // the eye as it was made, with the pixels that were cast in red
};
constexpr int kTruthTimes = 5;  // factor of Difference

struct PictureError {
    double psnr_db = 0;     // over the three channels of sRGB bytes, as in compare; equal pictures: 100
    int largest = 0;        // largest error of a channel, in steps of 255
    double wrongShare = 0;  // share of pixels that differ at all
};
// Returns the error between two pictures of one size. Sums are exact: the same for any number of threads.
PictureError errorOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image);

// Replaces the picture by its difference from the truth (TruthView::Difference).
void showDifference(const Plane<PackedColor>& truth, Plane<PackedColor>& image);
// Paints the picture where the mask is set.
void showHoles(const Plane<std::uint8_t>& mask, Plane<PackedColor>& image);

// The truth of a frame that was shown.
struct FrameTruth {
    long long version = 0;  // version of the frame's request
    PictureError error;     // error of its right eye
    double cast_ms = 0;     // time that the truth took
    std::string note;       // reason why there is none, else ""
};

// Makes truths, and keeps the pictures for them. For one thread at a time: the one that makes frames.
class TruthMaker {
public:
    struct Shown {
        std::string note;                   // explanation, or why it is not what was asked for
        std::optional<PictureError> error;  // set where a truth was made
    };
    // Returns the way in which the frame itself has to be made.
    static FrameWay wayOf(TruthView view, const FrameWay& way, const FrameMaker& frames);
    // Changes frame.right, just made by `way`, to the picture to show.
    Shown show(TruthView view, const Scene& scene, const StereoViews& views, double time, const FrameWay& way,
               EyePair& frame);
    Shown showOfOneEye(TruthView view);

    // Returns the error of the right eye as it was made in the last show(); empty where `stop` became true
    // meanwhile. Cast scenes stop within the time of a tile. Others can not be stopped, and are not measured
    // where a frame takes longer than 200 ms.
    std::optional<FrameTruth> measure(const Scene& scene, const StereoViews& views, double time,
                                      const FrameWay& way, const EyePair& frame,
                                      const std::atomic<bool>& stop);
    // Frees the pictures.
    void forget();

private:
    // Returns false where it was stopped.
    bool makeTruth(const Scene& scene, const StereoViews& views, double time, const FrameWay& way,
                   const std::atomic<bool>* stop);

    EyePair mTruth;              // the left eye is the truth of the right one
    Plane<PackedColor> mAsMade;  // picture before holes were painted over it; else empty
};

}  // namespace stereonav
