// Two sweeps over all of the lumen, on blocks of voxels where it is large. The place farthest from its widest
// place is one end. From there the cheapest ways lead everywhere, along the middle; the longest of them leads
// to the other end. It is found once more on the voxels in and around its blocks.
#include "colon/centreline/centreline_path.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/volume/voxel_path.h"

namespace stereonav {
namespace {

using Node = VoxelGraph::Node;

// Lumens of more voxels are coarsened.
constexpr std::size_t kMostFineNodes = 400000;

// A step costs (largest distance / distance)^2 a metre: twice as near to the wall, four times as dear.
constexpr double kWallPower = 2.0;

// Blocks of two voxels along the axes that are finely sampled, so that blocks are no longer than needed.
glm::ivec3 blockOf(const glm::dvec3& spacing, std::size_t voxels, std::size_t mostUneven) {
    if (voxels <= kMostFineNodes) return glm::ivec3(1);
    if (voxels > mostUneven) return glm::ivec3(2);
    const double smallest = std::min({spacing.x, spacing.y, spacing.z});
    glm::ivec3 block(1);
    for (int axis = 0; axis < 3; ++axis)
        if (spacing[axis] < 1.9 * smallest) block[axis] = 2;
    return block;
}

// Returns the wall distance of each node: that of its voxel which is farthest from the wall.
std::vector<float> nodeDistances(const VoxelGraph& graph, const DistanceVolume& distance) {
    std::vector<float> deepest(graph.nodeCount());
    constexpr std::size_t kChunk = 16384;
    parallelFor(static_cast<int>((deepest.size() + kChunk - 1) / kChunk), [&](int chunk) {
        const std::size_t begin = chunk * kChunk, end = std::min(begin + kChunk, deepest.size());
        for (std::size_t n = begin; n < end; ++n) {
            std::uint16_t most = 0;
            graph.forEachVoxel(static_cast<Node>(n),
                               [&](const glm::ivec3& v) { most = std::max(most, distance.at(v)); });
            deepest[n] = static_cast<float>(most * distance.unit);
        }
    });
    return deepest;
}

// Returns weights in the memory of the distances: least, 1, at the node farthest from the wall.
std::vector<float> wallWeights(std::vector<float> distances) {
    float deepest = 0;
    for (const float d : distances) deepest = std::max(deepest, d);
    for (float& d : distances) {
        const float share = deepest > 0 ? std::max(d / deepest, 1e-3f) : 1.0f;
        d = std::clamp(static_cast<float>(std::pow(share, -kWallPower)), 1.0f, kLargestWeight);
    }
    return distances;
}

std::vector<Node> farthestWay(const VoxelGraph& graph, std::vector<float> distances,
                              const std::function<void()>& poll) {
    const auto deepest = std::max_element(distances.begin(), distances.end()) - distances.begin();
    const Node end = findVoxelPaths(graph, {}, static_cast<Node>(deepest), VoxelPaths::kNone, poll).farthest;
    const VoxelPaths ways =
        findVoxelPaths(graph, wallWeights(std::move(distances)), end, VoxelPaths::kNone, poll);
    return ways.to(ways.farthest);
}

// The voxels of `segment` in the blocks along a way and around them, as a mask of ones.
struct Corridor {
    MaskVolume mask;
    glm::ivec3 first{0}, last{0};
};

Corridor corridorAround(const LumenField& lumen, int segment, const VoxelGraph& graph,
                        const std::vector<Node>& way) {
    Corridor corridor{MaskVolume(lumen.lumen.frame), lumen.lumen.frame.size, glm::ivec3(-1)};
    for (const Node node : way) {
        const glm::ivec3 block = graph.blockVoxel(node);
        const glm::ivec3 low = glm::max(block - graph.block(), glm::ivec3(0));
        const glm::ivec3 high = glm::min(block + 2 * graph.block(), lumen.lumen.frame.size) - 1;
        for (int k = low.z; k <= high.z; ++k)
            for (int j = low.y; j <= high.y; ++j)
                for (int i = low.x; i <= high.x; ++i)
                    if (lumen.lumen.at(i, j, k) == segment) corridor.mask.at(i, j, k) = 1;
        corridor.first = glm::min(corridor.first, low);
        corridor.last = glm::max(corridor.last, high);
    }
    return corridor;
}

// Returns the node's voxel that is farthest from the wall. It stands for a coarse end in the fine graph,
// whose voxels are the same.
glm::ivec3 deepestVoxel(const VoxelGraph& graph, Node node, const DistanceVolume& distance) {
    glm::ivec3 best(0);
    int most = -1;
    graph.forEachVoxel(node, [&](const glm::ivec3& v) {
        if (static_cast<int>(distance.at(v)) > most) {
            most = distance.at(v);
            best = v;
        }
    });
    return best;
}

std::vector<glm::ivec3> fineWay(const VoxelGraph& graph, const glm::ivec3& start, const glm::ivec3& end,
                                std::vector<float> distances, const std::function<void()>& poll) {
    Node from = VoxelPaths::kNone, to = VoxelPaths::kNone;
    for (Node n = 0; n < graph.nodeCount(); ++n) {
        if (graph.blockVoxel(n) == start) from = n;
        if (graph.blockVoxel(n) == end) to = n;
    }
    std::vector<glm::ivec3> voxels;
    for (const Node n : findVoxelPaths(graph, wallWeights(std::move(distances)), from, to, poll).to(to))
        voxels.push_back(graph.blockVoxel(n));
    return voxels;
}

}  // namespace

std::vector<glm::ivec3> roughCentreline(const LumenField& lumen, int segment, const DistanceVolume& distance,
                                        std::size_t mostUneven, const std::function<void()>& poll) {
    const LumenSegment& piece = lumen.segments[segment - 1];
    const glm::ivec3 block = blockOf(lumen.lumen.frame.spacing, piece.voxels, mostUneven);
    VoxelGraph graph(lumen.lumen, static_cast<std::uint8_t>(segment), piece.first, piece.last, block);
    if (graph.nodeCount() == 0)
        throw Error("", "", "segment " + std::to_string(segment) + " of the lumen has no voxels",
                    "segment the study again");
    const std::vector<Node> way = farthestWay(graph, nodeDistances(graph, distance), poll);
    std::vector<glm::ivec3> voxels;
    if (block == glm::ivec3(1)) {
        for (const Node n : way) voxels.push_back(graph.blockVoxel(n));
        return voxels;
    }
    const Corridor corridor = corridorAround(lumen, segment, graph, way);
    const glm::ivec3 start = deepestVoxel(graph, way.front(), distance),
                     end = deepestVoxel(graph, way.back(), distance);
    graph = VoxelGraph();  // its memory goes before that of the fine one is taken
    graph = VoxelGraph(corridor.mask, 1, corridor.first, corridor.last, glm::ivec3(1));
    return fineWay(graph, start, end, nodeDistances(graph, distance), poll);
}

}  // namespace stereonav
