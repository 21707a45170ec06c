// Chooses the cheapest way of making the right eye that fulfils a wish for quality. All ways worth trying are
// measured on a few frames of the scene. For each it is computed how many of its pixels must be cast as well
// to fulfil the wish (error_prediction.h). Unless the wish is for a time, the choice does not depend on
// measured times, so that pictures are reproducible.
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
    // dB that 95 of 100 frames are to reach; 0 to kMostPsnr_db.
    std::optional<double> targetPsnr_db = std::nullopt;
    // Milliseconds for both eyes, > 0; without another wish all of them are used.
    std::optional<double> target_ms = std::nullopt;
    bool firstAlone = false;  // only the first way is considered, and not the full cast either

    bool wantsError() const { return quality || targetPsnr_db; }
};

// A way of making the right eye, as measured on some frames.
struct MeasuredWarp {
    std::string name;  // "linear", "linear 1.1"
    WarpSetting setting;
    // Number of pixels by the contrast around them for each frame, without holes. Empty for the full cast,
    // which has no setting.refinement.calibration either.
    std::vector<ContrastCounts> counts;
    std::vector<double> holes;  // for each frame: number of pixels that the way itself casts
    double right_ms = 0;        // mean over the frames of the fastest repeat
    double ray_ns = 0;          // expected for each pixel cast in addition
};
// All ways that were measured on the same frames.
struct MeasuredWarps {
    std::vector<MeasuredWarp> warps;  // the scene's default first, the full cast last
    double pixels = 0;                // pixels of one eye
    double left_ms = 0;               // mean over the frames of the fastest repeat
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
// of one size. repeats: timed runs of each, >= 1. Throws Error without views, and where the last way is not
// the full cast.
MeasuredWarps measureWarps(const EyeRenderer& renderer, std::span<const StereoViews> views,
                           std::span<const NamedWarp> warps, int repeats);

// The chosen way, and what is expected of it.
struct QualityPlan {
    WarpSetting setting;  // includes its refinement
    std::string name;
    double castShare = 0;   // expected share of all pixels that are cast: holes and refined ones
    double meanSquare = 0;  // expected squared error, levels of sRGB bytes; holes are exact
    double both_ms = 0;     // expected for both eyes, by measured times
    // Factor for the picture's width and height at which both eyes are expected to take target_ms; 1 where
    // they do so in full size.
    double scale = 1;
};

// Returns the cheapest way that fulfils the wish. The first way is kept unless another is cheaper by
// kWorthAChange, and where the only wish is quality 0. Where no way is as fast as wished, returns the fastest
// one in a smaller picture without refinement, since errors are known only for the full size. Throws Error
// for a wish that is out of its range.
QualityPlan planQuality(const MeasuredWarps& measured, const QualityWish& wish);
constexpr double kWorthAChange = 0.05;  // share of the cost, or of the error, that another way has to save
constexpr double kLeastScale = 0.25;    // the least QualityPlan::scale

// Cost of a pixel that is cast in a hole or beside holes, in pixels of a full cast: such pixels lie apart.
// Ranks ways, and stands for the time where there was no hole to measure.
constexpr double kScatteredRay = 2;

}  // namespace stereonav
