// Sets of voxels as runs along i, and their connected components: what a flood fill finds, in one pass over
// the rows. Runs of neighbouring rows that overlap are joined in a union-find forest (Rosenfeld and Pfaltz
// 1966, on runs instead of voxels), so the work is that of the set's border, not of its volume.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/volume/volume.h"

namespace stereonav {

struct VoxelRun {
    std::int32_t first = 0, end = 0;  // voxels first .. end - 1 of a row
};

// A set of voxels of a grid. Runs of a row are ascending and do not touch.
struct VoxelRuns {
    glm::ivec3 size{0};
    std::vector<std::uint32_t> rowStart;  // size.y * size.z + 1: where each row's runs begin
    std::vector<VoxelRun> runs;

    std::size_t rowNumber(int j, int k) const { return static_cast<std::size_t>(k) * size.y + j; }
    std::span<const VoxelRun> row(int j, int k) const {
        const std::size_t n = rowNumber(j, k);
        return {runs.data() + rowStart[n], runs.data() + rowStart[n + 1]};
    }
    // Returns the run that holds a voxel; -1 where none does, and outside the grid.
    std::int64_t runAt(const glm::ivec3& voxel) const;
    std::size_t voxelCount() const;
};

// A function that appends the runs of row (j, k), ascending. Called from many threads, once a row.
using RowRuns = std::function<void(int j, int k, std::vector<VoxelRun>& runs)>;
VoxelRuns collectRuns(const glm::ivec3& size, const RowRuns& rowRuns);

// Runs of one slice, for who has not all of them yet.
struct SliceRuns {
    std::vector<VoxelRun> runs;
    std::vector<std::uint32_t> ofRow;  // how many runs each row has
};
// Returns the runs of values below limit, in a slice of size.x * size.y values.
SliceRuns sliceRunsBelow(const std::int16_t* slice, const glm::ivec3& size, double limit);
// Returns the runs of a volume out of those of its size.z slices.
VoxelRuns joinedRuns(const glm::ivec3& size, const std::vector<SliceRuns>& slices);

VoxelRuns runsOf(const MaskVolume& mask);                               // voxels not 0
VoxelRuns runsBelow(const Volume<std::int16_t>& volume, double limit);  // value < limit
VoxelRuns runsAbove(const Volume<std::int16_t>& volume, double limit);  // value > limit
VoxelRuns eroded(const VoxelRuns& runs);  // voxels whose six neighbours are in the set and in the grid too

// A piece of a set.
struct Component {
    std::size_t voxels = 0;
    glm::ivec3 first{0}, last{0};  // bounding box, last included
};

// Components of a set, connected by faces, numbered by their first voxel in memory.
struct Components {
    std::vector<std::uint32_t> ofRun;  // for each run its component
    std::vector<Component> list;

    // Returns the component that holds a voxel, -1 where none does.
    int at(const VoxelRuns& runs, const glm::ivec3& voxel) const {
        const std::int64_t run = runs.runAt(voxel);
        return run < 0 ? -1 : static_cast<int>(ofRun[static_cast<std::size_t>(run)]);
    }
};
Components connectedComponents(const VoxelRuns& runs);

}  // namespace stereonav
