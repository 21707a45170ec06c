// An incremental Delaunay triangulation of grid samples: integer coordinates, exact predicates (128-bit
// products), edges linked to their twins. The ground's simplification inserts samples into it.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace stereonav {

class MeshTriangulation {
public:
    // Makes the rectangle from (0, 0) to (lastX, lastY), cut along one diagonal.
    MeshTriangulation(int lastX, int lastY);

    int triangleCount() const { return static_cast<int>(mVertex.size() / 3); }
    const std::vector<glm::ivec2>& points() const { return mPoints; }
    // Returns corner k (0..2) of a triangle, an index into points(); counterclockwise.
    int vertex(int triangle, int k) const { return mVertex[3 * triangle + k]; }
    const glm::ivec2& corner(int triangle, int k) const { return mPoints[vertex(triangle, k)]; }

    // Returns a triangle that contains the point (inside or on its border), searched from `start` on.
    int locate(const glm::ivec2& point, int start) const;
    // Inserts a point that lies in `triangle` and is no vertex yet, and restores the empty-circle
    // property. changed: the triangles that are new or have other corners now, each once.
    void insert(const glm::ivec2& point, int triangle, std::vector<int>& changed);

private:
    int addTriangle();
    void set(int triangle, int a, int b, int c);
    void link(int edge, int twin);
    void splitInside(int triangle, int p);
    void splitEdge(int edge, int p);
    void legalize(int edge);

    static int next(int edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }
    static int previous(int edge) { return edge % 3 == 0 ? edge + 2 : edge - 1; }

    std::vector<glm::ivec2> mPoints;
    std::vector<int> mVertex;  // 3 a triangle; edge e leads from mVertex[e] to mVertex[next(e)]
    std::vector<int> mTwin;    // the same edge seen from the other side, -1 at the border
    std::vector<int> mSuspects;
    std::vector<int>* mChanged = nullptr;
};

// Twice the signed area: > 0 when a, b, c run counterclockwise. Exact for coordinates below 2^30.
inline std::int64_t twiceArea(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) {
    return static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) -
           static_cast<std::int64_t>(c.x - a.x) * (b.y - a.y);
}

}  // namespace stereonav
