// Raises the upper bounds of a fan's bins: slopes that no ray in them exceeds. Compiled once for each
// instruction set.
//
// Between two columns a bin's ground is a polygon in each cell. Over it the surface less a slope is a saddle,
// so it is largest on the border: at the samples inside the bin, or along one of the two rays at its edges.
// Those are walked; neighbours share an edge.
#include <limits>

#include "engine/simd/simd.h"
#include "terrain/survey/fan_rows.h"
#include "terrain/survey/fan_tops.h"

namespace stereonav::STEREONAV_ISA {
namespace {

STEREONAV_INLINE F placesFrom(int first) {
    return laneIndexF() + F(static_cast<float>(first));
}
// Returns the height, or the lowest float where it is unknown.
STEREONAV_INLINE F knownOf(F height) {
    return select(height <= F(std::numeric_limits<float>::max()), height,
                  F(std::numeric_limits<float>::lowest()));
}
STEREONAV_INLINE F heightBetween(F low, F middle, F high, F at) {
    return select(at <= F(1.0f), mulAdd(at, middle - low, low), mulAdd(at - F(1.0f), high - middle, middle));
}
// Returns how much the top of a bent piece may lie over its ends.
STEREONAV_INLINE F topOver(F bend, F share) {
    return max(F(0.0f), bend * share * share * F(-0.25f));
}

struct EdgeRows {
    F near, far;  // where a ray meets both columns
    M off;        // the ground ends between them
};

STEREONAV_INLINE EdgeRows rowsOfEdge(const HighRow& row, F edge) {
    const F last(static_cast<float>(row.top + 1)), none(0.0f);
    const F near = mulAdd(edge, F(row.nearRowStep), F(row.nearRow)),
            far = mulAdd(edge, F(row.bins.rowStep), F(row.bins.row));
    const F onNear = clamp(near, none, last), onFar = clamp(far, none, last);
    return {onNear, onFar, (onNear < near) | (near < onNear) | (onFar < far) | (far < onFar)};
}

// The largest slope, without curvature, along rays between both columns.
STEREONAV_INLINE F slopeAlong(const HighRow& row, F edge, M lanes) {
    const F one(1.0f), inverseNear(row.inverseNear), inverseFar(row.inverseFar);
    const auto [y0, y1, off] = rowsOfEdge(row, edge);
    const I first = max(I(0), min(floorToInt(min(y0, y1)), I(row.top)));
    const I near = max(I(0), min(first + I(row.shift), I(row.nearRows - 1)));
    const F f0 = y0 - toFloat(first), f1 = y1 - toFloat(first);
    const M crosses = lanes & (max(f0, f1) > one);
    const FPair n = gatherPair(row.near, near, lanes), d = gatherPair(row.far, first, lanes);
    F n2 = n.second, d2 = d.second;
    const F tangent = mulAdd(edge, F(row.bins.tangentStep), F(row.bins.tangent));
    const F lower = (n.first - d.first - n.second + d.second) * tangent;
    F most, over;
    if (any(crosses)) {
        n2 = gather(row.near + 2, near, crosses, n2), d2 = gather(row.far + 2, first, crosses, d2);
        const F h0 = heightBetween(n.first, n.second, n2, f0), h1 = heightBetween(d.first, d.second, d2, f1);
        const F share = select(crosses, clamp((one - f0) / (f1 - f0), F(0.0f), one), one);
        const F between = mulAdd(share, d.second - n.second, n.second) / (F(row.x) + share);
        most = max(h0 * inverseNear, h1 * inverseFar);
        most = select(crosses, max(most, between), most);
        const F upper = (n.second - d.second - n2 + d2) * tangent;
        const F shareLow = select(crosses, select(f0 < f1, share, one - share), one);
        over = max(topOver(lower, shareLow), topOver(upper, one - shareLow));
    } else {
        most = max(mulAdd(f0, n.second - n.first, n.first) * inverseNear,
                   mulAdd(f1, d.second - d.first, d.first) * inverseFar);
        over = topOver(lower, one);
    }
    const F slope = most + over * inverseNear;
    // At the end of the ground, and beside what is not known: by what is.
    const M told = ~off & (slope <= F(std::numeric_limits<float>::max()));
    if (all(told)) return slope;
    const F tallest = max(max(max(knownOf(n.first), knownOf(n.second)), knownOf(n2)),
                          max(max(knownOf(d.first), knownOf(d.second)), knownOf(d2)));
    return select(told, slope, tallest * select(tallest < F(0.0f), inverseFar, inverseNear));
}

// Height of the sample of a column inside the bins, if there is one.
STEREONAV_INLINE F sampleInside(const float* heights, F low, F high, int last, M lanes) {
    const I row = max(I(0), min(floorToInt(high), I(last)));
    const M inside = lanes & (low <= toFloat(row)) & (toFloat(row) <= high);
    return knownOf(gather(heights, row, inside, F(std::numeric_limits<float>::lowest())));
}

// No less than any slope of kLanes bins.
STEREONAV_INLINE float slopeOver(const HighRow& row, int bin) {
    const FanBins& bins = row.bins;
    const float low = static_cast<float>(bin), high = static_cast<float>(bin + kLanes);
    const float far = tallestBetween(row.farTops, row.farRows, bins.row + low * bins.rowStep,
                                     bins.row + high * bins.rowStep),
                near = tallestBetween(
                    row.nearTops, row.nearRows,
                    row.nearRow + low * row.nearRowStep + static_cast<float>(row.shift) - 1.0f,
                    row.nearRow + high * row.nearRowStep + static_cast<float>(row.shift) + 1.0f);
    const float over = (far > near ? far : near) + bins.slack;
    return over * (over < 0 ? row.inverseFar : row.inverseNear) - bins.fallAlong;
}

// Slopes of kLanes bins, whose edges are known.
STEREONAV_INLINE F slopeOfBins(const HighRow& row, int bin, M lanes) {
    const FanBins& bins = row.bins;
    const F edge = placesFrom(bin), next = edge + F(1.0f), shift(static_cast<float>(row.shift));
    const F far = sampleInside(row.far, mulAdd(edge, F(bins.rowStep), F(bins.row)),
                               mulAdd(next, F(bins.rowStep), F(bins.row)), row.top + 1, lanes);
    const F near =
        sampleInside(row.near, mulAdd(edge, F(row.nearRowStep), F(row.nearRow)) + shift,
                     mulAdd(next, F(row.nearRowStep), F(row.nearRow)) + shift, row.nearRows - 1, lanes);
    const F t0 = mulAdd(edge, F(bins.tangentStep), F(bins.tangent)), t1 = t0 + F(bins.tangentStep);
    const F least = select(t0 * t1 <= F(0.0f), F(0.0f), min(t0 * t0, t1 * t1));
    const F fall = mulAdd(least, F(bins.fallAcross), F(bins.fallAlong));
    const F most = max(max(loadF(row.edge + bin), loadF(row.edge + bin + 1)),
                       max(near * F(row.inverseNear), far * F(row.inverseFar)));
    return mulAdd(F(bins.slack), F(row.inverseNear), most) - fall;
}

}  // namespace

void raiseHigh(const HighRow& row) {
    const FanBins& bins = row.bins;
    int edges = 0;  // before this one they are known, or not asked for
    for (int b = 0; b < bins.count; b += kLanes) {
        const M lanes = firstLanes(bins.count - b);
        const F high = loadF(row.high + b), block = loadF(row.block + b);
        // Where nothing is raised, the block has a bound that is less sharp.
        const F over(slopeOver(row, b));
        if (!any(lanes & (high < over))) {
            store(row.block + b, max(block, over), lanes);
            continue;
        }
        for (edges = edges > b ? edges : b; edges <= b + kLanes && edges <= bins.count; edges += kLanes) {
            const M here = firstLanes(bins.count + 1 - edges);
            store(row.edge + edges, slopeAlong(row, placesFrom(edges), here), here);
        }
        const F slope = slopeOfBins(row, b, lanes);
        store(row.block + b, max(block, slope), lanes);
        store(row.high + b, max(high, slope), lanes);
    }
}

}  // namespace stereonav::STEREONAV_ISA
