// Values of the real spherical harmonics without angles: P_l^m(z) / sin^m by the usual recurrences, times
// sin^m cos(m phi) and sin^m sin(m phi), which are the parts of (x + i y)^m: polynomials, sound at the poles.
// The sign is the one that rotation needs (band 1 is +y, +z, +x): P_l^m without the Condon-Shortley phase.
#include "engine/light/skies/spherical_harmonics.h"

#include <array>

#include "engine/math/constants.h"
#include "engine/math/square_root.h"

namespace stereonav {
namespace {

// N_l^m of eq. 12, with the square root of 2 for m > 0; l (l + 1) / 2 + m.
constexpr auto kNormalisation = [] {
    std::array<double, kMaxHarmonicsOrder*(kMaxHarmonicsOrder + 1) / 2> values{};
    for (int l = 0; l < kMaxHarmonicsOrder; ++l)
        for (int m = 0; m <= l; ++m) {
            double ratio = 1;  // (l + m)! / (l - m)!
            for (int k = l - m + 1; k <= l + m; ++k) ratio *= k;
            values[l * (l + 1) / 2 + m] = constantRoot((m > 0 ? 2 : 1) * (2 * l + 1) / (4 * kPi * ratio));
        }
    return values;
}();

// All values of one |m| over the bands, times the two parts of (x + i y)^m.
template <int Order, typename T>
inline void fillColumn(int m, T z, T first, T cosine, T sine, T* values) {
    T before = 0, legendre = first;
    for (int l = m; l < Order; ++l) {
        const T value = static_cast<T>(kNormalisation[l * (l + 1) / 2 + m]) * legendre;
        values[l * (l + 1) + m] = value * cosine;
        if (m > 0) values[l * (l + 1) - m] = value * sine;
        const T next = (static_cast<T>(2 * l + 1) * z * legendre - static_cast<T>(l + m) * before) /
                       static_cast<T>(l + 1 - m);
        before = legendre;
        legendre = next;
    }
}

template <int Order, typename T>
void evaluate(T x, T y, T z, T* values) {
    T first = 1, cosine = 1, sine = 0;  // (2m - 1)!!, parts of (x + i y)^m
#pragma GCC unroll 6
    for (int m = 0; m < Order; ++m) {
        fillColumn<Order>(m, z, first, cosine, sine, values);
        first *= static_cast<T>(2 * m + 1);
        const T turned = cosine * x - sine * y;
        sine = cosine * y + sine * x;
        cosine = turned;
    }
}

template <typename T>
void dispatch(T x, T y, T z, int order, T* values) {
    switch (order) {
        case 1:
            return evaluate<1>(x, y, z, values);
        case 2:
            return evaluate<2>(x, y, z, values);
        case 3:
            return evaluate<3>(x, y, z, values);
        case 4:
            return evaluate<4>(x, y, z, values);
        case 5:
            return evaluate<5>(x, y, z, values);
        default:
            return evaluate<6>(x, y, z, values);
    }
}

}  // namespace

void evaluateHarmonics(const glm::dvec3& direction, int order, double* values) {
    dispatch(direction.x, direction.y, direction.z, order, values);
}

void evaluateHarmonics(const glm::vec3& direction, int order, float* values) {
    dispatch(direction.x, direction.y, direction.z, order, values);
}

}  // namespace stereonav
