// Measures the ways of making both eyes of a medium against each other: what method_comparison.h does for
// eyes that are cast.
#pragma once

#include <functional>
#include <vector>

#include "app/pair_renderer.h"
#include "app/timed_poses.h"
#include "engine/base/progress.h"
#include "engine/metrics/method_comparison.h"

namespace stereonav {

struct PairPicture {
    PairMethod method;
    const EyeImage &left, &right;
};
struct ComparedPair {
    int index = 0;
    const EyeImage &left, &right;  // of two sweeps
    std::vector<PairPicture> pictures;
};
using ComparedPairListener = std::function<void(const ComparedPair&)>;

struct PairComparisonSetting {
    std::vector<PairMethod> methods;
    int repeats = 3;                  // timed runs of a frame, >= 1; the fastest counts
    std::vector<StereoSetting> eyes;  // one a pose; empty: the same at all
};

// Medians over the frames, in the order of the methods. Of MethodFigures: left_ms is one eye alone, right_ms
// what the other costs on top of it; warp_ms and fill_ms are the splat of depths and the sweep after it;
// hole_percent are rays without a known start. Errors are those of both eyes together, against two sweeps;
// there is no finer truth and no warp: true_psnr_db, holesOfWarped_percent and surface_psnr_db are NaN.
// Throws Error without poses or methods; Cancelled.
std::vector<MethodFigures> comparePairs(PairRenderer& renderer, const std::vector<TimedPose>& poses,
                                        const Lens& lens, const StereoSetting& stereo,
                                        const PairComparisonSetting& setting, Progress& progress,
                                        const ComparedPairListener& listener);

}  // namespace stereonav
