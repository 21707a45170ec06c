// The ground as a triangle mesh of chosen error, for other programs.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <vector>

#include "engine/base/progress.h"
#include "engine/image/color_texture.h"
#include "terrain/ground/heightfield.h"
#include "terrain/mesh/mesh_place.h"

namespace stereonav {

// Vertices are samples of the ground. Triangles are counterclockwise seen from above, cover all cells
// without a hole and nothing else, and share their edges: there are no cracks.
struct TerrainMesh {
    std::vector<glm::ivec2> vertices;  // sample (i, j)
    std::vector<std::array<std::uint32_t, 3>> triangles;
    double maxError = 0;  // metres: the largest vertical distance of a sample to the mesh, measured
};

// Simplifies the ground to few triangles. error: the largest vertical distance, in metres and >= 0, that any
// sample may have to the mesh (apart from rounding: 1e-12 of the heights). Throws Error for other values;
// Cancelled.
TerrainMesh simplifyTerrain(const Heightfield& ground, double error, Progress& progress);

// Returns whether a mesh can be written under this name: .glb or .gltf.
bool isMeshFileName(const std::filesystem::path& file);

// Writes .glb or .gltf: positions in metres from the world's origin (y up), normals, and the colour
// texture as a picture inside, unlit since the light is in it. Its place is in the node's extras and, but for
// pipes and devices, in meshPlaceFile(). Both are written beside and renamed. Throws Error: then both places
// are as they were.
void writeTerrainMesh(const std::filesystem::path& file, const Heightfield& ground, const ColorTexture& color,
                      const TerrainMesh& mesh, const MeshPlace& place = {});

}  // namespace stereonav
