#include "colon/instruments/wall_marks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kBrickSide = 8;
constexpr int kMarksOfOneTask = 4096;
constexpr float kMarkSteps = 254;

}  // namespace

WallMarks::WallMarks(const WallMesh& mesh, const VolumeFrame& frame, const std::vector<float>& byVertex)
    : mFrame(frame), mCount((frame.size + (kBrickSide - 1)) / kBrickSide) {
    const double bricks = static_cast<double>(mCount.x) * mCount.y * mCount.z;
    checkMemory("marks on the wall",
                bricks * sizeof(std::uint32_t) + std::min(bricks, static_cast<double>(mesh.cells.size())) *
                                                     static_cast<double>(sizeof(Brick)),
                "leave --paint out");
    mNumbers.assign(static_cast<std::size_t>(bricks), 0);
    for (std::size_t v = 0; v < mesh.cells.size(); ++v) {
        const glm::ivec3& cell = mesh.cells[v];
        if (!frame.contains(cell)) continue;
        std::uint32_t& number = mNumbers[brickOf(cell)];
        if (number == 0) {
            mBricks.emplace_back().fill(0);
            number = static_cast<std::uint32_t>(mBricks.size());
        }
        const glm::ivec3 in = cell % kBrickSide;
        const float mark = std::clamp(byVertex[v], 0.0f, 1.0f);  // unspecified for NaN: none may come
        mBricks[number - 1][(in.z * kBrickSide + in.y) * kBrickSide + in.x] =
            static_cast<std::uint8_t>(1.5f + kMarkSteps * mark);
    }
}

std::size_t WallMarks::brickOf(const glm::ivec3& cell) const {
    const glm::ivec3 brick = cell / kBrickSide;
    return (static_cast<std::size_t>(brick.z) * mCount.y + brick.y) * mCount.x + brick.x;
}

int WallMarks::markOf(const glm::ivec3& cell) const {
    if (!mFrame.contains(cell)) return 0;
    const std::uint32_t number = mNumbers[brickOf(cell)];
    if (number == 0) return 0;
    const glm::ivec3 in = cell % kBrickSide;
    return mBricks[number - 1][(in.z * kBrickSide + in.y) * kBrickSide + in.x];
}

float WallMarks::at(const glm::dvec3& world) const {
    // A cell's middle is half a voxel beyond its first voxel.
    const glm::dvec3 place = mFrame.voxelFromWorld(world) - 0.5;
    const glm::dvec3 most(mFrame.size + 1);
    for (int axis = 0; axis < 3; ++axis)
        if (!(place[axis] > -2 && place[axis] < most[axis])) return -1;
    const glm::dvec3 low = glm::floor(place);
    const glm::ivec3 first(low);
    const glm::vec3 t(place - low);
    float sum = 0, weights = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const int mark = markOf(first + step);
        if (mark == 0) continue;
        const float weight = (step.x ? t.x : 1 - t.x) * (step.y ? t.y : 1 - t.y) * (step.z ? t.z : 1 - t.z);
        sum += weight * static_cast<float>(mark - 1);
        weights += weight;
    }
    return weights > 0 ? std::min(sum / (kMarkSteps * weights), 1.0f) : -1.0f;
}

std::vector<float> softened(const WallNeighbours& neighbours, std::vector<float> marks, int rounds) {
    const int count = static_cast<int>(marks.size());
    std::vector<float> next(marks.size());
    for (int round = 0; round < rounds; ++round) {
        parallelFor((count + kMarksOfOneTask - 1) / kMarksOfOneTask, [&](int task) {
            for (int v = task * kMarksOfOneTask; v < std::min((task + 1) * kMarksOfOneTask, count); ++v) {
                float sum = marks[v];
                for (std::uint32_t k = neighbours.first[v]; k < neighbours.first[v + 1]; ++k)
                    sum += marks[neighbours.neighbours[k]];
                next[v] = sum / static_cast<float>(1 + neighbours.first[v + 1] - neighbours.first[v]);
            }
        });
        std::swap(marks, next);
    }
    return marks;
}

}  // namespace stereonav
