// Data of a volume for a ray caster, in the order of use: how far a ray may leap from a cell, and, in the
// cells that hold the surface (or anything that is not transparent), the cell's eight values and normals in
// one cache line. Where most cells are such ones, normals are kept for each corner once, and values are the
// volume's own: a ninth of the memory, for some more places in it that a ray asks for.
//
// Cell (i, j, k) is the box between voxels (i, j, k) and (i + 1, j + 1, k + 1).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/progress.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Bytes and indices of cells, in bricks of 16^3 so that what is near in space is near in memory, whatever
// the direction; a brick of bytes is one page, which is never taken where nothing was written. Cells of
// a brick: i in bits 0..3, j in 4..7, k in 8..11.
struct BrickLayout {
    glm::ivec3 bricks{0};
    BrickLayout() = default;
    explicit BrickLayout(const glm::ivec3& cells) : bricks((cells + 15) / 16) {}
    std::size_t count() const { return static_cast<std::size_t>(bricks.x) * bricks.y * bricks.z * 4096; }
    std::size_t index(int i, int j, int k) const {
        const std::size_t brick =
            (static_cast<std::size_t>(k >> 4) * bricks.y + (j >> 4)) * bricks.x + (i >> 4);
        return brick << 12 | (k & 15) << 8 | (j & 15) << 4 | (i & 15);
    }
    // Returns the index of the group of 4^3 cells that a cell with this index is in, in bricks of 4^3 groups.
    static std::size_t farIndex(std::size_t index) {
        return index >> 12 << 6 | (index >> 6 & 48) | (index >> 4 & 12) | (index >> 2 & 3);
    }
};

// Stored data of an active cell.
struct alignas(64) CellRecord {
    std::int16_t values[8];  // at corner x + 2 y + 4 z, stored numbers
    std::uint32_t
        normals[8];  // there: unit world normal towards smaller values, or 0, packed as packCornerNormal does
    std::uint32_t spare[4];
};
static_assert(sizeof(CellRecord) == 64);

// Where the smoothed gradient is less than this of what the values around a voxel change by from one to the
// next, it tells no side, and a corner has no normal.
constexpr double kOneSided = 0.1371;

// Packs a unit vector, or 0, in three channels of 10 bits, x lowest: 0..1023 for -1..1, as EyeImage::normal
// wants it.
std::uint32_t packCornerNormal(const glm::dvec3& unit);
glm::dvec3 unpackCornerNormal(std::uint32_t packed);  // length near 1

// Leap codes of cells.
constexpr std::uint8_t kCellActive = 0;  // holds surface: see the record
constexpr std::uint8_t kCellNear = 1;    // none, but the next cell may: walk on cell by cell
// code c > 1: from any point of the cell, nothing active lies within (c - 1) * leapUnit metres.

constexpr std::uint32_t kDenseBrick = 1u << 31;
constexpr int kDenseSide = 17, kDenseCorners = kDenseSide * kDenseSide * kDenseSide;

// Cells of a volume, and what is kept of them.
struct SurfaceCells {
    VolumeFrame frame;  // the voxels' grid
    BrickLayout layout;
    double leapUnit = 0;            // metres; a quarter of the smallest spacing, more where leaps are long
    LazyArray<std::uint8_t> codes;  // by layout; see code(). kCellActive without a record: outside the region
    // Codes of groups of 4^3 cells, 64 a brick by farIndex: those of far bricks, whose cells have none of
    // their own (0 in `codes`, where no memory is taken); 0 for all others. Empty: no brick is far.
    LazyArray<std::uint8_t> farCodes;
    std::size_t codedBricks = 0;  // bricks that have codes of their own, where some are far
    // The number of each brick's first record; or, with kDenseBrick, its place among the dense ones.
    LazyArray<std::uint32_t> bricks;
    LazyArray<std::uint16_t> places;  // by layout: 1, 2, ... among its brick's records, 0 where there is none
    LazyArray<CellRecord> records;
    LazyArray<std::uint32_t>
        normals;  // those of dense bricks, kDenseCorners each, x fastest; 0 where none is asked for
    LazyArray<std::int16_t> values;  // the volume's, where there are dense bricks
    std::size_t active = 0;          // cells with a record
    float isovalue = 0;              // the surface is where the trilinear value reaches it, in stored numbers

    // Returns how far a ray may leap from a cell, as a code, or kCellActive. The cell must lie in the volume,
    // as below.
    std::uint8_t code(const glm::ivec3& cell) const {
        const std::size_t n = layout.index(cell.x, cell.y, cell.z);
        return codes[n] == 0 && !farCodes.empty() ? farCodes[BrickLayout::farIndex(n)] : codes[n];
    }
    // Returns what is kept of a cell, nothing where it is not active.
    std::optional<CellRecord> record(const glm::ivec3& cell) const;
    // The cell's number in `records`; nothing where it has none there.
    std::optional<std::size_t> recordNumber(const glm::ivec3& cell) const;
    std::size_t bytesHeld() const;  // pages in use
    SurfaceCells share() const;     // cells over the same memory (LazyArray::share)
};

// The definition of a surface, and how its cells are found.
struct SurfaceSetting {
    float isovalue = 0;  // stored numbers of the volume
    // Cells are active when the range of their values meets [lowest, highest], ends included. For the
    // surface alone both are the isovalue; for translucent walls the range where opacity is not zero.
    float lowest = 0, highest = 0;
    // If given (same frame as the volume): cells without a corner inside do not count, and leaps are
    // known only in cells with one.
    const MaskVolume* region = nullptr;
    // Leaps of more cells than these are measured in blocks: in a byte or so a cell instead of eight, and no
    // leap beyond 16 of the smallest spacing is as long as it may be (leap_blocks.h). With a region the
    // memory is that of the cells around it and rays take long leaps, so only the largest are measured so.
    // Left out: kCellsAtOnce, or kRegionAtOnce with a region.
    std::optional<std::size_t> atOnce = std::nullopt;
    static constexpr std::size_t kCellsAtOnce = std::size_t{1} << 25, kRegionAtOnce = std::size_t{1} << 28;
    // Number of active cells from which on a brick is dense, without a region.
    std::uint32_t denseFrom = kDenseFrom;
    static constexpr std::uint32_t kDenseFrom = 640, kNeverDense = 4097;
};

// Finds the cells. Rays must start below the isovalue: a volume that is seen from outside has a border of
// values below it. Throws Error when the volume has fewer than 2 voxels along an axis or too many for 32-bit
// indices of cells, or memory is short; Cancelled. Runs on all threads, the result does not depend on their
// number.
SurfaceCells findSurfaceCells(const GreyVolume& volume, const SurfaceSetting& setting, Progress& progress);

// Returns the gradient of the values smoothed by a tricubic B-spline over 4x4x4 voxels, at any voxel-space
// point (Wyman et al. 2006, section 4; Y3 of docs/ledger.md), in stored numbers a metre along the world axes.
// Beyond the faces the outermost voxels count on.
glm::dvec3 smoothGradient(const GreyVolume& volume, const glm::dvec3& voxel);

// Returns metres that are free of surface around a world point: no point of the surface is nearer, and the
// true distance is more than it by less than `tolerance` (metres). Looks no further than `upTo` metres, which
// is then the answer. More than 0 before the surface, however coarse the tolerance; 0 at and behind it
// (further behind than upTo only where the region ends) and outside the volume's region. The volume's faces
// count as surface, since beyond them it is 0. Tolerances below a millionth of the smallest spacing count as
// that.
double freeDistance(const SurfaceCells& cells, const glm::dvec3& world, double upTo, double tolerance);

}  // namespace stereonav
