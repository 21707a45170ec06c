// Plays poses through several ways of making the right eye and measures each: its time, and its
// error against the full right cast with one ray a pixel and against one with many.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/camera/stereo_rig.h"
#include "engine/metrics/image_difference.h"
#include "engine/render/eye_renderer.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

struct ComparisonSetting {
    std::vector<RightEyeMethod> methods;
    int repeats = 3;                  // timed runs of a frame, >= 1; the fastest counts
    int truthFactor = 4;              // the finer truth has truthFactor^2 rays a pixel
    int edgeRadius = 2;               // pixels by which the edge mask is grown
    std::vector<StereoSetting> eyes;  // one a pose; empty: the same at all
};

// Times in ms and errors of one method: of one frame, or medians over frames.
struct MethodFigures {
    std::string name;
    double left_ms = 0;  // the left eye, which every method needs
    double warp_ms = 0, fill_ms = 0, right_ms = 0;
    double full_right_ms = 0;    // the right eye cast in full, in the same run
    double hole_percent = 0;     // pixels cast again, of all
    ImageDifference difference;  // from the full right cast
    double true_psnr_db = 0;     // from the truth with many rays a pixel
    // As Wan et al. 2004 count (surface_difference.h); NaN where no pixel that shows the scene was warped, or
    // made.
    double holesOfWarped_percent = 0;
    double surface_psnr_db = 0;
};

// What one method made of one frame. The edge mask of every method is that of the default method's
// holes and the truth's depth edges, so that their edge figures compare.
struct MethodPicture {
    RightEyeMethod method;
    const EyeImage& right;
    const Plane<std::uint8_t>& holeMask;
};
struct ComparedFrame {
    int index = 0;
    const EyeImage &left, &fullRight;
    const Plane<PackedColor>& truth;
    std::vector<MethodPicture> pictures;
};
using ComparedFrameListener = std::function<void(const ComparedFrame&)>;

// Each frame runs left, full, A, B, C, left, full, A, B, C ... so that drift of the machine's speed
// meets all alike. listener may be empty. Throws Error without poses or methods; Cancelled.
std::vector<MethodFigures> compareMethods(const EyeRenderer& renderer, const std::vector<Pose>& poses,
                                          const Lens& lens, const StereoSetting& stereo,
                                          const ComparisonSetting& setting, Progress& progress,
                                          const ComparedFrameListener& listener);

// The median of each field (the mean of the middle two for an even count), of frames that have it: NaN where
// none has. frames: not empty.
MethodFigures medianOf(const std::vector<MethodFigures>& frames);

}  // namespace stereonav
