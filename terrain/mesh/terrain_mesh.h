// The ground as a triangle mesh of chosen error, for other programs.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/image/color_texture.h"
#include "terrain/ground/heightfield.h"

namespace stereonav {

// Vertices are samples of the ground. Triangles are counterclockwise seen from above, cover all cells
// without a hole and nothing else, and share their edges: there are no cracks.
struct TerrainMesh {
    std::vector<glm::ivec2> vertices;  // sample (i, j)
    std::vector<std::array<std::uint32_t, 3>> triangles;
    double maxError = 0;  // metres: the largest vertical distance of a sample to the mesh, measured
};

// error: the largest vertical distance, in metres and >= 0, that any sample may have to the mesh (apart
// from rounding: 1e-12 of the heights). Throws Error for other values; Cancelled.
TerrainMesh simplifyTerrain(const Heightfield& ground, double error, Progress& progress);

// Where a mesh lies, for who puts it beside other data: kept in the file, and not read back, as this program
// shows meshes by themselves. x, y of a place are offset + world / unit in its system; world: x east, y
// north, which are x and -z of the file's axes.
struct MeshPlace {
    std::string crs;                   // name of the elevation model's reference system; "": none
    std::optional<glm::dvec2> offset;  // of the world's origin in it; none: the ground is in another plane
    double unit = 1;                   // metres of a unit of it
    std::optional<glm::dvec2> originDegrees;  // longitude and latitude of the world's origin, WGS 84
    double verticalScale = 1;                 // of the heights: so many times those of the elevation model
};

// Whether a mesh can be written under this name: .glb or .gltf.
bool isMeshFileName(const std::filesystem::path& file);

// Writes .glb or .gltf: positions in metres from the world's origin (y up), normals, and the colour
// texture as a picture inside, unlit since the light is in it; its place as extras of the scene and of its
// node, `stereonav_place`. Written beside and renamed. Throws Error.
void writeTerrainMesh(const std::filesystem::path& file, const Heightfield& ground, const ColorTexture& color,
                      const TerrainMesh& mesh, const MeshPlace& place = {});

}  // namespace stereonav
