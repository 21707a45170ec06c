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
#include "engine/volume/cell_records.h"
#include "engine/volume/cell_rows.h"
#include "engine/volume/distance_transform.h"
#include "engine/volume/leap_blocks.h"

namespace stereonav {
namespace {

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

SurfaceCells SurfaceCells::share() const {
    SurfaceCells same;
    same.frame = frame;
    same.layout = layout;
    same.leapUnit = leapUnit;
    same.codes = codes.share();
    same.farCodes = farCodes.share();
    same.codedBricks = codedBricks;
    same.bricks = bricks.share();
    same.places = places.share();
    same.records = records.share();
    same.normals = normals.share();
    same.values = values.share();
    same.active = active;
    same.isovalue = isovalue;
    return same;
}

std::size_t SurfaceCells::bytesHeld() const {
    // Pages that were read count as in use, also those that nothing was written to, which all are one page
    // of zeros.
    const std::size_t own = farCodes.empty() ? residentBytes(codes) : codedBricks * kCellsOfBrick;
    return own + residentBytes(farCodes) + residentBytes(bricks) + residentBytes(places) +
           records.size() * sizeof(CellRecord) + normals.size() * sizeof(std::uint32_t);
}

std::optional<std::size_t> SurfaceCells::recordNumber(const glm::ivec3& cell) const {
    const std::size_t n = layout.index(cell.x, cell.y, cell.z);
    if (places[n] == 0) return std::nullopt;
    return std::size_t{bricks[n >> 12]} + places[n] - 1;
}

std::optional<CellRecord> SurfaceCells::record(const glm::ivec3& cell) const {
    const std::size_t n = layout.index(cell.x, cell.y, cell.z);
    const std::uint32_t brick = bricks[n >> 12];
    if (!(brick & kDenseBrick)) {
        if (places[n] == 0) return std::nullopt;
        return records[std::size_t{brick} + places[n] - 1];
    }
    if (code(cell) != kCellActive) return std::nullopt;
    CellRecord record{};
    const std::uint32_t* corners = normals.data() + std::size_t{brick & ~kDenseBrick} * kDenseCorners;
    for (int c = 0; c < 8; ++c) {
        const glm::ivec3 corner = cell + glm::ivec3(c & 1, c >> 1 & 1, c >> 2), local = corner - (cell & ~15);
        record.values[c] = values[frame.index(corner)];
        record.normals[c] = corners[(local.z * kDenseSide + local.y) * kDenseSide + local.x];
    }
    return record;
}

SurfaceCells findSurfaceCells(const GreyVolume& volume, const SurfaceSetting& setting, Progress& progress) {
    SurfaceCells cells;
    cells.frame = volume.frame;
    cells.isovalue = setting.isovalue;
    cells.layout = BrickLayout(volume.frame.size - 1);
    checkSize(volume.frame, cells.layout);
    const VolumeFrame frame = cellFrameOf(volume.frame);
    progress.report(0.0, "finding the surface");
    const std::size_t mostAtOnce =
        setting.region ? SurfaceSetting::kRegionAtOnce : SurfaceSetting::kCellsAtOnce;
    if (frame.count() > setting.atOnce.value_or(mostAtOnce)) {
        Progress measuring(progress, 0.3, 0.7);
        codeLeapsByBlocks(volume, setting, measuring, cells);
        progress.report(0.7, "storing what rays need");
        writeRecords(
            volume, setting,
            [&](const glm::ivec3& first, int count, std::uint8_t* active) {
                const std::size_t n = cells.layout.index(first.x, first.y, first.z);
                if (cells.farCodes[BrickLayout::farIndex(n)] != 0) return;  // a far brick: as it comes, all 0
                const std::uint8_t* codes = &cells.codes[n];
                for (int i = 0; i < count; ++i) active[i] = isMarkedActive(codes[i]);
            },
            cells);
        settleCodes(setting, cells);
    } else {
        const MaskVolume flags = codeLeapsAtOnce(volume, setting, frame, progress, cells);
        progress.report(0.7, "storing what rays need");
        writeRecords(
            volume, setting,
            [&](const glm::ivec3& first, int count, std::uint8_t* active) {
                std::copy_n(&flags.values[flags.frame.index(first)], count, active);
            },
            cells);
    }
    progress.report(1.0, "storing what rays need");
    return cells;
}

}  // namespace stereonav
