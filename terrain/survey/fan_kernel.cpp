// Bounds of a fan's bins, and what they tell of samples. Compiled once for each instruction set.
#include <limits>

#include "engine/simd/simd.h"
#include "terrain/survey/fan_rows.h"
#include "terrain/survey/fan_tops.h"

namespace stereonav::STEREONAV_ISA {
namespace {

STEREONAV_INLINE F lanesFrom(int first) {
    return laneIndexF() + F(static_cast<float>(first));
}

// Height of the surface at a row of the column.
STEREONAV_INLINE F heightOnLine(const float* height, F row, int rows, M lanes) {
    const I below = min(floorToInt(row), I(rows - 2));
    const FPair ends = gatherPair(height, below, lanes);
    return mulAdd(row - toFloat(below), ends.second - ends.first, ends.first);
}

// Returns the largest magnitude among finite values in lanes, or `most` where it is larger.
STEREONAV_INLINE F largerSize(F most, F value, M lanes) {
    const F size = max(value, F(0.0f) - value);
    return max(most, keep(lanes & (size <= F(std::numeric_limits<float>::max())), size));
}
STEREONAV_INLINE float largestLane(F value) {
    float lanes[kLanes];
    store(lanes, value);
    float most = lanes[0];
    for (int k = 1; k < kLanes; ++k) most = lanes[k] > most ? lanes[k] : most;
    return most;
}

}  // namespace

void readHeights(ReadRow& row) {
    F tallest(row.tallest), steepest(row.steepest);
    if (row.ahead != 0)
        for (int k = row.aheadRow; k < row.count; k += ReadRow::kTopRows)
            __builtin_prefetch(row.ground + k * row.stride + row.ahead);
    const I places = laneIndex() * I(static_cast<int>(row.stride));
    for (int k = 0; k < row.count; k += kLanes) {
        const M lanes = firstLanes(row.count - k);
        const float* const from = row.ground + k * row.stride;
        const F ground =
            row.stride == 1 && k + kLanes <= row.count ? loadF(from) : gather(from, places, lanes, F(0.0f));
        const F height = (ground - F(row.eye)) - F(row.eyeRest);
        store(row.height + k, height, lanes);
        tallest = largerSize(tallest, height, lanes);
    }
    for (int k = 0; k + 1 < row.count; k += kLanes)
        steepest = largerSize(steepest, loadF(row.height + k + 1) - loadF(row.height + k),
                              firstLanes(row.count - 1 - k));
    for (int k = 0; k < row.count; k += ReadRow::kTopRows) {
        const F below(std::numeric_limits<float>::lowest());
        F top = below;
        for (int n = k; n < k + ReadRow::kTopRows; n += kLanes) {
            const F height = loadF(row.height + n);
            const M known = firstLanes(row.count - n) & (height <= F(std::numeric_limits<float>::max()));
            top = max(top, select(known, height, below));
        }
        row.tops[k / ReadRow::kTopRows] = largestLane(top);
    }
    row.tallest = largestLane(tallest), row.steepest = largestLane(steepest);
}

void raiseLow(const LowRow& row) {
    const FanBins& bins = row.bins;
    const F top(static_cast<float>(row.rows - 1));
    for (int b = 0; b < bins.count; b += kLanes) {
        const M lanes = firstLanes(bins.count - b);
        const F known = loadF(row.low + b);
        const float over = tallestBetween(row.tops, row.rows, bins.row + static_cast<float>(b) * bins.rowStep,
                                          bins.row + static_cast<float>(b + kLanes) * bins.rowStep);
        if (!any(lanes & (known < F(over * row.inverse)))) continue;
        const F edge = lanesFrom(b), next = edge + F(1.0f);
        const F y0 = clamp(mulAdd(edge, F(bins.rowStep), F(bins.row)), F(0.0f), top);
        const F y1 = clamp(mulAdd(next, F(bins.rowStep), F(bins.row)), F(0.0f), top);
        const F h0 = heightOnLine(row.height, y0, row.rows, lanes),
                h1 = heightOnLine(row.height, y1, row.rows, lanes);
        const I inside = floorToInt(y1);
        const F between = gather(row.height, inside, lanes & (y0 < toFloat(inside)), h0);
        const F t0 = mulAdd(edge, F(bins.tangentStep), F(bins.tangent)), t1 = t0 + F(bins.tangentStep);
        const F fall = mulAdd(max(t0 * t0, t1 * t1), F(bins.fallAcross), F(bins.fallAlong));
        const F slope = (min(min(h0, h1), between) - F(bins.slack)) * F(row.inverse) - fall;
        // Unknown heights raise nothing: they make the sum NaN.
        const M firm = (h0 + h1) + between <= F(std::numeric_limits<float>::max());
        store(row.low + b, slope, lanes & firm & (known < slope));
    }
}

void tellSamples(const SampleRow& row) {
    for (int k = 0; k < row.count; k += kLanes) {
        const M lanes = firstLanes(row.count - k);
        const F at = lanesFrom(k), t = mulAdd(at, F(row.tangentStep), F(row.tangent));
        const I bin = max(I(0), min(floorToInt(mulAdd(at, F(row.binStep), F(row.bin))), I(row.bins - 1)));
        const F low = gather(row.low, bin, lanes, F(0.0f)), high = gather(row.high, bin, lanes, F(0.0f));
        const F fall = mulAdd(t * t, F(row.fallAcross), F(row.fallAlong));
        const F height = loadF(row.height + k) + F(row.targetHeight), slack(row.slack);
        const M hidden = (height + slack) * F(row.inverse) - fall < low;
        const M above = high < (height - slack) * F(row.inverse) - fall;
        const int word = k / 16, shift = k % 16;
        if (shift == 0) row.open[word] = row.above[word] = 0;
        row.open[word] = static_cast<std::uint16_t>(row.open[word] | bits(andNot(lanes, hidden)) << shift);
        row.above[word] = static_cast<std::uint16_t>(row.above[word] | bits(lanes & above) << shift);
    }
}

}  // namespace stereonav::STEREONAV_ISA
