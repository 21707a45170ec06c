#include "app/scene/mesh/mesh_type.h"

#include "app/scene/mesh/mesh_facts.h"
#include "app/scene/mesh/shown_mesh.h"
#include "engine/gltf/gltf_file.h"
#include "engine/math/constants.h"
#include "engine/mesh/mesh_file.h"

namespace stereonav {
namespace {

constexpr SunPlace kSun{225 * kRadians, 45 * kRadians};  // over the left shoulder of a viewer who looks north

bool isMesh(const std::string& file) {
    return hasGltfExtension(file);
}

std::unique_ptr<Scene> loadMesh(const SceneOptions& options, SimdTarget simd, Progress& progress) {
    Progress reading(progress, 0, 0.5), sorting(progress, 0.5, 1);
    TriangleMesh mesh = readMesh(options.scene, reading);
    const SunPlace sun = options.sun ? SunPlace{options.sun->azimuth, options.sun->elevation} : kSun;
    return std::make_unique<ShownMesh>(MeshCaster(std::move(mesh), options.scene, sorting), sun, simd);
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
