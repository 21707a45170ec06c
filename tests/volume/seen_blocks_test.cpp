// What is seen of a volume by blocks, against all of its voxels.
#include "engine/volume/seen_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace stereonav {
namespace {

template <typename ValueAt>
GreyVolume volumeOf(const glm::ivec3& size, const ValueAt& valueAt,
                    const glm::dvec3& spacing = glm::dvec3(0.001)) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = spacing;
    GreyVolume grey(frame);
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) grey.at(i, j, k) = static_cast<std::int16_t>(valueAt(i, j, k));
    return grey;
}

double sumOf(const SeenBlocks& blocks) {
    return std::accumulate(blocks.voxels.begin(), blocks.voxels.end(), 0.0);
}

TEST(SeenBlocks, CountEveryVoxelOnce) {
    const auto value = [](int i, int j, int k) { return (i * 7 + j * 13 + k * 29) % 100 - 50; };
    for (const glm::ivec3 size :
         {glm::ivec3(1, 1, 1), glm::ivec3(97, 3, 5), glm::ivec3(200, 1, 7), glm::ivec3(31, 193, 17)}) {
        const GreyVolume grey = volumeOf(size, value);
        const SeenBlocks blocks = seenBlocks(grey, seenFrom(10));
        double expected = 0;
        for (std::size_t n = 0; n < grey.frame.count(); ++n) expected += grey.values[n] >= 10;
        EXPECT_EQ(sumOf(blocks), expected);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(blocks.size[axis], SeenBlocks::kMostBlocks);
            EXPECT_GE(blocks.size[axis] * blocks.block[axis], size[axis]);
        }
    }
}

TEST(SeenBlocks, AreAboutAsLongAsWide) {
    const SeenBlocks blocks = seenBlocks(
        volumeOf({192, 192, 40}, [](int, int, int) { return 0; }, {0.001, 0.001, 0.005}), seenFrom(1));
    EXPECT_EQ(blocks.block, glm::ivec3(2, 2, 1));
    EXPECT_EQ(sumOf(blocks), 0);
    EXPECT_TRUE(surfaceOf(blocks).empty());
}

TEST(SeenBlocks, TheSurfaceOfABallFacesOutwards) {
    const glm::dvec3 middle(30, 32, 28);
    const auto ball = [&](int i, int j, int k) {
        return glm::length(glm::dvec3(i, j, k) - middle) < 20 ? 9 : 0;
    };
    const std::vector<SurfaceSample> samples =
        surfaceOf(seenBlocks(volumeOf({64, 64, 64}, ball), seenFrom(5)));
    ASSERT_GT(samples.size(), 2000u);
    for (const SurfaceSample& sample : samples) {
        const glm::dvec3 away = sample.place / 0.001 - middle;
        EXPECT_NEAR(glm::length(away), 19.3, 1.0);
        EXPECT_GT(glm::dot(glm::dvec3(sample.normal), glm::normalize(away)), 0.9);
    }
}

TEST(SeenBlocks, CrumbsGoAndPiecesStay) {
    const auto value = [](int i, int j, int k) {
        if (i >= 5 && i < 35 && j >= 5 && j < 35 && k >= 5 && k < 35) return 9;   // the object
        if (i >= 50 && i < 56 && j >= 5 && j < 11 && k >= 5 && k < 11) return 9;  // a piece of 216 voxels
        return i == 60 && j == 60 && k == 60 ? 9 : 0;                             // a crumb
    };
    SeenBlocks blocks = seenBlocks(volumeOf({64, 64, 64}, value), seenFrom(5));
    ASSERT_EQ(sumOf(blocks), 27000 + 216 + 1);
    dropCrumbs(blocks);
    EXPECT_EQ(sumOf(blocks), 27000 + 216);
    // What is all crumbs stays.
    SeenBlocks dust = seenBlocks(
        volumeOf({64, 64, 64}, [](int i, int j, int k) { return i % 3 + j % 3 + k % 3 == 0 ? 9 : 0; }),
        seenFrom(5));
    const double all = sumOf(dust);
    dropCrumbs(dust);
    EXPECT_EQ(sumOf(dust), all);
}

TEST(SeenBlocks, OneVoxelIsAllThereIs) {
    const std::vector<SurfaceSample> samples =
        surfaceOf(seenBlocks(volumeOf({1, 1, 1}, [](int, int, int) { return 7; }), seenFrom(7)));
    ASSERT_EQ(samples.size(), 1u);
    EXPECT_EQ(samples[0].place, glm::dvec3(0.0));
    EXPECT_EQ(samples[0].normal, glm::vec3(0.0f));
    EXPECT_TRUE(surfaceOf(seenBlocks(GreyVolume(), seenFrom(0))).empty());
}

}  // namespace
}  // namespace stereonav
