// Scattered rays: each lane takes the next ray when its own is done, so that a long ray does not hold up
// the others (rays into holes pass just over a ridge and end anywhere behind it). What a ray hits does
// not depend on its neighbours. Included by kernels only.
#pragma once

#include "terrain/cast/kernel_cast.h"
#include "terrain/cast/kernel_rings.h"
#include "terrain/cast/kernel_shade.h"

namespace stereonav::STEREONAV_ISA {

template <bool kBent>
class RayStream {
public:
    STEREONAV_INLINE RayStream(const CasterScene& scene, const CasterView& view, const CasterBatch& batch,
                               const CasterTarget& target)
        : mScene(scene), mView(view), mBatch(batch), mTarget(target), mRings(scene, view) {
        for (int k = 0; k < kLanes; ++k) mPixel[k] = 0, mX[k] = mY[k] = mZ[k] = 0, mStart[k] = 0;
        mFound.hit = mFound.unsure = mTaken = mWalk.active = mWalk.risen = maskFromBits(0);
        mFound.t = mWalk.t = F(0.0f);
        mFound.approach = F(-1.0f);
        mFound.curvature = mFound.h00 = mFound.h10 = mFound.h01 = mFound.h11 = F(0.0f);
        mWalk.i = mWalk.j = mWalk.level = I(0);
        if constexpr (kBent) mWalk.sink = mWalk.lowest = F(0.0f);
    }

    // Casts, colours and stores the whole batch.
    void cast() {
        for (;;) {
            const int busy = __builtin_popcount(bits(mWalk.active));
            const bool more = mNext < mBatch.count;
            if (busy == 0 || (more && busy <= kLanes / 2)) {
                finish(andNot(mTaken, mWalk.active));
                if (!more && busy == 0) return;
                take(~mWalk.active);
                continue;
            }
            const M parked = leap<false>(mRings[0].eye, mWalk, mWalk.active);
            if (any(parked)) tryCells(mRings[0].eye, mWalk, parked, mFound);
        }
    }

private:
    // Loads the next rays into the lanes m and tests their first cells.
    STEREONAV_INLINE void take(M m) {
        std::uint32_t fresh = 0;
        for (std::uint32_t left = bits(m); left != 0 && mNext < mBatch.count; left &= left - 1, ++mNext) {
            const int k = __builtin_ctz(left);
            const CasterPixel p = mBatch.pixels[mNext];
            const int dx = p.x - mView.firstX, dy = p.y - mView.firstY;
            const int a = dx * mView.laneX + dy * mView.laneY, q = dx * mView.stepX + dy * mView.stepY;
            mPixel[k] = mNext;
            mX[k] = mView.base[0] + a * mView.perLane[0] + q * mView.perStep[0];
            mY[k] = mView.base[1] + a * mView.perLane[1] + q * mView.perStep[1];
            mZ[k] = mView.base[2] + a * mView.perLane[2] + q * mView.perStep[2];
            mStart[k] = mBatch.start[mNext];
            fresh |= 1u << k;
        }
        begin(maskFromBits(fresh));
    }

    STEREONAV_INLINE void begin(M fresh) {
        const F start = loadF(mStart);
        const M known = start > F(0.0f);
        const I cold(kColdLevel < mScene.ground.levels ? kColdLevel : 0);
        const Walk<kBent> next = startWalk(mRings[0].eye, rays(), start, select(known, I(0), cold), fresh);
        const Walk<kBent> old = mWalk;
        mWalk = next;
        mWalk.t = select(fresh, next.t, old.t);
        mWalk.i = select(fresh, next.i, old.i);
        mWalk.j = select(fresh, next.j, old.j);
        mWalk.level = select(fresh, next.level, old.level);
        mWalk.active = (next.active & fresh) | andNot(old.active, fresh);
        mWalk.risen = (next.risen & fresh) | andNot(old.risen, fresh);
        mTaken = mTaken | fresh;
        const M close = mWalk.active & fresh & known;
        if (any(close)) tryCells(mRings[0].eye, mWalk, close, mFound);
    }

    STEREONAV_INLINE Rays rays() const {
        Rays r;
        __builtin_memcpy(&r.exactX, mX, sizeof r.exactX);
        __builtin_memcpy(&r.exactY, mY, sizeof r.exactY);
        __builtin_memcpy(&r.exactZ, mZ, sizeof r.exactZ);
        r.x = toFloat(r.exactX);
        r.y = toFloat(r.exactY);
        r.z = toFloat(r.exactZ);
        return r;
    }

    // Decides the hits of the lanes m, which are done; colours and stores them.
    STEREONAV_INLINE void finish(M m) {
        if (!any(m)) return;
        CellHit done = mFound;
        done.hit = done.hit & m;
        done.unsure = done.unsure & m;
        Hits hits = settle(mRings[0].eye, mWalk, done);
        const I color = shadeThrough(mRings, mView, mWalk.rays, loadF(mStart), m, hits);
        alignas(64) float depth[kLanes];
        alignas(64) std::uint32_t packed[kLanes];
        store(depth, hits.t);
        store(packed, color);
        for (std::uint32_t left = bits(m); left != 0; left &= left - 1) {
            const int k = __builtin_ctz(left);
            const CasterPixel p = mBatch.pixels[mPixel[k]];
            mTarget.depth[p.y * mTarget.depthStride + p.x] = depth[k];
            mTarget.color[p.y * mTarget.colorStride + p.x] = packed[k];
        }
        mFound.hit = andNot(mFound.hit, m);
        mFound.unsure = andNot(mFound.unsure, m);
        mTaken = andNot(mTaken, m);
    }

    const CasterScene& mScene;
    const CasterView& mView;
    const CasterBatch& mBatch;
    const CasterTarget& mTarget;
    const Rings<kBent> mRings;
    Walk<kBent> mWalk;
    CellHit mFound;
    M mTaken;
    int mNext = 0;
    int mPixel[kLanes];                                     // index in the batch
    alignas(64) double mX[kLanes], mY[kLanes], mZ[kLanes];  // directions, as CasterView's
    alignas(64) float mStart[kLanes];                       // view depths, metres
};

}  // namespace stereonav::STEREONAV_ISA
