// Least squared distance over the lines of a plane, kLanes columns side by side, for one instruction set.
// Takes the least of the parabolas of Felzenszwalb and Huttenlocher 2012, but without their lower envelope: a
// line at distance d can not improve a voxel whose distance is already below d, and lumens are narrow, so
// lines are tried outwards until none can improve any.
#include "engine/simd/simd.h"
#include "engine/volume/distance_kernel_types.h"

#if STEREONAV_ISA_avx512
// g++ 12 warns about its own undefined registers (gcc bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr int kMost = 65534, kNone = 65535;

STEREONAV_INLINE float squareOf(int n) {
    return static_cast<float>(n) * static_cast<float>(n);
}

// Returns the least squared distance over all lines, for kLanes columns of one line. start: the line's own
// squared distances.
STEREONAV_INLINE F leastOverLines(const DistancePlane& plane, const float* at, int line, F start) {
    F least = start;
    if (plane.seedsBelow) least = min(least, F(squareOf(line + 1) * plane.weight));
    const int above = plane.lines - 1 - line;
    if (plane.seedsAbove) least = min(least, F(squareOf(above + 1) * plane.weight));
    const int both = line < above ? line : above, last = line < above ? above : line;
    const float *down = at, *up = at;
    int d = 1;
    for (; d <= both; ++d) {
        const F away(squareOf(d) * plane.weight);
        if (!any(least > away)) return least;
        down -= plane.columns;
        up += plane.columns;
        least = min(least, min(loadF(down), loadF(up)) + away);
    }
    const std::ptrdiff_t step = line < above ? plane.columns : -plane.columns;
    const float* side = at + step * both;
    for (; d <= last; ++d) {
        const F away(squareOf(d) * plane.weight);
        if (!any(least > away)) return least;
        side += step;
        least = min(least, loadF(side) + away);
    }
    return least;
}

// Returns the distance in whole units, rounded down. The root in single precision is at most one unit too
// large, which double precision corrects.
STEREONAV_INLINE I inUnits(F squared, const DistanceUnits& units) {
    const F length = min(sqrt(squared) * F(units.perLength), F(static_cast<float>(kMost)));
    const I q = truncateToInt(length * F(1.000001f) + F(1e-6f));
    const D wide = toDouble(q);
    const M tooFar = toDouble(squared) * D(units.keep) < wide * wide * D(units.squaredUnit);
    const I rounded = min(q - select(tooFar, I(1), I(0)), I(kMost));
    return select(F(3.4028234e38f) < squared, I(kNone), rounded);
}

}  // namespace

void combineDistances(const DistancePlane& plane, float* to, std::ptrdiff_t stride) {
    for (int line = plane.begin; line < plane.end; ++line)
        for (int column = 0; column < plane.columns; column += kLanes) {
            const float* at = plane.from + static_cast<std::ptrdiff_t>(line) * plane.columns + column;
            const F own = loadF(at);
            if (!any(own > F(0.0f))) continue;
            store(to + (line - plane.begin) * stride + column, leastOverLines(plane, at, line, own));
        }
}

void finishDistances(const DistancePlane& plane, const DistanceUnits& units, std::uint16_t* to,
                     std::ptrdiff_t stride, int width) {
    for (int line = plane.begin; line < plane.end; ++line)
        for (int column = 0; column < width; column += kLanes) {
            const float* at = plane.from + static_cast<std::ptrdiff_t>(line) * plane.columns + column;
            const F own = loadF(at);
            if (!any(own > F(0.0f))) continue;
            std::int32_t results[kLanes];
            store(results, inUnits(leastOverLines(plane, at, line, own), units));
            std::uint16_t* out = to + (line - plane.begin) * stride + column;
            const int count = width - column < kLanes ? width - column : kLanes;
            for (int n = 0; n < count; ++n) out[n] = static_cast<std::uint16_t>(results[n]);
        }
}

}  // namespace stereonav::STEREONAV_ISA
