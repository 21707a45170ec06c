// The wall as triangles for Embree: a dual mesh of the same cells (one vertex a cell, at the mean of where
// the surface crosses its edges; two triangles an edge that crosses), with as many triangles as marching
// cubes make, about two a cell. What the casters of bench_colon are compared with.
#pragma once

#include <embree3/rtcore.h>

#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"
#include "engine/volume/surface_cells.h"

namespace stereonav {

class WallMesh {
public:
    explicit WallMesh(const SurfaceCells& cells) : mDevice(rtcNewDevice("threads=2")) {
        mScene = rtcNewScene(mDevice);
        rtcSetSceneBuildQuality(mScene, RTC_BUILD_QUALITY_HIGH);
        RTCGeometry geometry = rtcNewGeometry(mDevice, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), cells.records.size()));
        addCells(cells, vertices);
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                                     RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                                     mTriangles.size() / 3));
        std::copy(mTriangles.begin(), mTriangles.end(), index);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(mScene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(mScene);
    }
    ~WallMesh() {
        rtcReleaseScene(mScene);
        rtcReleaseDevice(mDevice);
    }
    WallMesh(const WallMesh&) = delete;
    WallMesh& operator=(const WallMesh&) = delete;

    std::size_t triangles() const { return mTriangles.size() / 3; }

    // View depths and packed normals of the 4 x 4 pixels from (x0, y0) on, all inside the picture: the
    // triangle's own normal, which costs less than one between its corners.
    __attribute__((target_clones("avx512f", "avx2", "default"))) void castBlock(const EyeView& view, int x0,
                                                                                int y0,
                                                                                EyeImage& image) const {
        alignas(64) static constexpr int kAll[16] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                     -1, -1, -1, -1, -1, -1, -1, -1};
        alignas(64) RTCRayHit16 rays;
        const glm::vec3 eye(view.eye), base(view.rayDirection(x0 + 0.5, y0 + 0.5));
        const glm::vec3 perX(view.right * view.pixelWidth()), perY(-view.up * view.pixelHeight());
        for (int k = 0; k < 16; ++k) {
            const float across = static_cast<float>(k % 4), down = static_cast<float>(k / 4);
            rays.ray.org_x[k] = eye.x;
            rays.ray.org_y[k] = eye.y;
            rays.ray.org_z[k] = eye.z;
            rays.ray.dir_x[k] = base.x + perX.x * across + perY.x * down;
            rays.ray.dir_y[k] = base.y + perX.y * across + perY.y * down;
            rays.ray.dir_z[k] = base.z + perX.z * across + perY.z * down;
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
        alignas(64) std::uint32_t normal[16];
        for (int k = 0; k < 16; ++k) {
            const float x = rays.hit.Ng_x[k], y = rays.hit.Ng_y[k], z = rays.hit.Ng_z[k];
            const float facing = x * rays.ray.dir_x[k] + y * rays.ray.dir_y[k] + z * rays.ray.dir_z[k];
            const float scale = (facing > 0 ? -511.5f : 511.5f) / __builtin_sqrtf(x * x + y * y + z * z);
            normal[k] = static_cast<std::uint32_t>(static_cast<int>(x * scale + 511.5f)) |
                        static_cast<std::uint32_t>(static_cast<int>(y * scale + 511.5f)) << 10 |
                        static_cast<std::uint32_t>(static_cast<int>(z * scale + 511.5f)) << 20;
        }
        for (int j = 0; j < 4; ++j) {
            __builtin_memcpy(image.normal.row(y0 + j) + x0, normal + 4 * j, 16);
            __builtin_memcpy(image.viewDepth.row(y0 + j) + x0, rays.ray.tfar + 4 * j, 16);
        }
    }

private:
    void addCells(const SurfaceCells& cells, float* vertices) {
        const glm::ivec3 last = cells.frame.size - 2;
        for (int k = 0; k <= last.z; ++k)
            for (int j = 0; j <= last.y; ++j)
                for (int i = 0; i <= last.x; ++i) {
                    const CellRecord* record = cells.record({i, j, k});
                    if (!record) continue;
                    const glm::vec3 place(cells.frame.worldFromVoxel(
                        glm::dvec3(i, j, k) + glm::dvec3(middleOf(*record, cells.isovalue))));
                    float* to = vertices + 3 * (record - cells.records.data());
                    to[0] = place.x, to[1] = place.y, to[2] = place.z;
                    for (int axis = 0; axis < 3; ++axis) addEdge(cells, {i, j, k}, *record, axis);
                }
    }

    // The mean of where the surface crosses the cell's edges, in the cell.
    static glm::vec3 middleOf(const CellRecord& record, float isovalue) {
        glm::vec3 sum(0.0f);
        int count = 0;
        for (int a = 0; a < 8; ++a)
            for (int axis = 0; axis < 3; ++axis) {
                const int b = a | 1 << axis;
                const float va = record.values[a] - isovalue, vb = record.values[b] - isovalue;
                if (a == b || (va < 0) == (vb < 0)) continue;
                glm::vec3 corner(a & 1, a >> 1 & 1, a >> 2);
                corner[axis] = va / (va - vb);
                sum += corner;
                ++count;
            }
        return count > 0 ? sum / static_cast<float>(count) : glm::vec3(0.5f);
    }

    // Two triangles around the edge from the cell's first corner along an axis, if the surface crosses it.
    void addEdge(const SurfaceCells& cells, const glm::ivec3& cell, const CellRecord& record, int axis) {
        if ((record.values[0] < cells.isovalue) == (record.values[1 << axis] < cells.isovalue)) return;
        glm::ivec3 back[2] = {glm::ivec3(0), glm::ivec3(0)};
        back[0][(axis + 1) % 3] = back[1][(axis + 2) % 3] = 1;
        const glm::ivec3 around[4] = {cell, cell - back[0], cell - back[0] - back[1], cell - back[1]};
        unsigned corner[4];
        for (int n = 0; n < 4; ++n) {
            if (around[n].x < 0 || around[n].y < 0 || around[n].z < 0) return;
            const CellRecord* one = cells.record(around[n]);
            if (!one) return;
            corner[n] = static_cast<unsigned>(one - cells.records.data());
        }
        for (const int n : {0, 1, 2, 0, 2, 3}) mTriangles.push_back(corner[n]);
    }

    RTCDevice mDevice;
    RTCScene mScene;
    std::vector<unsigned> mTriangles;
};

}  // namespace stereonav
