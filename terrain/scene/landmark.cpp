// Landmarks: placed on the ground, and cast as one mesh.
#include "terrain/scene/landmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "engine/base/error.h"
#include "engine/mesh/mesh_caster.h"
#include "engine/mesh/mesh_file.h"
#include "terrain/light/fog.h"
#include "terrain/light/sun_and_sky.h"

namespace stereonav {
namespace {

// World position of a mesh's own (x, y, z), before it is set on the ground: turned clockwise.
glm::dvec3 placed(const LandmarkFile& file, const glm::dvec3& p) {
    const double c = std::cos(file.heading), s = std::sin(file.heading);
    return file.scale * glm::dvec3(c * p.x + s * p.y, -s * p.x + c * p.y, p.z) +
           glm::dvec3(file.positionWorld, 0.0);
}

// How far up the placed mesh has to be moved.
double elevationOf(const LandmarkFile& file, const TriangleMesh& mesh, const Heightfield& ground) {
    if (file.z) return *file.z;
    const glm::dvec2 at = file.positionWorld;
    const double height =
        ground.contains(at) ? ground.heightAt(at) : std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(height))
        throw Error(file.mesh.string(), "position",
                    fmt::format("expected a place on the ground, got {:g}, {:g} metres", at.x, at.y),
                    "move the landmark, or give position_m a height");
    double base = std::numeric_limits<double>::infinity();
    for (const auto& vertex : mesh.vertices) base = std::min(base, file.scale * vertex.position.z);
    return height - base;
}

void checkPlacement(const LandmarkFile& file) {
    const bool finite = std::isfinite(file.positionWorld.x) && std::isfinite(file.positionWorld.y) &&
                        std::isfinite(file.z.value_or(0)) && std::isfinite(file.heading);
    if (!finite)
        throw Error(file.mesh.string(), "position", "expected finite numbers",
                    "correct position and heading");
    if (!(file.scale > 0 && std::isfinite(file.scale)))
        throw Error(file.mesh.string(), "scale",
                    fmt::format("expected a scale above 0, got {:g}", file.scale), "correct it");
}

TriangleMesh readAndPlace(const LandmarkFile& file, const Heightfield& ground) {
    checkPlacement(file);
    TriangleMesh mesh = readMesh(file.mesh);
    const double elevation = elevationOf(file, mesh, ground);
    const double c = std::cos(file.heading), s = std::sin(file.heading);
    for (auto& vertex : mesh.vertices) {
        vertex.position = placed(file, vertex.position) + glm::dvec3(0, 0, elevation);
        const glm::dvec3 n(vertex.normal);
        vertex.normal = glm::vec3(c * n.x + s * n.y, -s * n.x + c * n.y, n.z);
    }
    return mesh;
}

// Appends one mesh's lists to another's.
void append(TriangleMesh& all, TriangleMesh&& mesh) {
    const auto vertexBase = static_cast<std::uint32_t>(all.vertices.size());
    const int materialBase = static_cast<int>(all.materials.size());
    const int textureBase = static_cast<int>(all.textures.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (auto triangle : mesh.triangles) {
        for (auto& v : triangle.vertex) v += vertexBase;
        triangle.material += materialBase;
        all.triangles.push_back(triangle);
    }
    for (auto material : mesh.materials) {
        if (material.texture >= 0) material.texture += textureBase;
        all.materials.push_back(material);
    }
    std::move(mesh.textures.begin(), mesh.textures.end(), std::back_inserter(all.textures));
}

// All meshes as one.
TriangleMesh readAll(const std::vector<LandmarkFile>& files, const Heightfield& ground) {
    if (files.empty()) throw Error("", "landmarks", "expected at least one mesh, got none", "name one");
    TriangleMesh all;
    for (const LandmarkFile& file : files) append(all, readAndPlace(file, ground));
    return all;
}

}  // namespace

struct LandmarkSet::State {
    MeshCaster caster;
    MeshLight light;
    Fog fog;

    PackedColor seen(const MeshHit& hit, const glm::dvec3& eye, const glm::dvec3& direction, double pixelSize,
                     bool throughFog) const {
        const glm::vec3 color = colorOf(caster.mesh(), hit, direction, pixelSize, light);
        if (!throughFog || !fog.any()) return packColor(color);
        return packColor(fog.seen(glm::clamp(color, 0.0f, 1.0f), eye, direction, hit.t));
    }
};

LandmarkSet::LandmarkSet(const std::vector<LandmarkFile>& files, const Heightfield& ground,
                         const TerrainLook& look)
    : mState(new State{MeshCaster(readAll(files, ground), files.front().mesh.string()), {}, {}}) {
    setLook(look);
}

LandmarkSet::~LandmarkSet() = default;

void LandmarkSet::cast(const EyeView& view, int count, const glm::dvec3* direction, float* viewDepth,
                       PackedColor* color, bool throughFog) const {
    const MeshRays rays(mState->caster, view);
    const int packet = mState->caster.packet();
    MeshHit hits[MeshCaster::kMostRays];
    for (int first = 0; first < count; first += packet) {
        const int lanes = std::min(packet, count - first);
        if (!rays.cast(direction + first, viewDepth + first, lanes, hits)) continue;
        for (int k = 0; k < lanes; ++k) {
            if (hits[k].triangle == MeshHit::kNone) continue;
            viewDepth[first + k] = static_cast<float>(hits[k].t);
            color[first + k] =
                mState->seen(hits[k], view.eye, direction[first + k], view.pixelHeight(), throughFog);
        }
    }
}

void LandmarkSet::setLook(const TerrainLook& look) {
    mState->light.toSun =
        sunUp(std::sin(look.sunElevation)) * directionToSun(look.sunAzimuth, look.sunElevation);
    mState->light.ambient = look.ambient;
    mState->fog = Fog(look);
}

glm::dvec3 LandmarkSet::boundsMin() const {
    return mState->caster.low();
}
glm::dvec3 LandmarkSet::boundsMax() const {
    return mState->caster.high();
}
std::size_t LandmarkSet::triangleCount() const {
    return mState->caster.mesh().triangles.size();
}

}  // namespace stereonav
