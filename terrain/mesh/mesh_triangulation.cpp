// Incremental Delaunay triangulation with edge flips: Guibas and Stolfi, "Primitives for the manipulation
// of general subdivisions and the computation of Voronoi diagrams", 1985, section 10. Different here: twin
// links between the triangles' edges in place of quad-edges, and no outer triangle.
#include "terrain/mesh/mesh_triangulation.h"

#include <algorithm>

namespace stereonav {
namespace {

__extension__ using Wide = __int128;

// Returns whether d lies inside the circle through a, b, c (counterclockwise). On the circle is outside.
bool inCircle(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c, const glm::ivec2& d) {
    const std::int64_t ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x,
                       cy = c.y - d.y;
    const std::int64_t a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    return Wide(a2) * (bx * cy - cx * by) + Wide(b2) * (cx * ay - ax * cy) + Wide(c2) * (ax * by - bx * ay) >
           0;
}

}  // namespace

MeshTriangulation::MeshTriangulation(int lastX, int lastY)
    : mPoints{{0, 0}, {lastX, 0}, {lastX, lastY}, {0, lastY}} {
    addTriangle();
    addTriangle();
    set(0, 0, 1, 2);
    set(1, 0, 2, 3);
    link(2, 3);
}

int MeshTriangulation::addTriangle() {
    mVertex.resize(mVertex.size() + 3, -1);
    mTwin.resize(mVertex.size(), -1);
    return triangleCount() - 1;
}

void MeshTriangulation::set(int triangle, int a, int b, int c) {
    const std::size_t first = 3 * static_cast<std::size_t>(triangle);
    mVertex[first] = a;
    mVertex[first + 1] = b;
    mVertex[first + 2] = c;
    if (mChanged) mChanged->push_back(triangle);
}

void MeshTriangulation::link(int edge, int twin) {
    mTwin[edge] = twin;
    if (twin >= 0) mTwin[twin] = edge;
}

int MeshTriangulation::locate(const glm::ivec2& point, int start) const {
    // The walk ends because the triangulation is Delaunay: triangles are left in the order of their
    // circles' power, which never grows again (Edelsbrunner 1990).
    for (int triangle = start;;) {
        int across = -1;
        for (int edge = 3 * triangle; edge < 3 * triangle + 3 && across < 0; ++edge)
            if (twiceArea(mPoints[mVertex[edge]], mPoints[mVertex[next(edge)]], point) < 0)
                across = mTwin[edge];
        if (across < 0) return triangle;
        triangle = across / 3;
    }
}

void MeshTriangulation::insert(const glm::ivec2& point, int triangle, std::vector<int>& changed) {
    const int p = static_cast<int>(mPoints.size());
    mPoints.push_back(point);
    changed.clear();
    mChanged = &changed;
    int onEdge = -1;
    for (int edge = 3 * triangle; edge < 3 * triangle + 3; ++edge)
        if (twiceArea(mPoints[mVertex[edge]], mPoints[mVertex[next(edge)]], point) == 0) onEdge = edge;
    if (onEdge >= 0)
        splitEdge(onEdge, p);
    else
        splitInside(triangle, p);
    while (!mSuspects.empty()) {
        const int edge = mSuspects.back();
        mSuspects.pop_back();
        legalize(edge);
    }
    mChanged = nullptr;
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
}

// One triangle becomes three.
void MeshTriangulation::splitInside(int t, int p) {
    const std::size_t first = 3 * static_cast<std::size_t>(t);
    const int a = mVertex[first], b = mVertex[first + 1], c = mVertex[first + 2];
    const int twinBc = mTwin[first + 1], twinCa = mTwin[first + 2];
    const int u = addTriangle(), v = addTriangle();
    set(t, a, b, p);
    set(u, b, c, p);
    set(v, c, a, p);
    link(3 * u, twinBc);
    link(3 * v, twinCa);
    link(3 * t + 1, 3 * u + 2);
    link(3 * u + 1, 3 * v + 2);
    link(3 * v + 1, 3 * t + 2);
    mSuspects.assign({3 * t, 3 * u, 3 * v});
}

// The triangles on both sides of the edge become two each; at the border there is one side.
void MeshTriangulation::splitEdge(int edge, int p) {
    const int t = edge / 3, twin = mTwin[edge];
    const int a = mVertex[edge], b = mVertex[next(edge)], c = mVertex[previous(edge)];
    const int twinBc = mTwin[next(edge)], twinCa = mTwin[previous(edge)];
    const int d = twin >= 0 ? mVertex[previous(twin)] : -1;
    const int twinAd = twin >= 0 ? mTwin[next(twin)] : -1, twinDb = twin >= 0 ? mTwin[previous(twin)] : -1;
    const int t1 = addTriangle();
    set(t, a, p, c);
    set(t1, p, b, c);
    link(3 * t, -1);
    link(3 * t1, -1);
    link(3 * t + 1, 3 * t1 + 2);
    link(3 * t + 2, twinCa);
    link(3 * t1 + 1, twinBc);
    mSuspects.assign({3 * t + 2, 3 * t1 + 1});
    if (twin < 0) return;
    const int u = twin / 3, u1 = addTriangle();
    set(u, b, p, d);
    set(u1, p, a, d);
    link(3 * u, 3 * t1);
    link(3 * u1, 3 * t);
    link(3 * u + 1, 3 * u1 + 2);
    link(3 * u + 2, twinDb);
    link(3 * u1 + 1, twinAd);
    mSuspects.push_back(3 * u + 2);
    mSuspects.push_back(3 * u1 + 1);
}

// edge: opposite the new point. Flipped when the point beyond lies inside the triangle's circle.
void MeshTriangulation::legalize(int edge) {
    const int twin = mTwin[edge];
    if (twin < 0) return;
    const int a = mVertex[edge], b = mVertex[next(edge)], c = mVertex[previous(edge)],
              d = mVertex[previous(twin)];
    if (!inCircle(mPoints[a], mPoints[b], mPoints[c], mPoints[d])) return;
    const int t = edge / 3, u = twin / 3;
    const int twinBc = mTwin[next(edge)], twinCa = mTwin[previous(edge)];
    const int twinAd = mTwin[next(twin)], twinDb = mTwin[previous(twin)];
    set(t, a, d, c);
    set(u, d, b, c);
    link(3 * t, twinAd);
    link(3 * t + 1, 3 * u + 2);
    link(3 * t + 2, twinCa);
    link(3 * u, twinDb);
    link(3 * u + 1, twinBc);
    mSuspects.push_back(3 * t);
    mSuspects.push_back(3 * u);
}

}  // namespace stereonav
