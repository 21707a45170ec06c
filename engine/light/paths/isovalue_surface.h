// The isosurface through any point of a volume, for any isovalue: the traced isovalue, smoothed normals (Y3
// of docs/ledger.md) and starts of rays. Double precision; the kernels do the same with vectors.
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
// Returns the isovalue that is traced for a stored value: the value itself, except for the volume's least
// value, at which everything would be solid. For that it is a little larger, so that the surface lies where
// the values begin to rise.
inline double tracedIsovalue(double value, double leastOfVolume) {
    const double least = leastOfVolume + kAboveLeast;
    return value < least ? least : value;
}

// Where the smoothed gradient along the slope of the trilinear values is less than this share of that slope,
// it does not belong to this surface: the solid is thinner than a voxel there, and the smoothed gradient is
// that of one side or the other. The slope tells which side.
constexpr float kOwnSlope = 0.25f;

// Returns the unit normal, world, towards smaller values, on this side of the solid. 0 where the smoothed
// gradient vanishes: it is less than a millionth of the largest gradient that the values of the 4x4x4 voxels
// could have, or these are all equal.
glm::dvec3 surfaceNormal(const GreyVolume& volume, const glm::dvec3& voxel);

// Heights in voxels along the normal at which rays may start above the surface (Y3: the trilinear surface is
// bumpier than its smoothed normals). The first is used at which the value is below the isovalue, else the
// last. From a quarter up, planes and balls with edges 1 to 2 voxels wide and noise of 2 % hide at most 0.05
// % of their own sky from themselves; with a sixteenth it was 0.3 %. A start that is still at or above the
// isovalue lies in the solid, where every ray ends at once: such places get no direct light, and paths that
// reach them bounce on the spot.
constexpr std::array<double, 3> kLifts{0.25, 0.5, 1.0};

// Returns the start of rays from a point in voxel space with a unit normal in the world, kept within the
// volume's box.
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
