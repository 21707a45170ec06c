#include "colon/centreline/centreline_probe.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace stereonav {
namespace {

// A weighted sum of the values at a cell's corners; corners with weight 0 are not read.
template <typename Value>
double trilinear(const glm::ivec3& corner, const glm::dvec3& share, const Value& value) {
    double sum = 0;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 up(n & 1, n >> 1 & 1, n >> 2);
        const glm::dvec3 w = glm::mix(1.0 - share, share, glm::dvec3(up));
        if (const double weight = w.x * w.y * w.z; weight > 0) sum += weight * value(corner + up);
    }
    return sum;
}

}  // namespace

LumenProbe::LumenProbe(const LumenField& lumen, const DistanceVolume& distance, int segment)
    : mLumen(lumen), mDistance(distance), mSegment(segment) {
    const glm::dvec3& s = lumen.lumen.frame.spacing;
    mSmallest = std::min({s.x, s.y, s.z});
    mDiagonal = glm::length(s);
}

bool LumenProbe::locate(const glm::dvec3& world, Cell& cell) const {
    const VolumeFrame& frame = mLumen.lumen.frame;
    const glm::dvec3 v = frame.voxelFromWorld(world), low = glm::floor(v);
    // Rounding may move a voxel's centre off its place when it is converted to the world and back.
    constexpr double kSlack = 1e-6;
    for (int axis = 0; axis < 3; ++axis)
        if (!(v[axis] >= -kSlack && v[axis] <= frame.size[axis] - 1 + kSlack)) return false;
    cell.corner = glm::clamp(glm::ivec3(low), glm::ivec3(0), frame.size - 1);
    cell.share = glm::clamp(v - glm::dvec3(cell.corner), 0.0, 1.0);
    for (int axis = 0; axis < 3; ++axis)
        if (cell.corner[axis] == frame.size[axis] - 1) cell.share[axis] = 0;
    return true;
}

bool LumenProbe::inside(const glm::dvec3& world) const {
    Cell cell;
    if (!locate(world, cell)) return false;
    const glm::ivec3 nearest = cell.corner + glm::ivec3(glm::greaterThanEqual(cell.share, glm::dvec3(0.5)));
    if (mLumen.lumen.at(nearest) != mSegment) return false;
    if (mLumen.field.empty()) return true;
    return trilinear(cell.corner, cell.share, [&](const glm::ivec3& v) { return mLumen.field.at(v); }) <
           mLumen.isovalue;
}

bool LumenProbe::lineInside(const glm::dvec3& a, const glm::dvec3& b) const {
    const double length = glm::length(b - a);
    // If the wall is this far away, all cells on the line lie inside. The half spacing allows for errors of
    // the interpolated distance.
    if (distance(a) > length + mDiagonal + 0.5 * mSmallest) return inside(a);
    const int pieces = static_cast<int>(std::min(std::ceil(length / (0.25 * mSmallest)), 1e6));
    for (int n = 0; n <= pieces; ++n)
        if (!inside(pieces ? glm::mix(a, b, static_cast<double>(n) / pieces) : a)) return false;
    return true;
}

double LumenProbe::distance(const glm::dvec3& world) const {
    Cell cell;
    if (!locate(world, cell)) return 0;
    return mDistance.unit *
           trilinear(cell.corner, cell.share, [&](const glm::ivec3& v) { return mDistance.at(v); });
}

double LumenProbe::radius(const glm::dvec3& world) const {
    return std::max(0.0, distance(world) - 0.5 * mSmallest);
}

}  // namespace stereonav
