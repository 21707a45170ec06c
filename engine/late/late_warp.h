// A picture that was cast a moment ago, as it is seen from where the eye is now: rotation exact, translation
// by depth. What was not seen then is stretched from the farther side and marked. For the window, which shows
// a new picture at each refresh whatever a frame costs; files and pictures at rest are cast.
//
// Backwards, pixel by pixel of the new picture: late_kernel.cpp. Plain form: late_oracle.h.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"
#include "engine/late/late_row.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

// Returns where a pixel of `to` lies in the picture of `from`.
LateMove lateMove(const EyeView& from, const EyeView& to);

// An eye's picture prepared for the late warp, once for each picture that was cast.
class LateEye {
public:
    // Works out what warp() needs of a picture. depth: metres along the viewing axis; infinite is the sky;
    // what is 0 or no number is not known. Pixels beside much nearer ones are taken for as near: smooth edges
    // have colours of both. soft: for what is seen through, whose colours have more than one depth: depths
    // without edges, and what is infinitely far beside them goes with them, so that nothing tears.
    void prepare(const Plane<float>& depth, const EyeView& view, SimdTarget simd = SimdTarget::Auto,
                 bool soft = false);
    // Makes ready() false; the memory stays.
    void forget() { mReady = false; }
    bool ready() const { return mReady; }          // something is prepared
    const EyeView& view() const { return mView; }  // where it was cast from
    // Returns what depths lie around a place of the picture, or of its border where that is beside it.
    // ready() holds.
    const LateTile& tileAt(double x, double y) const;

    // Makes the picture `color`, of the prepared size, as `to` sees it, in as many pixels as `to` has.
    // uncovered: 255 where nothing was seen before, or null. On this thread alone; with parallel, on all.
    void warp(const Plane<PackedColor>& color, const EyeView& to, Plane<PackedColor>& image,
              Plane<std::uint8_t>* uncovered = nullptr, bool parallel = false) const;

    // Inverse depths, 1 / metres, and how each tile of the new picture is to be looked up, row by row, for
    // who warps elsewhere. ready() holds.
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
