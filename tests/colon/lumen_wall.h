// The wall of a lumen that a signed distance defines: its surface cells, mesh and neighbours, for tests of
// instruments.
#pragma once

#include "colon/wall/line_of_sight.h"
#include "colon/wall/wall_mesh.h"
#include "tests/colon/centreline_lumens.h"

namespace stereonav::test {

struct LumenWall {
    LumenField lumen;
    SurfaceCells cells;
    WallMesh mesh;
    WallNeighbours neighbours;

    LumenWall(const Shape& shape, const glm::dvec3& low, const glm::dvec3& high, double spacing)
        : LumenWall(lumenOf(shape, low, high, glm::dvec3(spacing))) {}
    explicit LumenWall(LumenField made) : lumen(std::move(made)) {
        Progress progress;
        SurfaceSetting setting;
        setting.isovalue = setting.lowest = setting.highest = static_cast<float>(lumen.isovalue);
        setting.region = &lumen.lumen;
        cells = findSurfaceCells(lumen.field, setting, progress);
        mesh = wallMesh(lumen.field, cells, lumen.lumen, progress);
        neighbours = neighboursOf(mesh);
    }
    LineOfSight sight() const { return {lumen.field, cells, lumen.isovalue}; }
    double freeDistanceAt(const glm::dvec3& place, double upTo) const {
        return freeDistance(cells, place, upTo, 1e-5);
    }
};

inline double toBall(const glm::dvec3& p, const glm::dvec3& middle, double radius) {
    return glm::length(p - middle) - radius;
}

// Returns the signed distance to a tube along z with flat ends, or a bound of it outside the edges.
inline double toTube(const glm::dvec3& p, double radius, double from, double to) {
    return std::max(std::hypot(p.x, p.y) - radius, std::max(from - p.z, p.z - to));
}

}  // namespace stereonav::test
