// The isosurface through any point of a volume, for any isovalue: where it is traced, its smoothed normals
// (Y3 of docs/ledger.md) and where rays start from it. Double precision; the kernels do the same in vectors.
//
// Solid is where the trilinear value is at or above the isovalue; light comes from the side of smaller
// values.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/volume/volume.h"

namespace stereonav {

constexpr float kAboveLeast = 1.0f / 16;  // stored numbers, which are whole
// Returns the isovalue that is traced for a stored value: the value itself but for the volume's least, at
// which all would be solid. There it is a little more, so that the surface lies where the values begin to
// rise.
inline double tracedIsovalue(double value, double leastOfVolume) {
    const double least = leastOfVolume + kAboveLeast;
    return value < least ? least : value;
}

// Where the smoothed gradient has less than this of the trilinear values' own slope, it is not of this
// surface: what is solid is thinner than a voxel there, and the smoothed gradient that of one side or the
// other. The slope knows the side.
constexpr float kOwnSlope = 0.25f;

// Returns the unit normal, world, towards smaller values on this side of what is solid; 0 where the smoothed
// gradient vanishes: it is less than a millionth of what the values within 4x4x4 voxels could give, or these
// do not differ.
glm::dvec3 surfaceNormal(const GreyVolume& volume, const glm::dvec3& voxel);

// Voxels along the normal by which rays start above the surface (Y3: the trilinear surface is bumpier than
// its smoothed normals say): the first of these at which the value is below the isovalue, else the last. From
// a quarter up, planes and balls with edges 1 to 2 voxels wide and noise of 2 % hide at most 0.05 % of their
// own sky from themselves; from a sixteenth it was 0.3 %. A start that still is at or above it lies in what
// is solid, and every ray from there ends there at once: such places get no light directly, and paths that
// reach them bounce on the spot.
constexpr std::array<double, 3> kLifts{0.25, 0.5, 1.0};

// Returns the start of rays from a point of voxel space with a unit world normal, kept within the volume's
// box.
glm::dvec3 liftedStart(const GreyVolume& volume, double isovalue, const glm::dvec3& voxel,
                       const glm::dvec3& normal);

// Returns whether what is solid, at or above `value`, is less than a voxel thick at a place in it: the
// surface lies on both sides of it along one of the 13 ways to opposite voxels, and faces away from it there.
// The light there would be that of either side.
bool thinnerThanVoxel(const GreyVolume& volume, const glm::dvec3& voxel, double value);

constexpr double kNearSurface = 1.75;  // voxels
// Returns the nearest place where the trilinear value is `value`, along the normal or, where it is not there,
// along the 26 directions to voxels around, within kNearSurface voxels; none where there is none. voxel:
// inside the volume.
std::optional<glm::dvec3> nearestOfValue(const GreyVolume& volume, const glm::dvec3& voxel, double value,
                                         const glm::dvec3& normal);

}  // namespace stereonav
