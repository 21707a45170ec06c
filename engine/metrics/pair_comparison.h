// Measures the ways that one FrameMaker has of making both eyes against each other: what method_comparison.h
// does for eyes that are cast.
#pragma once

#include <functional>
#include <vector>

#include "engine/base/progress.h"
#include "engine/camera/timed_poses.h"
#include "engine/frame/frame_maker.h"
#include "engine/metrics/method_comparison.h"

namespace stereonav {

struct PairPicture {
    std::string_view method;
    const EyeImage &left, &right;
};
struct ComparedPair {
    int index = 0;
    const EyeImage &left, &right;  // by the truth
    std::vector<PairPicture> pictures;
};
using ComparedPairListener = std::function<void(const ComparedPair&)>;

struct PairComparisonSetting {
    std::vector<std::string_view> methods;
    std::string_view truth;  // the method that the others are measured against: one eye after the other
    int repeats = 3;         // timed runs of a frame, >= 1; the fastest counts
    std::vector<StereoSetting> eyes;  // one a pose; empty: the same at all
};

// Medians over the frames, in the order of the methods. Of MethodFigures: left_ms is one eye alone, right_ms
// what the other costs on top of it; warp_ms and fill_ms are the splat of depths and the sweep after it;
// hole_percent are rays without a known start. Errors are those of both eyes together, against
// PairComparisonSetting::truth; there is no finer truth and no warp: true_psnr_db, holesOfWarped_percent and
// surface_psnr_db are NaN. Throws Error without poses or methods; Cancelled.
std::vector<MethodFigures> comparePairs(FrameMaker& frames, const std::vector<TimedPose>& poses,
                                        const Lens& lens, const StereoSetting& stereo,
                                        const PairComparisonSetting& setting, Progress& progress,
                                        const ComparedPairListener& listener);

}  // namespace stereonav
