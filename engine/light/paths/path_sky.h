// Directions of paths, and the distant light they reach. Included by kernels only.
#pragma once

#include "engine/light/paths/path_trace.h"
#include "engine/light/paths/path_vector_numbers.h"

namespace stereonav::STEREONAV_ISA {

constexpr float kPiF = 3.14159265358979f;  // pi

struct Turn {
    F sine, cosine;
};
// Returns sine and cosine of angles, radians, within pi / 4 of 0: Taylor's polynomials to the ninth and
// eighth degree, errors below 3e-8.
STEREONAV_INLINE Turn smallTurn(F x) {
    const F x2 = x * x;
    const F s = mulAdd(mulAdd(mulAdd(mulAdd(F(2.7557319e-6f), x2, F(-1.9841270e-4f)), x2, F(8.3333333e-3f)),
                              x2, F(-1.6666667e-1f)),
                       x2 * x, x);
    const F c = mulAdd(
        mulAdd(mulAdd(mulAdd(F(2.4801587e-5f), x2, F(-1.3888889e-3f)), x2, F(4.1666667e-2f)), x2, F(-0.5f)),
        x2, F(1.0f));
    return {s, c};
}
// Returns sine and cosine of any fraction of a full turn.
STEREONAV_INLINE Turn turn(F fraction) {
    const F quarters = fraction * F(4.0f);
    const I whole = floorToInt(quarters + F(0.5f));
    const Turn t = smallTurn((quarters - toFloat(whole)) * F(kPiF / 2));
    const M swapped = I(0) < (whole & I(1));
    const F sine = select(swapped, t.cosine, t.sine), cosine = select(swapped, t.sine, t.cosine);
    const M down = I(0) < (whole & I(2)), left = I(0) < ((whole + I(1)) & I(2));
    return {select(down, F(0.0f) - sine, sine), select(left, F(0.0f) - cosine, cosine)};
}

// Returns radians, -pi to pi; 0 for (0, 0). The arc tangent below tan(pi / 8) is Cephes's polynomial.
STEREONAV_INLINE F angleOf(F y, F x) {
    const F ax = abs(x), ay = abs(y), high = max(ax, ay), low = min(ax, ay);
    const F ratio = low / max(high, F(1e-37f));
    const M steep = ratio > F(0.41421356f);
    const F r = select(steep, (ratio - F(1.0f)) / (ratio + F(1.0f)), ratio), r2 = r * r;
    const F p =
        mulAdd(mulAdd(mulAdd(F(8.05374449538e-2f), r2, F(-1.38776856032e-1f)), r2, F(1.99777106478e-1f)), r2,
               F(-3.33329491539e-1f));
    F angle = mulAdd(p * r2, r, r) + select(steep, F(kPiF / 4), F(0.0f));
    angle = select(ax < ay, F(kPiF / 2) - angle, angle);
    angle = select(x < F(0.0f), F(kPiF) - angle, angle);
    return select(y < F(0.0f), F(0.0f) - angle, angle);
}

// Maps the unit square onto the unit disc, areas kept (Shirley and Chiu 1997).
STEREONAV_INLINE F2 onDisc(const F2& u) {
    const F a = mulAdd(F(2.0f), u.x, F(-1.0f)), b = mulAdd(F(2.0f), u.y, F(-1.0f));
    const M wide = abs(b) < abs(a);
    const F r = select(wide, a, b), other = select(wide, b, a);
    const M middle = abs(r) <= F(0.0f);
    const Turn t = smallTurn(other / select(middle, F(1.0f), r) * F(kPiF / 4));
    const F along = r * t.cosine, across = r * t.sine;
    return {select(wide, along, across), select(wide, across, along)};
}

// Returns the unit vector with these coordinates across a normal (frame of Duff et al. 2017) and along it.
STEREONAV_INLINE V3 aroundNormal(const V3& n, const F2& across, F up) {
    const F sign = select(n.z < F(0.0f), F(-1.0f), F(1.0f)), a = F(-1.0f) / (sign + n.z), b = n.x * n.y * a;
    const V3 s{mulAdd(sign * n.x, n.x * a, F(1.0f)), sign * b, F(0.0f) - sign * n.x};
    const V3 t{b, mulAdd(n.y, n.y * a, sign), F(0.0f) - n.y};
    const auto mixed = [&](F p, F q, F r) { return mulAdd(across.x, p, mulAdd(across.y, q, up * r)); };
    return {mixed(s.x, t.x, n.x), mixed(s.y, t.y, n.y), mixed(s.z, t.z, n.z)};
}

// Turn vectors along the volume's axes into the world, and back; axes: PathVolume's.
STEREONAV_INLINE V3 worldFromAxes(const float* axes, const V3& v) {
    const auto along = [&](int k) {
        return mulAdd(v.x, F(axes[k]), mulAdd(v.y, F(axes[3 + k]), v.z * F(axes[6 + k])));
    };
    return {along(0), along(1), along(2)};
}
STEREONAV_INLINE V3 axesFromWorld(const float* axes, const V3& v) {
    const auto along = [&](int k) {
        return mulAdd(v.x, F(axes[3 * k]), mulAdd(v.y, F(axes[3 * k + 1]), v.z * F(axes[3 * k + 2])));
    };
    return {along(0), along(1), along(2)};
}

// Radiance of the probe in a direction, and the density with which that direction is sampled.
struct ProbeSight {
    V3 radiance;
    F density;  // per steradian
};

STEREONAV_INLINE ProbeSight pixelAt(const PathProbe& probe, I column, I row, M m) {
    const I word = shiftLeft<2>(row * I(probe.width) + column);
    return {{gatherRow(probe.pixels, word, m), gatherRow(probe.pixels + 1, word, m),
             gatherRow(probe.pixels + 2, word, m)},
            gatherRow(probe.pixels + 3, word, m)};
}

// Returns the same as LightProbe::seen().
STEREONAV_INLINE ProbeSight probeTowards(const PathProbe& probe, const V3& world, M m) {
    const F polar = angleOf(sqrt(mulAdd(world.x, world.x, world.y * world.y)), world.z);
    const F azimuth = angleOf(world.y, world.x);
    const auto part = [](F share, int n) {
        return clamp(floorToInt(share * F(static_cast<float>(n))), I(0), I(n - 1));
    };
    const I row = part(polar * F(1 / kPiF), probe.height);
    return pixelAt(probe, part(mulAdd(azimuth, F(0.5f / kPiF), F(0.5f)), probe.width), row, m);
}

// An index into running sums, and the position within that entry, 0 to 1.
struct Choice {
    I index;
    F fraction;
};
// Returns the entry of running sums, from `start` in `sums`, that contains u, and the position of u within
// it, 0 to 1.
STEREONAV_INLINE Choice chooseEntry(const float* sums, I start, int count, int steps, F u, M m) {
    I low(0), high(count);
    for (int n = 0; n < steps; ++n) {
        const I middle = shiftRight<1>(low + high);
        const M beyond = u < gatherRow(sums, start + middle, m);
        high = select(beyond, middle, high);
        low = select(beyond, low, middle);
    }
    low = min(low, I(count - 1));
    const F from = gatherRow(sums, start + low, m), to = gatherRow(sums, start + low + I(1), m);
    const F width = to - from;
    return {low, clamp((u - from) / max(width, F(1e-30f)), F(0.0f), F(1.0f))};
}

// A chosen direction, unit, world, with the radiance and density there.
struct ProbeChoice {
    V3 world;
    ProbeSight sight;
};
// Returns the same as LightProbe::sample().
STEREONAV_INLINE ProbeChoice chooseProbe(const PathProbe& probe, const F2& u, M m) {
    const Choice row = chooseEntry(probe.rows, I(0), probe.height, probe.rowSteps, u.y, m);
    const I start = row.index * I(probe.width + 1);
    const Choice column = chooseEntry(probe.columns, start, probe.width, probe.columnSteps, u.x, m);
    const F above = gatherRow(probe.edges, row.index, m), below = gatherRow(probe.edges + 1, row.index, m);
    const F z = lerp(above, below, row.fraction);
    const F radius = sqrt(max((F(1.0f) - z) * (F(1.0f) + z), F(0.0f)));
    const F across = (toFloat(column.index) + column.fraction) * F(1.0f / static_cast<float>(probe.width));
    const Turn t = turn(across - F(0.5f));
    return {{radius * t.cosine, radius * t.sine, z}, pixelAt(probe, column.index, row.index, m)};
}

}  // namespace stereonav::STEREONAV_ISA
