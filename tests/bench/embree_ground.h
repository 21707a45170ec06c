// The same ground for Embree: its grid geometry, or two triangles a cell, cast in packets of sixteen.
// Benchmarks only.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/image/plane.h"
#include "terrain/heightfield.h"

namespace stereonav::bench {

enum class EmbreeGeometry { Grid, Triangles };

class EmbreeGround {
public:
    EmbreeGround(const Heightfield& ground, EmbreeGeometry kind) : mDevice(rtcNewDevice("threads=1")) {
        mScene = rtcNewScene(mDevice);
        rtcSetSceneBuildQuality(mScene, RTC_BUILD_QUALITY_HIGH);
        RTCGeometry geometry = kind == EmbreeGeometry::Grid ? gridGeometry(ground) : triangleGeometry(ground);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(mScene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(mScene);
    }
    ~EmbreeGround() {
        rtcReleaseScene(mScene);
        rtcReleaseDevice(mDevice);
    }
    EmbreeGround(const EmbreeGround&) = delete;
    EmbreeGround& operator=(const EmbreeGround&) = delete;

    bool nativePackets() const {
        return rtcGetDeviceProperty(mDevice, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
    }

    // View depths of the 4 x 4 pixels from (x0, y0) on, all inside the picture.
    void castBlock(const EyeView& view, int x0, int y0, Plane<float>& viewDepth) const {
        alignas(64) static constexpr int kAll[16] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                     -1, -1, -1, -1, -1, -1, -1, -1};
        alignas(64) RTCRayHit16 rays;
        const glm::dvec3 base = view.rayDirection(x0 + 0.5, y0 + 0.5);
        const glm::dvec3 perX = view.right * view.pixelWidth(), perY = -view.up * view.pixelHeight();
        for (int k = 0; k < 16; ++k) {
            const glm::dvec3 d = base + perX * double(k % 4) + perY * double(k / 4);
            rays.ray.org_x[k] = static_cast<float>(view.eye.x);
            rays.ray.org_y[k] = static_cast<float>(view.eye.y);
            rays.ray.org_z[k] = static_cast<float>(view.eye.z);
            rays.ray.dir_x[k] = static_cast<float>(d.x);
            rays.ray.dir_y[k] = static_cast<float>(d.y);
            rays.ray.dir_z[k] = static_cast<float>(d.z);
            rays.ray.tnear[k] = static_cast<float>(view.nearDepth);
            rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
            rays.ray.mask[k] = ~0u;
            rays.ray.time[k] = 0;
            rays.ray.flags[k] = 0;
            rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect16(kAll, mScene, &context, &rays);
        for (int k = 0; k < 16; ++k)
            viewDepth.at(x0 + k % 4, y0 + k / 4) = rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID
                                                       ? std::numeric_limits<float>::infinity()
                                                       : rays.ray.tfar[k];
    }

private:
    static void setVertices(RTCGeometry geometry, const Heightfield& ground) {
        const std::size_t count = static_cast<std::size_t>(ground.width()) * ground.height();
        auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), count));
        for (int j = 0; j < ground.height(); ++j)
            for (int i = 0; i < ground.width(); ++i, vertex += 3) {
                const glm::dvec2 world = ground.worldFromGrid({i, j});
                vertex[0] = static_cast<float>(world.x);
                vertex[1] = static_cast<float>(world.y);
                vertex[2] = ground.sample(i, j);
            }
    }

    RTCGeometry gridGeometry(const Heightfield& ground) const {
        // Embree's grids are at most 32767 samples a side.
        RTCGeometry geometry = rtcNewGeometry(mDevice, RTC_GEOMETRY_TYPE_GRID);
        setVertices(geometry, ground);
        auto* grid = static_cast<RTCGrid*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
        *grid = {0, static_cast<unsigned>(ground.width()), static_cast<unsigned short>(ground.width()),
                 static_cast<unsigned short>(ground.height())};
        return geometry;
    }

    RTCGeometry triangleGeometry(const Heightfield& ground) const {
        RTCGeometry geometry = rtcNewGeometry(mDevice, RTC_GEOMETRY_TYPE_TRIANGLE);
        setVertices(geometry, ground);
        const std::size_t cells = static_cast<std::size_t>(ground.width() - 1) * (ground.height() - 1);
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 2 * cells));
        for (int j = 0; j + 1 < ground.height(); ++j)
            for (int i = 0; i + 1 < ground.width(); ++i, index += 6) {
                const unsigned a = static_cast<unsigned>(j * ground.width() + i), b = a + 1;
                const unsigned c = a + static_cast<unsigned>(ground.width()), d = c + 1;
                const unsigned corners[6] = {a, b, d, a, d, c};
                std::copy_n(corners, 6, index);
            }
        return geometry;
    }

    RTCDevice mDevice;
    RTCScene mScene;
};

}  // namespace stereonav::bench
