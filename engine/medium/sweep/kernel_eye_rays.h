// Rays of an eye through the slabs of a sweep. Included by kernels only.
#pragma once

#include "engine/medium/sweep/kernel_medium.h"

namespace stereonav::STEREONAV_ISA {

constexpr float kLongest = 1e4f;  // 1 / kLeastCosine

// Rays as functions of the distance t along the axis from the chunk's reference, metres: place = at + t way.
struct EyeRays {
    V3 at, way;
    F length;           // length of `way`
    F depth, perDepth;  // view depth = depth + t perDepth
    M valid;

    STEREONAV_INLINE V3 placeAt(F t) const {
        return {mulAdd(t, way.x, at.x), mulAdd(t, way.y, at.y), mulAdd(t, way.z, at.z)};
    }
    // Returns the unit direction from the places to the eye.
    STEREONAV_INLINE V3 toEye(const SweepEye& eye) const {
        const F back = (eye.forward ? F(-1.0f) : F(1.0f)) / length;
        return {way.x * back, way.y * back, way.z * back};
    }
};
STEREONAV_INLINE EyeRays eyeRays(const SweepEye& eye, double reference, F x, F y) {
    const D wx = D(eye.xMin) + toDouble(x) * D(eye.perX), wy = D(eye.yMax) - toDouble(y) * D(eye.perY);
    const D c = D(eye.axis[2]) + D(eye.axis[0]) * wx + D(eye.axis[1]) * wy;
    const D rough = toDouble(F(1.0f) / awayFromZero(toFloat(c)));
    const D per = rough * (D(2.0) - c * rough), depth = per * D(reference - eye.start);
    EyeRays r;
    F at[3], way[3];
    for (int k = 0; k < 3; ++k) {
        const D direction = D(eye.ahead[k]) + D(eye.right[k]) * wx + D(eye.up[k]) * wy;
        at[k] = toFloat(D(eye.origin[k]) + direction * depth);
        way[k] = toFloat(direction * per);
    }
    r.at = {at[0], at[1], at[2]};
    r.way = {way[0], way[1], way[2]};
    r.length = lengthOf(r.way);
    r.depth = toFloat(depth);
    r.perDepth = toFloat(per);
    const F zero(0.0f);
    r.valid = (r.length < F(kLongest)) & (eye.forward ? r.perDepth > zero : r.perDepth < zero);
    return r;
}

}  // namespace stereonav::STEREONAV_ISA
