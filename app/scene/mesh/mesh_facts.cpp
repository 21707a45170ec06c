#include "app/scene/mesh/mesh_facts.h"

#include <fmt/format.h>

#include "app/scene/type/held_facts.h"
#include "engine/mesh/mesh_renderer.h"

namespace stereonav {

Facts factsOfMesh(const Scene& scene) {
    const MeshCaster& caster = scene.offered<const MeshRenderer>()->caster();
    const TriangleMesh& mesh = caster.mesh();
    const glm::dvec3 size = caster.high() - caster.low(), middle = 0.5 * (caster.low() + caster.high());
    std::size_t textureBytes = 0;
    for (const ColorTexture& texture : mesh.textures) textureBytes += texture.byteCount();
    FactList list;
    list.both("triangles", countOf(mesh.triangles.size()), "triangles");
    list.both("vertices", countOf(mesh.vertices.size()), "vertices");
    list.both("textures", countOf(mesh.textures.size()), "textures");
    list.both("size", FactNumbers{size.x, size.y, size.z}, "size",
              fmt::format("{:.6g} x {:.6g} x {:.6g} m", size.x, size.y, size.z), "m");
    list.both("middle", FactNumbers{middle.x, middle.y, middle.z}, "middle",
              fmt::format("{:.6g}, {:.6g}, {:.6g} m", middle.x, middle.y, middle.z), "m");
    const std::string held =
        addHeld(list.facts(), {{"vertices", mesh.vertices.size() * sizeof(TriangleMesh::Vertex)},
                               {"triangles", mesh.triangles.size() * sizeof(TriangleMesh::Triangle)},
                               {"tree", caster.treeBytes()},
                               {"textures", textureBytes}});
    list.text("memory", held);
    return std::move(list.facts());
}

}  // namespace stereonav
