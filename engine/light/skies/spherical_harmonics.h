// Real spherical harmonics of unit directions (Wyman et al. 2006, appendix, eq. 12). Order n means bands 0 to
// n - 1, which have n^2 coefficients; that of band l and degree m has the index l (l + 1) + m. The polar axis
// is z, which is up.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace stereonav {

constexpr int kMaxHarmonicsOrder = 6;
constexpr int kMaxHarmonics = kMaxHarmonicsOrder * kMaxHarmonicsOrder;

constexpr int harmonicsCount(int order) {
    return order * order;
}

// Fills `values` with the harmonics in a direction. order: 1..kMaxHarmonicsOrder; direction: unit; values:
// harmonicsCount(order) of them. Valid at the poles too.
void evaluateHarmonics(const glm::dvec3& direction, int order, double* values);
void evaluateHarmonics(const glm::vec3& direction, int order, float* values);

// Returns the rotation nearest to a matrix that is almost one (its polar factor). A rotation that the user
// drags on from frame to frame is a product of more and more rounded matrices, and drifts from orthogonality.
// The matrix of band l is a polynomial of degree l in its elements: there the error is l times as large.
// Throws Error for a matrix that is no rotation at all: not finite, flattened or mirrored.
glm::dmat3 nearestRotation(const glm::dmat3& almost);

// Turns coefficients so that the function they stand for is rotated: (R f)(w) = f(R^-1 w). Matrices band by
// band by the recursion of Ivanic and Ruedenberg (1996, with the corrections of 1998).
class HarmonicsRotation {
public:
    // rotation: a rotation matrix, but for rounding; nearestRotation() of it is used. Throws Error where
    // nearestRotation() does, and for an order out of 1..kMaxHarmonicsOrder.
    HarmonicsRotation(const glm::dmat3& rotation, int order);
    int order() const { return mOrder; }
    // Turns coefficients. from and to: harmonicsCount(order) values; not the same memory.
    void apply(const double* from, double* to) const;
    void apply(const glm::vec3* from, glm::vec3* to) const;
    // The matrix of band l: (2l + 1)^2 values, rows first.
    std::span<const double> band(int l) const&;
    std::span<const double> band(int l) && = delete;  // would outlive its values

private:
    int mOrder;
    std::vector<double> mBands;  // the matrices, one band after the other
};

}  // namespace stereonav
