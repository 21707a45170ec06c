// The same ground for Embree: its grid geometry, or two triangles a cell. Benchmarks only.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/image/plane.h"
#include "terrain/ground/heightfield.h"
#include "tests/bench/embree_packets.h"

namespace stereonav::bench {

enum class EmbreeGeometry { Grid, Triangles };

class EmbreeGround {
public:
    EmbreeGround(const Heightfield& ground, EmbreeGeometry kind) : mScene(1) {
        mScene.take(kind == EmbreeGeometry::Grid ? gridGeometry(ground) : triangleGeometry(ground));
    }

    // View depths of rows y0 to y1 - 1, in packets of `width` rays; see EmbreeScene::castRows.
    void castRows(const EyeView& view, int y0, int y1, int width, Plane<float>& viewDepth) const {
        const auto put = [&](int x, int y, int across, const auto& hits, int first)
            __attribute__((always_inline)) {
            float* to = viewDepth.row(y) + x;
            for (int k = 0; k < across; ++k)
                to[k] = hits.hit.geomID[first + k] == RTC_INVALID_GEOMETRY_ID
                            ? std::numeric_limits<float>::infinity()
                            : hits.ray.tfar[first + k];
        };
        mScene.castRows(view, y0, y1, width, put);
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
        RTCGeometry geometry = rtcNewGeometry(mScene.device(), RTC_GEOMETRY_TYPE_GRID);
        setVertices(geometry, ground);
        auto* grid = static_cast<RTCGrid*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
        *grid = {0, static_cast<unsigned>(ground.width()), static_cast<unsigned short>(ground.width()),
                 static_cast<unsigned short>(ground.height())};
        return geometry;
    }

    RTCGeometry triangleGeometry(const Heightfield& ground) const {
        RTCGeometry geometry = rtcNewGeometry(mScene.device(), RTC_GEOMETRY_TYPE_TRIANGLE);
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

    EmbreeScene mScene;
};

}  // namespace stereonav::bench
