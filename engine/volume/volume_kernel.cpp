// Casts rectangles and scattered pixels of a volume, a packet of 4 by kLanes / 4 pixels at a time. A beam
// around a block of pixels goes first: as long as the free sphere around its axis is wider than the beam, no
// ray of the block meets anything, so all of them start where the beam ended. Compiled once for each
// instruction set.
#include "engine/volume/kernel_integral.h"

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr int kBlock = 4;  // pixels a side of a beam
constexpr int kPacketX = 4, kPacketY = kLanes / 4;
constexpr int kLargestSide = 64;  // pixels a side of a rectangle that is cast at once
constexpr float kLifted = 1.0f;   // voxels: a shadow's end before the surface
constexpr int kNoNormal = 512 | 512 << 10 | 512 << 20;
constexpr float kInFront = 1.0f - 4e-6f;  // for the rounding of a beam's end

STEREONAV_INLINE Walk startAt(const Grid& grid, const Rays& r, F t, M lanes) {
    return {t, grid.cellsAt(r.direction, t), lanes};
}

// Returns where the volume begins, for rays from outside; infinite where they miss it.
STEREONAV_INLINE F entryOf(const Grid& grid, const Rays& r) {
    const auto slab = [](F eye, I base, I last, F inverse, F& in, F& out) {
        const F a = (toFloat(I(0) - base) - eye) * inverse, b = (toFloat(last + I(1) - base) - eye) * inverse;
        in = max(in, min(a, b));
        out = min(out, max(a, b));
    };
    F in(0.0f), out(__builtin_inff());
    slab(grid.eyeX, grid.baseX, grid.lastX, r.inverse.x, in, out);
    slab(grid.eyeY, grid.baseY, grid.lastY, r.inverse.y, in, out);
    slab(grid.eyeZ, grid.baseZ, grid.lastZ, r.inverse.z, in, out);
    return select(in < out, in, F(__builtin_inff()));
}

STEREONAV_INLINE Walk startOutside(const Grid& grid, const Rays& r, F nearest, M lanes) {
    const F entry = max(entryOf(grid, r), nearest);
    const M meets = lanes & (entry < F(__builtin_inff()));
    Walk w = startAt(grid, r, select(meets, entry, nearest), meets);
    // Rounding may leave the entry just outside.
    w.at = {clamp(w.at.x + grid.baseX, I(0), grid.lastX) - grid.baseX,
            clamp(w.at.y + grid.baseY, I(0), grid.lastY) - grid.baseY,
            clamp(w.at.z + grid.baseZ, I(0), grid.lastZ) - grid.baseZ};
    return w;
}

// Beams around the axes through pixels (x, y) that hold all rays within `radius` (at unit view depth,
// metres). Gives the view depth up to which they are free.
STEREONAV_INLINE F castBeams(const Grid& grid, const VolumeView& view, F x, F y, F radius, M lanes) {
    const Rays r = makeRays(view, x, y);
    const F length = approxReciprocal(r.perMetre);
    const F slower = approxReciprocal(length + radius) * F(1.0f - 1e-5f);
    const F unit(grid.data.leapUnit);
    F t(view.nearDepth);
    M moving = lanes;
    while (any(moving)) {
        const Cells at = grid.cellsAt(r.direction, t);
        const M in = moving & grid.inside(at);
        const I code = grid.code(grid.index(at), in);
        const F free = toFloat(code - I(1)) * unit;
        const F ahead = (free - radius * t) * slower;
        // Less than the smallest leap is not worth a look; less than the depth's rounding would never end.
        moving = in & (ahead * length > unit) & (t < t + ahead);
        t = select(moving, t + ahead, t);
    }
    return t * F(kInFront);
}

struct Packet {
    const VolumeData& data;
    const VolumeView& view;
    Grid grid;
    I behind;

    STEREONAV_INLINE Packet(const VolumeData& d, const VolumeView& v)
        : data(d), view(v), grid(d.cells, v), behind(packedBackground(d.light)) {}

    // Depths, colours and, where wanted, packed normals of one packet of rays.
    struct Result {
        F depth;
        I color, normal;
        F spread;  // translucent alone
    };
    STEREONAV_INLINE Result cast(F x, F y, F start, M lanes, bool wantNormal) const {
        const Rays r = makeRays(view, x, y);
        const F nearest(view.nearDepth);
        Walk w = view.inside ? startAt(grid, r, max(start, nearest), lanes)
                             : startOutside(grid, r, max(start, nearest), lanes);
        if (data.transfer.extinction) {
            const Composite sum = data.transfer.integrals ? integratePacket(data, view, grid, r, w)
                                                          : compositePacket(data, view, grid, r, w);
            return {sum.first, compositeColor(data, sum), I(0), spreadOf(sum)};
        }
        Hits hits = noHits();
        while (any(w.active)) advance(grid, r, nearest, w, hits);
        return shaded(r, hits, wantNormal);
    }
    // Opaque surfaces, two packets at once.
    STEREONAV_INLINE void castPair(const F (&x)[2], const F (&y)[2], const F (&start)[2], const M (&lanes)[2],
                                   bool wantNormal, Result (&result)[2]) const {
        const Rays r[2] = {makeRays(view, x[0], y[0]), makeRays(view, x[1], y[1])};
        const F nearest(view.nearDepth);
        Walk w[2];
        for (int k = 0; k < 2; ++k)
            w[k] = view.inside ? startAt(grid, r[k], max(start[k], nearest), lanes[k])
                               : startOutside(grid, r[k], max(start[k], nearest), lanes[k]);
        Hits hits[2] = {noHits(), noHits()};
        while (any(w[0].active | w[1].active)) advancePair(grid, r, nearest, w, hits);
        for (int k = 0; k < 2; ++k) result[k] = shaded(r[k], hits[k], wantNormal);
    }
    // 0 where something lies between a hit and the lamp. Rays go from the lamp, which they share, and end a
    // little before the hit, so that the surface does not shade itself.
    F litShare(const Rays& r, const Hits& hits) const {
        if (!data.light.shadows) return F(1.0f);
        const auto place = [&](int k, F direction) {
            const F offset = F(static_cast<float>(view.base[k] - view.lampBase[k])) - F(view.lampEye[k]);
            return awayFromZero(mulAdd(select(hits.hit, hits.t, F(1.0f)), direction, F(view.eye[k])) +
                                offset);
        };
        Rays from;
        setDirection(from, {place(0, r.direction.x), place(1, r.direction.y), place(2, r.direction.z)},
                     view.lampEye);
        // t is the share of the way here.
        const F voxels = sqrt(dot(from.direction, from.direction));
        const F end = F(1.0f) - F(kLifted) * approxReciprocal(voxels);
        // Metres are the smallest of what they can be along the axes: leaps stay short enough.
        from.perMetre = approxReciprocal(voxels * F(data.light.largestSpacing));
        const Grid lamp(data.cells, view.lampBase, view.lampEye);
        Walk w = view.lampInside ? startAt(lamp, from, F(0.0f), hits.hit)
                                 : startOutside(lamp, from, F(0.0f), hits.hit);
        Hits shade = noHits();
        while (any(w.active)) {
            advance(lamp, from, F(0.0f), w, shade);
            w.active = w.active & (w.t < end);
        }
        return select(shade.t < end, F(0.0f), F(1.0f));
    }
    // Returns the cells that the hits are in.
    STEREONAV_INLINE Cells cellsOf(const Rays& r, const Hits& hits) const {
        const F t = select(hits.hit, hits.t, F(0.0f));
        const auto cell = [&](F eye, F direction, F local) {
            return floorToInt(mulAdd(t, direction, eye) - local + F(0.5f));
        };
        return {cell(grid.eyeX, r.direction.x, hits.local.x), cell(grid.eyeY, r.direction.y, hits.local.y),
                cell(grid.eyeZ, r.direction.z, hits.local.z)};
    }
    // Normals that nothing asked for are left at none: whoever shades again will not ask either.
    STEREONAV_INLINE Result shaded(const Rays& r, const Hits& hits, bool wantNormal) const {
        // Normals of misses are then 0, as those of misses beside hits are.
        if (data.studio.words && !any(hits.hit)) return {hits.t, behind, I(0), F(0.0f)};
        Channels n = openChannels(I(kNoNormal));
        const I color = surfaceColor(data, view, r, hits.t, hits.hit, behind, [&](F t) {
            const auto values = [&] { return cornersOf(grid, hits.word, cellsOf(r, hits), hits.hit); };
            n = normalIn(grid.data, hits.word, values, hits.local, hits.hit);
            return litBy(data, view, r, t, directionOf(n), litShare(r, hits));
        });
        return {hits.t, color, wantNormal ? closeChannels(n) : I(0), F(0.0f)};
    }
};

// Rectangles: packets in blocks, blocks in pieces of at most kLargestSide.
class RectCaster {
public:
    STEREONAV_INLINE RectCaster(const VolumeData& data, const VolumeView& view, const VolumeTarget& target,
                                bool fromDepth)
        : mPacket(data, view), mTarget(target), mFromDepth(fromDepth) {}

    void cast(const VolumeRect& rect) {
        const bool beams = mPacket.view.inside && mPacket.data.cells.leaping && !mFromDepth;
        if (beams) castBlockBeams(rect);
        if (!mPacket.data.transfer.extinction && !mFromDepth) return castPairs(rect, beams);
        for (int y = rect.y0; y < rect.y1; y += kPacketY)
            for (int x = rect.x0; x < rect.x1; x += kPacketX) {
                const int block = (y - rect.y0) / kBlock * kBlocks + (x - rect.x0) / kBlock;
                castAt(x, y, rect, beams ? mStart[block] : 0.0f);
            }
    }

private:
    static constexpr int kBlocks = kLargestSide / kBlock;

    // Packets side by side; in an odd column the last one's second packet is empty.
    void castPairs(const VolumeRect& rect, bool beams) {
        for (int y = rect.y0; y < rect.y1; y += kPacketY)
            for (int x = rect.x0; x < rect.x1; x += 2 * kPacketX) castPairAt(x, y, rect, beams);
    }
    void castPairAt(int x, int y, const VolumeRect& rect, bool beams) {
        const I lane = laneIndex();
        const I across = lane & I(3), down = shiftRight<2>(lane);
        const int block = (y - rect.y0) / kBlock * kBlocks + (x - rect.x0) / kBlock;
        const M rows = down < I(rect.y1 - y);
        const F px[2] = {toFloat(across + I(x)), toFloat(across + I(x + kPacketX))};
        const F row = toFloat(down + I(y)), py[2] = {row, row};
        const F start[2] = {F(beams ? mStart[block] : 0.0f), F(beams ? mStart[block + 1] : 0.0f)};
        const M lanes[2] = {rows & (across < I(rect.x1 - x)), rows & (across < I(rect.x1 - x - kPacketX))};
        Packet::Result result[2];
        mPacket.castPair(px, py, start, lanes, mTarget.normal != nullptr, result);
        put(x, y, rect, result[0]);
        if (x + kPacketX < rect.x1) put(x + kPacketX, y, rect, result[1]);
    }

    void castBlockBeams(const VolumeRect& rect) {
        const int rows = (rect.y1 - rect.y0 + kBlock - 1) / kBlock;
        constexpr int kAll = kBlocks * kBlocks;
        const float side = 0.5f * (kBlock - 1) + 0.01f;
        const float dx = side * mPacket.view.pixelWidth, dy = side * mPacket.view.pixelHeight;
        const F radius = sqrt(F(dx * dx + dy * dy));
        for (int n = 0; n < rows * kBlocks && n < kAll; n += kLanes) {
            const I number = laneIndex() + I(n);
            const I row = shiftRight<4>(number), column = number & I(kBlocks - 1);
            const F x = toFloat(column * I(kBlock) + I(rect.x0)) + F(0.5f * (kBlock - 1));
            const F y = toFloat(row * I(kBlock) + I(rect.y0)) + F(0.5f * (kBlock - 1));
            const M lanes = (column * I(kBlock) < I(rect.x1 - rect.x0)) & (row < I(rows));
            store(mStart + n, castBeams(mPacket.grid, mPacket.view, x, y, radius, lanes));
        }
    }

    STEREONAV_INLINE void castAt(int x, int y, const VolumeRect& rect, float start) {
        const I lane = laneIndex();
        const I across = lane & I(3), down = shiftRight<2>(lane);
        const M lanes = (across < I(rect.x1 - x)) & (down < I(rect.y1 - y));
        const F px = toFloat(across + I(x)), py = toFloat(down + I(y));
        F from(start);
        M cast = lanes;
        if (mFromDepth) {
            from = depthsAt(x, y, rect);
            cast = lanes & (from < F(__builtin_inff()));
            from = select(cast, from, F(0.0f));
        }
        put(x, y, rect, mPacket.cast(px, py, from, cast, mTarget.normal != nullptr));
    }

    F depthsAt(int x, int y, const VolumeRect& rect) const {
        alignas(64) float depth[kLanes] = {};
        for (int k = 0; k < kLanes; ++k)
            if (x + (k & 3) < rect.x1 && y + (k >> 2) < rect.y1)
                depth[k] = mTarget.depth[(y + (k >> 2)) * mTarget.depthStride + x + (k & 3)];
        return loadF(depth);
    }

    STEREONAV_INLINE void put(int x, int y, const VolumeRect& rect, const Packet::Result& result) {
        alignas(64) float depth[kLanes], spread[kLanes];
        alignas(64) std::uint32_t color[kLanes], normal[kLanes];
        store(depth, result.depth);
        store(color, result.color);
        store(normal, result.normal);
        store(spread, result.spread);
        const int columns = rect.x1 - x < kPacketX ? rect.x1 - x : kPacketX;
        const int rows = rect.y1 - y < kPacketY ? rect.y1 - y : kPacketY;
        for (int j = 0; j < rows; ++j) {
            copyRow(mTarget.depth + (y + j) * mTarget.depthStride + x, depth + j * kPacketX, columns);
            copyRow(mTarget.color + (y + j) * mTarget.colorStride + x, color + j * kPacketX, columns);
            if (mTarget.normal)
                copyRow(mTarget.normal + (y + j) * mTarget.normalStride + x, normal + j * kPacketX, columns);
            if (mTarget.depthSpread)
                copyRow(mTarget.depthSpread + (y + j) * mTarget.depthStride + x, spread + j * kPacketX,
                        columns);
        }
    }

    template <typename T>
    STEREONAV_INLINE static void copyRow(T* to, const T* from, int columns) {
        if (columns == kPacketX) {
            __builtin_memcpy(to, from, sizeof(T) * kPacketX);
            return;
        }
        for (int i = 0; i < columns; ++i) to[i] = from[i];
    }

    const Packet mPacket;
    const VolumeTarget& mTarget;
    const bool mFromDepth;
    alignas(64) float mStart[kBlocks * kBlocks + 1];
};

void castRect(const VolumeData& data, const VolumeView& view, const VolumeRect& rect,
              const VolumeTarget& target, bool fromDepth) {
    RectCaster caster(data, view, target, fromDepth);
    for (int y = rect.y0; y < rect.y1; y += kLargestSide)
        for (int x = rect.x0; x < rect.x1; x += kLargestSide)
            caster.cast({x, y, x + kLargestSide < rect.x1 ? x + kLargestSide : rect.x1,
                         y + kLargestSide < rect.y1 ? y + kLargestSide : rect.y1});
}

// Scattered pixels, in packets of neighbours in the list. A ray starts at the depth that is known to be free,
// or else where the beam around its packet ends; as many beams are cast side by side as there are lanes.
class PixelCaster {
public:
    STEREONAV_INLINE PixelCaster(const VolumeData& data, const VolumeView& view, const VolumeTarget& target,
                                 const VolumePixel* pixels, int count)
        : mPacket(data, view), mTarget(target), mPixels(pixels), mCount(count) {}

    void cast() {
        const bool opaque = !mPacket.data.transfer.extinction;
        for (int first = 0; first < mCount; first += 2 * kLanes)
            if (opaque && first + kLanes < mCount) {
                castPair(first);
            } else {
                castOne(first);
                if (first + kLanes < mCount) castOne(first + kLanes);
            }
    }

private:
    struct Some {
        F x, y, start;
        M lanes;
    };

    STEREONAV_INLINE int lanesFrom(int first) const {
        return mCount - first < kLanes ? mCount - first : kLanes;
    }

    STEREONAV_INLINE Some takeFrom(int first) {
        alignas(64) float x[kLanes] = {}, y[kLanes] = {}, start[kLanes] = {};
        const int some = lanesFrom(first);
        bool known = true;
        for (int k = 0; k < some; ++k) {
            const VolumePixel p = mPixels[first + k];
            x[k] = p.x;
            y[k] = p.y;
            start[k] = mTarget.depth[p.y * mTarget.depthStride + p.x];
            known = known && start[k] > 0;
        }
        return {loadF(x), loadF(y), max(loadF(start), F(known ? 0.0f : beamOf(first))), firstLanes(some)};
    }

    void castOne(int first) {
        const Some s = takeFrom(first);
        store(first, mPacket.cast(s.x, s.y, s.start, s.lanes, mTarget.normal != nullptr));
    }

    void castPair(int first) {
        const Some a = takeFrom(first), b = takeFrom(first + kLanes);
        const F x[2] = {a.x, b.x}, y[2] = {a.y, b.y}, start[2] = {a.start, b.start};
        const M lanes[2] = {a.lanes, b.lanes};
        Packet::Result result[2];
        mPacket.castPair(x, y, start, lanes, mTarget.normal != nullptr, result);
        store(first, result[0]);
        store(first + kLanes, result[1]);
    }

    STEREONAV_INLINE void store(int first, const Packet::Result& result) const {
        alignas(64) float depth[kLanes];
        alignas(64) std::uint32_t color[kLanes], normal[kLanes];
        STEREONAV_ISA::store(depth, result.depth);
        STEREONAV_ISA::store(color, result.color);
        STEREONAV_ISA::store(normal, result.normal);
        for (int k = 0; k < lanesFrom(first); ++k) {
            const VolumePixel p = mPixels[first + k];
            mTarget.depth[p.y * mTarget.depthStride + p.x] = depth[k];
            mTarget.color[p.y * mTarget.colorStride + p.x] = color[k];
            if (mTarget.normal) mTarget.normal[p.y * mTarget.normalStride + p.x] = normal[k];
        }
    }

    // The beam of the packet that starts with pixel `first`; 0 where there are none.
    float beamOf(int first) {
        if (!mPacket.view.inside || !mPacket.data.cells.leaping) return 0.0f;
        const int group = first / (kLanes * kLanes);
        if (group != mBeamGroup) castBeamsFrom((mBeamGroup = group) * kLanes * kLanes);
        return mBeams[first / kLanes % kLanes];
    }

    // Beams around the next kLanes packets.
    void castBeamsFrom(int first) {
        alignas(64) float x[kLanes] = {}, y[kLanes] = {}, radius[kLanes] = {};
        int beams = 0;
        for (int begin = first; beams < kLanes && begin < mCount; begin += kLanes, ++beams) {
            const int end = begin + kLanes < mCount ? begin + kLanes : mCount;
            int low[2] = {65536, 65536}, high[2] = {0, 0};
            for (int k = begin; k < end; ++k) {
                const int at[2] = {mPixels[k].x, mPixels[k].y};
                for (int axis = 0; axis < 2; ++axis) {
                    low[axis] = at[axis] < low[axis] ? at[axis] : low[axis];
                    high[axis] = at[axis] > high[axis] ? at[axis] : high[axis];
                }
            }
            x[beams] = 0.5f * static_cast<float>(low[0] + high[0]);
            y[beams] = 0.5f * static_cast<float>(low[1] + high[1]);
            const float dx = (0.5f * static_cast<float>(high[0] - low[0]) + 0.01f) * mPacket.view.pixelWidth;
            const float dy = (0.5f * static_cast<float>(high[1] - low[1]) + 0.01f) * mPacket.view.pixelHeight;
            radius[beams] = __builtin_sqrtf(dx * dx + dy * dy);
        }
        STEREONAV_ISA::store(mBeams, castBeams(mPacket.grid, mPacket.view, loadF(x), loadF(y), loadF(radius),
                                               firstLanes(beams)));
    }

    const Packet mPacket;
    const VolumeTarget& mTarget;
    const VolumePixel* const mPixels;
    const int mCount;
    int mBeamGroup = -1;
    alignas(64) float mBeams[kLanes] = {};
};

void castPixels(const VolumeData& data, const VolumeView& view, const VolumePixel* pixels, int count,
                const VolumeTarget& target) {
    PixelCaster(data, view, target, pixels, count).cast();
}

// Data and view by value: what is stored can not change them, so that they stay in registers.
// kPlaces: light is looked up where the surface is.
template <bool kPlaces>
STEREONAV_INLINE void shadeBlocks(const VolumeData data, const VolumeView view, int y, int x0, int x1,
                                  const VolumeTarget& target) {
    const float* depth = target.depth + y * target.depthStride;
    std::uint32_t* color = target.color + y * target.colorStride;
    const std::uint32_t* normal = target.normal + y * target.normalStride;
    const I behind = packedBackground(data.light);
    const F row(static_cast<float>(y));
    for (int x = x0; x < x1; x += kLanes) {
        const F column = laneIndexF() + F(static_cast<float>(x));
        const F met = loadF(depth + x);
        const M lanes = firstLanes(x1 - x) & (met > F(0.0f));
        const M hit = lanes & (met < F(__builtin_inff()));
        const auto lampAt = [&](const Rays& r, F t) {
            return litBy(data, view, r, t, directionOf(openChannels(loadI(normal + x))), F(1.0f));
        };
        if constexpr (kPlaces) {
            const Rays r = makeRays(view, column, row);
            const I shown = surfaceColor(data, view, r, met, hit, behind, [&](F t) { return lampAt(r, t); });
            store(color + x, shown, lanes);
        } else {
            Rays r;
            setWindow(r, view, column, row);
            const F t = select(hit, met, F(1.0f));
            const Falling falling = ofLamp(lampAt(r, t), F(1.0f));
            store(color + x, sentColor(data.light, r, t, hit, falling, behind), lanes);
        }
    }
}

void shadeRow(const VolumeData& data, const VolumeView& view, int y, int x0, int x1,
              const VolumeTarget& target) {
    if (looksUpLight(data))
        shadeBlocks<true>(data, view, y, x0, x1, target);
    else
        shadeBlocks<false>(data, view, y, x0, x1, target);
}

}  // namespace

constinit const VolumeKernels kVolumeKernels = {kName, kLanes, castRect, castPixels, shadeRow};

}  // namespace stereonav::STEREONAV_ISA
