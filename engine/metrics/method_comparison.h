// Renders poses by all of a FrameMaker's methods and measures each method: its time; its error against each
// eye cast alone (FrameMaker::exactMethod) with one ray a pixel, and against truths with many rays a pixel;
// its flicker from frame to frame; and wrong differences between the eyes.
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
    std::vector<StereoSetting> eyes;        // one for each pose; empty: the same for all
    // The pose beside each pose in the flight (timedBeside), for flicker; empty: flicker is not measured.
    std::vector<TimedPose> beside;
    EdgeSetting edges;  // rays at the edges of both eyes, for every method that casts; times include them
    bool butteraugli = false;  // Butteraugli too, which takes longer than most methods
};

// Times in ms and errors of one method: of one frame, or medians over frames. Where a FrameMaker's methods
// differ only in the right eye (FrameMaker::rightFromLeft), the left one is made once, and errors are those
// of the right one. Elsewhere errors are those of both eyes together, no finer truth exists and nothing is
// warped: figures that need these are NaN.
struct MethodFigures {
    std::string name;
    double left_ms = 0;  // one eye by itself, which every method needs
    // Times of the other eye in addition: the warp, or the splat of depths, and casting or sweeping after it.
    double warp_ms = 0, fill_ms = 0, right_ms = 0;
    double full_right_ms = 0;    // the right eye by itself, in the same run
    double pair_ms = 0;          // both eyes, from the first ray to the last pixel
    double hole_percent = 0;     // pixels that are cast again, or swept without a known start, percent of all
    ImageDifference difference;  // from each eye by itself
    // PSNR of the method's right and left eye against truths with many rays a pixel; NaN without such truths.
    double true_psnr_db = 0, left_true_psnr_db = 0;
    // Figures in the way of Wan et al. 2004 (surface_difference.h). NaN where nothing is warped at all, or no
    // pixel that shows the scene was warped or made.
    double holesOfWarped_percent = 0;
    double surface_psnr_db = 0;
    // Changes from frame to frame (flicker.h), NaN without neighbours, and differences between the eyes, in
    // the whole picture and in the edge mask (rivalry.h). In dB against the finer truths, or, without those,
    // against each eye cast alone.
    double flicker_db = 0, rivalry_db = 0, edge_rivalry_db = 0;
    // Butteraugli's distance from the same truths (butteraugli.h), also inside the edge mask and outside it;
    // NaN where it was not asked for.
    double butteraugli = 0, butteraugli_max = 0, edge_butteraugli = 0, flat_butteraugli = 0;
};

// One method's pictures of one frame. All methods share an edge mask, made of the default method's holes and
// the truth's depth edges, so that their figures at edges can be compared.
struct MethodPicture {
    std::string_view method;
    const EyeImage &left,
        &right;  // with rays at their edges; left: the same for all where they differ in the right one alone
    const Plane<std::uint8_t>& holeMask;  // empty: nothing is warped
    // Map of errors as Butteraugli sees them: of the right eye, or of the left one above the right; empty:
    // not asked for.
    const Plane<float>& butteraugli;
};
// One frame as every method made it.
struct ComparedFrame {
    int index = 0;
    const EyeImage &left, &right;  // each cast alone
    // Truths of the right and the left eye with many rays a pixel; empty: none were made.
    const Plane<PackedColor>&truth, &leftTruth;
    std::vector<MethodPicture> pictures;
};
using ComparedFrameListener = std::function<void(const ComparedFrame&)>;

// Compares methods; each frame runs left, full, A, B, C, left, full, A, B, C ... so that a drift of the
// machine's speed affects all methods alike. Returns medians over the frames, in the order of the methods.
// listener may be empty. Throws Error without poses or methods, and for an unknown method; Cancelled.
std::vector<MethodFigures> compareMethods(FrameMaker& frames, const std::vector<TimedPose>& poses,
                                          const Lens& lens, const StereoSetting& stereo,
                                          const ComparisonSetting& setting, Progress& progress,
                                          const ComparedFrameListener& listener);

// Returns the median of each field (the mean of the middle two for an even count) over frames that have it:
// NaN where none has. frames: not empty. Throws Error otherwise.
MethodFigures medianOf(const std::vector<MethodFigures>& frames);

}  // namespace stereonav
