// What the right eye should have been: cast, or swept, by itself. Shown in its place as a whole, as the
// difference from what was made, or as the pixels that were cast anyway; and measured while a picture rests.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "engine/camera/stereo_rig.h"
#include "engine/frame/frame_maker.h"
#include "engine/scene/scene.h"

namespace stereonav {

// What is shown in the place of the right eye.
enum class TruthView {
    None,        // itself
    FullCast,    // its truth: cast in full, or swept by itself
    Difference,  // five times what is wrong, channel by channel on sRGB bytes; black where nothing is
    Holes,       // itself, with the pixels in red that were cast
};
constexpr int kTruthTimes = 5;  // Difference

struct PictureError {
    double psnr_db = 0;     // over the three channels of sRGB bytes, as compare's; equal pictures: 100
    int largest = 0;        // of a channel, steps of 255
    double wrongShare = 0;  // of the pixels: those that differ at all
};
// Of two pictures of one size. Exact sums: the same for any number of threads.
PictureError errorOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image);

// Replaces the picture by its difference from the truth, as TruthView::Difference has it.
void showDifference(const Plane<PackedColor>& truth, Plane<PackedColor>& image);
// Paints the picture where the mask is set.
void showHoles(const Plane<std::uint8_t>& mask, Plane<PackedColor>& image);

// Of a frame that was shown.
struct FrameTruth {
    long long version = 0;  // of its request
    PictureError error;     // of its right eye
    double cast_ms = 0;     // that the truth took
    std::string note;       // why there is none, else ""
};

// Makes truths, and keeps the pictures for them. For one thread at a time, the one that makes frames.
class TruthMaker {
public:
    struct Shown {
        std::string note;                   // what is not as asked for, or what is meant by it; "" mostly
        std::optional<PictureError> error;  // where a truth was made for it
    };
    // How the frame itself is to be made.
    static FrameWay wayOf(TruthView view, const FrameWay& way, const FrameMaker& frames);
    // Changes frame.right, just made by way, to what is to be shown.
    Shown show(TruthView view, const Scene& scene, const StereoViews& views, double time, const FrameWay& way,
               EyePair& frame);
    Shown showOfOneEye(TruthView view);

    // Of the right eye as it was made in the last show(), or nothing where `stop` became true meanwhile: of
    // scenes whose rays are cast within a tile's time. Others cannot be stopped, and are left alone where a
    // frame takes longer than 200 ms.
    std::optional<FrameTruth> measure(const Scene& scene, const StereoViews& views, double time,
                                      const FrameWay& way, const EyePair& frame,
                                      const std::atomic<bool>& stop);
    // Frees the pictures.
    void forget();

private:
    // False where it was stopped.
    bool makeTruth(const Scene& scene, const StereoViews& views, double time, const FrameWay& way,
                   const std::atomic<bool>* stop);

    EyePair mTruth;              // its left eye is the truth of the right one
    Plane<PackedColor> mAsMade;  // what holes were painted over; else empty
};

}  // namespace stereonav
