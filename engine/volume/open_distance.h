// The free distance for eyes that look at a volume from outside: beyond the volume's faces there is nothing.
#pragma once

#include "engine/volume/surface_cells.h"

namespace stereonav {

// Returns metres that are free of surface around a world point, at most upTo. In the volume it is
// freeDistance() (surface_cells.h) without the faces, which do not count as surface. Outside, no surface is
// nearer than the root of the squares of the way to the volume's box and of the free distance where that way
// ends, since the box is convex; that is the answer. Not finite points: 0.
double openDistance(const SurfaceCells& cells, const glm::dvec3& world, double upTo, double tolerance);

}  // namespace stereonav
