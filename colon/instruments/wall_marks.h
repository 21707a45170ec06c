// Marks on a wall, from 0 to 1, looked up at places of it: what was seen, what was under fluid. One for each
// cell of voxels that holds a vertex of the wall's mesh, in bricks of 8 x 8 x 8 cells.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "colon/wall/wall_mesh.h"
#include "engine/volume/volume.h"

namespace stereonav {

class WallMarks {
public:
    // frame: that of the volume whose wall the mesh is. byVertex: one mark for each vertex, cut off to 0 to
    // 1. Throws Error where there is not enough memory.
    WallMarks(const WallMesh& mesh, const VolumeFrame& frame, const std::vector<float>& byVertex);

    // Returns the mark between those of the cells around a place (trilinear, of those that hold wall), world,
    // metres; to 1/254. Less than 0 where there is no wall within a cell. From many threads.
    float at(const glm::dvec3& world) const;

private:
    using Brick = std::array<std::uint8_t, 512>;  // 0: no wall; else 1 + 254 * mark
    std::size_t brickOf(const glm::ivec3& cell) const;
    int markOf(const glm::ivec3& cell) const;

    VolumeFrame mFrame;
    glm::ivec3 mCount{0};                 // bricks
    std::vector<std::uint32_t> mNumbers;  // by brick: of mBricks, from 1; 0: no wall
    std::vector<Brick> mBricks;
};

// Returns the mean over each vertex and those next to it, `rounds` times, so that marks end softly.
std::vector<float> softened(const WallNeighbours& neighbours, std::vector<float> marks, int rounds);

}  // namespace stereonav
