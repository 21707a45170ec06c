// Shape and colour as read from glTF: the triangles of the default scene, node transforms applied. Not
// read: skins, morphing, opacity, and every texture but the base colour's.
#pragma once

#include <filesystem>

#include "engine/base/progress.h"
#include "engine/mesh/triangle_mesh.h"

namespace stereonav {

// Throws Error naming the file and the mesh or accessor, Cancelled; at least one triangle is returned.
TriangleMesh readMesh(const std::filesystem::path& file, Progress& progress);
TriangleMesh readMesh(const std::filesystem::path& file);  // that nobody waits for

}  // namespace stereonav
