// Openness from few samples, against that of a bake at all of them.
#include "terrain/light/quick_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace stereonav {
namespace {

Heightfield quicklyLit(int width, int height, const std::function<double(int, int)>& h) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) heights.push_back(static_cast<float>(h(i, j)));
    return Heightfield(width, height, {30, 30}, std::move(heights), "test ground");
}

TEST(QuickLight, OfLevelGroundIsTheWholeSky) {
    const Heightfield ground = quicklyLit(200, 90, [](int, int) { return 7; });
    Progress quiet;
    const TerrainLight light = spreadOpenness(ground, sparseOpenness(ground, 100, quiet));
    EXPECT_EQ(light.settings.kind, TerrainLightKind::Openness);
    EXPECT_EQ(light.openness, std::vector<std::uint8_t>(200 * 90, 255));
}

TEST(QuickLight, AtAllSamplesIsTheBake) {
    const Heightfield ground =
        quicklyLit(60, 50, [](int i, int j) { return 150 * std::sin(i * 0.3) * std::cos(j * 0.2); });
    Progress quiet;
    const TerrainLight baked = sparseOpenness(ground, 60 * 50, quiet);
    ASSERT_EQ(baked.grid.stride, 1);
    const TerrainLight light = spreadOpenness(ground, baked);
    double off = 0;
    for (std::size_t k = 0; k < light.openness.size(); ++k)
        off += std::abs(int(light.openness[k]) - int(baked.openness[k]));
    EXPECT_LT(off / (60 * 50), 1.0) << "levels of 255";
}

TEST(QuickLight, AtATenthOfTheSamplesIsNearTheBake) {
    const Heightfield ground = quicklyLit(240, 200, [](int i, int j) {
        return 400 * std::sin(i * 0.06) * std::cos(j * 0.07) + 20 * std::sin(i * 0.5) * std::sin(j * 0.4);
    });
    Progress quiet;
    const TerrainLight baked = sparseOpenness(ground, 240 * 200, quiet),
                       light = spreadOpenness(ground, sparseOpenness(ground, 5000, quiet));
    double squares = 0, mean = 0, spread = 0;
    const double count = 240 * 200;
    for (const std::uint8_t open : baked.openness) mean += open / count;
    for (std::size_t k = 0; k < light.openness.size(); ++k) {
        squares += std::pow(double(light.openness[k]) - baked.openness[k], 2) / count;
        spread += std::pow(baked.openness[k] - mean, 2) / count;
    }
    EXPECT_LT(std::sqrt(squares), 0.5 * std::sqrt(spread)) << "no better than their mean";
    EXPECT_LT(std::sqrt(squares), 6) << "levels of 255";
}

TEST(QuickLight, TakesHolesAndTheSmallestGround) {
    Progress quiet;
    const Heightfield holes = quicklyLit(50, 50, [](int i, int j) {
        return (i - 20) * (i - 20) + (j - 20) * (j - 20) < 40 ? std::nan("") : 10.0;
    });
    for (const std::uint8_t open : spreadOpenness(holes, sparseOpenness(holes, 200, quiet)).openness)
        EXPECT_EQ(open, 255);
    const Heightfield two = quicklyLit(2, 2, [](int, int) { return 0; });
    EXPECT_EQ(spreadOpenness(two, sparseOpenness(two, 1, quiet)).openness.size(), 4u);
}

}  // namespace
}  // namespace stereonav
