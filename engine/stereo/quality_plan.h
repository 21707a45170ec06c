// Chooses the way of making the right eye that meets a wish for quality at the least cost. All ways worth
// trying are measured on a few frames of the scene. Of each it is worked out how many of its pixels have to
// be cast as well to meet the wish (error_prediction.h). Unless the wish is for a time, the choice does not
// depend on measured times, so that pictures repeat.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/stereo/error_prediction.h"

namespace stereonav {

// Wishes of --quality, --target-psnr and --target-ms.
struct QualityWish {
    std::optional<double> quality =
        std::nullopt;  // share of the first way's expected squared error to be removed, 0 to 1
    std::optional<double> targetPsnr_db = std::nullopt;  // at least, for 95 of 100 frames; 0 to kMostPsnr_db
    std::optional<double> target_ms = std::nullopt;      // for both eyes, > 0; alone: all of it is used
    bool firstAlone = false;  // only the first way is considered, not even the full cast

    bool wantsError() const { return quality || targetPsnr_db; }
};

// A way of making the right eye, as measured on some frames.
struct MeasuredWarp {
    std::string name;  // "linear", "linear 1.1"
    WarpSetting setting;
    // Pixels of each frame by the contrast around them, without holes; empty for the full cast, which has no
    // setting.refinement.calibration either.
    std::vector<ContrastCounts> counts;
    std::vector<double> holes;  // for each frame: pixels that the way casts itself
    double right_ms = 0;        // mean of the frames, of each the least of its repeats
    double ray_ns = 0;          // expected for each pixel cast in addition
};
// All ways that were measured on the same frames.
struct MeasuredWarps {
    std::vector<MeasuredWarp> warps;  // the scene's default first, the full cast last
    double pixels = 0;                // pixels of one eye
    double left_ms = 0;               // mean of the frames, of each the least of its repeats
};

// A way of making the right eye, and its name.
struct NamedWarp {
    std::string name;
    WarpSetting setting;
};
// Lists the ways on the Pareto fronts that `report` measured: for opaque scenes linear with several
// stretches, for translucent ones selective with several spreads. The default comes first, the full cast
// last.
std::vector<NamedWarp> warpsWorthTrying(const EyeRenderer& renderer);

// Makes the right eye of each view by each way, the last of which is the full cast. views: at least one, all
// of one size. repeats: timed runs of each, >= 1. Throws Error without views, and where the last way is
// another.
MeasuredWarps measureWarps(const EyeRenderer& renderer, std::span<const StereoViews> views,
                           std::span<const NamedWarp> warps, int repeats);

// The way that was chosen, and what is expected of it.
struct QualityPlan {
    WarpSetting setting;  // with its refinement
    std::string name;
    double castShare = 0;   // expected share of all pixels that are cast: holes and refined ones
    double meanSquare = 0;  // expected squared error, levels of sRGB bytes; holes are exact
    double both_ms = 0;     // expected for both eyes, by times measured
    // Factor for the picture's width and height with which both eyes are expected to take target_ms; 1 where
    // they do in full size.
    double scale = 1;
};

// Returns the way that meets the wish at the least cost: the first one unless another is cheaper by
// kWorthAChange, and where nothing is wished but quality 0. Where no way is as fast as wished it is the
// fastest one, in a smaller picture and without refinement, since errors are known at the full size alone.
// Throws Error for a wish that is not in its range.
QualityPlan planQuality(const MeasuredWarps& measured, const QualityWish& wish);
constexpr double kWorthAChange = 0.05;  // share of the cost, or of the error, that another way has to save
constexpr double kLeastScale = 0.25;    // the least QualityPlan::scale

// Cost of a pixel that is cast in a hole or beside holes, in pixels of a full cast: such pixels lie apart.
// Ranks ways, and stands for the time where there was no hole to measure.
constexpr double kScatteredRay = 2;

}  // namespace stereonav
