#include "colon/wall/wall_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr int kRun = 4096;  // vertices that one task makes triangles of
constexpr const char* kMaking = "making the wall's mesh";

class Maker {
public:
    Maker(const GreyVolume& field, const SurfaceCells& cells, const MaskVolume& lumen)
        : mField(field), mCells(cells), mLumen(lumen) {}

    WallMesh make(Progress& progress) {
        progress.report(0, kMaking);
        findCells(progress);
        progress.report(0.3, kMaking);
        placeVertices();
        progress.report(0.6, kMaking);
        makeTriangles();
        addUp();
        progress.report(1, kMaking);
        return std::move(mMesh);
    }

private:
    // Cells that hold wall, brick by brick: by record number, which every cell with surface has.
    void findCells(Progress& progress) {
        const glm::ivec3 bricks = mCells.layout.bricks;
        const int count = bricks.x * bricks.y * bricks.z;
        std::vector<std::vector<glm::ivec3>> found(count);
        parallelFor(count, [&](int brick) {
            const glm::ivec3 low =
                16 * glm::ivec3(brick % bricks.x, brick / bricks.x % bricks.y, brick / (bricks.x * bricks.y));
            const std::uint16_t* places = &mCells.places[static_cast<std::size_t>(brick) * 4096];
            for (int n = 0; n < 4096; ++n) {
                const glm::ivec3 cell = low + glm::ivec3(n & 15, n >> 4 & 15, n >> 8);
                if (places[n] && holdsWall(cell)) found[brick].push_back(cell);
            }
        });
        std::size_t vertices = 0;
        for (const auto& part : found) vertices += part.size();
        // Two triangles a vertex, and as many again while they are put together.
        checkMemory("the wall's mesh",
                    static_cast<double>(vertices) * (sizeof(glm::vec3) * 3 + 4 + 4 * sizeof(Triangle)) +
                        static_cast<double>(mCells.records.size()) * 4,
                    "use a coarser study");
        progress.report(0.1, kMaking);
        mVertexOf.assign(mCells.records.size(), kNone);
        mMesh.cells.reserve(vertices);
        for (const auto& part : found)
            for (const glm::ivec3& cell : part) {
                mVertexOf[*mCells.recordNumber(cell)] = static_cast<std::uint32_t>(mMesh.cells.size());
                mMesh.cells.push_back(cell);
            }
    }

    bool inside(const glm::ivec3& voxel) const { return mLumen.at(voxel) != 0; }

    bool holdsWall(const glm::ivec3& cell) const {
        int corners = 0;
        for (int n = 0; n < 8; ++n) corners += inside(cell + glm::ivec3(n & 1, n >> 1 & 1, n >> 2));
        return corners > 0 && corners < 8;
    }

    // Returns where the wall crosses the edge between two voxels of which one is inside, from a, in [0, 1].
    double crossing(const glm::ivec3& a, const glm::ivec3& b) const {
        const double from = mField.at(a), to = mField.at(b);
        // Voxels are told apart by the mask: equal values there are another lumen's.
        if (from == to) return 0.5;
        return std::clamp((mCells.isovalue - from) / (to - from), 0.0, 1.0);
    }

    void placeVertices() {
        const int count = static_cast<int>(mMesh.cells.size());
        mMesh.places.resize(count);
        parallelFor((count + kRun - 1) / kRun, [&](int run) {
            for (int v = run * kRun; v < std::min((run + 1) * kRun, count); ++v)
                mMesh.places[v] = glm::vec3(placeIn(mMesh.cells[v]));
        });
    }

    glm::dvec3 placeIn(const glm::ivec3& cell) const {
        glm::dvec3 sum(0.0);
        int crossings = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (int n = 0; n < 4; ++n) {
                glm::ivec3 a(0);
                a[(axis + 1) % 3] = n & 1;
                a[(axis + 2) % 3] = n >> 1;
                glm::ivec3 b = a;
                b[axis] = 1;
                if (inside(cell + a) == inside(cell + b)) continue;
                glm::dvec3 place(cell + a);
                place[axis] += crossing(cell + a, cell + b);
                sum += place;
                ++crossings;
            }
        return mField.frame.worldFromVoxel(sum / static_cast<double>(crossings));
    }

    void makeTriangles() {
        const int count = static_cast<int>(mMesh.cells.size()), runs = (count + kRun - 1) / kRun;
        std::vector<std::vector<Triangle>> parts(runs);
        parallelFor(runs, [&](int run) {
            for (int v = run * kRun; v < std::min((run + 1) * kRun, count); ++v)
                for (int axis = 0; axis < 3; ++axis) addQuad(mMesh.cells[v], axis, parts[run]);
        });
        for (std::vector<Triangle>& part : parts) {
            mMesh.triangles.insert(mMesh.triangles.end(), part.begin(), part.end());
            part = {};
        }
    }

    // Adds the quad around the edge that leaves the cell's lowest corner along the axis.
    void addQuad(const glm::ivec3& cell, int axis, std::vector<Triangle>& triangles) const {
        glm::ivec3 next = cell;
        ++next[axis];
        const bool starts = inside(cell);
        if (starts == inside(next)) return;
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        if (cell[b] == 0 || cell[c] == 0) return;  // the volume's face
        std::array<std::uint32_t, 4> around{};
        for (int n = 0; n < 4; ++n) {
            glm::ivec3 of = cell;
            of[b] -= n == 1 || n == 2;
            of[c] -= n >= 2;
            const std::optional<std::size_t> record = mCells.recordNumber(of);
            if (!record || mVertexOf[*record] == kNone) return;
            around[n] = mVertexOf[*record];
        }
        // Counter-clockwise as seen from the edge's end, where axes are right-handed.
        if (starts == rightHanded()) std::swap(around[1], around[3]);
        const auto apart = [&](int m, int n) {
            const glm::vec3 way = mMesh.places[around[m]] - mMesh.places[around[n]];
            return glm::dot(way, way);
        };
        const int first = apart(0, 2) <= apart(1, 3) ? 0 : 1;
        const auto at = [&](int n) { return around[(first + n) % 4]; };
        triangles.push_back({at(0), at(1), at(2)});
        triangles.push_back({at(0), at(2), at(3)});
    }

    bool rightHanded() const { return glm::determinant(mField.frame.axes) > 0; }

    void addUp() {
        const std::size_t count = mMesh.places.size();
        std::vector<glm::dvec3> normals(count, glm::dvec3(0.0));
        std::vector<double> areas(count, 0.0);
        for (const Triangle& t : mMesh.triangles) {
            const glm::dvec3 a(mMesh.places[t[0]]), b(mMesh.places[t[1]]), c(mMesh.places[t[2]]);
            const glm::dvec3 doubled = glm::cross(b - a, c - a);
            const double area = 0.5 * glm::length(doubled);
            for (const std::uint32_t v : t) {
                normals[v] += doubled;
                areas[v] += area / 3;
            }
        }
        mMesh.normals.resize(count);
        mMesh.areas.resize(count);
        for (std::size_t v = 0; v < count; ++v) {
            const double length = glm::length(normals[v]);
            mMesh.normals[v] = length > 0 ? glm::vec3(normals[v] / length) : glm::vec3(0, 0, 1);
            mMesh.areas[v] = static_cast<float>(areas[v]);
        }
    }

    const GreyVolume& mField;
    const SurfaceCells& mCells;
    const MaskVolume& mLumen;
    std::vector<std::uint32_t> mVertexOf;  // by record
    WallMesh mMesh;
};

}  // namespace

double WallMesh::area() const {
    return std::accumulate(areas.begin(), areas.end(), 0.0);
}

WallMesh wallMesh(const GreyVolume& field, const SurfaceCells& cells, const MaskVolume& lumen,
                  Progress& progress) {
    return Maker(field, cells, lumen).make(progress);
}

WallNeighbours neighboursOf(const WallMesh& mesh) {
    const std::size_t count = mesh.places.size();
    std::vector<std::uint32_t> start(count + 1, 0);
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t v : t) start[v + 1] += 2;
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::uint32_t> all(start.back()), next(start.begin(), start.end() - 1);
    for (const auto& t : mesh.triangles)
        for (int n = 0; n < 3; ++n) {
            all[next[t[n]]++] = t[(n + 1) % 3];
            all[next[t[n]]++] = t[(n + 2) % 3];
        }
    WallNeighbours result;
    result.first.reserve(count + 1);
    result.first.push_back(0);
    for (std::size_t v = 0; v < count; ++v) {
        const auto from = all.begin() + start[v], to = all.begin() + start[v + 1];
        std::sort(from, to);
        result.neighbours.insert(result.neighbours.end(), from, std::unique(from, to));
        result.first.push_back(static_cast<std::uint32_t>(result.neighbours.size()));
    }
    return result;
}

}  // namespace stereonav
