// Which way of making the right eye meets a wish for quality at the least cost: all ways that are worth it
// are measured on a few frames of the scene, and each is thought refined (error_prediction.h) until the wish
// is met. Without a wish for a time nothing of what is chosen depends on measured times, so that pictures
// repeat.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/stereo/error_prediction.h"

namespace stereonav {

// What --quality, --target-psnr and --target-ms ask for.
struct QualityWish {
    std::optional<double> quality =
        std::nullopt;  // share of the first way's expected squared error that is to go, 0 to 1
    std::optional<double> targetPsnr_db = std::nullopt;  // reached by 95 of 100 frames; 0 to kMostPsnr_db
    std::optional<double> target_ms = std::nullopt;      // both eyes, above 0; alone it is spent as a whole
    bool firstAlone = false;                             // no other way is to be taken, nor all pixels cast

    bool wantsError() const { return quality || targetPsnr_db; }
};

// A way as measured on some frames.
struct MeasuredWarp {
    std::string name;  // "linear", "linear 1.1"
    WarpSetting setting;
    // setting.refinement.calibration is there for all but the full cast. Of each frame:
    std::vector<ContrastCounts> counts;
    std::vector<double> holes;  // pixels cast anyway
    double right_ms = 0;        // mean frame, the least of the repeats
    double ray_ns = 0;          // a pixel cast beside the holes
};
// All ways that were measured on the same frames.
struct MeasuredWarps {
    std::vector<MeasuredWarp> warps;  // the scene's default first, the full cast last
    double pixels = 0;                // pixels of one eye
    double left_ms = 0;               // mean frame
};

// Ways on the measured fronts of `report`, named: opaque scenes linear with several stretches, translucent
// ones selective with several spreads. The default first, the full cast last.
struct NamedWarp {
    std::string name;
    WarpSetting setting;
};
// Lists the ways for the scene of this renderer.
std::vector<NamedWarp> warpsWorthTrying(const EyeRenderer& renderer);

// Warps and casts each of the views, at least one, of one size. repeats: timed runs of each, >= 1. Throws
// Error without views.
MeasuredWarps measureWarps(const EyeRenderer& renderer, std::span<const StereoViews> views,
                           std::span<const NamedWarp> warps, int repeats);

// The way that was chosen, and what is expected of it.
struct QualityPlan {
    WarpSetting setting;  // with its refinement
    std::string name;
    double castShare = 0;   // expected share of all pixels: holes and those that are refined
    double meanSquare = 0;  // expected, squared levels of sRGB bytes; without holes, which are exact
    double both_ms = 0;     // expected for both eyes, by times measured
    // Share of the picture's sides that both eyes are to be made in so that they take target_ms; 1: they do.
    double scale = 1;
};

// Returns what meets the wish at the least cost, the first way where another is not cheaper by kWorthAChange,
// and where nothing is wished but quality 0. Where no way takes so little time as wished: the fastest one, in
// a smaller picture and without a bound, which is known at this size alone. Throws Error for a wish that is
// not in its range.
QualityPlan planQuality(const MeasuredWarps& measured, const QualityWish& wish);
constexpr double kWorthAChange = 0.05;  // share of the time that another way has to save
constexpr double kLeastScale = 0.25;    // the least QualityPlan::scale

// Pixels that are cast beside holes lie apart: a ray there takes as long as this many of a full cast, in
// ranking ways and where no hole was there to measure it on.
constexpr double kScatteredRay = 2;

}  // namespace stereonav
