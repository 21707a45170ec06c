// The wall of a lumen as triangles: what instruments measure on. One vertex in each cell that holds wall, so
// that a place in the volume and a place on the mesh are found from each other.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/base/progress.h"
#include "engine/volume/surface_cells.h"
#include "engine/volume/volume.h"

namespace stereonav {

struct WallMesh {
    // By vertex; what is near in space is mostly near in number.
    std::vector<glm::vec3> places;                        // world, metres
    std::vector<glm::vec3> normals;                       // unit, into the lumen
    std::vector<float> areas;                             // square metres: a third of the triangles around it
    std::vector<glm::ivec3> cells;                        // cell of the volume that each vertex lies in
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise as seen from the lumen

    double area() const;  // square metres
};

// Makes the surface between voxels of `lumen` and others, where `field` reaches the isovalue of `cells`
// between them. All three are of one frame; `cells` are those of that surface, or of more (findSurfaceCells).
// A vertex is the mean of the places where the wall crosses its cell's edges, and a quadrilateral, cut along
// its shorter diagonal, joins the four cells around each such edge (Gibson, "Constrained elastic surface
// nets", MICCAI 1998; without her relaxation: the places come from grey values). Flat walls are exact; round
// ones are cut off by about an eighth of a voxel's square over the radius. The wall is open where the lumen
// meets the volume's faces. The result does not depend on the number of threads. Throws Error where there is
// not enough memory, Cancelled.
WallMesh wallMesh(const GreyVolume& field, const SurfaceCells& cells, const MaskVolume& lumen,
                  Progress& progress);

// Vertices joined by triangles, for each vertex: neighbours[first[v]] to neighbours[first[v + 1]], ascending,
// each once.
struct WallNeighbours {
    std::vector<std::uint32_t> first, neighbours;
};
WallNeighbours neighboursOf(const WallMesh& mesh);

}  // namespace stereonav
