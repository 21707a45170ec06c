#include "terrain/light/terrain_horizon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace stereonav {
namespace {

// The level of a horizon's sine: level b stands for b / 255, and is that of a horizon between the levels'
// middles.
std::uint8_t levelOf(double slope) {
    constexpr int kLevels = 255;
    const double sine = std::isfinite(slope) ? slope / std::hypot(1.0, slope) : 1.0;
    return static_cast<std::uint8_t>(std::clamp(std::ceil(kLevels * sine - 0.5), 0.0, double(kLevels)));
}

}  // namespace

glm::dvec2 azimuthDirection(double a, int azimuths) {
    const double angle = a * 2 * std::numbers::pi / azimuths;
    const auto exact = [](double x) { return std::abs(x) < 1e-12 ? 0.0 : x; };  // along the grid
    return {exact(std::cos(angle)), exact(std::sin(angle))};
}

glm::dvec3 sampleNormal(const Heightfield& ground, int i, int j) {
    const glm::dvec2 gradient = ground.gradientAtSample(i, j);
    const double length = std::sqrt(1 + glm::dot(gradient, gradient));
    return std::isfinite(length) ? glm::dvec3(-gradient, 1.0) / length : glm::dvec3(0, 0, 1);
}

void bakeHorizonRow(const GroundHorizon& ground, const LightGrid& grid, int row, int azimuths,
                    std::uint8_t* horizon, std::size_t planeSize, const std::function<void()>& each) {
    constexpr int kLookAt = 16;  // samples between two calls of `each`
    std::vector<glm::dvec2> directions;
    directions.reserve(static_cast<std::size_t>(azimuths));
    for (int a = 0; a < azimuths; ++a) directions.push_back(azimuthDirection(a, azimuths));
    const int j = grid.row(row);
    for (int n = 0; n < grid.width; ++n) {
        if (n % kLookAt == 0) each();
        const int i = grid.column(n);
        const bool known = std::isfinite(ground.ground().sample(i, j));
        for (int a = 0; a < azimuths; ++a)
            horizon[a * planeSize + n] = known ? levelOf(ground.steepest(i, j, directions[a])) : 0;
    }
}

}  // namespace stereonav
