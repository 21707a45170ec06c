#include "colon/wall/line_of_sight.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/volume/plain_volume_caster.h"

namespace stereonav {
namespace {

constexpr double kBeyond = 1e-7;  // share of the smallest spacing: on into the next cell

// The cell that a line goes on into: on a face that of the side which it goes to. A line that hardly leaves a
// face would else stay beside it for steps without number.
glm::ivec3 cellAhead(const glm::dvec3& voxel, const glm::dvec3& perMetre, const glm::ivec3& size) {
    glm::ivec3 cell;
    for (int axis = 0; axis < 3; ++axis) {
        const double first = perMetre[axis] < 0 ? std::ceil(voxel[axis]) - 1 : std::floor(voxel[axis]);
        cell[axis] = std::clamp(static_cast<int>(first), 0, size[axis] - 2);
    }
    return cell;
}

// How far a line gets within its cell, from a place in it. Infinite where it only follows the volume's faces.
double leaving(const glm::dvec3& local, const glm::dvec3& perMetre) {
    double ahead = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double left = perMetre[axis] > 0 ? 1 - local[axis] : local[axis];
        if (perMetre[axis] != 0 && left > 0) ahead = std::min(ahead, left / std::abs(perMetre[axis]));
    }
    return ahead;
}

}  // namespace

LineOfSight::LineOfSight(const GreyVolume& field, const SurfaceCells& cells, double isovalue)
    : mField(field),
      mCells(cells),
      mIsovalue(isovalue),
      mSmallest(std::min({field.frame.spacing.x, field.frame.spacing.y, field.frame.spacing.z})) {}

bool LineOfSight::contains(const glm::dvec3& voxel) const {
    const glm::dvec3 last(mField.frame.size - 1);
    return voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x <= last.x && voxel.y <= last.y &&
           voxel.z <= last.z;
}

double LineOfSight::valueIn(const glm::dvec3& voxel) const {
    const glm::ivec3 c = glm::min(glm::ivec3(voxel), mField.frame.size - 2);
    const glm::dvec3 f = voxel - glm::dvec3(c);
    const std::int16_t* v = &mField.values[mField.frame.index(c)];
    const std::size_t row = mField.frame.size.x, slice = row * mField.frame.size.y;
    const auto along = [&](std::size_t at) { return v[at] + f.x * (v[at + 1] - v[at]); };
    const double low = along(0) + f.y * (along(row) - along(0));
    const double high = along(slice) + f.y * (along(slice + row) - along(slice));
    return low + f.z * (high - low);
}

double LineOfSight::valueAt(const glm::dvec3& world) const {
    const glm::dvec3 voxel = mField.frame.voxelFromWorld(world);
    return contains(voxel) ? valueIn(voxel) : mIsovalue;
}

double LineOfSight::reach(const glm::dvec3& from, const glm::dvec3& direction, double upTo) const {
    const VolumeFrame& frame = mField.frame;
    const glm::dvec3 start = frame.voxelFromWorld(from), perMetre = frame.voxelDirection(direction);
    for (double way = 0;;) {
        const glm::dvec3 voxel = start + way * perMetre;
        if (!contains(voxel)) return way;
        if (way >= upTo) return upTo;
        const glm::ivec3 cell = cellAhead(voxel, perMetre, frame.size);
        const std::uint8_t code = mCells.code(cell);
        if (code > kCellNear) {
            way = std::min(way + (code - 1) * mCells.leapUnit, upTo);
            continue;
        }
        const glm::dvec3 local = voxel - glm::dvec3(cell);
        const double ahead = std::min(leaving(local, perMetre), upTo - way);
        // Leaps are known where the region is; its other cells count as active.
        if (code == kCellActive) {
            const glm::dvec3 end = glm::clamp(local + ahead * perMetre, glm::dvec3(0.0), glm::dvec3(1.0));
            const double share = firstInCell(mField, mIsovalue, cell, local, end - local);
            if (share <= 1) return way + share * ahead;
        }
        way = std::min(way + std::max(ahead, kBeyond * mSmallest), upTo);
    }
}

bool LineOfSight::clear(const glm::dvec3& from, const glm::dvec3& to) const {
    const glm::dvec3 way = to - from;
    const double length = glm::length(way);
    if (!(length > 0)) return valueAt(from) < mIsovalue;
    // Ends outside the volume or in the wall are told by their value.
    return valueAt(from) < mIsovalue && valueAt(to) < mIsovalue &&
           reach(from, way / length, length) >= length;
}

}  // namespace stereonav
