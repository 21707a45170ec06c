// How the wall bends: principal curvatures at the vertices of its mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "colon/wall/wall_mesh.h"

namespace stereonav {

// Principal curvatures, 1/metre, larger first; positive where flesh bulges into the lumen: 1/r and 1/r on a
// ball of flesh of radius r, 0 and -1/r in a tube of radius r.
struct Curvatures {
    float larger = 0, smaller = 0;

    float mean() const { return 0.5f * (larger + smaller); }  // 1/metre
    // Returns the shape index of Koenderink and van Doorn, "Surface shape and curvature scales", Image and
    // Vision Computing 10 (1992), 0 to 1: 0 for a pit of the lumen's wall (a cup), 0.5 for a saddle, 0.75 for
    // a ridge and 1 for a cap of flesh; 0.5 where flat.
    double shapeIndex() const;
    double curvedness() const;  // 1/metre: the root of the mean square of both
};

// Returns the curvature at one vertex, by a quadric fitted to the vertices within `radius` metres that are
// joined to it within that (Cazals and Pouget, "Estimating differential quantities using polynomial fitting
// of osculating jets", CAGD 22 (2005), of degree 2), weighted towards the middle. Flat where fewer than six
// of them tell anything.
Curvatures curvaturesAt(const WallMesh& mesh, const WallNeighbours& neighbours, std::uint32_t vertex,
                        double radius);

// Returns the curvatures at all vertices, in parallel; they do not depend on the number of threads.
std::vector<Curvatures> wallCurvatures(const WallMesh& mesh, const WallNeighbours& neighbours, double radius);

// Returns the vertices within `radius` metres of a vertex that are joined to it within that; the vertex
// first.
std::vector<std::uint32_t> verticesAround(const WallMesh& mesh, const WallNeighbours& neighbours,
                                          std::uint32_t vertex, double radius);

}  // namespace stereonav
