// Reads shape and colour from glTF: the triangles of the default scene with node transforms applied. Not
// read: skins, morphing, opacity, and textures other than the base colour's.
#pragma once

#include <cstddef>
#include <filesystem>

#include "engine/base/progress.h"
#include "engine/mesh/triangle_mesh.h"

namespace stereonav {

// Largest number of primitives in a scene; each counts as often as nodes use it.
constexpr std::size_t kMostMeshParts = 1'000'000;

// Throws Error naming the file and the mesh or accessor, Cancelled; at least one triangle is returned.
TriangleMesh readMesh(const std::filesystem::path& file, Progress& progress);
TriangleMesh readMesh(const std::filesystem::path& file);  // reports no progress

}  // namespace stereonav
