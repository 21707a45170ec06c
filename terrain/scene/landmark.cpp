// Landmarks: placed, kept as floats about their own centre, and cast with Embree 3. Embree says which
// triangle is hit first; depth and barycentric coordinates are computed again here in double precision,
// so that they do not depend on which rays share a packet.
#include "terrain/scene/landmark.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/base/error.h"
#include "terrain/scene/landmark_mesh.h"
#include "terrain/scene/landmark_shader.h"

namespace stereonav {
namespace {

constexpr int kMaxPacket = 16;

struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using Scene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

// World position of a mesh's own (x, y, z), before it is set on the ground: turned clockwise.
glm::dvec3 placed(const LandmarkFile& file, const glm::dvec3& p) {
    const double c = std::cos(file.heading), s = std::sin(file.heading);
    return file.scale * glm::dvec3(c * p.x + s * p.y, -s * p.x + c * p.y, p.z) +
           glm::dvec3(file.positionWorld, 0.0);
}

// How far up the placed mesh has to be moved.
double elevationOf(const LandmarkFile& file, const LandmarkMesh& mesh, const Heightfield& ground) {
    if (file.z) return *file.z;
    const glm::dvec2 at = file.positionWorld;
    const double height =
        ground.contains(at) ? ground.heightAt(at) : std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(height))
        throw Error(file.mesh.string(), "position",
                    fmt::format("expected a place on the ground, got {:g}, {:g} metres", at.x, at.y),
                    "move the landmark or give it a z");
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

LandmarkMesh readAndPlace(const LandmarkFile& file, const Heightfield& ground) {
    checkPlacement(file);
    LandmarkMesh mesh = readLandmarkMesh(file.mesh);
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
void append(LandmarkMesh& all, LandmarkMesh&& mesh) {
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

struct PacketHits {
    std::uint32_t triangle[kMaxPacket];  // RTC_INVALID_GEOMETRY_ID: none
    float t[kMaxPacket];
};

// N rays from one origin; lanes with tFar < 0 take no part.
template <int N, typename RayHit, typename Intersect>
void castPacket(RTCScene scene, const glm::vec3& origin, float tNear, const glm::dvec3* direction,
                const float* tFar, int count, PacketHits& hits, const Intersect& intersect) {
    RayHit rays{};
    alignas(64) int valid[N];
    for (int k = 0; k < N; ++k) {
        const bool used = k < count && tFar[k] > tNear;
        const glm::vec3 d = used ? glm::vec3(direction[k]) : glm::vec3(0, 0, 1);
        valid[k] = used ? -1 : 0;
        rays.ray.org_x[k] = origin.x, rays.ray.org_y[k] = origin.y, rays.ray.org_z[k] = origin.z;
        rays.ray.dir_x[k] = d.x, rays.ray.dir_y[k] = d.y, rays.ray.dir_z[k] = d.z;
        rays.ray.tnear[k] = tNear;
        rays.ray.tfar[k] = used ? tFar[k] : -1.0f;
        rays.ray.mask[k] = ~0u;
        rays.hit.geomID[k] = rays.hit.primID[k] = RTC_INVALID_GEOMETRY_ID;
        rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    intersect(valid, scene, &context, &rays);
    for (int k = 0; k < std::min(N, count); ++k) {
        const bool hit = valid[k] && rays.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
        hits.triangle[k] = hit ? rays.hit.primID[k] : RTC_INVALID_GEOMETRY_ID;
        hits.t[k] = rays.ray.tfar[k];
    }
}

// The part of a view's window (at view depth 1) that a box covers: other rays need not be cast. All of
// it when the box reaches behind the near depth.
class Silhouette {
public:
    Silhouette(const EyeView& view, const glm::dvec3& low, const glm::dvec3& high) : mView(view) {
        constexpr double kMargin = 1e-4;  // Embree sees the directions as floats, rounded to 6e-8
        const glm::dvec2 everywhere(std::numeric_limits<double>::infinity());
        glm::dvec2 least = everywhere, most = -everywhere;
        for (int k = 0; k < 8; ++k) {
            const glm::dvec3 corner(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
            const glm::dvec3 d = corner - view.eye;
            const double depth = glm::dot(d, view.forward);
            if (!(depth > view.nearDepth)) return;
            const glm::dvec2 seen = glm::dvec2(glm::dot(d, view.right), glm::dot(d, view.up)) / depth;
            least = glm::min(least, seen - kMargin);
            most = glm::max(most, seen + kMargin);
        }
        mLeast = least;
        mMost = most;
    }

    // Whether any of the rays may meet the box.
    bool touches(const glm::dvec3* direction, int count) const {
        for (int k = 0; k < count; ++k) {
            const glm::dvec2 d(glm::dot(direction[k], mView.right), glm::dot(direction[k], mView.up));
            if (d.x >= mLeast.x && d.x <= mMost.x && d.y >= mLeast.y && d.y <= mMost.y) return true;
        }
        return false;
    }

private:
    const EyeView& mView;
    glm::dvec2 mLeast{-std::numeric_limits<double>::infinity()};
    glm::dvec2 mMost{std::numeric_limits<double>::infinity()};
};

int nativePacket(RTCDevice device) {
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return 16;
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) return 8;
    return 4;
}

}  // namespace

struct LandmarkSet::State {
    LandmarkShader shader;
    glm::dvec3 centre{0.0}, low{0.0}, high{0.0};  // world
    Device device;
    Scene scene;
    int packet = 4;

    State(LandmarkMesh&& mesh, const TerrainLook& look) : shader(std::move(mesh), look) {
        low = glm::dvec3(std::numeric_limits<double>::infinity());
        high = -low;
        for (const auto& vertex : shader.mesh().vertices) {
            low = glm::min(low, vertex.position);
            high = glm::max(high, vertex.position);
        }
        centre = 0.5 * (low + high);
        shader.recentre(centre);
    }
    void build(const std::string& name);
    void cast(const glm::vec3& origin, float tNear, const glm::dvec3* direction, const float* tFar, int count,
              PacketHits& hits) const;
};

void LandmarkSet::State::build(const std::string& name) {
    const auto failed = [&] {
        const RTCError code = rtcGetDeviceError(device.get());
        throw Error(name, "",
                    fmt::format("the ray tracing library refused it (code {})", static_cast<int>(code)),
                    "simplify the mesh, or free memory");
    };
    device.reset(rtcNewDevice(nullptr));
    if (!device) failed();
    packet = nativePacket(device.get());
    scene.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto& mesh = shader.mesh();
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.vertices.size()));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    if (vertices && indices) {
        for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
            for (int c = 0; c < 3; ++c)
                vertices[3 * k + c] = static_cast<float>(mesh.vertices[k].position[c]);
        for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
            std::copy_n(mesh.triangles[k].vertex, 3, indices + 3 * k);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene.get(), geometry);
    }
    rtcReleaseGeometry(geometry);
    if (!vertices || !indices) failed();
    rtcCommitScene(scene.get());
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) failed();
}

void LandmarkSet::State::cast(const glm::vec3& origin, float tNear, const glm::dvec3* direction,
                              const float* tFar, int count, PacketHits& hits) const {
    if (packet == 16)
        castPacket<16, RTCRayHit16>(scene.get(), origin, tNear, direction, tFar, count, hits, rtcIntersect16);
    else if (packet == 8)
        castPacket<8, RTCRayHit8>(scene.get(), origin, tNear, direction, tFar, count, hits, rtcIntersect8);
    else
        castPacket<4, RTCRayHit4>(scene.get(), origin, tNear, direction, tFar, count, hits, rtcIntersect4);
}

LandmarkSet::LandmarkSet(const std::vector<LandmarkFile>& files, const Heightfield& ground,
                         const TerrainLook& look) {
    if (files.empty()) throw Error("", "landmarks", "expected at least one mesh, got none", "name one");
    LandmarkMesh all;
    for (const LandmarkFile& file : files) append(all, readAndPlace(file, ground));
    mState = std::make_unique<State>(std::move(all), look);
    mState->build(files.front().mesh.string());
}

LandmarkSet::~LandmarkSet() = default;

void LandmarkSet::cast(const EyeView& view, int count, const glm::dvec3* direction, float* viewDepth,
                       PackedColor* color, bool throughFog) const {
    const glm::dvec3 origin = view.eye - mState->centre;
    const auto nearDepth = static_cast<float>(view.nearDepth);
    const Silhouette silhouette(view, mState->low, mState->high);
    for (int first = 0; first < count; first += mState->packet) {
        const int lanes = std::min(mState->packet, count - first);
        if (!silhouette.touches(direction + first, lanes)) continue;
        PacketHits hits;
        mState->cast(glm::vec3(origin), nearDepth, direction + first, viewDepth + first, lanes, hits);
        for (int k = 0; k < lanes; ++k) {
            if (hits.triangle[k] == RTC_INVALID_GEOMETRY_ID) continue;
            const LandmarkHit hit =
                mState->shader.hitAt(hits.triangle[k], origin, direction[first + k], hits.t[k]);
            const auto depth = static_cast<float>(hit.t);
            if (!(depth < viewDepth[first + k]) || depth < nearDepth) continue;
            viewDepth[first + k] = depth;
            color[first + k] =
                mState->shader.color(hit, direction[first + k], view.pixelHeight(), throughFog);
        }
    }
}

void LandmarkSet::setLook(const TerrainLook& look) {
    mState->shader.setLook(look);
}

glm::dvec3 LandmarkSet::boundsMin() const {
    return mState->low;
}
glm::dvec3 LandmarkSet::boundsMax() const {
    return mState->high;
}
std::size_t LandmarkSet::triangleCount() const {
    return mState->shader.mesh().triangles.size();
}

}  // namespace stereonav
