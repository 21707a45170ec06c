// Opacity modulation and the scale that it finds for itself.
#include "engine/light/occlusion/occlusion_modulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/base/error.h"

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

Volume<std::uint8_t> modulated(const GreyVolume& volume, ModulatedBy by, int radius,
                               const TransferFunction& transfer) {
    Progress progress;
    return opacityModulation(volume, {by, glm::ivec3(radius), {}, {}}, transfer, progress).share;
}

TEST(OpacityModulation, LeavesTheStrongestTenthOfWhatIsShown) {
    const GreyVolume volume = grainy();
    for (const ModulatedBy by : {ModulatedBy::Variance, ModulatedBy::Gradient}) {
        const auto modulation = modulated(volume, by, 3, above(0));
        std::size_t full = 0, some = 0;
        for (std::size_t n = 0; n < modulation.values.size(); ++n) {
            full += modulation.values[n] == 255;
            some += modulation.values[n] > 0;
        }
        // The scale is one of 255 levels: of those at its own level some may be cut too.
        EXPECT_GT(full, some / 12);
        EXPECT_LT(full, some / 5);
    }
    const auto variance = modulated(volume, ModulatedBy::Variance, 3, above(0));
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
    const auto all = modulated(volume, ModulatedBy::Variance, 1, above(-1));
    const auto upper = modulated(volume, ModulatedBy::Variance, 1, above(99.5));
    int differ = 0;
    for (std::size_t n = 0; n < all.values.size(); ++n) {
        ASSERT_LE(all.values[n], upper.values[n] + 1);
        differ += all.values[n] + 1 < upper.values[n];
    }
    EXPECT_GT(differ, kSide * kSide * kSide / 3);
}

// The shares are those of the formulas at the sigma that was given; the one that was chosen, given, is the
// same modulation.
TEST(OpacityModulation, TakesASigma) {
    const GreyVolume volume = grainy();
    Progress progress;
    ModulationSetting setting{ModulatedBy::Variance, glm::ivec3(3), {}, 11.0};
    const OpacityModulation variance = opacityModulation(volume, setting, above(0), progress);
    EXPECT_EQ(variance.sigma, 11);
    const auto wanted = varianceModulation(volume, glm::ivec3(3), 11, progress);
    EXPECT_TRUE(std::equal(wanted.values.data(), wanted.values.data() + wanted.values.size(),
                           variance.share.values.data()));
    setting = {ModulatedBy::Gradient, glm::ivec3(3), OcclusionMethod::Chebyshev, 0.2};
    const OpacityModulation gradient = opacityModulation(volume, setting, above(0), progress);
    const auto slopes = gradientModulation(
        estimateOpenness(volume, OcclusionMethod::Chebyshev, glm::ivec3(3), progress), 0.2);
    EXPECT_TRUE(std::equal(slopes.values.data(), slopes.values.data() + slopes.values.size(),
                           gradient.share.values.data()));
    for (const ModulatedBy by : {ModulatedBy::Variance, ModulatedBy::Gradient}) {
        const OpacityModulation chosen =
            opacityModulation(volume, {by, glm::ivec3(3), {}, {}}, above(0), progress);
        const OpacityModulation given =
            opacityModulation(volume, {by, glm::ivec3(3), {}, chosen.sigma}, above(0), progress);
        EXPECT_TRUE(std::equal(given.share.values.data(),
                               given.share.values.data() + given.share.values.size(),
                               chosen.share.values.data()));
        for (const double wrong : {0.0, -1.0, std::nan("")})
            EXPECT_THROW(opacityModulation(volume, {by, glm::ivec3(3), {}, wrong}, above(0), progress),
                         Error);
    }
    EXPECT_THROW(
        opacityModulation(volume, {ModulatedBy::Gradient, glm::ivec3(3), {}, 1.5}, above(0), progress),
        Error);
}

TEST(OpacityModulation, OfEqualValuesIsNothing) {
    GreyVolume volume(VolumeFrame{{9, 7, 5}, glm::dvec3(1e-3)});
    for (std::size_t n = 0; n < volume.values.size(); ++n) volume.values[n] = -1000;
    for (const ModulatedBy by : {ModulatedBy::Variance, ModulatedBy::Gradient})
        for (const double from : {-2000.0, 0.0}) {
            const auto modulation = modulated(volume, by, 2, above(from));
            for (std::size_t n = 0; n < modulation.values.size(); ++n) ASSERT_EQ(modulation.values[n], 0);
        }
    GreyVolume one(VolumeFrame{glm::ivec3(1), glm::dvec3(1e-3)});
    EXPECT_EQ(modulated(one, ModulatedBy::Gradient, 1, above(-1)).values[0], 0);
}

}  // namespace
}  // namespace stereonav
