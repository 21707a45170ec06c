// From a volume to what rays need: cells are told active row by row, distances between cells become leap
// codes, and active cells get their records, brick by brick.
#include "engine/volume/surface_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/pages.h"
#include "engine/base/parallel.h"
#include "engine/volume/cell_rows.h"
#include "engine/volume/distance_transform.h"
#include "engine/volume/leap_blocks.h"

namespace stereonav {
namespace {

constexpr int kBrick = 16, kBrickCells = kBrick * kBrick * kBrick;

// One flag a cell, in a volume of the cells' own frame.
struct CellFlags {
    MaskVolume active;  // holds surface
    MaskVolume region;  // rays are followed here; empty: everywhere
    std::vector<std::uint8_t> everywhere;

    const std::uint8_t* regionRow(int j, int k) const {
        return region.empty() ? everywhere.data() : region.values.data() + region.frame.index(0, j, k);
    }
};

CellFlags flagCells(const GreyVolume& volume, const SurfaceSetting& setting, const VolumeFrame& frame) {
    const glm::ivec3 size = frame.size;
    CellFlags flags{MaskVolume(frame), {}, {}};
    if (setting.region)
        flags.region = MaskVolume(frame);
    else
        flags.everywhere.assign(static_cast<std::size_t>(size.x), 1);
    parallelFor(size.z, [&](int k) {
        for (int j = 0; j < size.y; ++j) {
            const std::size_t row = frame.index(0, j, k);
            if (setting.region &&
                !flagRegion(*setting.region, j, k, size.x, flags.region.values.data() + row))
                continue;
            flagActive(volume, setting, j, k, size.x, flags.regionRow(j, k),
                       flags.active.values.data() + row);
        }
    });
    return flags;
}

// Cells of the region that do not touch an active cell, not even by a corner. The distance between the
// nearest points of two cells is that between the centre of one and the nearest centre of the other's
// 27 neighbours, so distances to what is not far are exact between cells as boxes.
MaskVolume farCells(const CellFlags& flags) {
    const VolumeFrame& frame = flags.active.frame;
    const glm::ivec3 size = frame.size;
    MaskVolume far(frame);
    parallelFor(size.z, [&](int k) {
        std::vector<std::uint8_t> any(static_cast<std::size_t>(size.x) + 2);
        for (int j = 0; j < size.y; ++j) {
            const std::uint8_t* region = flags.regionRow(j, k);
            if (!anySet(region, size.x)) continue;
            std::fill(any.begin(), any.end(), std::uint8_t{0});
            for (int z = std::max(k - 1, 0); z <= std::min(k + 1, size.z - 1); ++z)
                for (int y = std::max(j - 1, 0); y <= std::min(j + 1, size.y - 1); ++y) {
                    const std::uint8_t* active = flags.active.values.data() + frame.index(0, y, z);
                    for (int i = 0; i < size.x; ++i) any[i + 1] |= active[i];
                }
            std::uint8_t* out = far.values.data() + frame.index(0, j, k);
            for (int i = 0; i < size.x; ++i) out[i] = region[i] & !(any[i] | any[i + 1] | any[i + 2]);
        }
    });
    return far;
}

// The largest distance that occurs, in the volume's units.
std::uint16_t largestOf(const DistanceVolume& distance) {
    const glm::ivec3 size = distance.frame.size;
    std::vector<std::uint16_t> best(static_cast<std::size_t>(size.z), 0);
    parallelFor(size.z, [&](int k) {
        const std::uint16_t* d = distance.values.data() + distance.frame.index(0, 0, k);
        std::uint16_t most = 0;
        for (int n = 0; n < size.x * size.y; ++n)
            most = std::max(most, d[n] == DistanceVolume::kNoSeed ? std::uint16_t{0} : d[n]);
        best[k] = most;
    });
    return best.empty() ? std::uint16_t{0} : *std::max_element(best.begin(), best.end());
}

// Codes of the region's cells, which are not active. Distances have a finer unit than leaps: `divisor` of
// theirs make one.
void encodeLeaps(const CellFlags& flags, const DistanceVolume& distance, int divisor, SurfaceCells& cells) {
    const VolumeFrame& frame = flags.active.frame;
    parallelFor(frame.size.z, [&](int k) {
        for (int j = 0; j < frame.size.y; ++j) {
            const std::size_t row = frame.index(0, j, k);
            const std::uint8_t* region = flags.regionRow(j, k);
            if (!anySet(region, frame.size.x)) continue;
            const std::uint8_t* active = flags.active.values.data() + row;
            const std::uint16_t* d = distance.values.data() + row;
            for (int i = 0; i < frame.size.x; ++i) {
                if (!region[i] || active[i]) continue;
                cells.codes[cells.layout.index(i, j, k)] =
                    static_cast<std::uint8_t>(std::min(1 + d[i] / divisor, kLargestCode));
            }
        }
    });
}

// Codes by distances between all cells; gives the active ones.
MaskVolume codeLeapsAtOnce(const GreyVolume& volume, const SurfaceSetting& setting, const VolumeFrame& frame,
                           Progress& progress, SurfaceCells& cells) {
    CellFlags flags = flagCells(volume, setting, frame);
    progress.report(0.3, "measuring distances to the surface");
    const glm::dvec3 spacing = volume.frame.spacing;
    cells.leapUnit = 0.25 * std::min({spacing.x, spacing.y, spacing.z});
    const DistanceVolume distance = distanceToOutside(farCells(flags), false, cells.leapUnit);
    const int coarser = leapDivisor(largestOf(distance));
    cells.leapUnit *= coarser;
    cells.codes = LazyArray<std::uint8_t>(cells.layout.count());
    encodeLeaps(flags, distance, coarser, cells);
    return std::move(flags.active);
}

// The gradient at a voxel of the values smoothed by a tricubic B-spline: weights 1/6, 4/6, 1/6 across and
// -1/2, 0, 1/2 along. In stored numbers a metre along i, j, k. Summed in whole numbers, so that what is the
// same all around has none, whatever its value.
glm::dvec3 gradientAt(const GreyVolume& volume, const glm::ivec3& at) {
    const glm::ivec3 last = volume.frame.size - 1;
    const int x[3] = {std::max(at.x - 1, 0), at.x, std::min(at.x + 1, last.x)};
    constexpr int kSmooth[3] = {1, 4, 1};  // sixths
    int gx = 0, gy = 0, gz = 0;            // 72nds
    for (int c = 0; c < 3; ++c)
        for (int b = 0; b < 3; ++b) {
            const std::int16_t* row =
                volume.values.data() + volume.frame.index(0, std::clamp(at.y + b - 1, 0, last.y),
                                                          std::clamp(at.z + c - 1, 0, last.z));
            const int v0 = row[x[0]], v1 = row[x[1]], v2 = row[x[2]];
            const int across = v0 + 4 * v1 + v2;
            gx += kSmooth[b] * kSmooth[c] * (v2 - v0);
            gy += (b - 1) * kSmooth[c] * across;
            gz += kSmooth[b] * (c - 1) * across;
        }
    return glm::dvec3(gx, gy, gz) / (72.0 * volume.frame.spacing);
}

std::uint32_t normalAt(const GreyVolume& volume, const glm::ivec3& at) {
    const glm::dvec3 down = -(volume.frame.axes * gradientAt(volume, at));
    const double length = glm::length(down);
    return packCornerNormal(length > 0 ? down / length : glm::dvec3(0, 0, 1));
}

// Writes the records of one brick's active cells; corners that cells share are computed once.
class BrickRecords {
public:
    explicit BrickRecords(const GreyVolume& volume) : mVolume(volume), mNormals(17 * 17 * 17) {}

    // active: in the order of BrickLayout.
    void write(const glm::ivec3& brick, const std::uint8_t* active, std::uint32_t first,
               SurfaceCells& cells) {
        std::fill(mNormals.begin(), mNormals.end(), 0u);
        const glm::ivec3 low = brick * kBrick;
        for (int n = 0; n < kBrickCells; ++n) {
            if (!active[n]) continue;
            const glm::ivec3 at = low + glm::ivec3(n & 15, n >> 4 & 15, n >> 8);
            cells.cells[cells.layout.index(at.x, at.y, at.z)] = first + 1;
            fill(low, at, cells.records[first++]);
        }
    }

private:
    void fill(const glm::ivec3& low, const glm::ivec3& cell, CellRecord& record) {
        for (int n = 0; n < 8; ++n) {
            const glm::ivec3 corner = cell + glm::ivec3(n & 1, n >> 1 & 1, n >> 2);
            record.values[n] = mVolume.at(corner);
            const glm::ivec3 local = corner - low;
            std::uint32_t& normal =
                mNormals[static_cast<std::size_t>((local.z * 17 + local.y) * 17 + local.x)];
            if (normal == 0) normal = normalAt(mVolume, corner);  // no packed unit vector is 0
            record.normals[n] = normal;
        }
    }

    const GreyVolume& mVolume;
    std::vector<std::uint32_t> mNormals;
};

glm::ivec3 brickAt(const BrickLayout& layout, int n) {
    return {n % layout.bricks.x, n / layout.bricks.x % layout.bricks.y,
            n / (layout.bricks.x * layout.bricks.y)};
}

// Flags of a brick's active cells in the order of BrickLayout; how many there are.
using BrickActivity = std::function<std::uint32_t(const glm::ivec3& brick, std::uint8_t* active)>;

// By a flag a cell of the cells' frame.
template <typename IsActive>
std::uint32_t flagBrick(const glm::ivec3& size, const glm::ivec3& brick, std::uint8_t* active,
                        const IsActive& isActive) {
    const glm::ivec3 low = brick * kBrick, high = glm::min(low + kBrick, size);
    std::fill_n(active, kBrickCells, std::uint8_t{0});
    std::uint32_t count = 0;
    for (int k = low.z; k < high.z; ++k)
        for (int j = low.y; j < high.y; ++j) {
            std::uint8_t* row = active + ((k & 15) << 8 | (j & 15) << 4);
            for (int i = low.x; i < high.x; ++i) count += row[i & 15] = isActive(i, j, k);
        }
    return count;
}

void writeRecords(const GreyVolume& volume, const BrickActivity& activity, SurfaceCells& cells) {
    const int bricks = cells.layout.bricks.x * cells.layout.bricks.y * cells.layout.bricks.z;
    std::vector<std::uint32_t> first(static_cast<std::size_t>(bricks) + 1, 0);
    parallelFor(bricks, [&](int n) {
        std::uint8_t active[kBrickCells];
        first[n + 1] = activity(brickAt(cells.layout, n), active);
    });
    std::uint64_t total = 0;
    for (const std::uint32_t count : first) total += count;
    // Kernels count records in 4-byte steps with 32-bit numbers.
    if (total > (1ull << 31) / (sizeof(CellRecord) / 4) - 1)
        throw Error("", "isosurface", fmt::format("{} cells hold surface, more than 134 million", total),
                    "choose another isovalue or a smaller volume");
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::size_t bricksHeld = 0;
    for (int n = 0; n < bricks; ++n) bricksHeld += first[n] != first[n + 1];
    checkMemory(fmt::format("a surface of {} cells", total),
                static_cast<double>(total) * sizeof(CellRecord) +
                    static_cast<double>(bricksHeld) * kBrickCells * sizeof(std::uint32_t),
                "choose another isovalue, a transfer function that shows less, or a smaller volume");
    cells.records = LazyArray<CellRecord>(first.back());
    cells.records.preferLargePages();
    parallelFor(bricks, [&](int n) {
        if (first[n] == first[n + 1]) return;
        const glm::ivec3 brick = brickAt(cells.layout, n);
        std::uint8_t active[kBrickCells];
        activity(brick, active);
        BrickRecords(volume).write(brick, active, first[n], cells);
    });
}

void checkSize(const VolumeFrame& frame, const BrickLayout& layout) {
    const glm::ivec3 size = frame.size;
    const std::string got = fmt::format("{}x{}x{}", size.x, size.y, size.z);
    if (size.x < 2 || size.y < 2 || size.z < 2)
        throw Error("", "volume", "expected at least 2 voxels along each axis, got " + got,
                    "a single slice has no surface");
    if (layout.count() > 1ull << 32)
        throw Error("", "volume", "expected at most 2^32 voxels, got " + got, "crop or resample it");
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

SurfaceCells SurfaceCells::share() const {
    SurfaceCells same;
    same.frame = frame;
    same.layout = layout;
    same.leapUnit = leapUnit;
    same.codes = codes.share();
    same.cells = cells.share();
    same.records = records.share();
    same.isovalue = isovalue;
    return same;
}

std::size_t SurfaceCells::bytesHeld() const {
    return residentBytes(codes) + residentBytes(cells) + records.size() * sizeof(CellRecord);
}

SurfaceCells findSurfaceCells(const GreyVolume& volume, const SurfaceSetting& setting, Progress& progress) {
    SurfaceCells cells;
    cells.frame = volume.frame;
    cells.isovalue = setting.isovalue;
    cells.layout = BrickLayout(volume.frame.size - 1);
    checkSize(volume.frame, cells.layout);
    const VolumeFrame frame = cellFrameOf(volume.frame);
    progress.report(0.0, "finding the surface");
    if (!setting.region && frame.count() > setting.atOnce) {
        codeLeapsByBlocks(volume, setting, progress, cells);
        progress.report(0.7, "storing what rays need");
        cells.cells = LazyArray<std::uint32_t>(cells.layout.count());
        const auto active = [&](int i, int j, int k) {
            return cells.codes[cells.layout.index(i, j, k)] == kCellActive;
        };
        writeRecords(
            volume,
            [&](const glm::ivec3& brick, std::uint8_t* flags) {
                return flagBrick(frame.size, brick, flags, active);
            },
            cells);
    } else {
        const MaskVolume flags = codeLeapsAtOnce(volume, setting, frame, progress, cells);
        progress.report(0.7, "storing what rays need");
        cells.cells = LazyArray<std::uint32_t>(cells.layout.count());
        const auto active = [&](int i, int j, int k) { return flags.at(i, j, k) != 0; };
        writeRecords(
            volume,
            [&](const glm::ivec3& brick, std::uint8_t* out) {
                return flagBrick(frame.size, brick, out, active);
            },
            cells);
    }
    progress.report(1.0, "storing what rays need");
    return cells;
}

}  // namespace stereonav
