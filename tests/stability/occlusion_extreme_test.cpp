// Occlusion where it is least comfortable: walls one voxel thin, values at the ends of 16 bits, flat slices
// and long lines, very uneven spacing, isovalues at the data's ends.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/light/occlusion/occlusion.h"
#include "engine/light/occlusion/occlusion_rays.h"
#include "tests/light/occlusion_brute.h"

namespace stereonav {
namespace {

constexpr auto kMethods = test::kOcclusionMethods;

OpennessVolume estimate(const GreyVolume& volume, OcclusionMethod method, const glm::ivec3& radius) {
    Progress progress;
    return estimateOpenness(volume, method, radius, progress);
}

template <typename Value>
GreyVolume fill(const glm::ivec3& size, Value value, const glm::dvec3& spacing = glm::dvec3(1e-3)) {
    GreyVolume volume(VolumeFrame{size, spacing});
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                volume.at(i, j, k) = static_cast<std::int16_t>(value(glm::ivec3(i, j, k)));
    return volume;
}

TEST(OcclusionExtreme, AWallOneVoxelThinIsOpenFromBothSides) {
    // From end to end of 16 bits, one voxel in 21: of its box it has the rest below it.
    const GreyVolume volume =
        fill({21, 21, 21}, [](const glm::ivec3& v) { return v.z == 10 ? 32767 : -32768; });
    for (const OcclusionMethod method : kMethods) {
        const OpennessVolume openness = estimate(volume, method, glm::ivec3(7));
        EXPECT_GT(openness.at(10, 10, 10), 230) << static_cast<int>(method);
        EXPECT_LT(openness.at(10, 10, 9), 128) << static_cast<int>(method);
        EXPECT_EQ(openness.at(10, 10, 9), openness.at(10, 10, 11)) << static_cast<int>(method);
    }
    // The rays' wall has no side: its gradient is zero. Beside it there is one.
    EXPECT_FALSE(traceOpenness(volume, {10, 10, 10}, 5e-3).surface);
    EXPECT_TRUE(traceOpenness(volume, {10, 10, 9}, 5e-3).surface);
}

TEST(OcclusionExtreme, IsovaluesAtTheDatasEnds) {
    const GreyVolume volume = fill({20, 20, 20}, [](const glm::ivec3& v) {
        return v.z < 6 ? 32767 : v.z > 13 ? -32768 : 32767 - 8191 * (v.z - 5);
    });
    for (int z = 0; z < 20; ++z) {
        const TracedOpenness open = traceOpenness(volume, {10, 10, z}, 5e-3);
        for (const double share : {open.obscurance, open.visible, open.sphere}) {
            EXPECT_GE(share, 0) << z;
            EXPECT_LE(share, 1) << z;
        }
        // A flat wall is open whatever its isovalue, the least and the largest included.
        if (open.surface) {
            EXPECT_GT(open.obscurance, 0.97) << z;
        }
    }
    const OpennessVolume openness = estimate(volume, OcclusionMethod::Reconstructed, glm::ivec3(4));
    EXPECT_EQ(openness.at(10, 10, 5), 255);
    EXPECT_EQ(openness.at(10, 10, 14), 0);
}

TEST(OcclusionExtreme, SpacingOf1To1To20) {
    std::mt19937 engine(1);
    const GreyVolume volume =
        fill({30, 30, 6}, [&](const glm::ivec3& v) { return 100 * v.x + static_cast<int>(engine() % 50); },
             {1e-3, 1e-3, 20e-3});
    const glm::ivec3 radius = occlusionRadius(volume.frame, 6e-3);
    EXPECT_EQ(radius, glm::ivec3(6, 6, 0));
    for (const OcclusionMethod method : kMethods) {
        const OpennessVolume openness = estimate(volume, method, radius);
        for (int k = 0; k < 6; ++k) {
            const glm::ivec3 voxel(15, 14, k);
            const double truth =
                test::opennessOf(test::boxAt(volume, voxel, radius), volume.at(voxel), method);
            EXPECT_LE(test::bytesAway(openness.at(voxel), truth), 0.54) << k;
        }
    }
    const TracedOpenness open = traceOpenness(volume, {15, 14, 3}, 6e-3);
    EXPECT_TRUE(open.surface);
    EXPECT_GT(open.obscurance, 0.8);
}

TEST(OcclusionExtreme, LongLinesAndFlatSlices) {
    for (const glm::ivec3& size : {glm::ivec3(60000, 1, 1), glm::ivec3(1, 20000, 1), glm::ivec3(1, 1, 20000),
                                   glm::ivec3(300, 200, 1), glm::ivec3(2, 2, 2)}) {
        const GreyVolume volume =
            fill(size, [](const glm::ivec3& v) { return (v.x * 7919 + v.y * 10007 + v.z * 13007) % 30011; });
        for (const OcclusionMethod method : kMethods) {
            const OpennessVolume openness = estimate(volume, method, glm::ivec3(64));
            for (int n = 0; n < 50; ++n) {
                const glm::ivec3 voxel = (size - 1) * n / 49;
                const double truth =
                    test::opennessOf(test::boxAt(volume, voxel, glm::ivec3(64)), volume.at(voxel), method);
                ASSERT_LE(test::bytesAway(openness.at(voxel), truth), 0.54) << size.x << " " << n;
            }
        }
    }
}

TEST(OcclusionExtreme, OneBrightVoxelInALargeVolumeChangesOnlyItsBox) {
    GreyVolume volume =
        fill({70, 60, 50}, [](const glm::ivec3& v) { return 10 * ((v.x + 2 * v.y + 3 * v.z) % 17); });
    for (const OcclusionMethod method : kMethods) {
        const OpennessVolume before = estimate(volume, method, glm::ivec3(5));
        volume.at(40, 30, 20) = 32767;
        const OpennessVolume after = estimate(volume, method, glm::ivec3(5));
        volume.at(40, 30, 20) = static_cast<std::int16_t>(10 * ((40 + 60 + 60) % 17));
        for (int k = 0; k < 50; ++k)
            for (int j = 0; j < 60; ++j)
                for (int i = 0; i < 70; ++i) {
                    const bool near = std::abs(i - 40) <= 5 && std::abs(j - 30) <= 5 && std::abs(k - 20) <= 5;
                    if (near) continue;
                    ASSERT_EQ(before.at(i, j, k), after.at(i, j, k)) << i << " " << j << " " << k;
                }
    }
}

TEST(OcclusionExtreme, ModulationOfEvenAndOfExtremeVolumes) {
    Progress progress;
    GreyVolume volume = fill({9, 9, 9}, [](const glm::ivec3&) { return -32768; });
    EXPECT_EQ(varianceModulation(volume, glm::ivec3(2), 1, progress).at(4, 4, 4), 0);
    volume = fill({9, 9, 9}, [](const glm::ivec3& v) { return (v.x + v.y + v.z) % 2 ? 32767 : -32768; });
    // 63 of 125 at one end: sigma is half of the range but for 1 in 15,625 of its square.
    EXPECT_NEAR(varianceModulation(volume, glm::ivec3(2), 65535, progress).at(4, 4, 4), 64, 1);
    EXPECT_EQ(varianceModulation(volume, glm::ivec3(2), 30000, progress).at(4, 4, 4), 255);
}

}  // namespace
}  // namespace stereonav
