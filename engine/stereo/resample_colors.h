// Included by resample_kernel.cpp only: packed colours between taps in 16-bit fixed point, a lane a pixel;
// the same bits as packed_resample.h.
#pragma once

#include "engine/simd/simd_rows.h"

namespace stereonav::STEREONAV_ISA {
namespace {

// Red and blue in the low and high halves of a lane, green in the low one; channels times 16.
struct Channels {
    I redBlue, green;
};

// The channels of a packed colour.
STEREONAV_INLINE Channels unpack(I color) {
    return {(shiftLeft<4>(color) & I(0x3ff0)) | (color & I(0x3ff00000)), shiftRight<6>(color) & I(0x3ff0)};
}

// Channels within 0 .. 1023 * 16, rounded.
STEREONAV_INLINE I pack(const Channels& c) {
    const I half(0x00080008);
    const I redBlue = addHalves(c.redBlue, half), green = addHalves(c.green, half);
    return (shiftRight<4>(redBlue) & I(0x3ff)) | (redBlue & I(0x3ff00000)) |
           (shiftLeft<6>(green) & I(0x3ff << 10));
}

// Returns a weight, 0 to 1, with 15 fraction bits in both halves of a lane.
STEREONAV_INLINE I weightHalves(F weight) {
    const I w = roundToInt(min(weight * F(32768.0f), F(32767.0f)));
    return (w & I(0xffff)) | shiftLeft<16>(w);
}

// Returns (other - first) * weight.
STEREONAV_INLINE I partOf(I first, I other, I weight) {
    return scaledHalves(subtractHalves(other, first), weight);
}

// Returns the colour at t in [0, 1] between the two: nothing to limit.
STEREONAV_INLINE I lerpColors(I first, I second, F t) {
    const Channels a = unpack(first), b = unpack(second);
    const I w = weightHalves(t);
    return pack({addHalves(a.redBlue, partOf(a.redBlue, b.redBlue, w)),
                 addHalves(a.green, partOf(a.green, b.green, w))});
}

struct CubicHalves {
    I before, second, after;  // weights of taps 0, 2 and 3; tap 1 has the rest
};

// Returns Catmull-Rom's weights at t in [0, 1] between taps 1 and 2.
STEREONAV_INLINE CubicHalves cubicHalves(F t) {
    const F half(0.5f), t2 = t * t, t3 = t2 * t;
    return {weightHalves((t2 - half * t3) - half * t), weightHalves((F(2.0f) * t2 - F(1.5f) * t3) + half * t),
            weightHalves(half * t3 - half * t2)};
}

STEREONAV_INLINE I cubicHalf(I c0, I c1, I c2, I c3, const CubicHalves& w) {
    const I sum = addHalves(addHalves(addHalves(c1, partOf(c1, c0, w.before)), partOf(c1, c2, w.second)),
                            partOf(c1, c3, w.after));
    return clampHalves(sum, I(0), I(0x3ff03ff0));
}

// Returns the packed colour from four taps, t in [0, 1] between taps 1 and 2.
STEREONAV_INLINE I cubicColors(I tap0, I tap1, I tap2, I tap3, F t) {
    const Channels c0 = unpack(tap0), c1 = unpack(tap1), c2 = unpack(tap2), c3 = unpack(tap3);
    const CubicHalves w = cubicHalves(t);
    return pack({cubicHalf(c0.redBlue, c1.redBlue, c2.redBlue, c3.redBlue, w),
                 cubicHalf(c0.green, c1.green, c2.green, c3.green, w)});
}

}  // namespace
}  // namespace stereonav::STEREONAV_ISA
