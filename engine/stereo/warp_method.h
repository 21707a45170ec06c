// Descriptions of the methods of making the right eye: how each warps a row, and its properties. Shared by
// right_eye.cpp and the method_*.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/camera/stereo_rig.h"
#include "engine/image/eye_image.h"
#include "engine/stereo/right_eye.h"
#include "engine/stereo/warp_row.h"

namespace stereonav {

// Scratch memory that one worker needs for a row.
struct WarpScratch {
    std::vector<float> column, inverse, accumulators;  // rows for ResampleRow and SplatRow
    std::vector<std::int32_t> source;

    // Resizes for rows of `width` pixels; makes accumulators where `splats` is true.
    void resize(int width, bool splats);
};

struct WarpMethod;

// The warp of one frame.
struct WarpJob {
    const StereoViews& views;
    const EyeImage& left;
    const WarpSetting& setting;
    const WarpMethod& method;
    EyeImage& right;
    Plane<std::uint8_t>& mask;  // 255 where a pixel is to be cast
    ViewDependence dependence;
    bool airDiffers;  // fog or other air differs between the eyes, so that colours must be corrected

    int width() const { return left.width(); }
    // The rows' shift (pixels) and scale (pixels * metres): ResampleRow.
    float shift() const { return static_cast<float>(views.shiftAtInfinity); }
    float scale() const { return static_cast<float>(views.parallaxScale); }
    // Returns whether normals, from which colours follow, are moved from eye to eye in place of colours.
    bool movesNormals() const { return dependence == ViewDependence::Normal; }
    const Plane<std::uint32_t>& from() const { return movesNormals() ? left.normal : left.color; }
    Plane<std::uint32_t>& to() const { return movesNormals() ? right.normal : right.color; }
};

// Warps row y: writes job.to(), job.right.viewDepth and job.mask, every pixel of the row.
using WarpRowFunction = void (*)(const WarpJob& job, ResampleFunction resample, WarpScratch& scratch, int y);

// Treatment of the pixels that the warp marked.
enum class AfterWarp {
    Cast,            // holes are cast
    Leave,           // holes are left black
    CastFromDepths,  // every pixel is cast, those not marked from the depth that was written
};

// A way of making the right eye: what it does with a row, and what follows from that.
struct WarpMethod {
    WarpRowFunction warpRow = nullptr;  // null: every pixel is cast, without a warp
    AfterWarp after = AfterWarp::Cast;
    // Whether a warped pixel lies between the left pixels `source` and `source` + 1, as in ResampleRow.
    // Otherwise it shows the pixel `source`, and its depth is the nearest of those drawn there.
    bool between = false;
    bool splats = false;       // needs WarpScratch::accumulators
    bool marksBorder = true;   // casts pixels that may show what only the right eye sees (region V)
    bool opaque = true;        // is worth comparing for scenes of surfaces
    bool translucent = false;  // is worth comparing for translucent scenes
};

// kMethodFull, kMethodPaper, ...: each defined in its method_<name>.cpp.
#define STEREONAV_METHOD(id, name) extern const WarpMethod kMethod##id;
STEREONAV_RIGHT_EYE_METHODS(STEREONAV_METHOD)
#undef STEREONAV_METHOD

// The facts of a method.
const WarpMethod& warpMethodOf(RightEyeMethod method);

// Returns the row of an inverse warp with two taps.
ResampleRow resampleRowOf(const WarpJob& job, WarpScratch& scratch, int y);
// Warps row y with resampleRowOf().
void warpRowLinear(const WarpJob& job, ResampleFunction resample, WarpScratch& scratch, int y);

}  // namespace stereonav
