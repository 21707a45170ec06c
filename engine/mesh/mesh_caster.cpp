#include "engine/mesh/mesh_caster.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>

#include "engine/base/error.h"

namespace stereonav {
namespace {

struct DeviceRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using Tree = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

struct PacketHits {
    std::uint32_t triangle[MeshCaster::kMostRays];  // RTC_INVALID_GEOMETRY_ID: none
    float t[MeshCaster::kMostRays];
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

// Reports Embree's progress while it builds, on any of its threads; never less than before.
class BuildProgress {
public:
    explicit BuildProgress(Progress& progress) : mProgress(progress) { tell(0); }

    void tell(double fraction) {
        const std::lock_guard lock(mMutex);
        mTold = std::clamp(fraction, mTold, 1.0);
        mProgress.report(mTold, "sorting the mesh's triangles");
    }

private:
    Progress& mProgress;
    std::mutex mMutex;
    double mTold = 0;
};

// Called by Embree now and then while it builds; returning false ends its work.
bool goesOn(void* asked, double fraction) {
    try {
        static_cast<BuildProgress*>(asked)->tell(fraction);
    } catch (const Cancelled&) {
        return false;
    }
    return true;
}

int nativePacket(RTCDevice device) {
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return 16;
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) return 8;
    return 4;
}

}  // namespace

struct MeshCaster::State {
    TriangleMesh mesh;
    glm::dvec3 centre{0.0}, low{0.0}, high{0.0};  // world
    std::atomic<std::ptrdiff_t> treeBytes = 0;    // told by the device, also while it ends
    Device device;
    Tree tree;
    int packet = 4;

    explicit State(TriangleMesh&& given) : mesh(std::move(given)) {
        low = glm::dvec3(std::numeric_limits<double>::infinity());
        high = -low;
        for (const auto& vertex : mesh.vertices) {
            low = glm::min(low, vertex.position);
            high = glm::max(high, vertex.position);
        }
        centre = 0.5 * (low + high);
        for (auto& vertex : mesh.vertices) vertex.position = glm::dvec3(glm::vec3(vertex.position - centre));
    }
    void build(const std::string& name, Progress& progress);
    void cast(const glm::vec3& origin, float tNear, const glm::dvec3* direction, const float* tFar, int count,
              PacketHits& hits) const;
    MeshHit hitAt(std::uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction,
                  float t) const;
};

void MeshCaster::State::build(const std::string& name, Progress& progress) {
    const auto failed = [&] {
        const RTCError code = rtcGetDeviceError(device.get());
        throw Error(name, "",
                    fmt::format("the ray tracing library refused it (code {})", static_cast<int>(code)),
                    "simplify the mesh, or free memory");
    };
    device.reset(rtcNewDevice(nullptr));
    if (!device) failed();
    packet = nativePacket(device.get());
    rtcSetDeviceMemoryMonitorFunction(
        device.get(),
        [](void* state, ssize_t bytes, bool) {
            static_cast<State*>(state)->treeBytes += bytes;
            return true;
        },
        this);
    tree.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(tree.get(), RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
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
        rtcAttachGeometry(tree.get(), geometry);
    }
    rtcReleaseGeometry(geometry);
    if (!vertices || !indices) failed();
    BuildProgress building(progress);
    rtcSetSceneProgressMonitorFunction(tree.get(), goesOn, &building);
    rtcCommitScene(tree.get());
    rtcSetSceneProgressMonitorFunction(tree.get(), nullptr, nullptr);
    if (progress.cancelled()) throw Cancelled();
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) failed();
    building.tell(1);
}

void MeshCaster::State::cast(const glm::vec3& origin, float tNear, const glm::dvec3* direction,
                             const float* tFar, int count, PacketHits& hits) const {
    if (packet == 16)
        castPacket<16, RTCRayHit16>(tree.get(), origin, tNear, direction, tFar, count, hits, rtcIntersect16);
    else if (packet == 8)
        castPacket<8, RTCRayHit8>(tree.get(), origin, tNear, direction, tFar, count, hits, rtcIntersect8);
    else
        castPacket<4, RTCRayHit4>(tree.get(), origin, tNear, direction, tFar, count, hits, rtcIntersect4);
}

// origin: about the middle. t: the parameter to keep where the ray runs along the face.
MeshHit MeshCaster::State::hitAt(std::uint32_t triangle, const glm::dvec3& origin,
                                 const glm::dvec3& direction, float t) const {
    const auto& corner = mesh.triangles[triangle].vertex;
    const glm::dvec3 a = mesh.vertices[corner[0]].position;
    const glm::dvec3 ab = mesh.vertices[corner[1]].position - a, ac = mesh.vertices[corner[2]].position - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double twiceArea = glm::length(normal), along = glm::dot(direction, normal);
    MeshHit hit{t, triangle, {1, 0, 0}, {0, 0, 1}};
    if (!(twiceArea > 0)) return hit;
    hit.faceNormal = normal / twiceArea;
    // Along the face the plane says nothing about t, and Embree's value stands.
    if (std::abs(along) > 1e-9 * twiceArea * glm::length(direction))
        hit.t = glm::dot(a - origin, normal) / along;
    const glm::dvec3 p = origin + hit.t * direction - a;
    const double scale = 1 / (twiceArea * twiceArea);
    const double wb = std::clamp(glm::dot(glm::cross(p, ac), normal) * scale, 0.0, 1.0);
    const double wc = std::clamp(glm::dot(glm::cross(ab, p), normal) * scale, 0.0, 1.0 - wb);
    hit.weight[0] = static_cast<float>(1 - wb - wc);
    hit.weight[1] = static_cast<float>(wb);
    hit.weight[2] = static_cast<float>(wc);
    return hit;
}

MeshCaster::MeshCaster(TriangleMesh mesh, const std::string& name, Progress& progress)
    : mState(std::make_unique<State>(std::move(mesh))) {
    mState->build(name, progress);
}
MeshCaster::MeshCaster(TriangleMesh mesh, const std::string& name)
    : mState(std::make_unique<State>(std::move(mesh))) {
    Progress quiet;
    mState->build(name, quiet);
}
MeshCaster::MeshCaster(MeshCaster&&) noexcept = default;
MeshCaster& MeshCaster::operator=(MeshCaster&&) noexcept = default;
MeshCaster::~MeshCaster() = default;

const TriangleMesh& MeshCaster::mesh() const {
    return mState->mesh;
}
glm::dvec3 MeshCaster::low() const {
    return mState->low;
}
glm::dvec3 MeshCaster::high() const {
    return mState->high;
}
std::size_t MeshCaster::treeBytes() const {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(mState->treeBytes, 0));
}
int MeshCaster::packet() const {
    return mState->packet;
}

MeshRays::MeshRays(const MeshCaster& caster, const EyeView& view)
    : mCaster(caster), mView(view), mOrigin(view.eye - caster.mState->centre) {
    constexpr double kMargin = 1e-4;  // Embree sees the directions as floats, rounded to 6e-8
    const glm::dvec2 everywhere(std::numeric_limits<double>::infinity());
    mLeast = -everywhere, mMost = everywhere;
    glm::dvec2 least = everywhere, most = -everywhere;
    double nearest = std::numeric_limits<double>::infinity();
    const glm::dvec3 low = caster.low(), high = caster.high();
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 corner(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z);
        const glm::dvec3 d = corner - view.eye;
        const double depth = glm::dot(d, view.forward);
        if (!(depth > view.nearDepth)) return;
        const glm::dvec2 seen = glm::dvec2(glm::dot(d, view.right), glm::dot(d, view.up)) / depth;
        least = glm::min(least, seen - kMargin);
        most = glm::max(most, seen + kMargin);
        nearest = std::min(nearest, depth);
    }
    mLeast = least;
    mMost = most;
    mNearest = nearest;
}

bool MeshRays::touches(const glm::dvec3* direction, int count) const {
    for (int k = 0; k < count; ++k) {
        const glm::dvec2 d(glm::dot(direction[k], mView.right), glm::dot(direction[k], mView.up));
        if (d.x >= mLeast.x && d.x <= mMost.x && d.y >= mLeast.y && d.y <= mMost.y) return true;
    }
    return false;
}

bool MeshRays::cast(const glm::dvec3* direction, const float* farDepth, int count, MeshHit* hits) const {
    if (!touches(direction, count)) return false;
    const auto nearDepth = static_cast<float>(mView.nearDepth);
    PacketHits found;
    mCaster.mState->cast(glm::vec3(mOrigin), nearDepth, direction, farDepth, count, found);
    bool any = false;
    for (int k = 0; k < count; ++k) {
        hits[k].triangle = MeshHit::kNone;
        if (found.triangle[k] == RTC_INVALID_GEOMETRY_ID) continue;
        const MeshHit hit = mCaster.mState->hitAt(found.triangle[k], mOrigin, direction[k], found.t[k]);
        const auto depth = static_cast<float>(hit.t);
        if (!(depth < farDepth[k]) || depth < nearDepth) continue;
        hits[k] = hit;
        any = true;
    }
    return any;
}

bool MeshRays::mayMeetBefore(double depth, PixelRect rect) const {
    if (!(mNearest < depth)) return false;
    const double left = mView.xMin + rect.x0 * mView.pixelWidth(),
                 right = mView.xMin + rect.x1 * mView.pixelWidth(),
                 top = mView.yMax - rect.y0 * mView.pixelHeight(),
                 bottom = mView.yMax - rect.y1 * mView.pixelHeight();
    return right >= mLeast.x && left <= mMost.x && top >= mLeast.y && bottom <= mMost.y;
}

}  // namespace stereonav
