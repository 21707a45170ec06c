// Ways through voxels: against a search written another way, and that none leads through a wall.
#include "engine/volume/voxel_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <set>

namespace stereonav {
namespace {

using Node = VoxelGraph::Node;
const auto kNoPoll = [] {};

MaskVolume randomMask(const glm::ivec3& size, double share, unsigned seed, const glm::dvec3& spacing) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = spacing;
    MaskVolume mask(frame);
    std::mt19937 random(seed);
    for (std::size_t n = 0; n < frame.count(); ++n) mask.values[n] = random() % 1000 < share * 1000;
    return mask;
}

VoxelGraph graphOf(const MaskVolume& mask, const glm::ivec3& block) {
    return VoxelGraph(mask, 1, glm::ivec3(0), mask.frame.size - 1, block);
}

Node nodeAt(const VoxelGraph& graph, const glm::ivec3& voxel) {
    for (Node n = 0; n < graph.nodeCount(); ++n) {
        bool found = false;
        graph.forEachVoxel(n, [&](const glm::ivec3& v) { found |= v == voxel; });
        if (found) return n;
    }
    return VoxelPaths::kNone;
}

// Every step from voxel to voxel whose box is inside, relaxed until nothing changes.
std::vector<double> lengthsByRelaxing(const MaskVolume& mask, const glm::ivec3& start,
                                      const std::vector<double>& weights) {
    const VolumeFrame& frame = mask.frame;
    std::vector<double> cost(frame.count(), INFINITY);
    cost[frame.index(start)] = 0;
    const auto open = [&](const glm::ivec3& a, const glm::ivec3& b) {
        const glm::ivec3 low = glm::min(a, b), high = glm::max(a, b);
        for (int k = low.z; k <= high.z; ++k)
            for (int j = low.y; j <= high.y; ++j)
                for (int i = low.x; i <= high.x; ++i)
                    if (!mask.frame.contains({i, j, k}) || mask.at(i, j, k) != 1) return false;
        return true;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t n = 0; n < frame.count(); ++n) {
            const glm::ivec3 a(n % frame.size.x, n / frame.size.x % frame.size.y,
                               n / frame.size.x / frame.size.y);
            for (int m = 0; m < 27; ++m) {
                const glm::ivec3 b = a + glm::ivec3(m % 3 - 1, m / 3 % 3 - 1, m / 9 - 1);
                if (m == 13 || !open(a, b)) continue;
                const double weight = 0.5 * (weights[n] + weights[frame.index(b)]);
                const double next = cost[n] + weight * glm::length(frame.spacing * glm::dvec3(b - a));
                if (next < cost[frame.index(b)] - 1e-15) {
                    cost[frame.index(b)] = next;
                    changed = true;
                }
            }
        }
    }
    return cost;
}

TEST(VoxelPaths, AreTheCheapestByAnotherSearch) {
    const glm::ivec3 size(11, 9, 8);
    for (const glm::dvec3& spacing : {glm::dvec3(1, 1, 1), glm::dvec3(0.8, 0.8, 0.7), glm::dvec3(1, 1, 20)})
        for (unsigned seed = 1; seed <= 4; ++seed)
            for (const bool weighted : {false, true}) {
                MaskVolume mask = randomMask(size, seed < 3 ? 0.9 : 0.6, seed, spacing);
                const glm::ivec3 start(5, 4, 4);
                mask.at(start) = 1;
                const VoxelGraph graph = graphOf(mask, glm::ivec3(1));
                std::mt19937 random(seed);
                std::vector<double> weights(mask.frame.count(), 1.0);
                std::vector<float> nodeWeights(graph.nodeCount(), 1.0f);
                if (weighted)
                    for (Node n = 0; n < graph.nodeCount(); ++n)
                        weights[mask.frame.index(graph.blockVoxel(n))] = nodeWeights[n] =
                            static_cast<float>(1 + random() % 3000);
                const VoxelPaths paths =
                    findVoxelPaths(graph, nodeWeights, nodeAt(graph, start), VoxelPaths::kNone, kNoPoll);
                const std::vector<double> truth = lengthsByRelaxing(mask, start, weights);
                double longest = 0;
                for (Node n = 0; n < graph.nodeCount(); ++n) {
                    const double expected = truth[mask.frame.index(graph.blockVoxel(n))];
                    if (!std::isfinite(expected)) {
                        EXPECT_FALSE(std::isfinite(paths.ways[n].cost));
                        EXPECT_TRUE(paths.to(n).empty());
                        continue;
                    }
                    EXPECT_NEAR(paths.ways[n].cost, expected, 1e-5 * expected + 1e-6);
                    const std::vector<Node> way = paths.to(n);
                    ASSERT_FALSE(way.empty());
                    double length = 0;
                    for (std::size_t m = 1; m < way.size(); ++m)
                        length += glm::length(
                            spacing * glm::dvec3(graph.blockVoxel(way[m]) - graph.blockVoxel(way[m - 1])));
                    EXPECT_NEAR(paths.ways[n].length, length, 1e-5 * length);
                    longest = std::max(longest, length);
                }
                EXPECT_NEAR(paths.ways[paths.farthest].length, longest, 1e-5 * longest);
                // Stopping at an end gives the same cost there.
                const VoxelPaths stopped =
                    findVoxelPaths(graph, nodeWeights, nodeAt(graph, start), paths.farthest, kNoPoll);
                EXPECT_EQ(stopped.ways[paths.farthest].cost, paths.ways[paths.farthest].cost);
            }
}

// Pieces connected by faces, found by flooding: blocks must join and part the same voxels.
std::vector<int> flooded(const MaskVolume& mask) {
    std::vector<int> piece(mask.frame.count(), 0);
    int count = 0;
    for (std::size_t seed = 0; seed < piece.size(); ++seed) {
        if (!mask.values[seed] || piece[seed]) continue;
        std::vector<std::size_t> open{seed};
        piece[seed] = ++count;
        while (!open.empty()) {
            const std::size_t n = open.back();
            open.pop_back();
            const glm::ivec3 s = mask.frame.size, v(n % s.x, n / s.x % s.y, n / s.x / s.y);
            for (int axis = 0; axis < 3; ++axis)
                for (const int side : {-1, 1}) {
                    glm::ivec3 to = v;
                    to[axis] += side;
                    if (!mask.frame.contains(to) || !mask.at(to) || piece[mask.frame.index(to)]) continue;
                    piece[mask.frame.index(to)] = count;
                    open.push_back(mask.frame.index(to));
                }
        }
    }
    return piece;
}

TEST(VoxelPaths, BlocksJoinWhatVoxelsJoin) {
    for (const glm::ivec3& block : {glm::ivec3(1), glm::ivec3(2), glm::ivec3(2, 2, 1), glm::ivec3(1, 2, 1)})
        for (unsigned seed = 1; seed <= 12; ++seed) {
            const MaskVolume mask =
                randomMask({13, 10, 7}, 0.15 + 0.06 * seed, seed, glm::dvec3(0.8, 0.8, 0.7));
            const VoxelGraph graph = graphOf(mask, block);
            const std::vector<int> pieces = flooded(mask);
            std::size_t voxels = 0;
            for (Node start = 0; start < graph.nodeCount(); start += 7) {
                const VoxelPaths paths = findVoxelPaths(graph, {}, start, VoxelPaths::kNone, kNoPoll);
                int piece = 0;
                graph.forEachVoxel(start, [&](const glm::ivec3& v) { piece = pieces[mask.frame.index(v)]; });
                for (Node n = 0; n < graph.nodeCount(); ++n)
                    graph.forEachVoxel(n, [&](const glm::ivec3& v) {
                        EXPECT_EQ(std::isfinite(paths.ways[n].cost), pieces[mask.frame.index(v)] == piece);
                        voxels += start == 0;
                    });
            }
            EXPECT_EQ(voxels, static_cast<std::size_t>(std::count(
                                  mask.values.data(), mask.values.data() + mask.values.size(), 1)));
        }
}

TEST(VoxelPaths, OtherLabelsAreOutside) {
    MaskVolume mask = randomMask({5, 1, 1}, 1.0, 1, glm::dvec3(1.0));
    mask.at(2, 0, 0) = 2;
    const VoxelGraph graph = graphOf(mask, glm::ivec3(1));
    ASSERT_EQ(graph.nodeCount(), 4u);
    const VoxelPaths paths = findVoxelPaths(graph, {}, 0, VoxelPaths::kNone, kNoPoll);
    EXPECT_FALSE(std::isfinite(paths.ways[2].cost));
    EXPECT_EQ(paths.farthest, 1u);
}

TEST(VoxelPaths, NothingToSearch) {
    const MaskVolume mask = randomMask({4, 4, 4}, 0.0, 1, glm::dvec3(1.0));
    const VoxelGraph graph = graphOf(mask, glm::ivec3(2));
    EXPECT_EQ(graph.nodeCount(), 0u);
    const VoxelPaths paths = findVoxelPaths(graph, {}, 0, VoxelPaths::kNone, kNoPoll);
    EXPECT_EQ(paths.farthest, VoxelPaths::kNone);
    EXPECT_TRUE(paths.to(0).empty());
    // A box that lies outside of the volume.
    const VoxelGraph beyond(mask, 1, glm::ivec3(10), glm::ivec3(20), glm::ivec3(1));
    EXPECT_EQ(beyond.nodeCount(), 0u);
}

TEST(VoxelPaths, PollMayEndTheSearch) {
    const MaskVolume mask = randomMask({80, 80, 60}, 1.0, 1, glm::dvec3(1.0));
    const VoxelGraph graph = graphOf(mask, glm::ivec3(1));
    const auto stop = [] { throw std::runtime_error("stop"); };
    EXPECT_THROW(findVoxelPaths(graph, {}, 0, VoxelPaths::kNone, stop), std::runtime_error);
}

}  // namespace
}  // namespace stereonav
