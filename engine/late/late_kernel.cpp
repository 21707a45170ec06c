// The late warp's inner loops. Where the surface is smooth, u = a + i(u) d is solved by putting u in again,
// beginning with the inverse depth of the row above; neighbours differ by so little there that each time
// leaves less than a third of the error. Where depths jump, each ray is followed from near to far in steps of
// a pixel until it gets behind what is seen.
#include "engine/late/late_row.h"
#include "engine/simd/simd.h"

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr float kHalf = 0.5f;
constexpr float kSurfaceRise = 1.5f;  // steps: more between two of them is a jump
constexpr float kSame = 0.03f;        // relative: inverse depths of one surface, beside each other
// A factor on the nearest of four neighbours' depths: a pixel that lies farther than that is half covered by
// it where edges are smooth, and moves with it. What is farther would keep its colours, a line where it was.
// Without this: 1 to 3 dB less in terrain and in the colon (docs/measured.md), at all ages; also where edges
// are not smooth.
constexpr float kFront = 1.1f;

struct Place {
    F u, v;  // pixel of the picture that was cast
};

// Rays of a vector of pixels.
struct Rays {
    F a, b, du, dv;
    STEREONAV_INLINE Place at(F inverse) const { return {mulAdd(inverse, du, a), mulAdd(inverse, dv, b)}; }
};

STEREONAV_INLINE Rays raysOf(const LateMove& move, F x, float y) {
    const auto row = [&](int n) {
        return mulAdd(x, F(move.rows[n][0]), F(move.rows[n][1] * y + move.rows[n][2]));
    };
    // Places beside or behind the picture that was cast get its border.
    const F z = row(2), forward = max(z, F(1e-6f));
    // Exact: where the eye only moves, places lie on the borders of pixels, and the approximations of
    // different processors lead to different sides.
    const F one = F(1.0f) / forward;
    const F a = row(0) * one, b = row(1) * one;
    return {a, b, F(move.shift[0]) - F(move.shift[2]) * a, F(move.shift[1]) - F(move.shift[2]) * b};
}

STEREONAV_INLINE F nearestInverse(const LateSource& source, const Place& place) {
    const F u = clamp(place.u, F(0.0f), F(static_cast<float>(source.width) - kHalf));
    const F v = clamp(place.v, F(0.0f), F(static_cast<float>(source.height) - kHalf));
    const I index = truncateToInt(v) * I(source.inverseStride) + truncateToInt(u);
    return gather(source.inverse, index, firstLanes(kLanes), F(0.0f));
}

// Two channels of ten bits in the halves of a lane.
STEREONAV_INLINE I outer(I color) {
    return (color & I(1023)) | (shiftRight<4>(color) & I(0x03ff0000));
}
STEREONAV_INLINE I middle(I color) {
    return shiftRight<10>(color) & I(1023);
}
STEREONAV_INLINE I packed(I outer, I middle) {
    return (outer & I(1023)) | (shiftLeft<4>(outer) & I(0x3ff00000)) | shiftLeft<10>(middle & I(1023));
}
STEREONAV_INLINE I bothHalves(F share) {
    const I t = min(truncateToInt(share * F(32768.0f)), I(32767));
    return t | shiftLeft<16>(t);
}

struct Corner {
    I x, y;  // upper left pixel of four neighbours
    F right, down;
};
STEREONAV_INLINE Corner cornerOf(const LateSource& source, const Place& place) {
    const F u = clamp(place.u - F(kHalf), F(0.0f), F(static_cast<float>(source.width - 1)));
    const F v = clamp(place.v - F(kHalf), F(0.0f), F(static_cast<float>(source.height - 1)));
    const I x = min(truncateToInt(u), I(source.width > 1 ? source.width - 2 : 0)),
            y = min(truncateToInt(v), I(source.height > 1 ? source.height - 2 : 0));
    return {x, y, u - toFloat(x), v - toFloat(y)};
}

STEREONAV_INLINE I lerpColors(I a, I b, I c, I d, F right, F down) {
    const I s = bothHalves(right), t = bothHalves(down);
    const I edges = lerpHalves(lerpHalves(outer(a), outer(b), s), lerpHalves(outer(c), outer(d), s), t);
    const I green = lerpHalves(lerpHalves(middle(a), middle(b), s), lerpHalves(middle(c), middle(d), s), t);
    return packed(edges, green);
}

STEREONAV_INLINE I colorAt(const LateSource& source, const Place& place) {
    const Corner corner = cornerOf(source, place);
    const I index = corner.y * I(source.colorStride) + corner.x;
    const int below = source.height > 1 ? source.colorStride : 0;
    const M every = firstLanes(kLanes);
    const IPair up = gatherPair(source.color, index, every);
    const IPair low = gatherPair(source.color + below, index, every);
    return lerpColors(up.first, up.second, low.first, low.second, corner.right, corner.down);
}

// Only neighbours that lie on the surface at `inverse` give their colour: edges stay edges, and what is
// stretched into uncovered places has nothing of what stood before it.
STEREONAV_INLINE I colorOfSurface(const LateSource& source, const Place& place, F inverse, F reach) {
    const Corner corner = cornerOf(source, place);
    const I index = corner.y * I(source.colorStride) + corner.x,
            where = corner.y * I(source.inverseStride) + corner.x;
    const int below = source.height > 1 ? source.colorStride : 0,
              under = source.height > 1 ? source.inverseStride : 0;
    const M every = firstLanes(kLanes);
    const IPair up = gatherPair(source.color, index, every);
    const IPair low = gatherPair(source.color + below, index, every);
    const FPair upper = gatherPair(source.inverse, where, every);
    const FPair lower = gatherPair(source.inverse + under, where, every);
    const auto weight = [&](F depth, F share) { return keep(abs(depth - inverse) <= reach, share); };
    const F right = corner.right, left = F(1.0f) - right, down = corner.down, above = F(1.0f) - down;
    const F w0 = weight(upper.first, left * above), w1 = weight(upper.second, right * above),
            w2 = weight(lower.first, left * down), w3 = weight(lower.second, right * down);
    const F top = w0 + w1, bottom = w2 + w3, sum = top + bottom;
    // The shares as they would be of four that are all there; of none, all four as they lie.
    const M some = sum > F(1e-4f);
    const I a = select(w0 > F(0.0f), up.first, up.second), b = select(w1 > F(0.0f), up.second, up.first);
    const I c = select(w2 > F(0.0f), low.first, low.second), d = select(w3 > F(0.0f), low.second, low.first);
    const M upperSome = top > F(0.0f), lowerSome = bottom > F(0.0f);
    const F t = select(some, bottom / max(sum, F(1e-4f)), down);
    const I a2 = select(upperSome | ~some, a, c), b2 = select(upperSome | ~some, b, d);
    const I c2 = select(lowerSome | ~some, c, a), d2 = select(lowerSome | ~some, d, b);
    return lerpColors(select(some, a2, up.first), select(some, b2, up.second), select(some, c2, low.first),
                      select(some, d2, low.second), right, t);
}

struct Found {
    F inverse;
    M uncovered;
};

// Follows rays from near to far: a ray meets what is seen where it was before it a step ago and is behind it
// now, unless the depth jumped between. One that gets behind at a jump passes behind what stands there; where
// it comes out again it goes on, else it shows the place before the jump.
STEREONAV_INLINE Found followed(const LateSource& source, const LatePlan& plan, const Rays& rays) {
    const float step = (plan.nearest - plan.farthest) / static_cast<float>(plan.steps);
    const F slack(1e-6f + 1e-3f * plan.nearest), most(kSurfaceRise * step);
    F met(0.0f), front(plan.nearest), before(plan.nearest);
    F hereBefore(plan.nearest + step), seenBefore(plan.nearest);
    M found = firstLanes(0), wasFront = firstLanes(0);
    for (int n = 0; n <= plan.steps; ++n) {
        const F here(n == plan.steps ? plan.farthest : plan.nearest - step * static_cast<float>(n));
        const F seen = nearestInverse(source, rays.at(here));
        const M behind = seen >= here;
        const M overtaken = seen <= here + F(step) + slack;
        const M meets = andNot(behind & (overtaken | (wasFront & (seen - seenBefore <= most))), found);
        // Where both lines cross between the two steps.
        const F gap = max(hereBefore - seenBefore, F(0.0f)), over = seen - here;
        const F part = gap / max(gap + over, F(1e-20f));
        const F crossing = select(wasFront, mulAdd(part, here - hereBefore, hereBefore), seen);
        met = select(meets, crossing, met);
        found = found | meets;
        if (all(found)) break;
        const M isFront = ~(behind | found);
        before = select(isFront, select(wasFront, front, here), before);
        front = select(isFront, here, front);
        wasFront = isFront;
        hereBefore = here;
        seenBefore = seen;
    }
    // The last bit of the way. What then lies on another surface is left as it was.
    const F again = nearestInverse(source, rays.at(met));
    met = select(abs(again - met) <= abs(met) * F(kSame), again, met);
    return {select(found, met, before), ~found};
}

STEREONAV_INLINE void storePixels(std::uint32_t* to, I color, int count) {
    if (count >= kLanes)
        store(to, color);
    else
        store(to, color, firstLanes(count));
}

// Returns whether a place is outside of what was cast.
STEREONAV_INLINE M isBeside(const LateSource& source, const Place& place) {
    return (place.u < F(0.0f)) | (place.v < F(0.0f)) | (place.u > F(static_cast<float>(source.width))) |
           (place.v > F(static_cast<float>(source.height)));
}

inline void mark(std::uint8_t* to, M uncovered, int count) {
    const std::uint32_t set = bits(uncovered);
    for (int n = 0; n < kLanes && n < count; ++n) to[n] = (set >> n & 1u) != 0 ? 255 : 0;
}

constexpr int kVectors = kLateTileWidth / kLanes;

inline void warpTile(const LateBand& band, int tile) {
    const LateSource& source = *band.source;
    const LatePlan& plan = band.plans[tile];
    F last[kVectors], above[kVectors];  // inverse depths of the two rows above
    for (int part = 0; part < kVectors; ++part)
        above[part] = last[part] = F(kHalf * (plan.farthest + plan.nearest));
    for (int row = 0; row < band.rows; ++row) {
        const float y = static_cast<float>(band.top + row) + kHalf;
        for (int part = 0; part < kVectors; ++part) {
            const int x = tile * kLateTileWidth + part * kLanes;
            if (x >= band.width) break;
            const Rays rays = raysOf(*band.move, laneIndexF() + F(static_cast<float>(x) + kHalf), y);
            I color;
            M uncovered = firstLanes(0);
            Place place;
            if (plan.steps <= 0) {
                // The guess goes on as the rows above do.
                F inverse = row < 2 ? last[part] : last[part] + (last[part] - above[part]);
                const int times = plan.steps < 0 ? 0 : row == 0 ? 4 : row == 1 ? 2 : 1;
                for (int n = 0; n < times; ++n) inverse = nearestInverse(source, rays.at(inverse));
                above[part] = last[part];
                last[part] = inverse;
                place = rays.at(inverse);
                color = colorAt(source, place);
            } else {
                const Found found = followed(source, plan, rays);
                uncovered = found.uncovered;
                place = rays.at(found.inverse);
                const F inverse = select(uncovered, nearestInverse(source, place), found.inverse);
                // On a slope neighbours are further apart in depth, but not on the screen.
                const F pixel =
                    select(uncovered, F(0.0f), approxRsqrt(mulAdd(rays.du, rays.du, rays.dv * rays.dv)));
                color = colorOfSurface(source, place, inverse, max(inverse * F(kSame) + F(1e-9f), pixel));
            }
            std::uint32_t* const to = band.color + row * band.colorStride + x;
            storePixels(to, color, band.width - x);
            if (band.uncovered)
                mark(band.uncovered + row * band.uncoveredStride + x, uncovered | isBeside(source, place),
                     band.width - x);
        }
    }
}

// Returns the nearer depth; one that is not known, 0 or NaN, is not nearer.
inline F nearerOf(F z, F other) {
    return select((other > F(0.0f)) & (other < z), other, z);
}

// Fills depths that are not known with the farther of those known beside them.
inline void fillUnknown(const std::uint8_t* known, float* inverse, int width) {
    for (int x = 0; x < width;) {
        if (known[x]) {
            ++x;
            continue;
        }
        int end = x;
        while (end < width && !known[end]) ++end;
        const float left = x > 0 ? inverse[x - 1] : 3e38f, right = end < width ? inverse[end] : 3e38f;
        const float value = x == 0 && end == width ? 0.0f : left < right ? left : right;
        for (; x < end; ++x) inverse[x] = value;
    }
}

}  // namespace

void warpLateBand(const LateBand& band) {
    const int tiles = (band.width + kLateTileWidth - 1) / kLateTileWidth;
    for (int tile = 0; tile < tiles; ++tile) warpTile(band, tile);
}

void invertLateRow(const LateDepths& depths, int row) {
    constexpr int kMostPixels = 1 << 15;
    const float* const depth = depths.depth + static_cast<std::int64_t>(row) * depths.depthStride;
    const float* const above = row > 0 ? depth - depths.depthStride : depth;
    const float* const below = row + 1 < depths.height ? depth + depths.depthStride : depth;
    float* const inverse = depths.inverse + static_cast<std::int64_t>(row) * depths.inverseStride;
    float first[kLanes];  // what lies left of the first pixels
    for (int n = 0; n < kLanes; ++n) first[n] = depth[n > 0 ? n - 1 : 0];
    bool whole = true;
    for (int x = 0; x < depths.width; x += kLanes) {
        const int count = depths.width - x;
        const M inside = firstLanes(count < kLanes ? count : kLanes);
        const F z = loadF(depth + x);
        const M isKnown = z > F(0.0f);  // false of NaN
        F front = nearerOf(z, x > 0 ? loadF(depth + x - 1) : loadF(first));
        front = select(firstLanes(count - 1 < kLanes ? count - 1 : kLanes),
                       nearerOf(front, loadF(depth + x + 1)), front);
        front = nearerOf(nearerOf(front, loadF(above + x)), loadF(below + x));
        store(inverse + x, keep(isKnown, F(1.0f) / select(z > front * F(kFront), front, z)));
        whole = whole && all(isKnown | ~inside);
    }
    if (whole || depths.width > kMostPixels) return;
    std::uint8_t known[kMostPixels];
    for (int x = 0; x < depths.width; ++x) known[x] = depth[x] > 0.0f;
    fillUnknown(known, inverse, depths.width);
}

void measureLateTiles(const LateDepths& depths, int tileRow) {
    const int tiles = (depths.width + kLateTileWidth - 1) / kLateTileWidth;
    const int top = tileRow * kLateTileHeight;
    const int rows = depths.height - top < kLateTileHeight ? depths.height - top : kLateTileHeight;
    for (int tile = 0; tile < tiles; ++tile) {
        F low(3e38f), high(0.0f), jump(0.0f);
        for (int part = 0; part < kVectors; ++part) {
            const int x = tile * kLateTileWidth + part * kLanes;
            const int count = depths.width - x;
            if (count <= 0) break;
            const M inside = firstLanes(count < kLanes ? count : kLanes);
            const M hasNext = firstLanes(count - 1 < kLanes ? count - 1 : kLanes);
            for (int row = 0; row < rows; ++row) {
                const float* const at =
                    depths.inverse + static_cast<std::int64_t>(top + row) * depths.inverseStride + x;
                const F here = loadF(at);
                low = select(inside, min(low, here), low);
                high = select(inside, max(high, here), high);
                jump = select(hasNext, max(jump, abs(loadF(at + 1) - here)), jump);
                if (top + row + 1 < depths.height)
                    jump = select(inside, max(jump, abs(loadF(at + depths.inverseStride) - here)), jump);
            }
        }
        float lows[kLanes], highs[kLanes], jumps[kLanes];
        store(lows, low), store(highs, high), store(jumps, jump);
        LateTile& out = depths.tiles[tileRow * tiles + tile];
        out = {lows[0], highs[0], jumps[0]};
        for (int n = 1; n < kLanes; ++n) {
            out.farthest = lows[n] < out.farthest ? lows[n] : out.farthest;
            out.nearest = highs[n] > out.nearest ? highs[n] : out.nearest;
            out.jump = jumps[n] > out.jump ? jumps[n] : out.jump;
        }
    }
}

const LateKernels& lateKernels() {
    static constexpr LateKernels kernels{warpLateBand, invertLateRow, measureLateTiles};
    return kernels;
}

}  // namespace stereonav::STEREONAV_ISA
