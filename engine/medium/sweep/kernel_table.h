// Reads of a medium's table for packets, with interpolation between entries. Included by kernels only.
#pragma once

#include "engine/medium/sweep/sweep_kernel_types.h"
#include "engine/volume/kernel_light.h"

namespace stereonav::STEREONAV_ISA {

// OpticalProperties in packets.
struct Properties {
    F extinction;
    F indirect[3], color[3], glow[3];
    F surface;
};

// A position in the table: an entry, the share of the way to the next (0 to 1), and the same for rows.
struct Column {
    I entry;
    F share;
    I row;  // first entry of the lower row
    F rowShare;
};

// Returns a member interpolated between entry `index` and the next.
STEREONAV_INLINE F entryOf(const float* member, I index, F share, M m) {
    const FPair both = gatherPair(member, index, m);
    return lerp(both.first, both.second, share);
}
// Returns a member at a position in the table.
STEREONAV_INLINE F memberAt(const SweepTable& table, const float* member, const Column& at, M m) {
    if (table.rows == 1) return entryOf(member, at.entry, at.share, m);
    const I index = at.row + at.entry;
    return lerp(entryOf(member, index, at.share, m),
                entryOf(member + SweepTable::kColumns, index, at.share, m), at.rowShare);
}
// Returns the position for a value, in the first row.
STEREONAV_INLINE Column columnOf(const SweepTable& table, F value) {
    const F at = clamp(mulAdd(value, F(table.perValue), F(table.zero)), F(0.0f), F(1024.0f));
    const I entry = min(truncateToInt(at), I(SweepTable::kColumns - 2));
    return {entry, at - toFloat(entry), I(0), F(0.0f)};
}
// Sets the rows between which a gradient magnitude lies; value units per metre.
STEREONAV_INLINE void setRow(const SweepTable& table, F gradient, Column& at) {
    const F row = clamp(gradient * F(table.perGradient), F(0.0f), F(static_cast<float>(table.rows - 1)));
    const I low = min(truncateToInt(row), I(table.rows - 2));
    at.row = low * I(SweepTable::kColumns);
    at.rowShare = row - toFloat(low);
}
// Reads all members but the extinction, for lanes m.
STEREONAV_INLINE void readColors(const SweepTable& table, const Column& at, M m, Properties& p) {
    const F zero(0.0f);
    for (int k = 0; k < 3; ++k) p.color[k] = memberAt(table, table.color[k], at, m);
    p.surface = table.surface ? memberAt(table, table.surface, at, m) : zero;
    for (int k = 0; k < 3; ++k) p.glow[k] = table.glow[k] ? memberAt(table, table.glow[k], at, m) : zero;
}
// Reads the same for grids without layers or noise, where all rows have the same colours; leaves out the
// surface weight. read: returns a member at its position in the table.
template <typename Read>
STEREONAV_INLINE void readColorsAlone(const SweepTable& table, const Read& read, Properties& p) {
    const F zero(0.0f);
    for (int k = 0; k < 3; ++k) p.color[k] = read(table.color[k]);
    for (int k = 0; k < 3; ++k) p.glow[k] = table.glow[k] ? read(table.glow[k]) : zero;
    p.surface = zero;
}
template <typename Read>
STEREONAV_INLINE void readIndirectAlone(const SweepTable& table, const Read& read, Properties& p) {
    for (int k = 0; k < 3; ++k) p.indirect[k] = read(table.indirect[k]);
}
STEREONAV_INLINE void readIndirectAlone(const SweepTable& table, const Column& at, M m, Properties& p) {
    readIndirectAlone(
        table, [&](const float* member) { return entryOf(member, at.entry, at.share, m); }, p);
}
STEREONAV_INLINE void readIndirect(const SweepTable& table, const Column& at, M m, Properties& p) {
    for (int k = 0; k < 3; ++k) p.indirect[k] = memberAt(table, table.indirect[k], at, m);
}
// Returns the value interpolated between the two 15-bit entries of a word, 0 to 1. share: 0 to 1, a weight
// with 14 bits.
STEREONAV_INLINE F betweenHalves(I pair, F share) {
    const I high = truncateToInt(mulAdd(share, F(16384.0f), F(0.5f)));
    return toFloat(dotHalves(pair, shiftLeft<16>(high) + (I(16384) - high))) * F(1.0f / (16384 * 32767.0f));
}

}  // namespace stereonav::STEREONAV_ISA
