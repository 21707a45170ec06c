#include "colon/segmentation/wall_crossings.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

glm::ivec3 unit(int axis) {
    return {axis == 0, axis == 1, axis == 2};
}

// Crossings from the voxels of one row.
struct RowCrossings {
    std::vector<std::int32_t> column[3];
    std::vector<std::uint8_t> leaves[3];
    void add(int axis, int i, bool inside) {
        column[axis].push_back(i);
        leaves[axis].push_back(inside ? 1 : 0);
    }
};

// Voxels that are in one row of runs alone; `use` gets each, and whether it is in `a`.
template <typename Use>
void forDifferent(std::span<const VoxelRun> a, std::span<const VoxelRun> b, int size, const Use& use) {
    std::size_t m = 0, n = 0;
    for (int i = 0; i < size;) {
        while (m < a.size() && a[m].end <= i) ++m;
        while (n < b.size() && b[n].end <= i) ++n;
        const bool inA = m < a.size() && a[m].first <= i, inB = n < b.size() && b[n].first <= i;
        const int endA = m == a.size() ? size : inA ? a[m].end : a[m].first;
        const int endB = n == b.size() ? size : inB ? b[n].end : b[n].first;
        const int end = std::min({endA, endB, size});
        if (inA != inB)
            for (int at = i; at < end; ++at) use(at, inA);
        i = end;
    }
}

RowCrossings crossingsOf(const VoxelRuns& inside, int j, int k) {
    RowCrossings found;
    const auto row = inside.row(j, k);
    for (const VoxelRun& run : row) {
        if (run.first > 0) found.add(0, run.first - 1, false);
        if (run.end < inside.size.x) found.add(0, run.end - 1, true);
    }
    const auto add = [&](int axis) { return [&found, axis](int i, bool in) { found.add(axis, i, in); }; };
    if (j + 1 < inside.size.y) forDifferent(row, inside.row(j + 1, k), inside.size.x, add(1));
    if (k + 1 < inside.size.z) forDifferent(row, inside.row(j, k + 1), inside.size.x, add(2));
    return found;
}

// The neighbour of a crossing from `lower` along `axis` on one side, in the plane of `axis` and `across`.
CrossingLink linkOf(const WallCrossings& wall, int axis, const glm::ivec3& lower, bool leaves, int across,
                    int side) {
    const glm::ivec3 step = side ? unit(across) : -unit(across), beside = lower + step;
    if (beside[across] < 0 || beside[across] >= wall.size[across]) return {};
    const glm::ivec3 first = side ? lower : beside;
    const std::uint32_t atLower = wall.find(across, first), atUpper = wall.find(across, first + unit(axis));
    const bool low = atLower != WallCrossings::kNone, up = atUpper != WallCrossings::kNone;
    if (!low && !up) return {wall.find(axis, beside), CrossingLink::Beside};
    // Two outlines pass a face with four crossings: those around a corner that is inside belong together.
    if (low && (!up || leaves)) return {atLower, CrossingLink::AtLower};
    return {atUpper, CrossingLink::AtUpper};
}

void checkCount(std::uint64_t crossings) {
    // Column, side, place and axis; links; three pairs of bends; the next place; normals, twice.
    constexpr double kBytes = 4 + 1 + 4 + 1 + 16 + 24 + 2 * 16 + 4 + 2 * 12;
    const std::string what = fmt::format("smoothing a mask's wall at {} places", crossings);
    const char* const advice = "leave it as it is with --mask-smoothing 0, or make the mask coarser";
    if (crossings >= WallCrossings::kNone)
        throw Error("", "", what + fmt::format(" is more than {}", WallCrossings::kNone), advice);
    checkMemory(what, kBytes * static_cast<double>(crossings), advice);
}

}  // namespace

std::uint32_t WallCrossings::find(int axis, const glm::ivec3& lower) const {
    if (lower.y < 0 || lower.z < 0 || lower.y >= size.y || lower.z >= size.z) return kNone;
    const std::size_t list = 3 * (static_cast<std::size_t>(lower.z) * size.y + lower.y) + axis;
    const auto first = column.begin() + start[list], end = column.begin() + start[list + 1];
    const auto found = std::lower_bound(first, end, lower.x);
    return found != end && *found == lower.x ? static_cast<std::uint32_t>(found - column.begin()) : kNone;
}

WallCrossings findCrossings(const VoxelRuns& inside) {
    WallCrossings wall;
    wall.size = inside.size;
    const std::size_t rows = static_cast<std::size_t>(inside.size.y) * inside.size.z;
    wall.start.assign(3 * rows + 1, 0);
    const auto forRows = [&](const auto& use) {
        parallelFor(inside.size.z, [&](int k) {
            for (int j = 0; j < inside.size.y; ++j) use(inside.rowNumber(j, k), crossingsOf(inside, j, k));
        });
    };
    forRows([&](std::size_t row, const RowCrossings& found) {
        for (int axis = 0; axis < 3; ++axis)
            wall.start[3 * row + axis + 1] = static_cast<std::uint32_t>(found.column[axis].size());
    });
    checkCount(std::accumulate(wall.start.begin(), wall.start.end(), std::uint64_t{0}));
    for (std::size_t n = 1; n < wall.start.size(); ++n) wall.start[n] += wall.start[n - 1];
    wall.column.resize(wall.start.back());
    wall.leaves.resize(wall.start.back());
    wall.at.assign(wall.start.back(), 0.5f);
    forRows([&](std::size_t row, const RowCrossings& found) {
        for (int axis = 0; axis < 3; ++axis) {
            std::ranges::copy(found.column[axis], wall.column.begin() + wall.start[3 * row + axis]);
            std::ranges::copy(found.leaves[axis], wall.leaves.begin() + wall.start[3 * row + axis]);
        }
    });
    return wall;
}

CrossingLinks linksOf(const WallCrossings& wall) {
    CrossingLinks links(wall.count());
    const auto rows = static_cast<std::size_t>(wall.size.y);
    parallelFor(wall.size.z, [&](int k) {
        forCrossings(wall, rows * k, rows * (k + 1), [&](int axis, const glm::ivec3& lower, std::uint32_t n) {
            for (int plane = 0; plane < 2; ++plane)
                for (int side = 0; side < 2; ++side)
                    links[n][2 * plane + side] =
                        linkOf(wall, axis, lower, wall.leaves[n] != 0, (axis + 1 + plane) % 3, side);
        });
    });
    return links;
}

}  // namespace stereonav
