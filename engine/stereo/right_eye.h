// The right eye from the left one: warp, then cast rays into the holes. One method per way of
// reconstructing (right_eye_method.h); `Full` casts every pixel and is what the others are measured against.
#pragma once

#include <memory>

#include "engine/base/parallel.h"
#include "engine/camera/stereo_rig.h"
#include "engine/render/eye_renderer.h"
#include "engine/stereo/right_eye_method.h"

namespace stereonav {

struct ErrorCalibration;

// How many warped pixels are cast as well, those with the largest expected error first. None without a
// calibration.
struct Refinement {
    std::shared_ptr<const ErrorCalibration> calibration;
    // Share of the expected squared error to remove, 0..1: the quality dial. 1 casts every pixel.
    double quality = 0;
    double targetPsnr_db = 0;  // dB against a full cast that 95 of 100 frames have to reach; 0: no such wish
    double mostPixels = 1;     // largest share of all pixels to cast in addition to the holes
};

// How a right eye is made.
struct WarpSetting {
    RightEyeMethod method = kDefaultRightEyeMethod;
    // Inverse methods: a pixel between survivors further apart than this many right pixels is a hole. By
    // `compare` on real terrain, 1.1 instead is 1 to 3 dB better and casts 1.3 to 2.6 times the rays.
    float maxStretch = 1.4f;
    // Inverse methods: a pixel between survivors nearer to each other than this many right pixels is a hole
    // too, since that is a fold or a silhouette.
    float minStretch = 0.5f;
    // Paper: a pixel whose accumulated splat weight is below this share of full cover is a hole.
    float weightThreshold = 0.5f;
    // Selective: a pixel is cast where the depths that its light comes from shift apart by more than this
    // many right pixels (root mean square).
    float mostSpread = 0.7f;
    // DepthSplat: rays start before the depth found, by depthMargin of it and depthRangeMargin of its
    // difference from the neighbouring pixels, since the surface between the left eye's samples may be a
    // little nearer.
    float depthMargin = 0.01f;
    float depthRangeMargin = 1.0f;
    Refinement refinement;
    Schedule warpSchedule = Schedule::Dynamic;
    Schedule fillSchedule = Schedule::Dynamic;  // Dynamic sorts the bands by their number of holes
};

// Times of a right eye, and the number of its pixels that were cast.
struct RightEyeTimings {
    double warp_ms = 0, fill_ms = 0;  // DepthSplat: splatting, and casting every pixel
    // Number of pixels that were cast, of width * height. DepthSplat: those cast without a known start.
    long long holePixels = 0;
    long long refinedPixels = 0;  // pixels cast again that had been warped before
    double boundPsnr_db = 0;      // expected PSNR that 95 of 100 frames exceed, where there is a calibration
    double right_ms() const { return warp_ms + fill_ms; }
};

// Makes right eyes, keeping its buffers between frames. Not for two threads at once; the work inside
// runs on all threads.
class RightEye {
public:
    RightEye();
    ~RightEye();
    RightEye(RightEye&&) noexcept;
    RightEye& operator=(RightEye&&) noexcept;

    // Makes a right eye. left: the left eye as cast. right: resized here; every pixel of color and viewDepth
    // is set (viewDepth 0 where a hole was left). Widths from 1 up. The viewDepth of a warped pixel is that
    // of the nearer of the two left pixels that it lies between; where colours are shaded again from normals
    // alone, it is interpolated to the pixel. Throws Error where the left eye's size is not that of the
    // views.
    RightEyeTimings render(const EyeRenderer& renderer, const StereoViews& views, const EyeImage& left,
                           const WarpSetting& setting, EyeImage& right);

    // Returns 255 where the last render() cast a ray or left a hole, 0 where it warped; for DepthSplat 0
    // where the start of the ray was known. Valid until the next call.
    const Plane<std::uint8_t>& holeMask() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

}  // namespace stereonav
