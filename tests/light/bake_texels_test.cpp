// The texels a bake wants are those that lookups at surface points touch: none too few at any resolution,
// none too many where cells can be told apart one by one.
#include "engine/light/transfer/bake_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <set>

#include "engine/base/parallel.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

using Texels = std::set<std::size_t>;

GreyVolume waves(const glm::ivec3& size) {
    return test::greyVolume(test::slantedFrame(size), [](const glm::dvec3& v) {
        return 100 * std::sin(0.31 * v.x) * std::cos(0.23 * v.y + 1) + 60 * std::sin(0.4 * v.z);
    });
}

Texels wanted(const GreyVolume& volume, const VolumeFrame& texels, const TexelChoice& choice) {
    Progress progress;
    const TexelLayout layout(texels.size);
    Texels all;
    for (const TexelBrick& brick : wantedBricks(volume, texels, choice, progress))
        for (const glm::ivec3& t : texelsIn(layout, brick)) {
            EXPECT_TRUE(texels.contains(t));
            EXPECT_TRUE(all.insert(texels.index(t)).second);
        }
    return all;
}

double trilinear(const GreyVolume& volume, const glm::dvec3& p) {
    const glm::ivec3 low = glm::min(glm::ivec3(glm::floor(p)), volume.frame.size - 2);
    const glm::dvec3 f = p - glm::dvec3(low);
    double sum = 0;
    for (int n = 0; n < 8; ++n)
        sum += (n & 1 ? f.x : 1 - f.x) * (n & 2 ? f.y : 1 - f.y) * (n & 4 ? f.z : 1 - f.z) *
               volume.at(low + glm::ivec3(n & 1, n >> 1 & 1, n >> 2));
    return sum;
}

TEST(BakeTexels, EveryTexelThatALookupTouchesIsWanted) {
    const GreyVolume volume = waves({21, 17, 19});
    TexelChoice choice;
    choice.lowest = -20;
    choice.highest = 12;
    for (const double perVoxel : {0.5, 1.0 / 3, 0.7, 1.0, 2.0, 2.5}) {
        const VolumeFrame texels = texelFrame(volume.frame, perVoxel);
        const Texels chosen = wanted(volume, texels, choice);
        test::Random random(11);
        int checked = 0;
        for (int n = 0; n < 20000; ++n) {
            const glm::dvec3 p = random.inBox(glm::dvec3(0), glm::dvec3(volume.frame.size) - 1.0);
            const double value = trilinear(volume, p);
            if (value < choice.lowest || value > choice.highest) continue;
            const glm::ivec3 low = glm::min(glm::ivec3(glm::floor(p * perVoxel)), texels.size - 2);
            for (int c = 0; c < 8; ++c)
                ASSERT_TRUE(chosen.contains(texels.index(low + glm::ivec3(c & 1, c >> 1 & 1, c >> 2))))
                    << perVoxel;
            ++checked;
        }
        EXPECT_GT(checked, 1000);
        EXPECT_LE(chosen.size(), perVoxel < 1 ? texels.count() : texels.count() - 1) << perVoxel;
    }
}

// Cells by their eight values, without bricks: the same set.
TEST(BakeTexels, NoTexelTooManyAtTheVolumesResolution) {
    const GreyVolume volume = waves({30, 22, 25});
    TexelChoice choice;
    choice.lowest = choice.highest = 10.5f;
    Texels expected;
    for (int k = 0; k + 1 < 25; ++k)
        for (int j = 0; j + 1 < 22; ++j)
            for (int i = 0; i + 1 < 30; ++i) {
                int below = 0;
                for (int n = 0; n < 8; ++n)
                    below += volume.at(i + (n & 1), j + (n >> 1 & 1), k + (n >> 2)) < 10.5;
                if (below == 0 || below == 8) continue;
                for (int n = 0; n < 8; ++n)
                    expected.insert(volume.frame.index(i + (n & 1), j + (n >> 1 & 1), k + (n >> 2)));
            }
    EXPECT_EQ(wanted(volume, texelFrame(volume.frame, 1), choice), expected);
}

TEST(BakeTexels, FinerGridsWantAThinnerShell) {
    const GreyVolume volume = waves({32, 32, 32});
    TexelChoice choice;
    choice.lowest = choice.highest = 0.5f;
    const double coarse = static_cast<double>(wanted(volume, texelFrame(volume.frame, 1), choice).size());
    const double fine = static_cast<double>(wanted(volume, texelFrame(volume.frame, 2), choice).size());
    // A shell of about two layers of texels: four times as many, not eight.
    EXPECT_GT(fine, 3 * coarse);
    EXPECT_LT(fine, 5 * coarse);
}

TEST(BakeTexels, OnlyWhereTheRegionIs) {
    const GreyVolume volume = waves({32, 24, 24});
    MaskVolume region(volume.frame);
    for (int k = 0; k < 24; ++k)
        for (int j = 0; j < 24; ++j)
            for (int i = 0; i < 10; ++i) region.at(i, j, k) = 1;
    TexelChoice choice;
    choice.lowest = choice.highest = 0.5f;
    const VolumeFrame texels = texelFrame(volume.frame, 1);
    const Texels all = wanted(volume, texels, choice);
    choice.region = &region;
    const Texels inside = wanted(volume, texels, choice);
    EXPECT_FALSE(inside.empty());
    for (const std::size_t t : all) {
        const std::size_t i = t % 32;  // the last cell with a corner inside ends at voxel 10
        if (i == 10) continue;         // has cells on both sides
        ASSERT_EQ(inside.contains(t), i < 10) << i;
    }
    for (const std::size_t t : inside) ASSERT_TRUE(all.contains(t));
}

TEST(BakeTexels, FullIsAllOfThem) {
    const GreyVolume volume = waves({9, 16, 17});
    TexelChoice choice;
    choice.full = true;
    for (const double perVoxel : {0.5, 1.0, 2.0}) {
        const VolumeFrame texels = texelFrame(volume.frame, perVoxel);
        EXPECT_EQ(wanted(volume, texels, choice).size(), texels.count());
    }
}

TEST(BakeTexels, ConstantRegionsAndValuesNobodyReachesWantNothing) {
    const GreyVolume flat =
        test::greyVolume(test::slantedFrame({12, 12, 12}), [](const glm::dvec3&) { return 7; });
    TexelChoice choice;
    choice.lowest = 0;
    choice.highest = 10;
    EXPECT_TRUE(wanted(flat, texelFrame(flat.frame, 1), choice).empty());
    const GreyVolume volume = waves({12, 12, 12});
    choice.lowest = choice.highest = 5000;
    EXPECT_TRUE(wanted(volume, texelFrame(volume.frame, 1), choice).empty());
    choice.lowest = choice.highest = std::nanf("");
    EXPECT_TRUE(wanted(volume, texelFrame(volume.frame, 1), choice).empty());
}

TEST(BakeTexels, SmallestVolumes) {
    TexelChoice choice;
    choice.lowest = choice.highest = 5;
    GreyVolume one(test::slantedFrame({1, 1, 1}));
    EXPECT_TRUE(wanted(one, texelFrame(one.frame, 1), choice).empty());
    GreyVolume two(test::slantedFrame({2, 2, 2}));
    two.at(1, 0, 0) = 10;
    EXPECT_EQ(wanted(two, texelFrame(two.frame, 1), choice).size(), 8u);
    GreyVolume slice(test::slantedFrame({2, 2, 1}));
    slice.at(1, 0, 0) = 10;
    EXPECT_EQ(wanted(slice, texelFrame(slice.frame, 1), choice).size(), 4u);
}

TEST(BakeTexels, BricksInOrderForAnyThreadCount) {
    const GreyVolume volume = waves({40, 40, 40});
    TexelChoice choice;
    choice.lowest = choice.highest = 3;
    Progress progress;
    std::vector<TexelBrick> bricks[2];
    for (const int threads : {1, 4}) {
        setThreadCount(threads);
        bricks[threads > 1] = wantedBricks(volume, volume.frame, choice, progress);
    }
    ASSERT_EQ(bricks[0].size(), bricks[1].size());
    for (std::size_t n = 0; n < bricks[0].size(); ++n) {
        ASSERT_EQ(bricks[0][n].number, bricks[1][n].number);
        ASSERT_EQ(bricks[0][n].wanted, bricks[1][n].wanted);
        ASSERT_TRUE(n == 0 || bricks[0][n].number > bricks[0][n - 1].number);
    }
}

}  // namespace
}  // namespace stereonav
