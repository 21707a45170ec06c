// Where the wall of a ready mask crosses the lines between neighbouring voxel centres: one point for each
// pair of face neighbours of which one is inside. Moving these points along their lines moves the wall
// without a voxel centre ever changing its side.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/volume/components.h"

namespace stereonav {

struct WallCrossings {
    static constexpr std::uint32_t kNone = 0x3FFFFFFFu;  // numbers of crossings are smaller

    glm::ivec3 size{0};
    // Where the crossings of lines along each axis begin: those of axis a from voxels of row r at 3 r + a.
    std::vector<std::uint32_t> start;
    std::vector<std::int32_t> column;  // i of the lower voxel; ascending for an axis and a row
    std::vector<std::uint8_t> leaves;  // 1: the lower voxel is inside, 0: the upper one
    std::vector<float> at;             // share of the way from the lower voxel's centre to the upper one's

    std::size_t count() const { return column.size(); }
    // Returns the crossing between a voxel and the next one along an axis; kNone where there is none.
    std::uint32_t find(int axis, const glm::ivec3& lower) const;
};

// A neighbour of a crossing on the wall's outline in a plane of voxel centres, and where its line is: beside
// the crossing's own, or from its lower or upper voxel.
class CrossingLink {
public:
    enum Line : std::uint32_t { Beside, AtLower, AtUpper };
    CrossingLink() = default;
    CrossingLink(std::uint32_t crossing, Line line) : mPacked(crossing | line << 30) {}
    std::uint32_t crossing() const { return mPacked & WallCrossings::kNone; }
    Line line() const { return static_cast<Line>(mPacked >> 30); }
    bool none() const { return crossing() == WallCrossings::kNone; }

private:
    std::uint32_t mPacked = WallCrossings::kNone;
};

// Neighbours of each crossing: in the plane of its axis a and of axis (a + 1 + plane) % 3 the one on the
// lower and on the upper side, at 2 plane + side. None beyond the grid.
using CrossingLinks = std::vector<std::array<CrossingLink, 4>>;

// Finds them half way between the voxels, on all threads. Beyond the grid nothing is known: no crossings.
// Throws Error where memory is short for them and for smoothing the wall.
WallCrossings findCrossings(const VoxelRuns& inside);

// Where two pieces of the set touch by an edge alone their walls stay apart, as the set's components are.
CrossingLinks linksOf(const WallCrossings& crossings);

// Calls use(axis, lower voxel, number) for the crossings from voxels of rows k * size.y + j, first <= row <
// end.
template <typename Use>
void forCrossings(const WallCrossings& wall, std::size_t first, std::size_t end, const Use& use) {
    const auto rows = static_cast<std::size_t>(wall.size.y);
    for (std::size_t row = first; row < end; ++row)
        for (int axis = 0; axis < 3; ++axis)
            for (std::uint32_t n = wall.start[3 * row + axis]; n < wall.start[3 * row + axis + 1]; ++n)
                use(axis,
                    glm::ivec3(wall.column[n], static_cast<int>(row % rows), static_cast<int>(row / rows)),
                    n);
}

}  // namespace stereonav
