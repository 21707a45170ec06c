// Bricks are counted first, then each is written in its place: corners that its cells share are computed
// once.
#include "engine/volume/cell_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kBrick = 16, kBrickCells = kBrick * kBrick * kBrick;
// Kernels count words of 4 bytes with 32-bit numbers.
constexpr std::uint64_t kMostWords = 1ull << 31;

// The slope at a voxel of the values smoothed by a tricubic B-spline: weights 1/6, 4/6, 1/6 across and -1/2,
// 0, 1/2 along. In stored numbers a metre along i, j, k. Summed in whole numbers, so that what is the same
// all around has none, whatever its value. And the same of what values rise and fall by, whichever they do.
struct SlopeAt {
    glm::dvec3 slope, change;
};
SlopeAt slopeAt(const GreyVolume& volume, const glm::ivec3& at) {
    const glm::ivec3 last = volume.frame.size - 1;
    const int x[3] = {std::max(at.x - 1, 0), at.x, std::min(at.x + 1, last.x)};
    constexpr int kSmooth[3] = {1, 4, 1};  // sixths
    int v[3][3][3];                        // by z, y, x
    for (int c = 0; c < 3; ++c)
        for (int b = 0; b < 3; ++b) {
            const std::int16_t* row =
                volume.values.data() + volume.frame.index(0, std::clamp(at.y + b - 1, 0, last.y),
                                                          std::clamp(at.z + c - 1, 0, last.z));
            for (int a = 0; a < 3; ++a) v[c][b][a] = row[x[a]];
        }
    glm::ivec3 slope(0), change(0);  // 72nds
    const auto add = [&](int axis, int weight, int before, int here, int after) {
        slope[axis] += weight * (after - before);
        change[axis] += weight * (std::abs(after - here) + std::abs(here - before));
    };
    for (int c = 0; c < 3; ++c)
        for (int b = 0; b < 3; ++b) {
            const int weight = kSmooth[b] * kSmooth[c];
            add(0, weight, v[c][b][0], v[c][b][1], v[c][b][2]);
            add(1, weight, v[c][0][b], v[c][1][b], v[c][2][b]);
            add(2, weight, v[0][c][b], v[1][c][b], v[2][c][b]);
        }
    const glm::dvec3 metres = 72.0 * volume.frame.spacing;
    return {glm::dvec3(slope) / metres, glm::dvec3(change) / metres};
}

std::uint32_t normalAt(const GreyVolume& volume, const glm::ivec3& at) {
    const SlopeAt here = slopeAt(volume, at);
    const double length = glm::length(here.slope);
    // In the middle of what is thin values rise and fall by more than the slope: its neighbours alone count.
    if (!(length > 0 && length >= kOneSided * glm::length(here.change)))
        return packCornerNormal(glm::dvec3(0));
    return packCornerNormal(-(volume.frame.axes * here.slope) / length);
}

// Where one brick's active cells go; corners that they share are computed once.
class BrickRecords {
public:
    explicit BrickRecords(const GreyVolume& volume) : mVolume(volume) {}

    // active: in the order of BrickLayout.
    void write(const glm::ivec3& brick, const std::uint8_t* active, std::uint32_t first,
               SurfaceCells& cells) {
        std::vector<std::uint32_t> normals(kDenseCorners);
        std::uint16_t place = 0;
        forActive(brick, active, [&](const glm::ivec3& low, const glm::ivec3& at) {
            cells.places[cells.layout.index(at.x, at.y, at.z)] = ++place;
            CellRecord& record = cells.records[first + place - 1u];
            for (int n = 0; n < 8; ++n) {
                record.values[n] = mVolume.at(cornerOf(at, n));
                record.normals[n] = normalOf(low, cornerOf(at, n), normals.data());
            }
        });
    }

    // Writes a dense brick's normals, and no records.
    void writeNormals(const glm::ivec3& brick, const std::uint8_t* active, std::uint32_t* normals) {
        forActive(brick, active, [&](const glm::ivec3& low, const glm::ivec3& at) {
            for (int n = 0; n < 8; ++n) normalOf(low, cornerOf(at, n), normals);
        });
    }

private:
    template <typename Use>
    static void forActive(const glm::ivec3& brick, const std::uint8_t* active, const Use& use) {
        const glm::ivec3 low = brick * kBrick;
        for (int n = 0; n < kBrickCells; ++n)
            if (active[n]) use(low, low + glm::ivec3(n & 15, n >> 4 & 15, n >> 8));
    }
    static glm::ivec3 cornerOf(const glm::ivec3& cell, int n) {
        return cell + glm::ivec3(n & 1, n >> 1 & 1, n >> 2);
    }
    std::uint32_t normalOf(const glm::ivec3& low, const glm::ivec3& corner, std::uint32_t* normals) const {
        const glm::ivec3 local = corner - low;
        std::uint32_t& normal = normals[(local.z * kDenseSide + local.y) * kDenseSide + local.x];
        if (normal == 0) normal = normalAt(mVolume, corner);  // no packed unit vector is 0
        return normal;
    }

    const GreyVolume& mVolume;
};

glm::ivec3 brickAt(const BrickLayout& layout, int n) {
    return {n % layout.bricks.x, n / layout.bricks.x % layout.bricks.y,
            n / (layout.bricks.x * layout.bricks.y)};
}

// Flags of a brick's active cells in the order of BrickLayout; gives how many there are.
std::uint32_t flagBrick(const glm::ivec3& size, const glm::ivec3& brick, const ActiveRow& activeRow,
                        std::uint8_t* active) {
    const glm::ivec3 low = brick * kBrick, high = glm::min(low + kBrick, size);
    std::fill_n(active, kBrickCells, std::uint8_t{0});
    for (int k = low.z; k < high.z; ++k)
        for (int j = low.y; j < high.y; ++j)
            activeRow({low.x, j, k}, high.x - low.x, active + ((k & 15) << 8 | (j & 15) << 4));
    return static_cast<std::uint32_t>(std::count(active, active + kBrickCells, std::uint8_t{1}));
}

// From active cells of each brick to where its first record is, or its normals.
struct Totals {
    std::uint64_t records = 0, dense = 0, sparse = 0;
};
Totals placeBricks(std::vector<std::uint32_t>& counts, std::uint32_t denseFrom, SurfaceCells& cells) {
    Totals totals;
    for (std::size_t n = 0; n < counts.size(); ++n) {
        cells.active += counts[n];
        const bool dense = counts[n] >= denseFrom;
        if (counts[n] == 0) continue;
        cells.bricks[n] = static_cast<std::uint32_t>(dense ? kDenseBrick | totals.dense : totals.records);
        totals.dense += dense;
        totals.sparse += !dense;
        if (!dense) totals.records += counts[n];
    }
    if (totals.records > kMostWords / (sizeof(CellRecord) / 4) - 1 ||
        totals.dense > kMostWords / kDenseCorners - 1)
        throw Error("", "isosurface",
                    fmt::format("{} cells hold surface, more than can be counted", cells.active),
                    "choose another isovalue or a smaller volume");
    checkMemory(fmt::format("a surface of {} cells", cells.active),
                static_cast<double>(totals.records) * sizeof(CellRecord) +
                    static_cast<double>(totals.sparse) * kBrickCells * sizeof(std::uint16_t) +
                    static_cast<double>(totals.dense) * kDenseCorners * sizeof(std::uint32_t),
                "choose another isovalue, a transfer function that shows less, or a smaller volume");
    return totals;
}

}  // namespace

std::uint32_t packCornerNormal(const glm::dvec3& unit) {
    const auto channel = [](double v) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(v, -1.0, 1.0) * 511.5 + 511.5));
    };
    return channel(unit.x) | channel(unit.y) << 10 | channel(unit.z) << 20;
}

glm::dvec3 unpackCornerNormal(std::uint32_t packed) {
    const auto channel = [&](int shift) { return (packed >> shift & 1023u) / 511.5 - 1.0; };
    return {channel(0), channel(10), channel(20)};
}

void writeRecords(const GreyVolume& volume, const SurfaceSetting& setting, const ActiveRow& activeRow,
                  SurfaceCells& cells) {
    const int bricks = cells.layout.bricks.x * cells.layout.bricks.y * cells.layout.bricks.z;
    const glm::ivec3 size = volume.frame.size - 1;
    std::vector<std::uint32_t> counts(static_cast<std::size_t>(bricks));
    parallelFor(bricks, [&](int n) {
        std::uint8_t active[kBrickCells];
        counts[n] = flagBrick(size, brickAt(cells.layout, n), activeRow, active);
    });
    cells.bricks = LazyArray<std::uint32_t>(counts.size());
    cells.places = LazyArray<std::uint16_t>(cells.layout.count());
    // In a region what is not active and what lies outside have the same code.
    const std::uint32_t denseFrom = setting.region ? SurfaceSetting::kNeverDense : setting.denseFrom;
    const Totals totals = placeBricks(counts, denseFrom, cells);
    cells.records = LazyArray<CellRecord>(totals.records);
    cells.records.preferLargePages();
    cells.normals = LazyArray<std::uint32_t>(totals.dense * kDenseCorners);
    if (totals.dense > 0) cells.values = volume.values.share();
    parallelFor(bricks, [&](int n) {
        if (counts[n] == 0) return;
        const glm::ivec3 brick = brickAt(cells.layout, n);
        std::uint8_t active[kBrickCells];
        flagBrick(size, brick, activeRow, active);
        const std::uint32_t place = cells.bricks[n];
        BrickRecords records(volume);
        if (place & kDenseBrick)
            records.writeNormals(brick, active,
                                 cells.normals.data() + std::size_t{place & ~kDenseBrick} * kDenseCorners);
        else
            records.write(brick, active, place, cells);
    });
}

}  // namespace stereonav
