// See the header.
#include "engine/light/paths/isovalue_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/volume/plain_volume_caster.h"
#include "engine/volume/surface_cells.h"

namespace stereonav {
namespace {

// Largest difference of values within the 4x4x4 voxels whose gradient is taken.
double rangeAround(const GreyVolume& volume, const glm::dvec3& voxel) {
    const glm::ivec3 last = volume.frame.size - 1;
    const glm::ivec3 corner(glm::floor(glm::clamp(voxel, glm::dvec3(0.0), glm::dvec3(last))));
    const glm::ivec3 low = glm::max(corner - 1, glm::ivec3(0)), high = glm::min(corner + 2, last);
    std::int16_t least = 32767, most = -32768;
    for (int k = low.z; k <= high.z; ++k)
        for (int j = low.y; j <= high.y; ++j)
            for (int i = low.x; i <= high.x; ++i) {
                least = std::min(least, volume.at(i, j, k));
                most = std::max(most, volume.at(i, j, k));
            }
    return double(most) - double(least);
}

// The slope of the trilinear values, stored numbers a metre, world; 0 on the faces of cells, which have two.
glm::dvec3 slopeAt(const GreyVolume& volume, const glm::dvec3& voxel) {
    const glm::dvec3 low = glm::floor(voxel), last(volume.frame.size - 1);
    glm::dvec3 slope(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        if (!(low[axis] >= 0 && low[axis] < voxel[axis] && voxel[axis] < last[axis])) return glm::dvec3(0.0);
        glm::dvec3 from = voxel, to = voxel;
        from[axis] = low[axis], to[axis] = low[axis] + 1;
        slope[axis] = plainValue(volume, to) - plainValue(volume, from);
    }
    return volume.frame.axes * (slope / volume.frame.spacing);
}

constexpr double kVanishing = 1e-6;  // rounding of the sum of 64 weighted voxels stays far below

}  // namespace

glm::dvec3 surfaceNormal(const GreyVolume& volume, const glm::dvec3& voxel) {
    const double range = rangeAround(volume, voxel);
    if (range == 0) return glm::dvec3(0.0);
    glm::dvec3 gradient = smoothGradient(volume, voxel);
    if (const glm::dvec3 slope = slopeAt(volume, voxel);
        glm::dot(gradient, slope) < static_cast<double>(kOwnSlope) * glm::dot(slope, slope))
        gradient = slope;
    const glm::dvec3 perVoxel = glm::transpose(volume.frame.axes) * gradient * volume.frame.spacing;
    if (!(glm::length(perVoxel) > kVanishing * range)) return glm::dvec3(0.0);
    return -glm::normalize(gradient);
}

namespace {

// Returns a distance in voxels from `voxel` along `way` (of length 1), or none within kNearSurface.
std::optional<double> crossingAlong(const GreyVolume& volume, const glm::dvec3& voxel, const glm::dvec3& way,
                                    double value) {
    constexpr int kPieces = 14, kHalvings = 12;
    const glm::dvec3 last(volume.frame.size - 1);
    const auto above = [&](double far) {
        return plainValue(volume, glm::clamp(voxel + far * way, glm::dvec3(0.0), last)) >= value;
    };
    const bool first = above(0);
    for (int n = 1; n <= kPieces; ++n) {
        double near = kNearSurface * (n - 1) / kPieces, far = kNearSurface * n / kPieces;
        if (above(far) == first) continue;
        for (int halving = 0; halving < kHalvings; ++halving) {
            const double middle = 0.5 * (near + far);
            (above(middle) == first ? near : far) = middle;
        }
        return 0.5 * (near + far);
    }
    return std::nullopt;
}

}  // namespace

bool thinnerThanVoxel(const GreyVolume& volume, const glm::dvec3& voxel, double value) {
    if (!(plainValue(volume, voxel) >= value)) return false;
    const glm::dvec3 last(volume.frame.size - 1);
    const auto within = [&](const glm::dvec3& place) { return glm::clamp(place, glm::dvec3(0.0), last); };
    const auto below = [&](const glm::dvec3& place) {
        return within(place) == place && plainValue(volume, place) < value;
    };
    // Returns the slope of the values just before the surface, per metre, from steps of a quarter voxel:
    // longer ones would hide which way it faces.
    const auto risesBefore = [&](const glm::dvec3& place, const glm::dvec3& outwards) {
        glm::dvec3 rises(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0.0);
            step[axis] = 0.25;
            const glm::dvec3 before = place + 0.3 * outwards;
            const double rise =
                plainValue(volume, within(before + step)) - plainValue(volume, within(before - step));
            rises[axis] = rise / volume.frame.spacing[axis];
        }
        return rises;
    };
    for (int n = 0; n < 13; ++n) {
        const glm::dvec3 way = glm::normalize(glm::dvec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
        if (!below(voxel + way) || !below(voxel - way)) continue;
        const auto ahead = crossingAlong(volume, voxel, way, value),
                   behind = crossingAlong(volume, voxel, -way, value);
        if (!ahead || !behind || !(*ahead + *behind < 1)) continue;
        // On a body that bulges lines along its surface leave it on both sides as well.
        const glm::dvec3 one = risesBefore(voxel + *ahead * way, way),
                         other = risesBefore(voxel - *behind * way, -way);
        if (glm::dot(one, other) < -0.5 * glm::length(one) * glm::length(other)) return true;
    }
    return false;
}

std::optional<glm::dvec3> nearestOfValue(const GreyVolume& volume, const glm::dvec3& voxel, double value,
                                         const glm::dvec3& normal) {
    const glm::dvec3 along = volume.frame.voxelDirection(normal);
    if (!(glm::length(along) > 0)) return std::nullopt;
    const glm::dvec3 towards = glm::normalize(along) * (plainValue(volume, voxel) >= value ? 1.0 : -1.0);
    const glm::dvec3 last(volume.frame.size - 1);
    const auto placeAt = [&](const glm::dvec3& way, double far) {
        return glm::clamp(voxel + far * way, glm::dvec3(0.0), last);
    };
    if (const auto far = crossingAlong(volume, voxel, towards, value)) return placeAt(towards, *far);
    std::optional<glm::dvec3> place;
    double nearest = 2 * kNearSurface;
    for (int n = 0; n < 27; ++n) {
        if (n == 13) continue;
        const glm::dvec3 way = glm::normalize(glm::dvec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
        const auto far = crossingAlong(volume, voxel, way, value);
        if (!far || *far >= nearest) continue;
        nearest = *far;
        place = placeAt(way, *far);
    }
    return place;
}

glm::dvec3 liftedStart(const GreyVolume& volume, double isovalue, const glm::dvec3& voxel,
                       const glm::dvec3& normal) {
    const glm::dvec3 last(volume.frame.size - 1);
    const glm::dvec3 way = volume.frame.voxelDirection(normal);
    const double length = glm::length(way);
    glm::dvec3 start = glm::clamp(voxel, glm::dvec3(0.0), last);
    if (!(length > 0)) return start;
    for (const double lift : kLifts) {
        start = glm::clamp(voxel + way * (lift / length), glm::dvec3(0.0), last);
        if (plainValue(volume, start) < isovalue) break;
    }
    return start;
}

}  // namespace stereonav
