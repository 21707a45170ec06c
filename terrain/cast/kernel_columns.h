// Level views: every lane's rays lie in one vertical plane, so all of them run over the same line of
// cells and see the same profile of the ground; only their slope changes. A packet of columns is swept
// once, from its lowest ray to its highest, and never looks back (Wan et al. 2004, section 2.1; there
// one column at a time and in equal steps). Along the ray the ground in a cell is a parabola, found when
// the cell is entered and solved for each ray that ends in it. Included by kernels only.
#pragma once

#include "terrain/cast/kernel_rings.h"

namespace stereonav::STEREONAV_ISA {

// Rise of a row's rays, in metres per metre of depth.
struct RowSlope {
    D exact;
    F rough;
};

template <bool kBent>
class Columns {
public:
    // rays: the lowest ray of each column. border: view depth in metres at which rays come from a finer
    // ground; 0: they come from the eye.
    STEREONAV_INLINE Columns(const Eye<kBent>& eye, const Rays& rays, M lanes, F border = F(0.0f))
        : mEye(eye) {
        mWalk = startWalk(eye, rays, border, I(0), lanes);
        mEntering = border > F(0.0f);
        mWalk.floor = max(mWalk.floor, border);
        mExit = cellExit(mEye, mWalk);
        // A steeper ray may come down later than a flatter one enters, so that each must start at the border.
        mStarted = false;
    }

    // Returns the hits of the lanes' rays in the next row, which must not be flatter than those before.
    STEREONAV_INLINE Hits cast(const RowSlope& slope, M lanes) {
        mWalk.rays.exactZ = slope.exact;
        takeSlope(mWalk, slope.rough);
        if (!mStarted) start();
        CellHit found;
        found.hit = found.unsure = maskFromBits(0);
        found.t = infinity();
        found.approach = F(-1.0f);
        mSunk = maskFromBits(0);
        M pending = mWalk.active & lanes;
        for (int cells = 0; any(pending); ++cells) {
            solve(pending, found);
            pending = andNot(pending, found.hit | found.unsure) & mWalk.active;
            if (!any(pending)) break;
            if (cells < kOutright) {
                leaveCell(mEye, mWalk, mExit, pending);
                pending = pending & mWalk.active;
            } else {
                pending = jump(pending);
            }
            enterCell(pending);
        }
        return settled(found);
    }

    STEREONAV_INLINE bool active() const { return any(mWalk.active); }
    STEREONAV_INLINE const Rays& rays() const { return mWalk.rays; }

private:
    static constexpr int kOutright = 2;  // cells tried before leaping

    STEREONAV_INLINE void start() {
        mStarted = true;
        enterCell(mWalk.active);
    }

    // Leaps with the lanes m to cells they may hit.
    STEREONAV_INLINE M jump(M m) {
        leaveCell(mEye, mWalk, mExit, m);
        mWalk.level = I(0);
        return leap<true>(mEye, mWalk, m & mWalk.active);
    }

    // Finds the ground along the columns in the cells where the lanes m stand: h0 + h1 s + h2 s^2, with s
    // counted from the entry.
    STEREONAV_INLINE void enterCell(M m) {
        if (!any(m)) return;
        const I index = mWalk.j * I(mEye.ground->width) + mWalk.i;
        const FPair south = gatherPair(mEye.ground->heights, index, m);
        const FPair north = gatherPair(mEye.ground->heights + mEye.ground->width, index, m);
        mH00 = select(m, south.first, mH00);
        mH10 = select(m, south.second, mH10);
        mH01 = select(m, north.first, mH01);
        mH11 = select(m, north.second, mH11);
        const F du = mH10 - mH00, dv = mH01 - mH00, twist = (mH11 - mH01) - du;
        const F u = mulAdd(mWalk.t, mWalk.rays.x, mEye.relativeX - toFloat(mWalk.i - I(mEye.baseI)));
        const F v = mulAdd(mWalk.t, mWalk.rays.y, mEye.relativeY - toFloat(mWalk.j - I(mEye.baseJ)));
        const F slopeU = mulAdd(v, twist, du), slopeV = mulAdd(u, twist, dv);
        // Height of the eye above the ground at the entry.
        mGround0 = (mEye.height - mH00) + (mEye.rest - mulAdd(u, slopeU, v * dv));
        mGround1 = mulAdd(mWalk.rays.x, slopeU, mWalk.rays.y * slopeV);
        mCurvature = curvatureOf(mWalk, twist);
        mExit = cellExit(mEye, mWalk);
        mLength = mulAdd(mExit.t, F(0x1p-21f), mExit.t - mWalk.t);
    }

    STEREONAV_INLINE void solve(M m, CellHit& found) {
        F height = heightAt(mWalk, mWalk.t, mGround0);
        const M unsure = m & (height < F(0.0f) - mEye.margin - mEye.margin);
        const M step = unsure & mEntering & (mWalk.t <= mWalk.floor);
        mSunk = mSunk | step;
        height = max(height, F(0.0f));
        const F b = riseAt(mWalk, mWalk.t) - mGround1;
        const F discriminant = mulAdd(b, b, F(-4.0f) * mCurvature * height);
        const F root = discriminant * approxRsqrt(max(discriminant, F(1e-30f)));
        const M rising = b > F(0.0f);
        const F s = select(rising, b + root, height + height) *
                    approxReciprocal(select(rising, F(-2.0f) * mCurvature, root - b));
        const M hit = andNot(m, unsure) & (discriminant >= F(0.0f)) & (s >= F(0.0f)) & (s <= mLength);
        found.t = select(hit, mWalk.t + s, found.t);
        found.approach = select(hit, mulAdd(mCurvature + mCurvature, s, b), found.approach);
        found.hit = found.hit | hit | step;
        found.unsure = found.unsure | andNot(unsure, step);
    }

    STEREONAV_INLINE Hits settled(CellHit& found) {
        Hits hits = noHits();
        if (!any(found.hit | found.unsure)) return hits;
        found.h00 = mH00, found.h10 = mH10, found.h01 = mH01, found.h11 = mH11;
        found.curvature = mCurvature;
        const M doubtful = found.unsure | refine(mEye, mWalk, found, andNot(found.hit, mSunk), hits);
        if (any(doubtful)) castExactly(mEye, mWalk.rays, mWalk.t, mWalk.floor, doubtful, hits);
        if (any(mSunk)) meetAt({mWalk.t, mWalk.i, mWalk.j}, standingAt(mEye, mWalk, mSunk), mSunk, hits);
        return hits;
    }

    const Eye<kBent>& mEye;
    Walk<kBent> mWalk;
    BlockExit mExit;
    F mH00{0.0f}, mH10{0.0f}, mH01{0.0f}, mH11{0.0f};
    F mGround0{0.0f}, mGround1{0.0f}, mCurvature{0.0f}, mLength{0.0f};
    M mEntering, mSunk;  // come from a finer ground; are below this ground where they entered it
    bool mStarted = false;
};

}  // namespace stereonav::STEREONAV_ISA
