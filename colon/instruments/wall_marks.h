// Marks on a wall, 0 to 1, by place: what was seen, or was under fluid. Each cell of voxels that contains a
// vertex of the wall's mesh has one; cells are stored in bricks of 8 x 8 x 8.
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
    // frame: of the volume whose wall the mesh is. byVertex: one mark for each vertex, clamped to 0 to 1.
    // Throws Error where there is not enough memory.
    WallMarks(const WallMesh& mesh, const VolumeFrame& frame, const std::vector<float>& byVertex);

    // Returns the mark at a place in the world, metres, with a precision of 1/254: trilinear between the
    // cells around that contain wall. Less than 0 where there is no wall within a cell. From many threads.
    float at(const glm::dvec3& world) const;

private:
    using Brick = std::array<std::uint8_t, 512>;  // 0: no wall; else 1 + 254 * mark
    std::size_t brickOf(const glm::ivec3& cell) const;
    int markOf(const glm::ivec3& cell) const;

    VolumeFrame mFrame;
    glm::ivec3 mCount{0};                 // bricks
    std::vector<std::uint32_t> mNumbers;  // by brick: index into mBricks plus 1; 0: no wall
    std::vector<Brick> mBricks;
};

// Returns the mean over each vertex and its neighbours, repeated `rounds` times, so that marks have soft
// borders.
std::vector<float> softened(const WallNeighbours& neighbours, std::vector<float> marks, int rounds);

}  // namespace stereonav
