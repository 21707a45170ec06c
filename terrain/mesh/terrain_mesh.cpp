// Simplification by greedy insertion: the sample farthest from the mesh becomes a vertex until all are
// within the error (Garland and Heckbert, "Fast polygonal approximation of terrains and height fields",
// CMU-CS-95-181, algorithm III). Every sample is measured against the triangle it lies in, so the bound
// holds for all of them, which nested right triangles (RTIN) with errors taken at midpoints do not give;
// any size needs no padding, and a plane takes two triangles. Added here: the borders of holes are
// inserted first. They consist of edges as long as the grid's spacing, which every Delaunay
// triangulation of grid points keeps, so no triangle crosses one.
#include "terrain/mesh/terrain_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <queue>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "terrain/mesh/mesh_triangulation.h"

namespace stereonav {
namespace {

constexpr int kLeastRoom = 1 << 14;
constexpr double kHoles = 0.1;  // share of the progress, where there are any
constexpr double kTriangleBytes =
    160;  // with its share of the vertices, its place in the queue and in the file

std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
    return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

struct RowSpan {
    int begin, end;  // first and last sample; empty when begin > end
};

// Samples of row y inside a triangle or on its border, exactly.
RowSpan spanOf(const glm::ivec2* corner, int y) {
    RowSpan span{std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
    const auto include = [&](std::int64_t first, std::int64_t last) {
        span.begin = std::min(span.begin, static_cast<int>(first));
        span.end = std::max(span.end, static_cast<int>(last));
    };
    for (int k = 0; k < 3; ++k) {
        const glm::ivec2 p = corner[k], q = corner[(k + 1) % 3];
        if (y < std::min(p.y, q.y) || y > std::max(p.y, q.y)) continue;
        if (p.y == y) include(p.x, p.x);
        if (q.y == y) include(q.x, q.x);
        if (p.y == y || q.y == y) continue;
        const std::int64_t across = static_cast<std::int64_t>(q.x - p.x) * (y - p.y), down = q.y - p.y;
        const std::int64_t floor = floorDivide(across, down), ceil = -floorDivide(-across, down);
        include(p.x + ceil, p.x + floor);
    }
    return span;
}

class Simplifier {
public:
    Simplifier(const Heightfield& ground, double error, Progress& progress)
        : mGround(ground), mProgress(progress), mMesh(ground.width() - 1, ground.height() - 1) {
        // Rounding of the plane's height at a sample, with room to spare.
        const double largest =
            std::max(std::abs(double(ground.minHeight())), std::abs(double(ground.maxHeight())));
        mError = std::max(error, 1e-12 * largest);
    }

    TerrainMesh run() {
        mProgress.report(0, "simplifying");
        if (mGround.hasHoles()) insertHoleBorders();
        mCandidates.resize(mMesh.triangleCount());
        for (int t = 0; t < mMesh.triangleCount(); ++t) measure(t);
        Progress refining(mProgress, mGround.hasHoles() ? kHoles : 0, 1);
        refine(refining);
        return result();
    }

private:
    struct Candidate {
        double error = 0;      // metres
        glm::ivec2 sample{0};  // where it is
        std::uint32_t version = 0;
    };
    struct Entry {
        double error;
        int triangle;
        std::uint32_t version;  // version of the triangle when it was measured: an older entry is void
        bool operator<(const Entry& other) const {
            return error != other.error ? error < other.error : triangle > other.triangle;
        }
    };

    bool isOpenCell(int i, int j) const {
        return !std::isfinite(mGround.sample(i, j) + mGround.sample(i + 1, j) + mGround.sample(i, j + 1) +
                              mGround.sample(i + 1, j + 1));
    }
    bool isOpen(int triangle) const {
        if (!mGround.hasHoles()) return false;
        // The cell right above the centroid overlaps the triangle's inside, also where the centroid lies
        // on a line of the grid; and a triangle never lies in both open and closed cells.
        const glm::ivec2 sum =
            mMesh.corner(triangle, 0) + mMesh.corner(triangle, 1) + mMesh.corner(triangle, 2);
        return isOpenCell(sum.x / 3, sum.y / 3);
    }
    void insertHoleBorders();
    void insertOnce(const glm::ivec2& point);
    void measure(int triangle);
    void makeRoom();
    void refine(Progress& progress);
    TerrainMesh result() const;

    const Heightfield& mGround;
    Progress& mProgress;
    MeshTriangulation mMesh;
    double mError;
    std::vector<Candidate> mCandidates;  // one a triangle
    std::priority_queue<Entry> mQueue;
    std::vector<bool> mInserted;  // samples, while hole borders are inserted
    std::vector<int> mChanged;
    int mLast = 0;
    int mRoom = 0;  // triangles
};

void Simplifier::insertOnce(const glm::ivec2& point) {
    const std::size_t index = static_cast<std::size_t>(point.y) * mGround.width() + point.x;
    if (mInserted[index]) return;
    mInserted[index] = true;
    mMesh.insert(point, mMesh.locate(point, mLast), mChanged);
    mLast = mChanged.front();
}

void Simplifier::insertHoleBorders() {
    const int w = mGround.width(), h = mGround.height();
    mInserted.assign(static_cast<std::size_t>(w) * h, false);
    for (const glm::ivec2 corner : {glm::ivec2(0, 0), {w - 1, 0}, {w - 1, h - 1}, {0, h - 1}})
        mInserted[static_cast<std::size_t>(corner.y) * w + corner.x] = true;
    for (int j = 0; j + 1 < h; ++j) {
        mProgress.report(kHoles * j / h, "outlining holes");
        for (int i = 0; i + 1 < w; ++i) {
            const bool open = isOpenCell(i, j);
            if (i + 2 < w && open != isOpenCell(i + 1, j)) insertOnce({i + 1, j}), insertOnce({i + 1, j + 1});
            if (j + 2 < h && open != isOpenCell(i, j + 1)) insertOnce({i, j + 1}), insertOnce({i + 1, j + 1});
        }
    }
}

// Finds the sample of a triangle that is farthest from its plane, and queues it if it is too far.
void Simplifier::measure(int triangle) {
    Candidate& best = mCandidates[triangle];
    best.error = 0;
    ++best.version;
    if (isOpen(triangle)) return;
    const glm::ivec2 corner[3] = {mMesh.corner(triangle, 0), mMesh.corner(triangle, 1),
                                  mMesh.corner(triangle, 2)};
    const double z0 = mGround.sample(corner[0].x, corner[0].y);
    const double z1 = mGround.sample(corner[1].x, corner[1].y) - z0;
    const double z2 = mGround.sample(corner[2].x, corner[2].y) - z0;
    const double scale = 1.0 / static_cast<double>(twiceArea(corner[0], corner[1], corner[2]));
    const int low = std::min({corner[0].y, corner[1].y, corner[2].y});
    const int high = std::max({corner[0].y, corner[1].y, corner[2].y});
    for (int y = low; y <= high; ++y) {
        const RowSpan span = spanOf(corner, y);
        if (span.begin > span.end) continue;
        // Areas opposite corners 1 and 2 at the first sample: whole numbers, linear in x. Counting from
        // there keeps all terms within the triangle's own size, also in slivers.
        const glm::ivec2 first(span.begin, y);
        const auto area1 = static_cast<double>(twiceArea(corner[2], corner[0], first));
        const auto area2 = static_cast<double>(twiceArea(corner[0], corner[1], first));
        const double step1 = corner[2].y - corner[0].y, step2 = corner[0].y - corner[1].y;
        const double start = z0 + (area1 * z1 + area2 * z2) * scale,
                     slope = (step1 * z1 + step2 * z2) * scale;
        const float* row = mGround.data() + static_cast<std::size_t>(y) * mGround.width() + span.begin;
        for (int n = 0; n <= span.end - span.begin; ++n) {
            const double error = std::abs(row[n] - (start + slope * n));
            if (error > best.error) best.error = error, best.sample = {span.begin + n, y};
        }
    }
    if (best.error > mError) mQueue.push({best.error, triangle, best.version});
}

// The size of a mesh is not known before it is made: before each doubling memory is checked, with the copy
// that growing arrays need.
void Simplifier::makeRoom() {
    mRoom = std::max(2 * mMesh.triangleCount(), kLeastRoom);
    checkMemory(fmt::format("a mesh of more than {} triangles", mMesh.triangleCount()),
                kTriangleBytes * mRoom, fmt::format("give a larger --error than {:g} m", mError));
}

void Simplifier::refine(Progress& progress) {
    double told = 0;  // a new triangle may be worse than the last
    const double first = mQueue.empty() ? 0.0 : mQueue.top().error;
    for (long long steps = 0; !mQueue.empty(); ++steps) {
        const Entry worst = mQueue.top();
        mQueue.pop();
        const Candidate candidate = mCandidates[worst.triangle];
        if (candidate.version != worst.version) continue;
        // Errors fall about as a power of the number of vertices.
        if (steps % 4096 == 0) {
            told = std::clamp(std::log(first / worst.error) / std::log(first / mError + 1e-9), told, 1.0);
            progress.report(told, "simplifying");
        }
        mMesh.insert(candidate.sample, worst.triangle, mChanged);
        if (mMesh.triangleCount() > mRoom) makeRoom();
        mCandidates.resize(mMesh.triangleCount());
        for (const int t : mChanged) measure(t);
    }
    progress.report(1, "simplifying");
}

TerrainMesh Simplifier::result() const {
    TerrainMesh mesh;
    std::vector<std::uint32_t> number(mMesh.points().size(), ~0u);
    for (int t = 0; t < mMesh.triangleCount(); ++t) {
        if (isOpen(t)) continue;
        mesh.maxError = std::max(mesh.maxError, mCandidates[t].error);
        std::array<std::uint32_t, 3> triangle{};
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& n = number[mMesh.vertex(t, k)];
            if (n == ~0u) {
                n = static_cast<std::uint32_t>(mesh.vertices.size());
                mesh.vertices.push_back(mMesh.corner(t, k));
            }
            triangle[k] = n;
        }
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

}  // namespace

TerrainMesh simplifyTerrain(const Heightfield& ground, double error, Progress& progress) {
    if (!(error >= 0 && std::isfinite(error)))
        throw Error("", "mesh error", fmt::format("expected metres >= 0, got {:g}", error),
                    "give another --error");
    return Simplifier(ground, error, progress).run();
}

}  // namespace stereonav
