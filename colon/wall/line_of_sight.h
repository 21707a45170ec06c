// Whether two places of a lumen see each other: straight lines against the wall, one at a time.
#pragma once

#include <glm/vec3.hpp>

#include "engine/volume/surface_cells.h"
#include "engine/volume/volume.h"

namespace stereonav {

// The volume and its cells must outlive the object; safe to use from many threads.
class LineOfSight {
public:
    // The wall is where the trilinear value of `field` reaches `isovalue` (stored numbers); `cells` are those
    // of that surface or of more.
    LineOfSight(const GreyVolume& field, const SurfaceCells& cells, double isovalue);

    // Returns whether no wall is on the way, both ends included, however thin. World, metres. Returns false
    // where either end is outside the volume.
    bool clear(const glm::dvec3& from, const glm::dvec3& to) const;

    // Returns how far a line from `from` (in the lumen) gets towards `direction` (unit) before it meets wall,
    // metres; `upTo` where it meets none before; 0 where it starts in the wall.
    double reach(const glm::dvec3& from, const glm::dvec3& direction, double upTo) const;

    double smallestSpacing() const { return mSmallest; }  // metres
    // Returns the trilinear value at a place, stored numbers; beyond the volume the isovalue, which is wall.
    double valueAt(const glm::dvec3& world) const;

private:
    double valueIn(const glm::dvec3& voxel) const;
    bool contains(const glm::dvec3& voxel) const;

    const GreyVolume& mField;
    const SurfaceCells& mCells;
    double mIsovalue, mSmallest;  // stored number; metres
};

}  // namespace stereonav
