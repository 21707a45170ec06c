// Translucent volumes, integrated: each ray goes from cell to cell, and gathers in each what lies between the
// values at the ends of two pieces of its way through it, however thin a film between two values is. Samples
// at even distances meet such a film once, twice or not at all, which shows as rings. Included by kernels
// only.
#pragma once

#include "engine/volume/integral_data.h"
#include "engine/volume/kernel_composite.h"

namespace stereonav::STEREONAV_ISA {

// A place in the table of integrals.
struct TablePlace {
    F at;    // in entries
    I word;  // the entry's in the table; entries at the ends stand for all values beyond
    F rest;  // entries from its begin
};
STEREONAV_INLINE TablePlace tablePlace(const IntegralData& table, F value) {
    const F at = mulAdd(value, F(table.scale), F(table.offset));
    const I entry = truncateToInt(clamp(at, F(0.0f), F(IntegralData::kEntries + 1.0f)));
    return {at, shiftLeft<3>(entry), at - toFloat(entry)};
}

// Values between two places, which differ by less than this of an entry, count as one value.
constexpr float kOneValue = 1.0f / 64;

// A piece of a ray's way through a cell.
struct Piece {
    TablePlace from, to;
    F inverse;  // 1 / entries between them
    M one;      // one value: means are those of the entries
    STEREONAV_INLINE Piece(const TablePlace& a, const TablePlace& b)
        : from(a), to(b), inverse(approxReciprocal(b.at - a.at)), one(abs(b.at - a.at) < F(kOneValue)) {}

    // Returns the mean of what is integrated.
    STEREONAV_INLINE F mean(const IntegralData& table, const IPair& atFrom, const IPair& atTo) const {
        const F begins = asFloat(atFrom.second), ends = asFloat(atTo.second);
        const F whole = toFloat(atTo.first - atFrom.first) * F(table.quantum);
        const F between = mulAdd(to.rest, ends, mulAdd(F(0.0f) - from.rest, begins, whole));
        return max(select(one, F(0.5f) * (begins + ends), between * inverse), F(0.0f));
    }
    // Returns the share of the piece before which everything is transparent, 0 to 1.
    STEREONAV_INLINE F clearShare(const IntegralData& table) const {
        const F first = clamp(from.at, F(table.lowest), F(table.highest));
        return select(one, F(0.0f), clamp((first - from.at) * inverse, F(0.0f), F(1.0f)));
    }
};

constexpr float kFaint = 0.3f;  // share of the light: what is behind it needs less care

// The way of the lanes m through a cell, and its values.
struct CellWay {
    Cells at;
    Crossing way;
    Corners corners;
    CornerNormals normals;
    STEREONAV_INLINE V3 placeAt(F s) const {
        return {clamp(mulAdd(s, way.way.x, way.start.x), F(0.0f), F(1.0f)),
                clamp(mulAdd(s, way.way.y, way.start.y), F(0.0f), F(1.0f)),
                clamp(mulAdd(s, way.way.z, way.start.z), F(0.0f), F(1.0f))};
    }
};

// Adds the light of a piece: `share` of the light is of its colour times what falls onto the middle of what
// is seen there.
STEREONAV_INLINE void addLight(const VolumeData& data, const VolumeView& view, const Grid& grid,
                               const Rays& r, const CellWay& cell, F s, F share, const Light& color, M seen,
                               Composite& sum) {
    const F t = select(seen, mulAdd(s, cell.way.out - cell.way.in, cell.way.in), F(1.0f));
    const Falling lit = fallingOn(data, view, r, t, seen, kLeastKnown, [&] {
        const V3 n = directionOf(normalAmong(
            grid.data, cell.normals, [&] { return cell.corners; }, cell.placeAt(s), seen));
        return litBy(data, view, r, t, n, F(1.0f));
    });
    const auto add = [&](F channel, F light, F& to) {
        to = select(seen, mulAdd(share, mulAdd(channel, light, lit.highlight), to), to);
    };
    add(color.red, lit.diffuse.red, sum.red);
    add(color.green, lit.diffuse.green, sum.green);
    add(color.blue, lit.diffuse.blue, sum.blue);
}

// Adds a piece of the cell, between places on the way through it, 0 to 1.
STEREONAV_INLINE void addPiece(const VolumeData& data, const VolumeView& view, const Grid& grid,
                               const Rays& r, const CellWay& cell, const Piece& piece, F begin, F size, M m,
                               Composite& sum) {
    const IntegralData& table = *data.transfer.integrals;
    const F zero(0.0f), one(1.0f), half(0.5f);
    const auto mean = [&](int n, M lanes) {
        return piece.mean(table, gatherPair(table.table + 2 * n, piece.from.word, lanes),
                          gatherPair(table.table + 2 * n, piece.to.word, lanes));
    };
    const F extinction = mean(0, m), span = cell.way.out - cell.way.in;
    F depth = extinction * span * size * approxReciprocal(r.perMetre);
    if (data.transfer.modulation.values)
        depth = depth * modulationAt(data.transfer.modulation, grid, cell.at,
                                     cell.placeAt(mulAdd(half, size, begin)), m);
    const M seen = m & (depth > zero);
    if (!any(seen)) return;
    const F share = select(seen, sum.through * (one - exp2(depth * F(-1.44269504f))), zero);
    const F per = approxReciprocal(max(extinction, F(1e-30f)));
    const Light color{per * mean(1, seen), per * mean(2, seen), per * mean(3, seen)};
    const F clear = piece.clearShare(table), first = mulAdd(clear, size, begin),
            middle = select(seen, half * (first + begin + size), zero);
    addLight(data, view, grid, r, cell, middle, share, color, seen, sum);
    sum.through = sum.through - share;
    sum.first = select(seen, min(sum.first, mulAdd(first, span, cell.way.in)), sum.first);
    const F behind = select(seen, mulAdd(middle, span, cell.way.in) - sum.first, zero);
    sum.square = mulAdd(share * behind, behind, sum.square);
}

// Adds the cells of the lanes m, each in two pieces; in one where little of the light is left.
STEREONAV_INLINE void addCell(const VolumeData& data, const VolumeView& view, const Grid& grid, const Rays& r,
                              const Cells& at, I word, M m, Composite& sum) {
    const IntegralData& table = *data.transfer.integrals;
    const CellWay cell{at, crossingOf(grid, r, at, F(view.nearDepth)), cornersOf(grid, word, at, m),
                       CornerNormals(grid.data, word, m)};
    const Cubic values = cubicAlong(cell.corners, cell.way.start, cell.way.way);
    const F zero(0.0f), one(1.0f), half(0.5f);
    const M faint = sum.through < F(kFaint);
    const F size = select(faint, one, half);
    const TablePlace from = tablePlace(table, values.at(zero)), to = tablePlace(table, values.at(size));
    addPiece(data, view, grid, r, cell, Piece(from, to), zero, size, m, sum);
    const M more = andNot(m, faint);
    if (!any(more)) return;
    addPiece(data, view, grid, r, cell, Piece(to, tablePlace(table, values.at(one))), half, half, more, sum);
}

// Gathers along the rays from cell to cell; w stands before the first that is not transparent.
STEREONAV_INLINE Composite integratePacket(const VolumeData& data, const VolumeView& view, const Grid& grid,
                                           const Rays& r, Walk w) {
    Composite sum{F(0.0f), F(0.0f), F(0.0f), F(1.0f), F(__builtin_inff()), F(0.0f)};
    while (any(w.active)) {
        const Parked parked = leap(grid, r, w);
        if (!any(parked.lanes)) continue;
        const auto [word, known] = placesOf(grid.data, parked.index, parked.lanes);
        addCell(data, view, grid, r, w.at, word, known, sum);
        const M further = known & (sum.through >= F(kEnoughLeft));
        w.active = andNot(w.active, andNot(parked.lanes, further));
        stepCell(r, w, further);
    }
    return sum;
}

}  // namespace stereonav::STEREONAV_ISA
