// Translucent volumes: samples at even distances along each ray, composited front to back. Rays leap to the
// cells that are not transparent; samples lie at whole multiples of the step from the eye, wherever a leap
// ended. Opacity is 1 - exp(-extinction * step): sound for any density. Included by kernels only.
#pragma once

#include "engine/volume/kernel_light.h"

namespace stereonav::STEREONAV_ISA {

constexpr float kEnoughLeft = 1.0f / 1024;  // share of the light: less than a packed step

// Light and transmittance that a ray has gathered.
struct Composite {
    F red, green, blue;  // linear RGB
    F through;           // share of what lies behind that passes
    F first;             // view depth, metres, of the first sample that is not transparent; infinite: none
    F square;            // the samples' squared distances behind the first, metres^2, weighted by light sent
};

// Returns the trilinear value at places in cells, 0..1 along each axis.
STEREONAV_INLINE F valueAt(const Corners& c, const V3& p) {
    const F near = lerp(lerp(c.v[0], c.v[1], p.x), lerp(c.v[2], c.v[3], p.x), p.y);
    const F far = lerp(lerp(c.v[4], c.v[5], p.x), lerp(c.v[6], c.v[7], p.x), p.y);
    return lerp(near, far, p.z);
}

// Returns linear light of the channel that begins at bit `shift`, 0 to 1.
STEREONAV_INLINE F channelAt(I packed, int shift) {
    const F root = toFloat(shiftRight(packed, I(shift)) & I(1023)) * F(1.0f / 1023);
    return root * root;
}

// Returns what the extinction is multiplied with, 0 to 1 (Ruiz et al. 2010, section 4.2), at places in cells.
STEREONAV_INLINE F modulationAt(const ByteData& data, const Grid& grid, const Cells& at, const V3& p, M m) {
    const I x = at.x + grid.baseX, y = at.y + grid.baseY, z = at.z + grid.baseZ;
    return bytesAt(data, z * I(data.slice) + y * I(data.row) + x, p, m) * F(1.0f / 255);
}

// Adds one sample of the lanes m, which stand in active cells.
STEREONAV_INLINE void addSample(const VolumeData& data, const VolumeView& view, const Grid& grid,
                                const Rays& r, const Walk& w, I word, M m, Composite& sum) {
    const V3 local{inCell(grid.eyeX, w.t, r.direction.x, w.at.x),
                   inCell(grid.eyeY, w.t, r.direction.y, w.at.y),
                   inCell(grid.eyeZ, w.t, r.direction.z, w.at.z)};
    const Corners corners = cornersOf(grid, word, w.at, m);
    const F value = valueAt(corners, local) + F(grid.data.isovalue);
    const TransferData& transfer = data.transfer;
    const F at =
        clamp((value - F(transfer.first)) * F(transfer.scale), F(0.0f), F(TransferData::kEntries - 0.01f));
    const I entry = truncateToInt(at);
    const F rest = at - toFloat(entry);
    F density = lerp(gather(transfer.extinction, entry, m, F(0.0f)),
                     gather(transfer.extinction + 1, entry, m, F(0.0f)), rest);
    if (transfer.modulation.values)
        density = density * modulationAt(transfer.modulation, grid, w.at, local, m);
    const M seen = m & (density > F(0.0f));
    if (!any(seen)) return;
    const I color = gather(transfer.color, entry, seen);
    // Lanes that are not seen have a share of 0, and light that is finite: nothing of it stays.
    const Falling lit = fallingOn(data, view, r, w.t, seen, kLeastKnown, [&] {
        const V3 n = directionOf(normalIn(
            grid.data, word, [&] { return corners; }, local, seen));
        return litBy(data, view, r, w.t, n, F(1.0f));
    });
    const F passes = exp2(density * F(-1.44269504f * transfer.step));
    const F share = select(seen, sum.through * (F(1.0f) - passes), F(0.0f));
    sum.red = mulAdd(share, mulAdd(lit.diffuse.red, channelAt(color, 0), lit.highlight), sum.red);
    sum.green = mulAdd(share, mulAdd(lit.diffuse.green, channelAt(color, 10), lit.highlight), sum.green);
    sum.blue = mulAdd(share, mulAdd(lit.diffuse.blue, channelAt(color, 20), lit.highlight), sum.blue);
    sum.through = sum.through - share;
    sum.first = select(seen, min(sum.first, w.t), sum.first);
    const F behind = select(seen, w.t - sum.first, F(0.0f));
    sum.square = mulAdd(share * behind, behind, sum.square);
}

// Goes to the first sample behind t, and the cell there. Where samples are nearer to each other than the view
// depth's rounding (an eye millions of samples away), to the next view depth that there is.
STEREONAV_INLINE void toSample(const VolumeData& data, const Grid& grid, const Rays& r, Walk& w, F t, M m) {
    const F apart = F(data.transfer.step) * r.perMetre;
    const F number = toFloat(floorToInt(t / apart)) + F(1.0f);
    w.t = select(m, max(number * apart, t * F(1.0f + 2.4e-7f)), w.t);
    const Cells c = grid.cellsAt(r.direction, w.t);
    w.at = {select(m, c.x, w.at.x), select(m, c.y, w.at.y), select(m, c.z, w.at.z)};
}

// Gathers along the rays; w stands anywhere before the first sample.
STEREONAV_INLINE Composite compositePacket(const VolumeData& data, const VolumeView& view, const Grid& grid,
                                           const Rays& r, Walk w) {
    Composite sum{F(0.0f), F(0.0f), F(0.0f), F(1.0f), F(__builtin_inff()), F(0.0f)};
    toSample(data, grid, r, w, w.t, w.active);
    const F unit(grid.data.leapUnit);
    while (any(w.active)) {
        w.active = w.active & grid.inside(w.at);
        const I index = grid.index(w.at);
        const I code = grid.code(index, w.active);
        const M here = w.active & (code == I(0));
        if (any(here)) {
            const auto [word, known] = placesOf(grid.data, index, here);
            w.active = andNot(w.active, andNot(here, known));
            addSample(data, view, grid, r, w, word, known, sum);
            w.active = w.active & (sum.through >= F(kEnoughLeft));
        }
        // From the middle between two samples, so that rounding can not repeat one.
        const F half = F(0.5f * data.transfer.step) * r.perMetre;
        const F way = grid.data.leaping ? max(toFloat(code - I(1)) * unit * r.perMetre, half) : half;
        toSample(data, grid, r, w, w.t + way, w.active);
    }
    return sum;
}

// Returns the root of the mean square distance, metres, behind the first sample that light comes from.
STEREONAV_INLINE F spreadOf(const Composite& sum) {
    return sqrt(sum.square * approxReciprocal(max(F(1.0f) - sum.through, F(1e-6f))));
}

// Returns what was gathered before the background, as a packed colour.
STEREONAV_INLINE I compositeColor(const VolumeData& data, const Composite& sum) {
    // A transmittance below kEnoughLeft counts as 0; else the background shows through by it.
    const F through = select(sum.through < F(kEnoughLeft), F(0.0f), sum.through);
    const Light behind = backgroundOf(data.light);
    return packLight({mulAdd(through, behind.red, sum.red), mulAdd(through, behind.green, sum.green),
                      mulAdd(through, behind.blue, sum.blue)});
}

}  // namespace stereonav::STEREONAV_ISA
