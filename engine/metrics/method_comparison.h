// Plays poses through the ways that one FrameMaker has of making two eyes and measures each: its time, and
// its error against each eye by itself (FrameMaker::exactMethod), one ray a pixel, and against many rays a
// pixel; how it flickers from frame to frame, and what it shows both eyes differently.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/progress.h"
#include "engine/camera/timed_poses.h"
#include "engine/frame/frame_maker.h"
#include "engine/metrics/butteraugli.h"
#include "engine/metrics/image_difference.h"

namespace stereonav {

struct ComparisonSetting {
    std::vector<std::string_view> methods;  // some of FrameMaker::methods()
    int repeats = 3;                        // timed runs of a frame, >= 1; the fastest counts
    int truthFactor = 8;                    // at least 1: finer truths have truthFactor^2 rays a pixel
    int edgeRadius = 2;                     // pixels by which the edge mask is grown
    std::vector<StereoSetting> eyes;        // one a pose; empty: the same at all
    // The neighbour of each pose in the flight (timedBeside), for flicker; empty: there is no such figure.
    std::vector<TimedPose> beside;
    EdgeSetting edges;         // rays at both eyes' edges, by every method that casts; times are with them
    bool butteraugli = false;  // Butteraugli too, which takes longer than most methods
};

// Times in ms and errors of one method: of one frame, or medians over frames. Where a FrameMaker's methods
// differ in the right eye alone (FrameMaker::rightFromLeft) the left one is made once, and errors are those
// of the right one. Elsewhere they are those of both eyes together; there is no finer truth and nothing is
// warped: what is only then there is NaN below.
struct MethodFigures {
    std::string name;
    double left_ms = 0;  // one eye by itself, which every method needs
    // Times of the other eye on top of it: the warp, or splat of depths, and what is cast or swept after it.
    double warp_ms = 0, fill_ms = 0, right_ms = 0;
    double full_right_ms = 0;    // the right eye by itself, in the same run
    double pair_ms = 0;          // both eyes, from the first ray to the last pixel
    double hole_percent = 0;     // pixels cast again, or swept without a known start: share of all
    ImageDifference difference;  // from each eye by itself
    // PSNR of the right eye and of the left one, as the method uses it, from truths with many rays a pixel;
    // NaN: there are none.
    double true_psnr_db = 0, left_true_psnr_db = 0;
    // Figures as Wan et al. 2004 count (surface_difference.h); NaN where no pixel that shows the scene was
    // warped, or made; or where nothing is warped at all.
    double holesOfWarped_percent = 0;
    double surface_psnr_db = 0;
    // Changes from frame to frame (flicker.h), NaN without neighbours, and differences between the eyes, in
    // the whole and in the edge mask (rivalry.h): dB from the finer truths, or, where there are none, from
    // each eye by itself.
    double flicker_db = 0, rivalry_db = 0, edge_rivalry_db = 0;
    // Butteraugli's distance from the same truths (butteraugli.h), also inside the edge mask and outside it;
    // NaN where it was not asked for.
    double butteraugli = 0, butteraugli_max = 0, edge_butteraugli = 0, flat_butteraugli = 0;
};

// One method's pictures of one frame. The edge mask of every method is that of the default method's holes and
// the truth's depth edges, so that their edge figures compare.
struct MethodPicture {
    std::string_view method;
    const EyeImage &left,
        &right;  // with rays at their edges; left: the same for all where they differ in the right one alone
    const Plane<std::uint8_t>& holeMask;  // empty: nothing is warped
    // Map of what errors are counted in: the right eye, or the left one over it; empty: not asked for.
    const Plane<float>& butteraugli;
};
// One frame as every method made it.
struct ComparedFrame {
    int index = 0;
    const EyeImage &left, &right;  // each by itself
    // Truths of the right and the left eye by many rays a pixel; empty: there are none.
    const Plane<PackedColor>&truth, &leftTruth;
    std::vector<MethodPicture> pictures;
};
using ComparedFrameListener = std::function<void(const ComparedFrame&)>;

// Each frame runs left, full, A, B, C, left, full, A, B, C ... so that drift of the machine's speed
// meets all alike. Medians over the frames, in the order of the methods. listener may be empty. Throws Error
// without poses or methods, and for a method that is not there; Cancelled.
std::vector<MethodFigures> compareMethods(FrameMaker& frames, const std::vector<TimedPose>& poses,
                                          const Lens& lens, const StereoSetting& stereo,
                                          const ComparisonSetting& setting, Progress& progress,
                                          const ComparedFrameListener& listener);

// Returns the median of each field (the mean of the middle two for an even count) over frames that have it:
// NaN where none has. frames: not empty. Throws Error otherwise.
MethodFigures medianOf(const std::vector<MethodFigures>& frames);

}  // namespace stereonav
