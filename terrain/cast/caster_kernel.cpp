// Casts bands of a picture and scattered pixels, one packet of rays at a time. Within a band, rows go
// from lower rays to higher ones, and a ray starts where a lower one's free way proves its own to be
// free (coherentStart). Compiled once for each instruction set.
#include "terrain/cast/kernel_columns.h"
#include "terrain/cast/kernel_rings.h"
#include "terrain/cast/kernel_shade.h"
#include "terrain/cast/kernel_stream.h"

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr int kRows = 8;         // rows of the ring of depths; a power of two above the largest look-back
constexpr int kMargin = 32;      // zeroed depths kept on both sides of a row
constexpr int kMaxBack = 4;      // rows looked back for coherence, below kRows
constexpr int kFarBack = 7;      // the furthest
constexpr double kMaxDrift = 2;  // lanes a row; with it no lead lies outside the margins
constexpr double kExpectedRise = 0.8;  // pixel heights that slopes rise a row, to choose the row; then proven

// Lane k's part of a row's directions.
struct LaneOffsets {
    D x, y, z;
};

STEREONAV_INLINE LaneOffsets laneOffsets(const CasterView& view) {
    const D lane = toDouble(laneIndex());
    return {lane * D(view.perLane[0]), lane * D(view.perLane[1]), lane * D(view.perLane[2])};
}

STEREONAV_INLINE Rays raysOfRow(const CasterView& view, const LaneOffsets& offsets, int a, int q) {
    const auto first = [&](int k) { return D(view.base[k] + a * view.perLane[k] + q * view.perStep[k]); };
    Rays r;
    r.exactX = first(0) + offsets.x;
    r.exactY = first(1) + offsets.y;
    r.exactZ = first(2) + offsets.z;
    r.x = toFloat(r.exactX);
    r.y = toFloat(r.exactY);
    r.z = toFloat(r.exactZ);
    return r;
}

// Directions in metres and what coherence needs of them.
struct Heading {
    F x, y, slope, inverseRun;  // unit horizontal direction; rise over run; 1 / horizontal length
};

STEREONAV_INLINE Heading headingOf(F x, F y, F z) {
    const F inverse = approxRsqrt(max(mulAdd(x, x, y * y), F(1e-24f)));
    return {x * inverse, y * inverse, z * inverse, inverse};
}

// Lipschitz coherence. Let a ray with horizontal unit heading e and slope s be free of ground out to
// the horizontal distance r. A ray from the same eye with heading e' and slope s' is above it by
// r (s' - s) and beside it by r |e' - e| at every distance up to r; as the ground rises at most by
// maxSlope a metre sideways, it is free to r too if s' - s >= maxSlope |e' - e|. With e' = e this is the
// rule of Wan et al. 2004, section 2.1 (a higher ray of a column hits no nearer); unlike theirs it
// holds for any roll and pitch. kSlack covers the rounding of headings (2^-21) and slopes.
constexpr float kSlack = 2e-6f;

STEREONAV_INLINE F startFrom(F inverseMaxSlope, const Heading& ray, const Heading& lower, F lowerT) {
    const F ex = ray.x - lower.x, ey = ray.y - lower.y;
    const F rise = (ray.slope - lower.slope) - F(kSlack) * (abs(ray.slope) + F(1.0f));
    const F reach = rise * inverseMaxSlope - F(kSlack);
    const M proven = (reach > F(0.0f)) & (mulAdd(ex, ex, ey * ey) <= reach * reach);
    // The same horizontal distance, in this ray's parameter.
    return select(proven, lowerT * ray.inverseRun * approxReciprocal(lower.inverseRun), F(0.0f));
}

STEREONAV_INLINE int nearestInt(double x) {
    return static_cast<int>(x + (x < 0 ? -0.5 : 0.5));
}

// How far to look back for a ray that proves this one's way: the nearest row whose pixels come close
// enough to the same heading. drift: lanes a step towards lower rays.
STEREONAV_INLINE int lookBack(double drift, float maxSlope) {
    for (int back = 1; back < kMaxBack; ++back) {
        const double at = drift * back;
        const double beside = at - nearestInt(at);
        if ((beside < 0 ? -beside : beside) * maxSlope <= kExpectedRise * back) return back;
    }
    return kMaxBack;
}

template <bool kBent>
class Band {
public:
    STEREONAV_INLINE Band(const CasterScene& scene, const CasterView& view, const CasterBand& band,
                          const CasterTarget& target, float* scratch)
        : mScene(scene),
          mView(view),
          mBand(band),
          mTarget(target),
          mRings(scene, view),
          mOffsets(laneOffsets(view)),
          mRing(scratch + kMargin + kLanes),
          mPitch(view.lanes + 2 * (kMargin + kLanes)) {}

    void cast() {
        if (mView.verticalColumns && mView.coherent) return castColumns();
        for (int q = mBand.firstStep; q < mBand.endStep; ++q) {
            const int begin = bandEdge(mBand.left, mBand.leftSlope, q, mView.lanes);
            const int end = bandEdge(mBand.right, mBand.rightSlope, q, mView.lanes);
            float* row = depths(q);
            lead(row, q, begin - kMargin, begin);
            for (int a = begin; a < end; a += kLanes)
                castPacketAt(a, q, end - a < kLanes ? end - a : kLanes, row);
            lead(row, q, end, end + kMargin);
        }
    }

private:
    void castColumns() {
        const int begin = bandEdge(mBand.left, mBand.leftSlope, 0, mView.lanes);
        const int end = bandEdge(mBand.right, mBand.rightSlope, 0, mView.lanes);
        for (int a = begin; a < end; a += kLanes) {
            const int count = end - a < kLanes ? end - a : kLanes;
            const M lanes = firstLanes(count);
            const Rays rays = raysOfRow(mView, mOffsets, a, mBand.firstStep);
            const M shaded = mRings.count() > 1 ? maskFromBits(0) : lanes;
            Columns<kBent> columns(mRings[0].eye, rays, lanes);
            for (int q = mBand.firstStep; q < mBand.endStep; ++q) {
                const Hits hits = columns.cast(slopeOf(a, q), lanes);
                const M colored = shaded | (hits.t < infinity());
                put(a, q, count, lanes, hits.t,
                    any(colored) ? shadePacket(mScene, mView, columns.rays(), hits, lanes & colored) : I(0));
            }
            if (mRings.count() > 1) columnsBeyond(a, lanes, rays);
        }
    }

    // Upright columns of a row rise alike, but what a round Earth turns them by.
    STEREONAV_INLINE RowSlope slopeOf(int a, int q) const {
        const double z = mView.base[2] + q * mView.perStep[2];
        if constexpr (kBent) {
            const D exact = D(z + a * mView.perLane[2]) + mOffsets.z;
            return {exact, toFloat(exact)};
        } else {
            return {D(z), F(static_cast<float>(z))};
        }
    }

    // The columns' rays that met nothing, over each coarser ground in turn: again from the lowest up. What is
    // met is told by the depths that are stored. Columns are upright, lanes lie beside each other.
    void columnsBeyond(int a, M lanes, const Rays& rays) {
        const Inverses inverse = inversesOf(rays);
        F border = borderExit(mRings[0], inverse);
        for (int n = 1; n < mRings.count(); ++n) {
            const Ring<kBent>& ring = mRings[n];
            const bool last = n + 1 == mRings.count();
            Columns<kBent> columns(ring.eye, scaled(rays, ring.scale), lanes, border);
            for (int q = mBand.firstStep; q < mBand.endStep; ++q) {
                const std::int64_t row = mView.firstY + static_cast<std::int64_t>(q) * mView.stepY;
                float* depth = mTarget.depth + row * mTarget.depthStride + mView.firstX + a;
                std::uint32_t* color = mTarget.color + row * mTarget.colorStride + mView.firstX + a;
                const M left = lanes & (loadF(depth) >= infinity());
                if (!any(left)) continue;
                const Hits hits = columns.cast(slopeOf(a, q), left);
                const M met = left & (hits.t < infinity()), shaded = last ? left : met;
                if (!any(shaded)) continue;
                store(color, shadePacket(*ring.scene, mView, columns.rays(), hits, shaded), shaded);
                store(depth, hits.t, met);
            }
            border = max(border, borderExit(ring, inverse));
        }
    }

    float* depths(int q) { return mRing + static_cast<std::int64_t>(q & (kRows - 1)) * mPitch; }

    // Beside the band nothing is known, or what the picture holds already: the depth of a warped pixel is
    // good to about a pixel's worth of ground, so its ray counts as free up to a little before.
    void lead(float* row, int q, int from, int to) {
        if (from < -kMargin) from = -kMargin;
        if (to > mView.lanes + kMargin) to = mView.lanes + kMargin;
        for (int a = from; a < to; ++a) row[a] = 0.0f;
        if (mView.laneX != 1) return;
        const float* known =
            mTarget.depth + (mView.firstY + std::int64_t{q} * mView.stepY) * mTarget.depthStride;
        if (from < mBand.knownFrom) from = mBand.knownFrom;
        if (to > mBand.knownTo) to = mBand.knownTo;
        for (int a = from; a < to; ++a) row[a] = known[a] < __builtin_inff() ? known[a] * kInFront : 0.0f;
    }

    void castPacketAt(int a, int q, int count, float* row) {
        const M lanes = firstLanes(count);
        const Rays rays = raysOfRow(mView, mOffsets, a, q);
        const F start = coherentStart(rays, a, q, lanes);
        Hits hits;
        const I color = castThrough(mRings, mView, rays, start, lanes, hits);
        store(row + a, hits.free, lanes);
        put(a, q, count, lanes, hits.t, color);
    }

    STEREONAV_INLINE F coherentStart(const Rays& rays, int a, int q, M lanes) {
        if (!mView.coherent) return F(0.0f);
        const double lowQ = mView.lowQ - q * mView.lowW;
        if (!(lowQ < 0)) return F(0.0f);
        const double drift = (mView.lowA - (a + kLanes / 2) * mView.lowW) / -lowQ;
        if (!(drift > -kMaxDrift && drift < kMaxDrift)) return F(0.0f);
        const F sx(static_cast<float>(mScene.ground.spacingX)),
            sy(static_cast<float>(mScene.ground.spacingY));
        const F inverseMaxSlope(1.0f / mScene.ground.maxSlope);
        const Heading ray = headingOf(rays.x * sx, rays.y * sy, rays.z);
        const int rows = q - mBand.firstStep;
        F start(0.0f);
        const auto ledBy = [&](int back, int shift) {
            const auto change = [&](int k) {
                return F(static_cast<float>(shift * mView.perLane[k] - back * mView.perStep[k]));
            };
            const Heading lower =
                headingOf((rays.x + change(0)) * sx, (rays.y + change(1)) * sy, rays.z + change(2));
            start = max(start, startFrom(inverseMaxSlope, ray, lower, loadF(depths(q - back) + a + shift)));
            return all((start > F(0.0f)) | ~lanes);
        };
        bool done = false;
        for (int back = lookBack(drift, mScene.ground.maxSlope); back <= kMaxBack && back <= rows && !done;
             ++back)
            done = ledBy(back, nearestInt(drift * back));
        // Lanes at the band's edges, whose leads lie outside: from further back, one within it will do.
        if (!done && rows >= kFarBack) {
            const int inside = static_cast<int>(drift * kFarBack);
            if (!ledBy(kFarBack, inside)) ledBy(kFarBack, inside + (drift < 0 ? -1 : 1));
        }
        return backed(start);
    }

    // A little before, for the rounding of t and of the horizontal lengths.
    STEREONAV_INLINE static F backed(F t) { return t * F(1.0f - 4e-6f); }

    STEREONAV_INLINE void put(int a, int q, int count, M lanes, F t, I color) {
        if (mView.laneX == 1) {
            const std::int64_t x = mView.firstX + a,
                               y = mView.firstY + static_cast<std::int64_t>(q) * mView.stepY;
            store(mTarget.depth + y * mTarget.depthStride + x, t, lanes);
            store(mTarget.color + y * mTarget.colorStride + x, color, lanes);
            return;
        }
        alignas(64) float depth[kLanes];
        alignas(64) std::uint32_t packed[kLanes];
        store(depth, t);
        store(packed, color);
        for (int k = 0; k < count; ++k) {
            const std::int64_t x = mView.firstX + (a + k) * mView.laneX + q * mView.stepX;
            const std::int64_t y = mView.firstY + (a + k) * mView.laneY + q * mView.stepY;
            mTarget.depth[y * mTarget.depthStride + x] = depth[k];
            mTarget.color[y * mTarget.colorStride + x] = packed[k];
        }
    }

    const CasterScene& mScene;
    const CasterView& mView;
    const CasterBand& mBand;
    const CasterTarget& mTarget;
    const Rings<kBent> mRings;
    const LaneOffsets mOffsets;
    float* const mRing;
    const std::int64_t mPitch;
};

void castBand(const CasterScene& scene, const CasterView& view, const CasterBand& band,
              const CasterTarget& target, float* scratch) {
    view.fall > 0 ? Band<true>(scene, view, band, target, scratch).cast()
                  : Band<false>(scene, view, band, target, scratch).cast();
}

void castPixels(const CasterScene& scene, const CasterView& view, const CasterBatch& batch,
                const CasterTarget& target) {
    view.fall > 0 ? RayStream<true>(scene, view, batch, target).cast()
                  : RayStream<false>(scene, view, batch, target).cast();
}

// Returns the hits, as shading needs them, at points of known depths.
template <bool kBent>
STEREONAV_INLINE Hits hitsAt(const GroundData& ground, const Eye<kBent>& eye, const Rays& rays, F t,
                             M lanes) {
    Hits hits;
    hits.t = t;
    const M below = lanes & (t < infinity());
    const F safe = select(below, t, F(0.0f));
    const F gx = mulAdd(safe, rays.x, eye.relativeX), gy = mulAdd(safe, rays.y, eye.relativeY);
    hits.i = clamp(floorToInt(gx) + I(eye.baseI), I(0), eye.lastI);
    hits.j = clamp(floorToInt(gy) + I(eye.baseJ), I(0), eye.lastJ);
    hits.u = gx - toFloat(hits.i - I(eye.baseI));
    hits.v = gy - toFloat(hits.j - I(eye.baseJ));
    const I index = hits.j * I(ground.width) + hits.i;
    const FPair south = gatherPair(ground.heights, index, below);
    const FPair north = gatherPair(ground.heights + ground.width, index, below);
    const F du = south.second - south.first, dv = north.first - south.first;
    const F twist = (north.second - north.first) - du;
    F rise = rays.z;
    if constexpr (kBent)
        rise = mulAdd(F(2.0f) * safe,
                      F(static_cast<float>(eye.bend.bendX)) * rays.x * rays.x +
                          F(static_cast<float>(eye.bend.bendY)) * rays.y * rays.y,
                      rise);
    hits.approach = rise - rays.x * mulAdd(hits.v, twist, du) - rays.y * mulAdd(hits.u, twist, dv);
    hits.free = F(0.0f);
    return hits;
}

template <bool kBent>
void shadeRowOf(const CasterScene& scene, const CasterView& view, int y, const CasterTarget& target) {
    const Eye<kBent> eye = makeEye<kBent>(scene.ground, view);
    const int q = (y - view.firstY) * view.stepY;
    const LaneOffsets offsets = laneOffsets(view);
    float* depth = target.depth + y * target.depthStride;
    std::uint32_t* color = target.color + y * target.colorStride;
    for (int x = 0; x < view.lanes; x += kLanes) {
        const M lanes = firstLanes(view.lanes - x);
        const Rays rays = raysOfRow(view, offsets, x, q);
        const Hits hits = hitsAt(scene.ground, eye, rays, loadF(depth + x), lanes);
        store(color + x, shadePacket(scene, view, rays, hits, lanes), lanes);
    }
}

void shadeRow(const CasterScene& scene, const CasterView& view, int y, const CasterTarget& target) {
    view.fall > 0 ? shadeRowOf<true>(scene, view, y, target) : shadeRowOf<false>(scene, view, y, target);
}

}  // namespace

constinit const CasterKernels kCasterKernels = {kName, kLanes, castBand, castPixels, shadeRow};

}  // namespace stereonav::STEREONAV_ISA
