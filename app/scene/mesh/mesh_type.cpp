#include "app/scene/mesh/mesh_type.h"

#include "app/scene/mesh/mesh_facts.h"
#include "app/scene/mesh/shown_mesh.h"
#include "engine/gltf/gltf_file.h"
#include "engine/mesh/mesh_file.h"

namespace stereonav {
namespace {

bool isMesh(const std::string& file) {
    return hasGltfExtension(file);
}

std::unique_ptr<Scene> loadMesh(const SceneOptions& options, SimdTarget simd, Progress& progress) {
    Progress reading(progress, 0, 0.5), sorting(progress, 0.5, 1);
    TriangleMesh mesh = readMesh(options.scene, reading);
    return std::make_unique<ShownMesh>(MeshCaster(std::move(mesh), options.scene, sorting), options, simd);
}

}  // namespace

const SceneType& meshType() {
    static const SceneType type{.noun = "mesh",
                                .owns = isMesh,
                                .optionsFor = [](const std::string&) { return scene_type::kMeshFile; },
                                .glance = glanceAtMesh,
                                .load = loadMesh};
    return type;
}

}  // namespace stereonav
