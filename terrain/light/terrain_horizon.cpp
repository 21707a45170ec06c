// Bisection of the horizon's sine with packets of parallel rays: neighbours in a row, one azimuth.
#include "terrain/light/terrain_horizon.h"

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

// What is known of one sample's horizon: the ray between low and low + 1 is blocked, or low is -1; the one
// between high and high + 1 is free, or high is kLevels. The search starts at the horizon of the azimuth
// before and steps away from it, ever further, until it lies between; then it bisects.
struct Bounds {
    int low, high, guess;
    int step = 1;
    bool blockedSeen = false, freeSeen = false;

    bool open() const { return high - low > 1; }
    int middle() const {
        if (blockedSeen && freeSeen) return (low + high) / 2;
        const int at = freeSeen ? high - step : blockedSeen ? low + step : guess;
        return std::clamp(at, low + 1, high - 1);
    }
    void take(int level, bool blocked) {
        (blocked ? low : high) = level;
        (blocked ? blockedSeen : freeSeen) = true;
        step *= 3;
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

namespace {

// Up to sixteen neighbours in a row of baked samples.
class HorizonPacket {
public:
    HorizonPacket(const GroundRays& rays, const LightGrid& grid, int row, int first)
        : mRays(rays), mGrid(grid), mRow(grid.row(row)), mFirst(first) {
        mCount = std::min(RayPacket::kSize, grid.width - first);
        const Heightfield& ground = rays.ground();
        for (int k = 0; k < RayPacket::kSize; ++k) {
            const int i = grid.column(first + std::min(k, mCount - 1));
            const glm::dvec2 world = ground.worldFromGrid({i, mRow});
            const double height = ground.sample(i, mRow);
            const bool known = std::isfinite(height);
            if (k < mCount && known) mKnown |= 1u << k;
            mPacket.originX[k] = static_cast<float>(world.x);
            mPacket.originY[k] = static_cast<float>(world.y);
            mPacket.originZ[k] =
                known ? static_cast<float>(height - rays.centreHeight() + rays.lift()) : 0.0f;
        }
    }

    // Writes the horizons of one azimuth; `horizon` is the first sample's.
    void find(const glm::dvec2& direction, std::uint8_t* horizon) {
        Bounds bounds[RayPacket::kSize];
        std::uint32_t open = 0;
        for (int k = 0; k < mCount; ++k) {
            bounds[k] = {-1, 0, 0};
            if (!(mKnown >> k & 1)) continue;
            const int i = mGrid.column(mFirst + k);
            bounds[k] = {levelBelow(mRays.slopeBeside(i, mRow, direction)), kLevels, mBefore[k]};
            if (bounds[k].open()) open |= 1u << k;
        }
        while (open) open = narrow(direction, open, bounds);
        for (int k = 0; k < mCount; ++k) {
            mBefore[k] = bounds[k].high;
            horizon[k] = static_cast<std::uint8_t>(bounds[k].high);
        }
    }

private:
    std::uint32_t narrow(const glm::dvec2& direction, std::uint32_t open, Bounds* bounds) {
        int level[RayPacket::kSize];
        for (int k = 0; k < mCount; ++k) {
            level[k] = bounds[k].open() ? bounds[k].middle() : 0;
            const double z = between(level[k]), across = std::sqrt(1 - z * z);
            mPacket.directionX[k] = static_cast<float>(direction.x * across);
            mPacket.directionY[k] = static_cast<float>(direction.y * across);
            mPacket.directionZ[k] = static_cast<float>(z);
        }
        const std::uint32_t blocked = mRays.occluded(mPacket, open);
        std::uint32_t left = 0;
        for (int k = 0; k < mCount; ++k) {
            if (!(open >> k & 1)) continue;
            bounds[k].take(level[k], blocked >> k & 1);
            if (bounds[k].open()) left |= 1u << k;
        }
        return left;
    }

    const GroundRays& mRays;
    const LightGrid& mGrid;
    const int mRow, mFirst;
    int mCount = 0;
    std::uint32_t mKnown = 0;
    int mBefore[RayPacket::kSize] = {};
    RayPacket mPacket{};
};

}  // namespace

void bakeHorizonRow(const GroundRays& rays, const LightGrid& grid, int row, int azimuths,
                    std::uint8_t* horizon, std::size_t planeSize, const std::function<void()>& each) {
    for (int first = 0; first < grid.width; first += RayPacket::kSize) {
        each();
        HorizonPacket packet(rays, grid, row, first);
        for (int a = 0; a < azimuths; ++a)
            packet.find(azimuthDirection(a, azimuths), horizon + a * planeSize + first);
    }
}

}  // namespace stereonav
