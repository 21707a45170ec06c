// Colours seen through an eye's own fog, from those that the other eye saw. Compiled once for each
// instruction set.
#include "engine/simd/simd.h"
#include "terrain/cast/fog_row.h"
#include "terrain/cast/kernel_shade.h"

namespace stereonav::STEREONAV_ISA {
namespace {

// Returns a packed channel after its light from behind the fog was multiplied by `ratio`. fog: the fog's own
// colour, linear.
STEREONAV_INLINE I changedChannel(I channel, float fog, F ratio) {
    const F root = toFloat(channel) * F(1.0f / 1023);
    const F linear = lerp(F(fog), root * root, ratio);
    return truncateToInt(mulAdd(sqrt(clamp(linear, F(0.0f), F(1.0f))), F(1023.0f), F(0.5f)));
}

// Returns the factor from the light of a surface that reached the other eye to the light that reaches this
// eye.
STEREONAV_INLINE F ratioAt(const FogRow& row, int x, F z) {
    const F rx = mulAdd(laneIndexF() + F(static_cast<float>(x)), F(row.perX), F(row.firstX)), ry(row.y);
    const F way = z * sqrt(mulAdd(rx, rx, mulAdd(ry, ry, F(1.0f))));
    const F ox(row.offset[0]), oy(row.offset[1]), oz(row.offset[2]);
    const F px = mulAdd(z, rx, ox), py = mulAdd(z, ry, oy), pz = z + oz;
    const F before = sqrt(mulAdd(px, px, mulAdd(py, py, pz * pz)));
    // The difference of the two distances, as the difference of their squares divided by their sum:
    // subtracting large distances directly would leave only rounding.
    const F squares = mulAdd(
        z * F(2.0f), mulAdd(rx, ox, mulAdd(ry, oy, oz)),
        F(row.offset[0] * row.offset[0] + row.offset[1] * row.offset[1] + row.offset[2] * row.offset[2]));
    const F nearer = squares / max(way + before, F(1e-30f));
    const F depth = clamp(nearer * F(row.perMetre), F(-kMostFogBetweenEyes), F(kMostFogBetweenEyes));
    const F less = expMinus(max(depth, F(0.0f) - depth));
    return select(depth < F(0.0f), less, F(1.0f) / less);
}

}  // namespace

void changeFog(const FogRow& row) {
    for (int x = 0; x < row.width; x += kLanes) {
        const F z = loadF(row.depth + x);
        const M seen = firstLanes(row.width - x) & (z > F(0.0f)) & (z < infinity());
        if (!any(seen)) continue;
        const F ratio = ratioAt(row, x, select(seen, z, F(1.0f)));
        const I color = loadI(row.color + x), channel(1023);
        const I red = changedChannel(color & channel, row.linear[0], ratio);
        const I green = changedChannel(shiftRight<10>(color) & channel, row.linear[1], ratio);
        const I blue = changedChannel(shiftRight<20>(color) & channel, row.linear[2], ratio);
        store(row.color + x, red | shiftLeft<10>(green) | shiftLeft<20>(blue), seen);
    }
}

}  // namespace stereonav::STEREONAV_ISA
