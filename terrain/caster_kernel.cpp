// Casts bands of a picture and scattered pixels, one packet of rays at a time. Within a band, rows go
// from lower rays to higher ones, and a ray starts where a lower one's free way proves its own to be
// free (coherentStart). Compiled once for each instruction set.
#include "terrain/kernel_columns.h"
#include "terrain/kernel_shade.h"

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr int kRows = 8;       // rows of the ring of depths; a power of two above the largest look-back
constexpr int kMargin = 32;    // zeroed depths kept on both sides of a row
constexpr int kColdLevel = 3;  // pyramid level for a ray about which nothing is known

STEREONAV_INLINE D lanesFrom(double base, double perLane) {
    return D(base) + toDouble(laneIndex()) * D(perLane);
}

STEREONAV_INLINE Rays raysOfRow(const CasterView& view, int a, int q) {
    Rays r;
    D* exact[3] = {&r.exactX, &r.exactY, &r.exactZ};
    for (int k = 0; k < 3; ++k)
        *exact[k] = lanesFrom(view.base[k] + a * view.perLane[k] + q * view.perStep[k], view.perLane[k]);
    r.x = toFloat(r.exactX);
    r.y = toFloat(r.exactY);
    r.z = toFloat(r.exactZ);
    return r;
}

// Directions in metres and what coherence needs of them.
struct Heading {
    F x, y, inverseLength, slope;  // horizontal metres; 1 / horizontal length; rise over run
};

STEREONAV_INLINE Heading headingOf(F x, F y, F z) {
    const F inverse = F(1.0f) / sqrt(max(mulAdd(x, x, y * y), F(1e-24f)));
    return {x, y, inverse, z * inverse};
}

// Lipschitz coherence. Let a ray with horizontal unit heading e and slope s be free of ground out to
// the horizontal distance r. A ray from the same eye with heading e' and slope s' is above it by
// r (s' - s) and beside it by r |e' - e| at every distance up to r; as the ground rises at most by
// maxSlope a metre sideways, it is free to r too if s' - s >= maxSlope |e' - e|. With e' = e this is the
// rule of Wan et al. 2004, section 2.1 (a higher ray of a column hits no nearer); unlike theirs it
// holds for any roll and pitch. Rounding is covered by kSlack.
constexpr float kSlack = 4e-7f;

STEREONAV_INLINE F startFrom(const GroundData& ground, const Heading& ray, const Heading& lower, F lowerT) {
    const F ex = ray.x * ray.inverseLength - lower.x * lower.inverseLength;
    const F ey = ray.y * ray.inverseLength - lower.y * lower.inverseLength;
    const F aside = sqrt(mulAdd(ex, ex, ey * ey)) + F(kSlack);
    const F rise = ray.slope - lower.slope;
    const M proven = (rise - F(kSlack) * (abs(ray.slope) + F(1.0f))) >= F(ground.maxSlope) * aside;
    // The same horizontal distance, in this ray's parameter.
    return select(proven, lowerT * ray.inverseLength / lower.inverseLength, F(0.0f));
}

class Band {
public:
    STEREONAV_INLINE Band(const CasterScene& scene, const CasterView& view, const CasterBand& band,
                          const CasterTarget& target, float* scratch)
        : mScene(scene),
          mView(view),
          mBand(band),
          mTarget(target),
          mEye(makeEye(scene.ground, view)),
          mRing(scratch + kMargin + kLanes),
          mPitch(view.lanes + 2 * (kMargin + kLanes)) {}

    void cast() {
        if (mView.verticalColumns && mView.coherent) return castColumns();
        for (int q = mBand.firstStep; q < mBand.endStep; ++q) {
            const int begin = bandEdge(mBand.left, mBand.leftSlope, q, mView.lanes);
            const int end = bandEdge(mBand.right, mBand.rightSlope, q, mView.lanes);
            float* row = depths(q);
            clear(row, begin - kMargin, begin);
            for (int a = begin; a < end; a += kLanes)
                castPacketAt(a, q, end - a < kLanes ? end - a : kLanes, row);
            clear(row, end, end + kMargin);
        }
    }

private:
    void castColumns() {
        const int begin = bandEdge(mBand.left, mBand.leftSlope, 0, mView.lanes);
        const int end = bandEdge(mBand.right, mBand.rightSlope, 0, mView.lanes);
        for (int a = begin; a < end; a += kLanes) {
            const int count = end - a < kLanes ? end - a : kLanes;
            const M lanes = firstLanes(count);
            Columns columns(mEye, raysOfRow(mView, a, mBand.firstStep), lanes);
            for (int q = mBand.firstStep; q < mBand.endStep; ++q) {
                const Hits hits = columns.cast(mView.base[2] + q * mView.perStep[2]);
                put(a, q, count, lanes, hits.t, shadePacket(mScene, mView, columns.rays(), hits, lanes));
            }
        }
    }

    float* depths(int q) { return mRing + static_cast<std::int64_t>(q & (kRows - 1)) * mPitch; }

    void clear(float* row, int from, int to) {
        if (from < -kMargin) from = -kMargin;
        if (to > mView.lanes + kMargin) to = mView.lanes + kMargin;
        for (int a = from; a < to; ++a) row[a] = 0.0f;
    }

    void castPacketAt(int a, int q, int count, float* row) {
        const M lanes = firstLanes(count);
        const Rays rays = raysOfRow(mView, a, q);
        const F start = coherentStart(rays, a, q);
        const I level = select(start > F(0.0f), I(0), I(kColdLevel < mScene.ground.levels ? kColdLevel : 0));
        const Hits hits = castPacket(mEye, rays, start, level, lanes);
        const I color = shadePacket(mScene, mView, rays, hits, lanes);
        store(row + a, hits.free, lanes);
        put(a, q, count, lanes, hits.t, color);
    }

    STEREONAV_INLINE F coherentStart(const Rays& rays, int a, int q) {
        if (!mView.coherent) return F(0.0f);
        const double lowQ = mView.lowQ - q * mView.lowW;
        if (!(lowQ < 0)) return F(0.0f);
        const double drift = (mView.lowA - (a + kLanes / 2) * mView.lowW) / -lowQ;  // lanes a step down
        const F sx(static_cast<float>(mScene.ground.spacingX)),
            sy(static_cast<float>(mScene.ground.spacingY));
        const Heading ray = headingOf(rays.x * sx, rays.y * sy, rays.z);
        F start(0.0f);
        for (int back = 1; back <= 4 && back <= q - mBand.firstStep; back *= 2) {
            const double exactShift = drift * back;
            if (!(exactShift > -8 && exactShift < 8)) break;
            const int shift = static_cast<int>(exactShift + (exactShift < 0 ? -0.5 : 0.5));
            const auto change = [&](int k) {
                return F(static_cast<float>(shift * mView.perLane[k] - back * mView.perStep[k]));
            };
            const Heading lower =
                headingOf((rays.x + change(0)) * sx, (rays.y + change(1)) * sy, rays.z + change(2));
            start = max(start, startFrom(mScene.ground, ray, lower, loadF(depths(q - back) + a + shift)));
            if (all(start > F(0.0f))) break;
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
    const Eye mEye;
    float* const mRing;
    const std::int64_t mPitch;
};

void castBand(const CasterScene& scene, const CasterView& view, const CasterBand& band,
              const CasterTarget& target, float* scratch) {
    Band(scene, view, band, target, scratch).cast();
}

// Lane and step of a picture's pixel.
struct Place {
    int a, q;
};

STEREONAV_INLINE Place placeOf(const CasterView& view, CasterPixel p) {
    const int dx = p.x - view.firstX, dy = p.y - view.firstY;
    return {dx * view.laneX + dy * view.laneY, dx * view.stepX + dy * view.stepY};
}

STEREONAV_INLINE Rays raysOfPixels(const CasterView& view, const CasterPixel* pixels, int count) {
    alignas(64) double direction[3][kLanes];
    for (int k = 0; k < kLanes; ++k) {
        const Place p = placeOf(view, pixels[k < count ? k : 0]);
        for (int c = 0; c < 3; ++c)
            direction[c][k] = view.base[c] + p.a * view.perLane[c] + p.q * view.perStep[c];
    }
    Rays r;
    __builtin_memcpy(&r.exactX, direction[0], sizeof r.exactX);
    __builtin_memcpy(&r.exactY, direction[1], sizeof r.exactY);
    __builtin_memcpy(&r.exactZ, direction[2], sizeof r.exactZ);
    r.x = toFloat(r.exactX);
    r.y = toFloat(r.exactY);
    r.z = toFloat(r.exactZ);
    return r;
}

STEREONAV_INLINE void scatter(const CasterTarget& target, const CasterPixel* pixels, int count, F t,
                              I color) {
    alignas(64) float depth[kLanes];
    alignas(64) std::uint32_t packed[kLanes];
    store(depth, t);
    store(packed, color);
    for (int k = 0; k < count; ++k) {
        target.depth[pixels[k].y * target.depthStride + pixels[k].x] = depth[k];
        target.color[pixels[k].y * target.colorStride + pixels[k].x] = packed[k];
    }
}

STEREONAV_INLINE F startsOf(const CasterBatch& batch, int first, int count) {
    alignas(64) float start[kLanes] = {};
    for (int k = 0; k < count; ++k) start[k] = batch.start[first + k];
    return loadF(start);
}

void castPixels(const CasterScene& scene, const CasterView& view, const CasterBatch& batch,
                const CasterTarget& target) {
    const Eye eye = makeEye(scene.ground, view);
    const int cold = kColdLevel < scene.ground.levels ? kColdLevel : 0;
    for (int first = 0; first < batch.count; first += kLanes) {
        const int count = batch.count - first < kLanes ? batch.count - first : kLanes;
        const M lanes = firstLanes(count);
        const Rays rays = raysOfPixels(view, batch.pixels + first, count);
        const F start = startsOf(batch, first, count);
        const Hits hits = castPacket(eye, rays, start, select(start > F(0.0f), I(0), I(cold)), lanes);
        scatter(target, batch.pixels + first, count, hits.t, shadePacket(scene, view, rays, hits, lanes));
    }
}

// What shading needs to know of points at known depths.
STEREONAV_INLINE Hits hitsAt(const GroundData& ground, const Eye& eye, const Rays& rays, F t, M lanes) {
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
    hits.approach = rays.z - rays.x * mulAdd(hits.v, twist, du) - rays.y * mulAdd(hits.u, twist, dv);
    hits.free = F(0.0f);
    return hits;
}

void shadeRow(const CasterScene& scene, const CasterView& view, int y, const CasterTarget& target) {
    const Eye eye = makeEye(scene.ground, view);
    const int q = (y - view.firstY) * view.stepY;
    float* depth = target.depth + y * target.depthStride;
    std::uint32_t* color = target.color + y * target.colorStride;
    for (int x = 0; x < view.lanes; x += kLanes) {
        const M lanes = firstLanes(view.lanes - x);
        const Rays rays = raysOfRow(view, x, q);
        const Hits hits = hitsAt(scene.ground, eye, rays, loadF(depth + x), lanes);
        store(color + x, shadePacket(scene, view, rays, hits, lanes), lanes);
    }
}

}  // namespace

constinit const CasterKernels kCasterKernels = {kName, kLanes, castBand, castPixels, shadeRow};

}  // namespace stereonav::STEREONAV_ISA
