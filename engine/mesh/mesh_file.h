// Shape and colour as read from glTF: the triangles of the default scene, node transforms applied. Not
// read: skins, morphing, opacity, and every texture but the base colour's.
#pragma once

#include <cstddef>
#include <filesystem>

#include "engine/base/progress.h"
#include "engine/mesh/triangle_mesh.h"

namespace stereonav {

// Primitives that a scene shows, each as often as nodes do.
constexpr std::size_t kMostMeshParts = 1'000'000;

// Throws Error naming the file and the mesh or accessor, Cancelled; at least one triangle is returned.
TriangleMesh readMesh(const std::filesystem::path& file, Progress& progress);
TriangleMesh readMesh(const std::filesystem::path& file);  // reports no progress

}  // namespace stereonav
