// Warps a picture that was cast a moment ago to the eye's present place: rotation exactly, translation by
// depth. Parts that were not seen then are filled by stretching the farther side, and are marked. For the
// window, which shows a new picture at each refresh however long a frame takes; files and pictures at rest
// are cast instead.
//
// Works backwards, from each pixel of the new picture: late_kernel.cpp. Plain version: late_oracle.h.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"
#include "engine/late/late_row.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

// Returns the mapping from pixels of `to` to the picture of `from`.
LateMove lateMove(const EyeView& from, const EyeView& to);

// An eye's picture prepared for the late warp, once for each picture that was cast.
class LateEye {
public:
    // Prepares a picture for warp(). depth: metres along the viewing axis; infinite is the sky; 0 and NaN are
    // unknown. Pixels beside much nearer ones are taken for as near as these, since antialiased edges have
    // colours of both. soft: for translucent scenes, whose colours come from more than one depth: depths are
    // smoothed without edges, and infinite depths beside them follow them, so that nothing tears.
    void prepare(const Plane<float>& depth, const EyeView& view, SimdTarget simd = SimdTarget::Auto,
                 bool soft = false);
    // Makes ready() false; the memory stays.
    void forget() { mReady = false; }
    bool ready() const { return mReady; }          // something is prepared
    const EyeView& view() const { return mView; }  // where it was cast from
    // Returns the range of depths around a place of the picture, or at its border for places outside.
    // Requires ready().
    const LateTile& tileAt(double x, double y) const;

    // Warps `color`, of the prepared size, to the view `to`, in as many pixels as `to` has. uncovered: 255
    // where nothing was seen before, or null. Runs on this thread only; with `parallel` on all.
    void warp(const Plane<PackedColor>& color, const EyeView& to, Plane<PackedColor>& image,
              Plane<std::uint8_t>* uncovered = nullptr, bool parallel = false) const;

    // Return the inverse depths, 1 / metres, and for each tile of the new picture, row by row, how its pixels
    // are found; for code that warps elsewhere. Require ready().
    const Plane<float>& inverse() const { return mInverse; }
    LateMove planAll(const EyeView& to, std::vector<LatePlan>& plans) const;

private:
    void measure(const Plane<float>& depth);
    void planRow(const LateMove& move, const EyeView& to, int tileRow, LatePlan* plans) const;
    LatePlan planOf(const LateMove& move, int x0, int y0, int x1, int y1, float nearestSeen) const;

    bool mReady = false;
    SimdTarget mSimd = SimdTarget::Auto;
    EyeView mView;
    Plane<float> mInverse;
    std::vector<LateTile> mTiles;
    int mAcross = 0, mDown = 0;         // tiles
    float mFarthest = 0, mNearest = 0;  // inverse depths, 1 / metres
};

}  // namespace stereonav
