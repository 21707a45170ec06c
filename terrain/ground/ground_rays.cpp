#include "terrain/ground/ground_rays.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/stop.h"

namespace stereonav {
namespace {

constexpr float kNoHit = std::numeric_limits<float>::infinity();
constexpr int kGridSide = 4096;          // samples a side of one of Embree's grids, which hold 32767
constexpr double kMostSamples = 3e8;     // 12 bytes each: Embree's buffers end at 4 GiB
constexpr double kLiftOfCell = 1e-4;     // share of the finer spacing
constexpr double kLiftOfSize = 0x1p-21;  // share of the terrain's size: a few roundings of float coordinates

template <typename T, void (*release)(T)>
class Held {
public:
    Held() = default;
    explicit Held(T held) : mHeld(held) {}
    ~Held() {
        if (mHeld) release(mHeld);
    }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    T get() const { return mHeld; }

private:
    T mHeld = nullptr;
};

bool cellKnown(const Heightfield& ground, int i, int j) {
    return i >= 0 && j >= 0 && i + 1 < ground.width() && j + 1 < ground.height() &&
           std::isfinite(ground.sample(i, j) + ground.sample(i + 1, j) + ground.sample(i, j + 1) +
                         ground.sample(i + 1, j + 1));
}

// Lanes first .. first + N - 1 of a packet into Embree's.
template <int N, typename Ray>
void fill(Ray& ray, const RayPacket& rays, int first) {
    std::copy_n(rays.originX + first, N, ray.org_x);
    std::copy_n(rays.originY + first, N, ray.org_y);
    std::copy_n(rays.originZ + first, N, ray.org_z);
    std::copy_n(rays.directionX + first, N, ray.dir_x);
    std::copy_n(rays.directionY + first, N, ray.dir_y);
    std::copy_n(rays.directionZ + first, N, ray.dir_z);
    std::copy_n(rays.nearest + first, N, ray.tnear);
    std::fill_n(ray.tfar, N, kNoHit);
    std::fill_n(ray.time, N, 0.0f);
    std::fill_n(ray.mask, N, ~0u);
    std::fill_n(ray.flags, N, 0u);
}

template <int N>
bool validLanes(std::uint32_t active, int first, int* valid) {
    bool any = false;
    for (int k = 0; k < N; ++k) {
        valid[k] = active >> (first + k) & 1 ? -1 : 0;
        any |= valid[k] != 0;
    }
    return any;
}

template <int N, typename Ray, typename Occluded>
std::uint32_t occludedBy(RTCScene scene, const RayPacket& rays, std::uint32_t active, Occluded test) {
    std::uint32_t hit = 0;
    for (int first = 0; first < RayPacket::kSize; first += N) {
        alignas(64) int valid[N];
        if (!validLanes<N>(active, first, valid)) continue;
        Ray ray;
        fill<N>(ray, rays, first);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        test(valid, scene, &context, &ray);
        for (int k = 0; k < N; ++k)
            if (valid[k] && ray.tfar[k] < 0) hit |= 1u << (first + k);
    }
    return hit;
}

template <int N, typename RayHit, typename Intersect>
void intersectBy(RTCScene scene, RayPacket& rays, std::uint32_t active, Intersect test) {
    for (int first = 0; first < RayPacket::kSize; first += N) {
        alignas(64) int valid[N];
        if (!validLanes<N>(active, first, valid)) continue;
        RayHit ray;
        fill<N>(ray.ray, rays, first);
        std::fill_n(ray.hit.geomID, N, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(ray.hit.primID, N, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(ray.hit.instID[0], N, RTC_INVALID_GEOMETRY_ID);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        test(valid, scene, &context, &ray);
        for (int k = 0; k < N; ++k)
            if (valid[k])
                rays.distance[first + k] =
                    ray.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID ? kNoHit : ray.ray.tfar[k];
    }
}

}  // namespace

struct GroundRays::State {
    Held<RTCDevice, rtcReleaseDevice> device;
    Held<RTCScene, rtcReleaseScene> scene;
    int packet = 4;

    explicit State(const Heightfield& ground, double centreHeight)
        : device(rtcNewDevice(nullptr)), scene(device.get() ? rtcNewScene(device.get()) : nullptr) {
        if (!scene.get()) failed();
        if (rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) packet = 8;
        if (rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) packet = 16;
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        const RTCGeometry geometry = rtcNewGeometry(
            device.get(), ground.hasHoles() ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_GRID);
        const bool filled = setVertices(geometry, ground, centreHeight) &&
                            (ground.hasHoles() ? setTriangles(geometry, ground) : setGrids(geometry, ground));
        if (filled) {
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene.get(), geometry);
        }
        rtcReleaseGeometry(geometry);
        if (!filled) failed();
        // Building the tree takes half a minute for the largest grounds.
        rtcSetSceneProgressMonitorFunction(
            scene.get(), [](void*, double) { return !stopWished(); }, nullptr);
        rtcCommitScene(scene.get());
        throwIfStopped();
        if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE) failed();
    }

    [[noreturn]] void failed() const {
        const int code = static_cast<int>(rtcGetDeviceError(device.get()));
        throw Error("", "", fmt::format("the ray tracing library refused the ground (code {})", code),
                    "free memory, or take a smaller elevation model");
    }

    static bool setVertices(RTCGeometry geometry, const Heightfield& ground, double centreHeight) {
        const std::size_t count = static_cast<std::size_t>(ground.width()) * ground.height();
        auto* vertex = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, count));
        if (!vertex) return false;
        for (int j = 0; j < ground.height(); ++j)
            for (int i = 0; i < ground.width(); ++i, vertex += 3) {
                const glm::dvec2 world = ground.worldFromGrid({i, j});
                const float height = ground.sample(i, j);
                vertex[0] = static_cast<float>(world.x);
                vertex[1] = static_cast<float>(world.y);
                vertex[2] = std::isfinite(height) ? static_cast<float>(height - centreHeight) : 0.0f;
            }
        return true;
    }

    static bool setGrids(RTCGeometry geometry, const Heightfield& ground) {
        const int across = (ground.width() - 2) / (kGridSide - 1) + 1,
                  down = (ground.height() - 2) / (kGridSide - 1) + 1;
        auto* grid = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0,
                                                                   RTC_FORMAT_GRID, sizeof(RTCGrid),
                                                                   static_cast<std::size_t>(across) * down));
        if (!grid) return false;
        const auto samples = [](int first, int all) {
            return static_cast<unsigned short>(std::min(kGridSide, all - first));
        };
        for (int j = 0; j + 1 < ground.height(); j += kGridSide - 1)
            for (int i = 0; i + 1 < ground.width(); i += kGridSide - 1)
                *grid++ = {static_cast<unsigned>(j) * ground.width() + i,
                           static_cast<unsigned>(ground.width()), samples(i, ground.width()),
                           samples(j, ground.height())};
        return true;
    }

    static bool setTriangles(RTCGeometry geometry, const Heightfield& ground) {
        std::size_t cells = 0;
        for (int j = 0; j + 1 < ground.height(); ++j)
            for (int i = 0; i + 1 < ground.width(); ++i) cells += cellKnown(ground, i, j);
        auto* index = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 2 * cells));
        if (!index) return false;
        for (int j = 0; j + 1 < ground.height(); ++j)
            for (int i = 0; i + 1 < ground.width(); ++i) {
                if (!cellKnown(ground, i, j)) continue;
                const unsigned a = static_cast<unsigned>(j) * ground.width() + i, b = a + 1;
                const unsigned c = a + static_cast<unsigned>(ground.width()), d = c + 1;
                const unsigned corners[6] = {a, b, c, d, c, b};
                index = std::copy_n(corners, 6, index);
            }
        return true;
    }
};

GroundRays::GroundRays(const Heightfield& ground) : mGround(ground) {
    if (static_cast<double>(ground.width()) * ground.height() > kMostSamples)
        throw Error("", "",
                    fmt::format("{}x{} samples are more than light can be baked for", ground.width(),
                                ground.height()),
                    "take a coarser elevation model");
    mCentreHeight = 0.5 * (static_cast<double>(ground.minHeight()) + ground.maxHeight());
    const glm::dvec2 extent = glm::dvec2(ground.width() - 1, ground.height() - 1) * ground.spacing();
    const double size = std::max({extent.x, extent.y, double(ground.maxHeight()) - ground.minHeight()});
    mLift = kLiftOfCell * std::min(ground.spacing().x, ground.spacing().y) + kLiftOfSize * size;
    mState = std::make_unique<State>(ground, mCentreHeight);
}

GroundRays::~GroundRays() = default;

GroundRays::GroundRays(const Heightfield& part, const GroundRays& whole, const glm::dvec2& offset)
    : GroundRays(part) {
    mWhole = &whole;
    mOffset = offset;
}

std::uint32_t GroundRays::occludedHere(const RayPacket& rays, std::uint32_t active) const {
    RTCScene scene = mState->scene.get();
    if (mState->packet == 16) return occludedBy<16, RTCRay16>(scene, rays, active, rtcOccluded16);
    if (mState->packet == 8) return occludedBy<8, RTCRay8>(scene, rays, active, rtcOccluded8);
    return occludedBy<4, RTCRay4>(scene, rays, active, rtcOccluded4);
}

void GroundRays::intersectHere(RayPacket& rays, std::uint32_t active) const {
    RTCScene scene = mState->scene.get();
    if (mState->packet == 16) return intersectBy<16, RTCRayHit16>(scene, rays, active, rtcIntersect16);
    if (mState->packet == 8) return intersectBy<8, RTCRayHit8>(scene, rays, active, rtcIntersect8);
    intersectBy<4, RTCRayHit4>(scene, rays, active, rtcIntersect4);
}

// A ray that stands still over the plan never leaves.
RayPacket GroundRays::beyond(const RayPacket& rays) const {
    RayPacket packet = rays;
    const glm::dvec2 low = mGround.originWorld(),
                     high = mGround.worldFromGrid({mGround.width() - 1, mGround.height() - 1});
    const auto wayTo = [](double from, double direction, double below, double above) {
        if (direction == 0) return std::numeric_limits<double>::infinity();
        return ((direction > 0 ? above : below) - from) / direction;
    };
    const double up = mCentreHeight - mWhole->mCentreHeight;
    for (int k = 0; k < RayPacket::kSize; ++k) {
        const double way = std::min(wayTo(rays.originX[k], rays.directionX[k], low.x, high.x),
                                    wayTo(rays.originY[k], rays.directionY[k], low.y, high.y));
        packet.nearest[k] = std::max(rays.nearest[k], static_cast<float>(way));
        packet.originX[k] = static_cast<float>(rays.originX[k] + mOffset.x);
        packet.originY[k] = static_cast<float>(rays.originY[k] + mOffset.y);
        packet.originZ[k] = static_cast<float>(rays.originZ[k] + up);
    }
    return packet;
}

std::uint32_t GroundRays::occluded(const RayPacket& rays, std::uint32_t active) const {
    const std::uint32_t here = occludedHere(rays, active), left = active & ~here;
    return mWhole && left ? here | mWhole->occluded(beyond(rays), left) : here;
}

void GroundRays::intersect(RayPacket& rays, std::uint32_t active) const {
    intersectHere(rays, active);
    if (!mWhole) return;
    std::uint32_t left = 0;
    for (int k = 0; k < RayPacket::kSize; ++k)
        if (active >> k & 1 && !std::isfinite(rays.distance[k])) left |= 1u << k;
    if (left == 0) return;
    RayPacket on = beyond(rays);
    mWhole->intersect(on, left);
    for (int k = 0; k < RayPacket::kSize; ++k)
        if (left >> k & 1) rays.distance[k] = on.distance[k];
}

double GroundRays::heightAt(const glm::dvec2& world) const {
    const glm::dvec2 grid = mGround.gridFromWorld(world);
    const double x = std::clamp(grid.x, 0.0, mGround.width() - 1.0);
    const double y = std::clamp(grid.y, 0.0, mGround.height() - 1.0);
    const int i = std::min(static_cast<int>(x), mGround.width() - 2);
    const int j = std::min(static_cast<int>(y), mGround.height() - 2);
    const double u = x - i, v = y - j;
    const double east = mGround.sample(i + 1, j), north = mGround.sample(i, j + 1);
    if (u + v <= 1) return (1 - u - v) * mGround.sample(i, j) + u * east + v * north;
    return (u + v - 1) * mGround.sample(i + 1, j + 1) + (1 - u) * north + (1 - v) * east;
}

}  // namespace stereonav
