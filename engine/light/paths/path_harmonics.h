// Sums the harmonics of the directions in which paths left (eq. 8), one path per lane; values equal those of
// evaluateHarmonics(). Included by kernels only.
#pragma once

#include "engine/light/paths/path_trace.h"
#include "engine/math/constants.h"
#include "engine/math/square_root.h"

namespace stereonav::STEREONAV_ISA {

constexpr int kMostBands = 6;  // kMaxHarmonicsOrder

// N_l^m of eq. 12, with the square root of 2 for m > 0.
struct Normalisations {
    float of[kMostBands][kMostBands] = {};
    constexpr Normalisations() {
        for (int l = 0; l < kMostBands; ++l)
            for (int m = 0; m <= l; ++m) {
                double ratio = 1;  // (l + m)! / (l - m)!
                for (int k = l - m + 1; k <= l + m; ++k) ratio *= k;
                of[l][m] =
                    static_cast<float>(constantRoot((m > 0 ? 2 : 1) * (2 * l + 1) / (4 * kPi * ratio)));
            }
    }
};
constexpr Normalisations kNormalisations;

// Fills values[l (l + 1) + m] of unit directions: see spherical_harmonics.cpp for the recurrences.
STEREONAV_INLINE void harmonicsOf(const V3& d, int order, F* values) {
    F first(1.0f), cosine(1.0f), sine(0.0f);
    for (int m = 0; m < order; ++m) {
        F before(0.0f), legendre = first;
        for (int l = m; l < order; ++l) {
            const F value = F(kNormalisations.of[l][m]) * legendre;
            values[l * (l + 1) + m] = value * cosine;
            if (m > 0) values[l * (l + 1) - m] = value * sine;
            const F next = mulAdd(F(static_cast<float>(2 * l + 1)) * d.z, legendre,
                                  F(static_cast<float>(-l - m)) * before) *
                           F(1.0f / static_cast<float>(l + 1 - m));
            before = legendre;
            legendre = next;
        }
        first = first * F(static_cast<float>(2 * m + 1));
        const F turned = cosine * d.x - sine * d.y;
        sine = mulAdd(cosine, d.y, sine * d.x);
        cosine = turned;
    }
}

inline float sumOf(F f) {
    float lanes[kLanes];
    store(lanes, f);
    float sum = 0;
    for (const float lane : lanes) sum += lane;
    return sum;
}

// Adds the harmonics of paths first .. first + count - 1 of the store, coefficient by coefficient.
inline void addHarmonics(const PathStore& s, int first, int count, int order, int channels, float* sums) {
    F totals[kMostBands * kMostBands * 3];
    const int coefficients = order * order;
    for (int n = 0; n < coefficients * channels; ++n) totals[n] = F(0.0f);
    for (int n = 0; n < count; n += kLanes) {
        const M m = firstLanes(count - n);
        const auto row = [&](const float* r) { return select(m, loadF(r + first + n), F(0.0f)); };
        const V3 way{row(s.way[0]), row(s.way[1]), row(s.way[2])};
        F values[kMostBands * kMostBands];
        harmonicsOf(way, order, values);
        for (int k = 0; k < channels; ++k) {
            const F throughput = row(s.throughput[k]);
            for (int c = 0; c < coefficients; ++c) {
                F& total = totals[c * channels + k];
                total = mulAdd(values[c], throughput, total);
            }
        }
    }
    for (int n = 0; n < coefficients * channels; ++n) sums[n] += sumOf(totals[n]);
}

}  // namespace stereonav::STEREONAV_ISA
