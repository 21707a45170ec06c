// Runs and components against flood fills and voxel-by-voxel counts that know nothing of runs.
#include "engine/volume/components.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <limits>
#include <vector>

#include "engine/base/parallel.h"
#include "test_volumes.h"

namespace stereonav {
namespace {

using test::Random;

MaskVolume maskWhere(const glm::ivec3& size, const std::function<bool(int, int, int)>& in) {
    VolumeFrame frame;
    frame.size = size;
    MaskVolume mask(frame);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) mask.at(i, j, k) = in(i, j, k) ? 1 + (i + j) % 3 : 0;
    return mask;
}

MaskVolume noise(const glm::ivec3& size, double share, unsigned seed) {
    Random random(seed);
    return maskWhere(size, [&](int, int, int) { return random.between(0, 1) < share; });
}

constexpr int kSteps[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

// Numbers of the components by flood fill, in the order of their first voxels; -1 outside the set.
struct Flooded {
    std::vector<int> number;
    std::vector<Component> list;
};
Flooded flood(const MaskVolume& mask) {
    const VolumeFrame& frame = mask.frame;
    Flooded result;
    result.number.assign(frame.count(), -1);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i) {
                if (!mask.at(i, j, k) || result.number[frame.index(i, j, k)] >= 0) continue;
                const int n = static_cast<int>(result.list.size());
                result.list.push_back({0, {i, j, k}, {i, j, k}});
                std::vector<glm::ivec3> open{{i, j, k}};
                result.number[frame.index(i, j, k)] = n;
                while (!open.empty()) {
                    const glm::ivec3 at = open.back();
                    open.pop_back();
                    Component& part = result.list.back();
                    ++part.voxels;
                    part.first = glm::min(part.first, at);
                    part.last = glm::max(part.last, at);
                    for (const auto& s : kSteps) {
                        const glm::ivec3 to = at + glm::ivec3(s[0], s[1], s[2]);
                        if (!frame.contains(to) || !mask.at(to) || result.number[frame.index(to)] >= 0)
                            continue;
                        result.number[frame.index(to)] = n;
                        open.push_back(to);
                    }
                }
            }
    return result;
}

void expectSame(const MaskVolume& mask) {
    const VoxelRuns runs = runsOf(mask);
    const Components parts = connectedComponents(runs);
    const Flooded truth = flood(mask);
    ASSERT_EQ(parts.list.size(), truth.list.size());
    for (std::size_t n = 0; n < truth.list.size(); ++n) {
        ASSERT_EQ(parts.list[n].voxels, truth.list[n].voxels) << n;
        ASSERT_EQ(parts.list[n].first, truth.list[n].first) << n;
        ASSERT_EQ(parts.list[n].last, truth.list[n].last) << n;
    }
    const VolumeFrame& frame = mask.frame;
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                ASSERT_EQ(parts.at(runs, {i, j, k}), truth.number[frame.index(i, j, k)]);
}

TEST(Components, AreThoseOfAFloodFill) {
    // From loose specks past the threshold of percolation (0.31 for cubes by faces) to nearly full.
    for (const double share : {0.05, 0.25, 0.31, 0.4, 0.6, 0.95})
        for (const glm::ivec3 size : {glm::ivec3(23, 17, 13), glm::ivec3(64, 9, 5), glm::ivec3(3, 40, 11)}) {
            SCOPED_TRACE(testing::Message() << share << " of " << size.x << 'x' << size.y << 'x' << size.z);
            expectSame(noise(size, share, static_cast<unsigned>(1000 * share) + size.x));
        }
}

TEST(Components, OfSmallAndPlainSets) {
    for (const glm::ivec3 size : {glm::ivec3(1, 1, 1), glm::ivec3(1, 1, 7), glm::ivec3(9, 1, 1),
                                  glm::ivec3(1, 8, 1), glm::ivec3(5, 4, 3)}) {
        expectSame(maskWhere(size, [](int, int, int) { return true; }));
        expectSame(maskWhere(size, [](int, int, int) { return false; }));
        expectSame(maskWhere(size, [](int i, int j, int k) { return (i + j + k) % 2 == 0; }));
    }
}

// Edges and corners do not connect; a comb is joined only by its back, a spiral only at its end.
TEST(Components, AreConnectedByFacesAlone) {
    const auto count = [](const MaskVolume& mask) { return connectedComponents(runsOf(mask)).list.size(); };
    EXPECT_EQ(count(maskWhere({2, 2, 1}, [](int i, int j, int) { return i == j; })), 2u);
    EXPECT_EQ(count(maskWhere({2, 2, 2}, [](int i, int j, int k) { return i == j && j == k; })), 2u);
    const MaskVolume comb = maskWhere({21, 9, 1}, [](int i, int j, int) { return i % 2 == 0 || j == 8; });
    EXPECT_EQ(count(comb), 1u);
    expectSame(comb);
    const MaskVolume teeth = maskWhere({21, 8, 1}, [](int i, int, int) { return i % 2 == 0; });
    EXPECT_EQ(count(teeth), 11u);
}

TEST(Components, DoNotDependOnThreads) {
    const MaskVolume mask = noise({40, 30, 20}, 0.33, 7);
    const int before = threadCount();
    setThreadCount(1);
    const VoxelRuns one = runsOf(mask);
    setThreadCount(4);
    const VoxelRuns four = runsOf(mask);
    setThreadCount(before);
    EXPECT_EQ(one.rowStart, four.rowStart);
    ASSERT_EQ(one.runs.size(), four.runs.size());
    for (std::size_t n = 0; n < one.runs.size(); ++n) {
        ASSERT_EQ(one.runs[n].first, four.runs[n].first);
        ASSERT_EQ(one.runs[n].end, four.runs[n].end);
    }
}

TEST(VoxelRuns, HoldExactlyTheVoxelsOfTheSet) {
    const MaskVolume mask = noise({37, 11, 9}, 0.5, 3);
    const VoxelRuns runs = runsOf(mask);
    std::size_t voxels = 0;
    for (int k = -1; k <= 9; ++k)
        for (int j = -1; j <= 11; ++j)
            for (int i = -1; i <= 37; ++i) {
                const bool in = mask.frame.contains({i, j, k}) && mask.at(i, j, k) != 0;
                const std::int64_t run = runs.runAt({i, j, k});
                ASSERT_EQ(run >= 0, in) << i << ' ' << j << ' ' << k;
                voxels += in;
                if (!in) continue;
                const VoxelRun& r = runs.runs[static_cast<std::size_t>(run)];
                ASSERT_TRUE(r.first <= i && i < r.end);
            }
    EXPECT_EQ(runs.voxelCount(), voxels);
    for (int k = 0; k < 9; ++k)
        for (int j = 0; j < 11; ++j) {
            const auto row = runs.row(j, k);
            for (std::size_t n = 1; n < row.size(); ++n) ASSERT_GT(row[n].first, row[n - 1].end);
        }
}

TEST(VoxelRuns, BelowAndAboveALimitLeaveTheLimitOut) {
    VolumeFrame frame;
    frame.size = {19, 7, 5};
    GreyVolume grey(frame);
    Random random(5);
    for (std::size_t n = 0; n < frame.count(); ++n)
        grey.values[n] = static_cast<std::int16_t>(random.below(9) - 4);
    grey.values[3] = -32768;
    grey.values[4] = 32767;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double limit : {-kInfinity, -32768.0, -3.0, -2.5, 0.0, 4.0, 32767.0, 1e9, kInfinity}) {
        const VoxelRuns below = runsBelow(grey, limit), above = runsAbove(grey, limit);
        for (int k = 0; k < 5; ++k)
            for (int j = 0; j < 7; ++j)
                for (int i = 0; i < 19; ++i) {
                    ASSERT_EQ(below.runAt({i, j, k}) >= 0, grey.at(i, j, k) < limit) << limit;
                    ASSERT_EQ(above.runAt({i, j, k}) >= 0, grey.at(i, j, k) > limit) << limit;
                }
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(runsBelow(grey, nan).voxelCount(), 0u);
    EXPECT_EQ(runsAbove(grey, nan).voxelCount(), 0u);
}

TEST(VoxelRuns, ErodedHaveAllSixNeighboursInTheSetAndTheGrid) {
    for (const double share : {0.5, 0.8, 0.95, 1.0})
        for (const glm::ivec3 size :
             {glm::ivec3(31, 14, 9), glm::ivec3(3, 3, 3), glm::ivec3(2, 5, 5), glm::ivec3(1, 1, 1)}) {
            const MaskVolume mask = noise(size, share, static_cast<unsigned>(100 * share));
            const VoxelRuns inner = eroded(runsOf(mask));
            ASSERT_EQ(inner.size, size);
            for (int k = 0; k < size.z; ++k)
                for (int j = 0; j < size.y; ++j)
                    for (int i = 0; i < size.x; ++i) {
                        bool all = mask.at(i, j, k) != 0;
                        for (const auto& s : kSteps) {
                            const glm::ivec3 to = glm::ivec3(i, j, k) + glm::ivec3(s[0], s[1], s[2]);
                            all = all && mask.frame.contains(to) && mask.at(to) != 0;
                        }
                        ASSERT_EQ(inner.runAt({i, j, k}) >= 0, all) << share << ' ' << size.x;
                    }
        }
}

}  // namespace
}  // namespace stereonav
