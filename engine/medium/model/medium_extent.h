// The extent of the part of a grid that is not empty, which bounds a medium.
#pragma once

#include <glm/vec3.hpp>

#include "engine/volume/volume.h"

namespace stereonav {

struct GreyRange {
    double lowest = 0, highest = 0;  // values
};
// Returns the least and the greatest value (not stored number) of a grid with at least one voxel.
GreyRange valueRange(const GreyVolume& field);

struct CellBox {
    glm::ivec3 first{0}, last{-1};  // voxels: lowest and highest corner of the cells that were found
    bool empty() const { return last.x < first.x; }
};
// Returns the cells of eight voxels in which the trilinear value comes strictly between the two values.
CellBox cellsBetween(const GreyVolume& field, double lowest, double highest);

}  // namespace stereonav
