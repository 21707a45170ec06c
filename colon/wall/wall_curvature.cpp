#include "colon/wall/wall_curvature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <unordered_set>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kTerms = 6;  // terms of a quadric z(x, y)
constexpr int kBatch = 1024;

using Row = std::array<double, kTerms + 1>;

// Solves the normal equations by Gauss' elimination with pivots; false where they have no one solution.
bool solve(std::array<Row, kTerms>& m, std::array<double, kTerms>& result) {
    double largest = 0;
    for (int n = 0; n < kTerms; ++n) largest = std::max(largest, std::abs(m[n][n]));
    for (int column = 0; column < kTerms; ++column) {
        const auto pivot = std::max_element(m.begin() + column, m.end(), [&](const Row& a, const Row& b) {
            return std::abs(a[column]) < std::abs(b[column]);
        });
        if (!(std::abs((*pivot)[column]) > 1e-12 * largest)) return false;
        std::swap(m[column], *pivot);
        for (int row = column + 1; row < kTerms; ++row) {
            const double factor = m[row][column] / m[column][column];
            for (int k = column; k <= kTerms; ++k) m[row][k] -= factor * m[column][k];
        }
    }
    for (int row = kTerms - 1; row >= 0; --row) {
        double sum = m[row][kTerms];
        for (int k = row + 1; k < kTerms; ++k) sum -= m[row][k] * result[k];
        result[row] = sum / m[row][row];
    }
    return true;
}

// z = a x^2 + b x y + c y^2 + d x + e y + f over the tangent plane, lengths in `radius`.
Curvatures fromQuadric(const std::array<double, kTerms>& q, double radius) {
    const double fx = q[3], fy = q[4], fxx = 2 * q[0], fxy = q[1], fyy = 2 * q[2];
    const double w = 1 + fx * fx + fy * fy;
    const double gauss = (fxx * fyy - fxy * fxy) / (w * w);
    const double mean =
        ((1 + fy * fy) * fxx - 2 * fx * fy * fxy + (1 + fx * fx) * fyy) / (2 * w * std::sqrt(w));
    const double apart = std::sqrt(std::max(mean * mean - gauss, 0.0));
    // A cap of flesh falls away from its tangent plane: z, into the lumen, is negative there.
    return {static_cast<float>((-mean + apart) / radius), static_cast<float>((-mean - apart) / radius)};
}

}  // namespace

double Curvatures::shapeIndex() const {
    const double sum = static_cast<double>(larger) + smaller, apart = static_cast<double>(larger) - smaller;
    if (sum == 0 && apart == 0) return 0.5;
    return 0.5 + std::atan2(sum, apart) / std::numbers::pi;
}

double Curvatures::curvedness() const {
    return std::sqrt(0.5 * (static_cast<double>(larger) * larger + static_cast<double>(smaller) * smaller));
}

std::vector<std::uint32_t> verticesAround(const WallMesh& mesh, const WallNeighbours& neighbours,
                                          std::uint32_t vertex, double radius) {
    std::vector<std::uint32_t> found{vertex};
    std::unordered_set<std::uint32_t> known{vertex};
    const glm::dvec3 middle(mesh.places[vertex]);
    for (std::size_t n = 0; n < found.size(); ++n)
        for (std::uint32_t k = neighbours.first[found[n]]; k < neighbours.first[found[n] + 1]; ++k) {
            const std::uint32_t next = neighbours.neighbours[k];
            if (glm::distance(glm::dvec3(mesh.places[next]), middle) <= radius && known.insert(next).second)
                found.push_back(next);
        }
    return found;
}

Curvatures curvaturesAt(const WallMesh& mesh, const WallNeighbours& neighbours, std::uint32_t vertex,
                        double radius) {
    const glm::dvec3 middle(mesh.places[vertex]), up(mesh.normals[vertex]);
    const glm::dvec3 helper = std::abs(up.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(up, helper)), over = glm::cross(up, across);
    std::array<Row, kTerms> equations{};
    for (const std::uint32_t v : verticesAround(mesh, neighbours, vertex, radius)) {
        // The other side of a thin fold bends another way.
        if (glm::dot(mesh.normals[v], mesh.normals[vertex]) <= 0) continue;
        const glm::dvec3 to = (glm::dvec3(mesh.places[v]) - middle) / radius;
        const double x = glm::dot(to, across), y = glm::dot(to, over), z = glm::dot(to, up);
        const double weight = mesh.areas[v] / (radius * radius) * std::exp(-1.5 * glm::dot(to, to));
        const Row row{x * x, x * y, y * y, x, y, 1, z};
        for (int m = 0; m < kTerms; ++m)
            for (int k = 0; k <= kTerms; ++k) equations[m][k] += weight * row[m] * row[k];
    }
    std::array<double, kTerms> quadric{};
    if (!solve(equations, quadric)) return {};
    return fromQuadric(quadric, radius);
}

std::vector<Curvatures> wallCurvatures(const WallMesh& mesh, const WallNeighbours& neighbours,
                                       double radius) {
    const int count = static_cast<int>(mesh.places.size());
    std::vector<Curvatures> all(count);
    parallelFor((count + kBatch - 1) / kBatch, [&](int run) {
        for (int v = run * kBatch; v < std::min((run + 1) * kBatch, count); ++v)
            all[v] = curvaturesAt(mesh, neighbours, static_cast<std::uint32_t>(v), radius);
    });
    return all;
}

}  // namespace stereonav
