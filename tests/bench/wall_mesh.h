// The wall as triangles for Embree: a dual mesh of the same cells (one vertex a cell, at the mean of where
// the surface crosses its edges; two triangles an edge that crosses), with as many triangles as marching
// cubes make, about two a cell. What the casters of bench_colon are compared with.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/image/eye_image.h"
#include "engine/volume/surface_cells.h"
#include "tests/bench/embree_packets.h"

namespace stereonav {

class WallMesh {
public:
    explicit WallMesh(const SurfaceCells& cells) : mScene(2) {
        RTCGeometry geometry = rtcNewGeometry(mScene.device(), RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), cells.records.size()));
        addCells(cells, vertices);
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                                     RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                                     mTriangles.size() / 3));
        std::copy(mTriangles.begin(), mTriangles.end(), index);
        mScene.take(geometry);
    }

    std::size_t triangles() const { return mTriangles.size() / 3; }

    // View depths and packed normals of a picture, in packets of `width` rays (see EmbreeScene::castRows):
    // the triangle's own normal, which costs less than one between its corners.
    void cast(const EyeView& view, int width, EyeImage& image) const {
        const auto put = [&](int x, int y, int across, const auto& rays, int first)
            __attribute__((always_inline)) {
            float* depth = image.viewDepth.row(y) + x;
            std::uint32_t* normal = image.normal.row(y) + x;
            for (int k = 0; k < across; ++k) {
                const int n = first + k;
                depth[k] = rays.ray.tfar[n];
                normal[k] = packed(rays.hit.Ng_x[n], rays.hit.Ng_y[n], rays.hit.Ng_z[n], rays.ray.dir_x[n],
                                   rays.ray.dir_y[n], rays.ray.dir_z[n]);
            }
        };
        mScene.castRows(view, 0, view.height, width, put);
    }

private:
    // Packs a normal of any length, turned against the ray.
    __attribute__((always_inline)) static std::uint32_t packed(float x, float y, float z, float rayX,
                                                               float rayY, float rayZ) {
        const float facing = x * rayX + y * rayY + z * rayZ;
        const float scale = (facing > 0 ? -511.5f : 511.5f) / __builtin_sqrtf(x * x + y * y + z * z);
        return static_cast<std::uint32_t>(static_cast<int>(x * scale + 511.5f)) |
               static_cast<std::uint32_t>(static_cast<int>(y * scale + 511.5f)) << 10 |
               static_cast<std::uint32_t>(static_cast<int>(z * scale + 511.5f)) << 20;
    }

    void addCells(const SurfaceCells& cells, float* vertices) {
        const glm::ivec3 last = cells.frame.size - 2;
        for (int k = 0; k <= last.z; ++k)
            for (int j = 0; j <= last.y; ++j)
                for (int i = 0; i <= last.x; ++i) {
                    const std::optional<std::size_t> number = cells.recordNumber({i, j, k});
                    if (!number) continue;
                    const CellRecord& record = cells.records[*number];
                    const glm::vec3 place(cells.frame.worldFromVoxel(
                        glm::dvec3(i, j, k) + glm::dvec3(middleOf(record, cells.isovalue))));
                    float* to = vertices + 3 * *number;
                    to[0] = place.x, to[1] = place.y, to[2] = place.z;
                    for (int axis = 0; axis < 3; ++axis) addEdge(cells, {i, j, k}, record, axis);
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
            const std::optional<std::size_t> one = cells.recordNumber(around[n]);
            if (!one) return;
            corner[n] = static_cast<unsigned>(*one);
        }
        for (const int n : {0, 1, 2, 0, 2, 3}) mTriangles.push_back(corner[n]);
    }

    bench::EmbreeScene mScene;
    std::vector<unsigned> mTriangles;
};

}  // namespace stereonav
