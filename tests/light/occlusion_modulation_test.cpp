// Opacity modulation and the scale that it finds for itself.
#include "engine/light/occlusion_modulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stereonav {
namespace {

constexpr int kSide = 24;

// Values of 100 to 200 whose spread grows along i.
GreyVolume grainy() {
    GreyVolume volume(VolumeFrame{glm::ivec3(kSide), glm::dvec3(1e-3)});
    std::mt19937 engine(8);
    for (int k = 0; k < kSide; ++k)
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i)
                volume.at(i, j, k) =
                    static_cast<std::int16_t>(150 + static_cast<int>(engine() % (4u * i + 1)) - 2 * i);
    return volume;
}

TransferFunction above(double value) {
    return TransferFunction({{value, glm::vec3(1.0f), 0.0}, {value + 1, glm::vec3(1.0f), 0.5}}, 0.001,
                            "test");
}

TEST(OpacityModulation, LeavesTheStrongestTenthOfWhatIsShown) {
    const GreyVolume volume = grainy();
    Progress progress;
    for (const ModulatedBy by : {ModulatedBy::Variance, ModulatedBy::Gradient}) {
        const auto modulation = opacityModulation(volume, by, glm::ivec3(3), above(0), progress);
        std::size_t full = 0, some = 0;
        for (std::size_t n = 0; n < modulation.values.size(); ++n) {
            full += modulation.values[n] == 255;
            some += modulation.values[n] > 0;
        }
        // The scale is one of 255 levels: of those at its own level some may be cut too.
        EXPECT_GT(full, some / 12);
        EXPECT_LT(full, some / 5);
    }
    const auto variance = opacityModulation(volume, ModulatedBy::Variance, glm::ivec3(3), above(0), progress);
    EXPECT_LT(variance.at(5, 12, 12), variance.at(12, 12, 12));
    EXPECT_LT(variance.at(12, 12, 12), variance.at(20, 12, 12));
}

TEST(OpacityModulation, CountsOnlyWhatIsShown) {
    // One half varies by 100 and is not shown; the other, by 10, and a twelfth of it lies beside the first.
    GreyVolume volume(VolumeFrame{glm::ivec3(kSide), glm::dvec3(1e-3)});
    std::mt19937 engine(9);
    for (int k = 0; k < kSide; ++k)
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i)
                volume.at(i, j, k) =
                    static_cast<std::int16_t>(i < kSide / 2 ? engine() % 100 : 100 + engine() % 10);
    Progress progress;
    const auto all = opacityModulation(volume, ModulatedBy::Variance, glm::ivec3(1), above(-1), progress);
    const auto upper = opacityModulation(volume, ModulatedBy::Variance, glm::ivec3(1), above(99.5), progress);
    int differ = 0;
    for (std::size_t n = 0; n < all.values.size(); ++n) {
        ASSERT_LE(all.values[n], upper.values[n] + 1);
        differ += all.values[n] + 1 < upper.values[n];
    }
    EXPECT_GT(differ, kSide * kSide * kSide / 3);
}

TEST(OpacityModulation, OfEqualValuesIsNothing) {
    GreyVolume volume(VolumeFrame{{9, 7, 5}, glm::dvec3(1e-3)});
    for (std::size_t n = 0; n < volume.values.size(); ++n) volume.values[n] = -1000;
    Progress progress;
    for (const ModulatedBy by : {ModulatedBy::Variance, ModulatedBy::Gradient})
        for (const double from : {-2000.0, 0.0}) {
            const auto modulation = opacityModulation(volume, by, glm::ivec3(2), above(from), progress);
            for (std::size_t n = 0; n < modulation.values.size(); ++n) ASSERT_EQ(modulation.values[n], 0);
        }
    GreyVolume one(VolumeFrame{glm::ivec3(1), glm::dvec3(1e-3)});
    EXPECT_EQ(opacityModulation(one, ModulatedBy::Gradient, glm::ivec3(1), above(-1), progress).values[0], 0);
}

}  // namespace
}  // namespace stereonav
