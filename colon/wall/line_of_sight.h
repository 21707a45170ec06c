// Visibility between two places of a lumen: tests single straight lines against the wall.
#pragma once

#include <glm/vec3.hpp>

#include "engine/volume/surface_cells.h"
#include "engine/volume/volume.h"

namespace stereonav {

// The volume and its cells must outlive this object; it may be used by many threads.
class LineOfSight {
public:
    // The wall is where the trilinear value of `field` reaches `isovalue` (stored numbers). cells: contain at
    // least all cells of that surface.
    LineOfSight(const GreyVolume& field, const SurfaceCells& cells, double isovalue);

    // Returns whether there is no wall, however thin, between two places, including both. World, metres.
    // False where either place is outside the volume.
    bool clear(const glm::dvec3& from, const glm::dvec3& to) const;

    // Returns the distance in metres from `from` (in the lumen) to the first wall in a unit direction; `upTo`
    // where there is none before; 0 where it starts in the wall.
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
