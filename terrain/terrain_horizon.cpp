// Bisection of the horizon's sine with packets of parallel rays: neighbours in a row, one azimuth.
#include "terrain/terrain_horizon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace stereonav {
namespace {

constexpr int kLevels = 255;  // of the horizon's sine: level b stands for b / 255

// The sine of the elevation between levels b and b + 1: whoever sees it free has a horizon of at most b.
double between(int b) {
    return (b + 0.5) / kLevels;
}

// What sixteen samples know of their horizons: the ray between low and low + 1 is blocked (low = -1: none
// need be), the one between high and high + 1 is free.
struct Bounds {
    int low[RayPacket::kSize], high[RayPacket::kSize];

    std::uint32_t open(int count) const {
        std::uint32_t bits = 0;
        for (int k = 0; k < count; ++k)
            if (high[k] - low[k] > 1) bits |= 1u << k;
        return bits;
    }
};

// The ground right beside the sample decides alone where rays can not: they start on it.
int levelBelow(double slope) {
    if (!(slope > 0)) return -1;
    const double sine = std::isfinite(slope) ? slope / std::sqrt(1 + slope * slope) : 1.0;
    return std::min(static_cast<int>(std::ceil(sine * kLevels - 0.5)) - 1, kLevels - 1);
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

void bakeHorizonRow(const GroundRays& rays, const LightGrid& grid, int row, int azimuths,
                    std::uint8_t* horizon, std::size_t planeSize) {
    const Heightfield& ground = rays.ground();
    const int j = grid.row(row);
    RayPacket packet{};
    Bounds bounds;
    for (int first = 0; first < grid.width; first += RayPacket::kSize) {
        const int count = std::min(RayPacket::kSize, grid.width - first);
        std::uint32_t known = 0;
        for (int k = 0; k < RayPacket::kSize; ++k) {
            const int i = grid.column(first + std::min(k, count - 1));
            const glm::dvec2 world = ground.worldFromGrid({i, j});
            const double height = ground.sample(i, j);
            if (k < count && std::isfinite(height)) known |= 1u << k;
            packet.originX[k] = static_cast<float>(world.x);
            packet.originY[k] = static_cast<float>(world.y);
            packet.originZ[k] =
                static_cast<float>(std::isfinite(height) ? height - rays.centreHeight() + rays.lift() : 0);
        }
        for (int a = 0; a < azimuths; ++a) {
            const glm::dvec2 d = azimuthDirection(a, azimuths);
            for (int k = 0; k < count; ++k) {
                const bool is = known >> k & 1;
                bounds.low[k] = is ? levelBelow(rays.slopeBeside(grid.column(first + k), j, d)) : -1;
                bounds.high[k] = is ? kLevels : 0;
            }
            for (std::uint32_t open = bounds.open(count); open; open = bounds.open(count)) {
                int middle[RayPacket::kSize];
                for (int k = 0; k < count; ++k) {
                    // The first try is right above the low bound: much ground sees a level horizon.
                    middle[k] = bounds.high[k] == kLevels ? bounds.low[k] + (kLevels - bounds.low[k]) / 8 + 1
                                                          : (bounds.low[k] + bounds.high[k]) / 2;
                    if (middle[k] >= bounds.high[k]) middle[k] = bounds.high[k] - 1;
                    const double z = between(middle[k]);
                    const double level = std::sqrt(1 - z * z);
                    packet.directionX[k] = static_cast<float>(d.x * level);
                    packet.directionY[k] = static_cast<float>(d.y * level);
                    packet.directionZ[k] = static_cast<float>(z);
                }
                const std::uint32_t blocked = rays.occluded(packet, open);
                for (int k = 0; k < count; ++k)
                    if (open >> k & 1) (blocked >> k & 1 ? bounds.low : bounds.high)[k] = middle[k];
            }
            for (int k = 0; k < count; ++k)
                horizon[a * planeSize + first + k] = static_cast<std::uint8_t>(bounds.high[k]);
        }
    }
}

}  // namespace stereonav
