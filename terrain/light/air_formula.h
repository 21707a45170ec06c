// Aerial perspective of one ray: what the air between an eye and a point leaves of the point's light, and the
// sunlight that the air sends to the eye itself. Single scattering in molecules and haze whose densities fall
// exponentially with height, over level ground (Nishita et al. 1993; Preetham et al. 1999, section 4), and a
// uniform light from everywhere in the place of what is scattered more often.
//
// Optical depths are exact. In such air the depth towards the sun changes in proportion to the depth along
// the ray where haze or molecules are alone, so the light of a piece of the ray is an exponential's integral,
// too. Two pieces, parted where half of the light along the ray is left, and in each the mean mixture of
// both. tests/terrain/atmosphere_test.cpp holds it against the plain integral.
//
// A template for vectors of kernels and for double: N has the operators of numbers, min, max, select, mulAdd,
// abs, and airExp(x) = e^-x, airLog (rough: within 0.01), airReciprocal, airRsqrt.
#pragma once

#include "terrain/light/air_data.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define STEREONAV_AIR_INLINE inline
#else
#define STEREONAV_AIR_INLINE inline __attribute__((always_inline))
#endif

namespace stereonav {

// By colour: the share of light that is left, and the light that the air adds, linear.
template <class N>
struct AirAlong {
    N through[3], light[3];
};

// Returns the mean of an exponential over a way from its values at both ends, which differ by a factor e^-v:
// a quotient of differences, and where that would be all rounding a series about their mean.
template <class N>
STEREONAV_AIR_INLINE N airMean(N start, N end, N v) {
    const auto small = abs(v) < N(0.5f);
    const N square = v * v;
    const N series = (start + end) * mulAdd(square, mulAdd(square, N(1.0f / 240), N(-1.0f / 24)), N(0.5f));
    return select(small, series, (start - end) * airReciprocal(select(small, N(1.0f), v)));
}

// A point of a ray: optical depths from the eye, and what is left there.
template <class N>
struct AirPoint {
    N red, grey;          // depths from the eye: of molecules red, of haze
    N redSun, greySun;    // depths to the sun, those from the eye added
    N thin, dense;        // e^-red, e^-grey
    N thinLit, denseLit;  // e^-redSun, e^-greySun
    N molecules, haze;    // extinction there, 1/metre: red of molecules, haze
};
// Returns the point with these depths from the eye. molecules, haze: densities there, 1 at the sea.
template <class N>
STEREONAV_AIR_INLINE AirPoint<N> airPoint(const AirData& air, N red, N grey, N molecules, N haze) {
    AirPoint<N> p;
    p.red = red, p.grey = grey;
    p.molecules = N(air.molecules) * molecules, p.haze = N(air.haze) * haze;
    p.redSun = mulAdd(N(air.sunDepth[0]), molecules, red);
    p.greySun = mulAdd(N(air.sunDepth[1]), haze, grey);
    p.thin = airExp(p.red), p.dense = airExp(p.grey);
    p.thinLit = airExp(p.redSun), p.denseLit = airExp(p.greySun);
    return p;
}

// Returns x, x^2, x^5: what is left of green and of blue by what is left of red.
template <class N>
STEREONAV_AIR_INLINE N airPower(int channel, N x) {
    if (channel == 0) return x;
    const N square = x * x;
    return channel == 1 ? square : square * square * x;
}

// Returns a's share of a + b.
template <class N>
STEREONAV_AIR_INLINE N airShareOfFirst(N a, N b) {
    return a * airReciprocal(max(a + b, N(1e-30f)));
}
// Returns where the middle of e^-kx over x from 0 to 1 lies, from the middle of the way: 1 / k - 1 / (e^k -
// 1) - 1 / 2, within 0.03.
template <class N>
STEREONAV_AIR_INLINE N airAside(N k) {
    const N square = mulAdd(k * k, N(4.0f), N(144.0f));
    return N(0.0f) - k * airRsqrt(square);
}

// Returns the x up to which e^-kx over x from 0 to 1 has half of its integral, within 0.02: where a ray is
// parted.
template <class N>
STEREONAV_AIR_INLINE N airHalf(N k) {
    const N size = abs(k);
    const N share = airReciprocal(mulAdd(size, mulAdd(size, N(0.07f), N(0.55f)), N(2.0f)));
    return select(k < N(0.0f), N(1.0f) - share, share);
}

// Returns what the air does along a ray. way: metres from the eye. rise: metres a metre. cosSun: cosine of
// the angle to the sun.
template <class N>
STEREONAV_AIR_INLINE AirAlong<N> airAlong(const AirData& air, const AirEye& eye, N way, N rise, N cosSun) {
    if (eye.above > 0) way = max(way - N(eye.above) * airReciprocal(max(N(0.0f) - rise, N(1e-9f))), N(0.0f));
    const N perMolecules(air.perHeight[0]), perHaze(air.perHeight[1]);
    const N risen = rise * way, height = N(eye.height), end = risen + height;
    const N molecules0(eye.density[0]), molecules2 = airExp(end * perMolecules);
    const N haze0(eye.density[1]), haze2 = airExp(end * perHaze);
    const N fallMolecules = risen * perMolecules, fallHaze = risen * perHaze;
    const N redWay = way * N(air.molecules), greyWay = way * N(air.haze);
    const N red = max(redWay * airMean(molecules0, molecules2, fallMolecules), N(0.0f));
    const N grey = max(greyWay * airMean(haze0, haze2, fallHaze), N(0.0f));

    AirPoint<N> point[3];
    point[0].red = point[0].grey = N(0.0f);
    point[0].molecules = N(air.molecules) * molecules0, point[0].haze = N(air.haze) * haze0;
    point[0].redSun = N(eye.sunDepth[0]), point[0].greySun = N(eye.sunDepth[1]);
    point[0].thin = point[0].dense = N(1.0f);
    point[0].thinLit = N(eye.sunLeft[0]), point[0].denseLit = N(eye.sunLeft[1]);
    point[2] = airPoint(air, red, grey, molecules2, haze2);

    // The parting point by its share of the haze, which says how high it lies.
    const N share = airHalf(
        mulAdd(N(kGreenOfRed), point[2].redSun - point[0].redSun, point[2].greySun - point[0].greySun));
    const N haze1 = max(mulAdd(share, haze2 - haze0, haze0), N(1e-30f));
    const auto level = abs(fallHaze) < N(0.01f);
    const N place = select(
        level, share, airLog(haze0 * airReciprocal(haze1)) * airReciprocal(select(level, N(1.0f), fallHaze)));
    const N molecules1 = airExp(mulAdd(place, risen, height) * perMolecules);
    const N red1 = place * redWay * airMean(molecules0, molecules1, place * fallMolecules);
    point[1] = airPoint(air, red1, share * grey, molecules1, haze1);

    const N square = mulAdd(cosSun, cosSun, N(1.0f));
    const N below = max(mulAdd(N(0.0f) - N(air.hazePerCosine), cosSun, N(air.hazeTop)), N(1e-6f));
    const N byMolecules = square * N(air.phaseMolecules);
    const N perRoot = airRsqrt(below);
    const N byHaze = square * N(air.phaseHaze * air.hazeScatters) * (perRoot * perRoot * perRoot);

    AirAlong<N> along;
    for (int c = 0; c < 3; ++c) {
        const N power(c == 0 ? 1.0f : c == 1 ? kGreenOfRed : kBlueOfRed);
        const N shares[3] = {N(eye.share[c]), airShareOfFirst(power * point[1].molecules, point[1].haze),
                             airShareOfFirst(power * point[2].molecules, point[2].haze)};
        N light(0.0f);
        for (int k = 0; k < 2; ++k) {
            const AirPoint<N>&from = point[k], &to = point[k + 1];
            const N ownGrey = max(to.grey - from.grey, N(0.0f));
            const N own = power * max(to.red - from.red, N(0.0f)), depth = own + ownGrey;
            const N lit = mulAdd(power, to.redSun - from.redSun, to.greySun - from.greySun);
            const N scattered = mulAdd(own, byMolecules, ownGrey * byHaze) +
                                (shares[k + 1] - shares[k]) * (byMolecules - byHaze) * depth * airAside(lit);
            const N again =
                mulAdd(N(0.5f - 0.5f * air.hazeScatters), shares[k] + shares[k + 1], N(air.hazeScatters));
            light = light +
                    N(air.sunlight[c]) * max(scattered, N(0.0f)) *
                        airMean(from.denseLit * airPower(c, from.thinLit),
                                to.denseLit * airPower(c, to.thinLit), lit) +
                    N(air.ambient[c]) * again *
                        (from.dense * airPower(c, from.thin) - to.dense * airPower(c, to.thin));
        }
        along.light[c] = max(light, N(0.0f));  // differences are rounded
        along.through[c] = point[2].dense * airPower(c, point[2].thin);
    }
    return along;
}

}  // namespace stereonav
