// Shortest paths through the voxels of a mask. Steps never cut through what is outside: a face step needs
// both voxels, a diagonal step the whole box of 4 or 8 voxels that it spans, so the straight line between
// two neighbours stays inside and thin walls are not crossed at their edges.
//
// Large masks are coarsened: a node may be a block of 2 voxels along some axes. What is inside of a block
// falls into pieces connected by faces (at most 4); each piece is a node of its own, so that coarsening
// opens no way that the voxels do not have.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/volume/volume.h"

namespace stereonav {

class VoxelGraph {
public:
    using Node = std::uint32_t;

    VoxelGraph() = default;  // no nodes
    // The voxels of `mask` that equal `label`, looked for from voxel `first` to `last` (included; clipped to
    // the volume). block: 1 or 2 voxels to a node along each axis. Throws Error when there are too many.
    VoxelGraph(const MaskVolume& mask, std::uint8_t label, const glm::ivec3& first, const glm::ivec3& last,
               const glm::ivec3& block);

    std::size_t nodeCount() const { return mCells.size(); }
    const glm::ivec3& block() const { return mBlock; }

    // Metres of the 26 steps, by their number.
    double stepLength(int step) const { return mLengths[step]; }
    double shortestStep() const { return mShortest; }
    double longestStep() const { return mLongest; }

    // Calls visit(neighbour, step) for each way out of a node; a neighbour may come twice.
    template <typename Visit>
    void forEachNeighbour(Node node, const Visit& visit) const;

    // Calls visit(voxel) for each voxel of a node.
    template <typename Visit>
    void forEachVoxel(Node node, const Visit& visit) const;

    // Returns the first voxel of the node's block, which need not be inside.
    glm::ivec3 blockVoxel(Node node) const;

private:
    static constexpr int kSteps = 26, kFaces = 6;
    struct Step {
        glm::ivec3 by{0};
        std::uint32_t needs = 0;  // the steps whose blocks must be full, itself included, as bits
        std::ptrdiff_t offset = 0;
    };
    void makeSteps(const glm::dvec3& spacing);
    void gatherPatterns(const MaskVolume& mask, std::uint8_t label);
    void numberNodes();
    std::uint8_t partOf(std::uint8_t pattern, int voxel) const;
    template <typename Visit>
    void visitFace(Node node, int step, const Visit& visit) const;

    glm::ivec3 mFirst{0}, mLast{0}, mBlock{1};
    glm::ivec3 mGrid{0};                    // blocks, with a border of one on all sides
    std::uint8_t mFull = 1;                 // the pattern of a block that is all inside
    std::array<Step, kSteps> mSteps{};      // faces first
    std::array<double, kSteps> mLengths{};  // metres
    double mShortest = 0, mLongest = 0;     // metres
    // The voxel pairs that meet at each face: number in this block, number in the other.
    std::array<std::vector<std::array<std::uint8_t, 2>>, kFaces> mFacePairs;
    LazyArray<std::uint8_t> mPatterns;  // by block: bit x + 2 y + 4 z where a voxel is inside
    LazyArray<Node> mFirstNode;         // by block: number of the first node + 1
    std::vector<std::uint32_t> mCells;  // by node: the block
    std::vector<std::uint8_t> mParts;   // by node: the piece of the block
};

// Returns the pieces of a block by its pattern: two bits a voxel, and their number. Voxels are numbered x + 2
// y + 4 z.
struct BlockPieces {
    std::array<std::uint8_t, 8> piece{};
    std::uint8_t count = 0;
};
const BlockPieces& blockPieces(std::uint8_t pattern);

// The cheapest ways from one node to all others.
struct VoxelPaths {
    static constexpr VoxelGraph::Node kNone = 0xffffffff;
    // The way to a node.
    struct Way {
        float cost, length;         // length: metres along the cheapest way; both infinite where not reached
        float weight;               // cost a metre at the node itself
        VoxelGraph::Node previous;  // kNone at the start and where not reached
    };
    std::vector<Way> ways;              // by node
    VoxelGraph::Node farthest = kNone;  // end of the longest of them; ties: the first node

    std::vector<VoxelGraph::Node> to(VoxelGraph::Node end) const;  // way from the start; empty if not reached
};

constexpr float kLargestWeight = 16384.0f;  // cost a metre
// Finds ways by Dijkstra's algorithm with a circular queue of buckets (Dial 1969), on one thread: the same
// result always. weights: cost a metre at each node, at least 1 and at most kLargestWeight, a step costs
// their mean; empty: lengths alone; they go once they are taken over. Stops once the cost of `end` is final
// (kNone: never). Calls `poll` now and then, which may throw to end the search.
VoxelPaths findVoxelPaths(const VoxelGraph& graph, std::vector<float> weights, VoxelGraph::Node start,
                          VoxelGraph::Node end, const std::function<void()>& poll);

template <typename Visit>
void VoxelGraph::visitFace(Node node, int step, const Visit& visit) const {
    const std::size_t cell = mCells[node], other = cell + mSteps[step].offset;
    const std::uint8_t theirs = mPatterns[other];
    if (!theirs) return;
    const BlockPieces& own = blockPieces(mPatterns[cell]);
    const BlockPieces& next = blockPieces(theirs);
    int seen = 0;
    for (const auto& [a, b] : mFacePairs[step]) {
        if (!(mPatterns[cell] >> a & 1) || own.piece[a] != mParts[node] || !(theirs >> b & 1)) continue;
        if (seen >> next.piece[b] & 1) continue;
        seen |= 1 << next.piece[b];
        visit(mFirstNode[other] - 1 + next.piece[b], step);
    }
}

template <typename Visit>
void VoxelGraph::forEachNeighbour(Node node, const Visit& visit) const {
    const std::size_t cell = mCells[node];
    if (mPatterns[cell] != mFull) {
        for (int step = 0; step < kFaces; ++step) visitFace(node, step, visit);
        return;
    }
    std::uint32_t full = 0;
    for (int step = 0; step < kSteps; ++step)
        full |= std::uint32_t(mPatterns[cell + mSteps[step].offset] == mFull) << step;
    for (int step = 0; step < kSteps; ++step)
        if ((mSteps[step].needs & ~full) == 0)
            visit(mFirstNode[cell + mSteps[step].offset] - 1, step);
        else if (step < kFaces)
            visitFace(node, step, visit);
}

template <typename Visit>
void VoxelGraph::forEachVoxel(Node node, const Visit& visit) const {
    const std::uint8_t pattern = mPatterns[mCells[node]];
    const BlockPieces& pieces = blockPieces(pattern);
    const glm::ivec3 corner = blockVoxel(node);
    for (int n = 0; n < 8; ++n)
        if ((pattern >> n & 1) && pieces.piece[n] == mParts[node])
            visit(corner + glm::ivec3(n & 1, n >> 1 & 1, n >> 2));
}

}  // namespace stereonav
