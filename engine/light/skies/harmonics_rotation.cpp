// Rotation matrices of real spherical harmonics, each band from the one below (Ivanic and Ruedenberg 1996, as
// corrected in 1998; Wyman et al. 2006, table 3 and eq. 17). The second terms of V and W for s < 0 are those
// of the corrections: V's has the index -s - 1 (-s + 1 can lie outside the band below) and W's is subtracted.
#include <cmath>
#include <cstdlib>
#include <glm/matrix.hpp>
#include <string>

#include "engine/base/error.h"
#include "engine/light/skies/spherical_harmonics.h"

namespace stereonav {
namespace {

constexpr int bandStart(int l) {
    return l * (4 * l * l - 1) / 3;
}

// One band of a rotation, indexed from -l to l.
struct BandView {
    const double* values;
    int l;
    double operator()(int s, int t) const { return values[(s + l) * (2 * l + 1) + t + l]; }
};

// Table 3: what element (s, t) of band i is made of. r: band 1; below: band i - 1.
struct Recursion {
    BandView r, below;
    int i;

    double p(int a, int s, int t) const {
        if (t == i) return r(a, 1) * below(s, i - 1) - r(a, -1) * below(s, 1 - i);
        if (t == -i) return r(a, 1) * below(s, 1 - i) + r(a, -1) * below(s, i - 1);
        return r(a, 0) * below(s, t);
    }
    double v(int s, int t) const {
        if (s == 0) return p(1, 1, t) + p(-1, -1, t);
        if (s == 1) return p(1, 0, t) * std::sqrt(2.0);
        if (s == -1) return p(-1, 0, t) * std::sqrt(2.0);
        return s > 0 ? p(1, s - 1, t) - p(-1, 1 - s, t) : p(1, s + 1, t) + p(-1, -s - 1, t);
    }
    double w(int s, int t) const {
        return s > 0 ? p(1, s + 1, t) + p(-1, -s - 1, t) : p(1, s - 1, t) - p(-1, 1 - s, t);
    }
    double element(int s, int t) const {
        const int a = std::abs(s);
        const double below2 = std::abs(t) == i ? 2.0 * i * (2 * i - 1) : (i + t) * (i - t);
        double sum = 0;  // terms of weight 0 have indices outside the band below
        if (a < i) sum += std::sqrt((i + s) * (i - s) / below2) * p(0, s, t);
        sum += (s == 0 ? -std::sqrt(2.0) : 1.0) * 0.5 * std::sqrt((i + a - 1) * (i + a) / below2) * v(s, t);
        if (s != 0 && a < i - 1) sum -= 0.5 * std::sqrt((i - a - 1) * (i - a) / below2) * w(s, t);
        return sum;
    }
};

// Largest element of a matrix; NaN where there is one.
double largest(const glm::dmat3& m) {
    double most = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) most = std::abs(m[c][r]) <= most ? most : std::abs(m[c][r]);
    return most;
}

template <typename T, typename Sum>
void turn(const std::vector<double>& bands, int order, const T* from, T* to) {
    const double* element = bands.data();
    for (int l = 0; l < order; ++l)
        for (int s = 0; s <= 2 * l; ++s) {
            Sum sum(0);
            for (int t = 0; t <= 2 * l; ++t) sum += *element++ * Sum(from[l * l + t]);
            to[l * l + s] = T(sum);
        }
}

}  // namespace

// Newton's iteration for the polar factor (Higham 1986): quadratic near the end.
glm::dmat3 nearestRotation(const glm::dmat3& almost) {
    const double scale = largest(almost);
    const glm::dmat3 scaled = almost / scale;
    if (!(scale > 0 && std::isfinite(scale)) || !(glm::determinant(scaled) > 1e-9))
        throw Error("", "rotation", "expected a rotation matrix, got one that flattens or mirrors",
                    "give three unit vectors at right angles, the third the cross product of the others");
    glm::dmat3 rotation = scaled;
    for (int step = 0; step < 100; ++step) {
        const glm::dmat3 next = 0.5 * (rotation + glm::transpose(glm::inverse(rotation)));
        const double moved = largest(next - rotation);
        rotation = next;
        if (!(moved > 1e-15)) break;
    }
    return rotation;
}

HarmonicsRotation::HarmonicsRotation(const glm::dmat3& rotation, int order) : mOrder(order) {
    if (order < 1 || order > kMaxHarmonicsOrder)
        throw Error("", "order", "expected 1 to 6, got " + std::to_string(order), "give another order");
    const glm::dmat3 matrix = nearestRotation(rotation);
    mBands.resize(bandStart(order));
    mBands[0] = 1;
    constexpr int kAxis[3] = {1, 2, 0};  // axes of s = -1, 0, 1: band 1 is the matrix itself, as y, z, x
    for (int s = 0; s < 3 && order > 1; ++s)
        for (int t = 0; t < 3; ++t) mBands[1 + 3 * s + t] = matrix[kAxis[t]][kAxis[s]];
    for (int i = 2; i < order; ++i) {
        const Recursion recursion{{&mBands[1], 1}, {&mBands[bandStart(i - 1)], i - 1}, i};
        double* element = &mBands[bandStart(i)];
        for (int s = -i; s <= i; ++s)
            for (int t = -i; t <= i; ++t) *element++ = recursion.element(s, t);
    }
}

void HarmonicsRotation::apply(const double* from, double* to) const {
    turn<double, double>(mBands, mOrder, from, to);
}

void HarmonicsRotation::apply(const glm::vec3* from, glm::vec3* to) const {
    turn<glm::vec3, glm::dvec3>(mBands, mOrder, from, to);
}

std::span<const double> HarmonicsRotation::band(int l) const& {
    return {&mBands[bandStart(l)], static_cast<std::size_t>((2 * l + 1) * (2 * l + 1))};
}

}  // namespace stereonav
