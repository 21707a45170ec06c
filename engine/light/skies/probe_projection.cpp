// A probe's spherical harmonics (Wyman et al. 2006, eq. 7). The paper samples the sphere at random; here each
// pixel's integral is exact: over a pixel a harmonic is a function of the polar angle times one of the
// azimuth. The second is integrated in closed form, the first, a trigonometric polynomial of degree l + 1, by
// Gauss-Legendre nodes enough for it. So dim and dazzling pixels alike bring no noise.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/base/error.h"
#include "engine/light/skies/light_probe.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

constexpr int kTurns = 2 * kMaxHarmonicsOrder - 1;  // m from 1 - order to order - 1

using PolarIntegrals = std::array<double, kMaxHarmonics>;  // index: l (l + 1) + m, for m >= 0
using RowSums = std::array<glm::dvec3, kTurns>;            // index: m + kMaxHarmonicsOrder - 1

constexpr double kNodes[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr double kWeights[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                0.1012285362903763};

void addPanel(double from, double to, int order, PolarIntegrals& sums) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    PolarIntegrals values;
    for (int n = 0; n < 8; ++n) {
        const double polar = middle + (n < 4 ? half : -half) * kNodes[n & 3];
        evaluateHarmonics(glm::dvec3(std::sin(polar), 0, std::cos(polar)), order, values.data());
        const double weight = half * kWeights[n & 3] * std::sin(polar);
        for (int i = 0; i < harmonicsCount(order); ++i) sums[i] += weight * values[i];
    }
}

// Integrals over the polar angle of the harmonics at azimuth 0. Eight nodes are exact to rounding, up to
// degree 6, over a sixteenth of the half turn: the error's bound is (pi / 16)^17 8!^4 / (17 16!^3) 6^16 <
// 1e-21.
PolarIntegrals polarIntegrals(int row, int height, int order) {
    PolarIntegrals sums{};
    const int panels = (16 + height - 1) / height;
    const double step = kPi / height / panels;
    for (int p = 0; p < panels; ++p) {
        const double from = kPi * row / height + step * p;
        addPanel(from, from + step, order, sums);
    }
    return sums;
}

// Integrals over each column of cos (m >= 0) and sin (m < 0) of |m| times the azimuth.
std::vector<std::array<double, kTurns>> columnIntegrals(int width) {
    std::vector<std::array<double, kTurns>> columns(width);
    for (int i = 0; i < width; ++i) {
        const double middle = 2 * kPi * ((i + 0.5) / width - 0.5);
        columns[i][kMaxHarmonicsOrder - 1] = 2 * kPi / width;
        for (int m = 1; m < kMaxHarmonicsOrder; ++m) {
            const double extent = 2 * std::sin(m * kPi / width) / m;
            columns[i][kMaxHarmonicsOrder - 1 + m] = extent * std::cos(m * middle);
            columns[i][kMaxHarmonicsOrder - 1 - m] = extent * std::sin(m * middle);
        }
    }
    return columns;
}

}  // namespace

std::vector<glm::vec3> LightProbe::project(int order) const {
    if (order < 1 || order > kMaxHarmonicsOrder)
        throw Error("", "order", "expected 1 to 6, got " + std::to_string(order), "give another order");
    const auto columns = columnIntegrals(mWidth);
    std::array<glm::dvec3, kMaxHarmonics> sums{};
    for (int row = 0; row < mHeight; ++row) {
        RowSums turns{};
        for (int i = 0; i < mWidth; ++i)
            for (int m = 0; m < kTurns; ++m)
                turns[m] += columns[i][m] * glm::dvec3(mRadiance[index({i, row})]);
        const PolarIntegrals polar = polarIntegrals(row, mHeight, order);
        for (int l = 0; l < order; ++l)
            for (int m = -l; m <= l; ++m)
                sums[l * (l + 1) + m] += polar[l * (l + 1) + std::abs(m)] * turns[m + kMaxHarmonicsOrder - 1];
    }
    return {sums.begin(), sums.begin() + harmonicsCount(order)};
}

}  // namespace stereonav
