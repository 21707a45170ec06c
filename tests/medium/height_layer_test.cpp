// Height fields as thin volumes: levels, interpolation, edges and holes, the taper.
#include "engine/medium/model/height_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stereonav {
namespace {

MediumTable tableOf(double opacity) {
    MediumMaterial m;
    m.opacity = opacity;
    return makeMediumTable(MediumTransfer({{0, m}}, 1, "test"), 0, 1);
}

template <typename Height>
HeightLayer layerOf(int width, int height, double spacing, Height heightAt) {
    HeightLayer layer;
    layer.originX = 1000;
    layer.originY = -500;
    layer.spacing = spacing;
    layer.levels.emplace_back(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            layer.levels[0].at(x, y) =
                static_cast<float>(heightAt(layer.originX + x * spacing, layer.originY + y * spacing));
    layer.table = tableOf(0.5);
    makeMipLevels(layer);
    return layer;
}

double plane(double x, double y) {
    return 100 + 0.25 * (x - 1000) - 0.5 * (y + 500);
}

TEST(HeightLayer, ATiltedPlaneIsReproducedByEveryLevel) {
    for (const auto& [width, height] : {std::pair(64, 64), std::pair(37, 51)}) {
        const HeightLayer layer = layerOf(width, height, 10, plane);
        ASSERT_EQ(layer.levels.size(), width == 64 ? 7u : 6u);
        for (double footprint : {0.0, 5.0, 10.0, 13.0, 20.0, 31.0, 40.0, 79.0}) {
            // Where each block of the coarser level used has neighbours: 2^level samples from the edge.
            const double inset =
                footprint <= 10 ? 0 : 10 * std::exp2(std::ceil(std::log2(footprint / 10)) + 1);
            for (double x = inset; x <= (width - 1) * 10 - inset; x += 17.3)
                for (double y = inset; y <= (height - 1) * 10 - inset; y += 23.7)
                    EXPECT_NEAR(layer.heightAt(1000 + x, -500 + y, footprint), plane(1000 + x, -500 + y),
                                1e-4)
                        << x << " " << y << " " << footprint;
        }
    }
}

TEST(HeightLayer, FootprintsTakeMeansOverThem) {
    // A chequerboard of single samples: from the second level on it is flat.
    const HeightLayer layer = layerOf(64, 64, 1, [](double x, double y) {
        return std::fmod(std::floor(x) + std::floor(y + 1000), 2) == 0 ? 1.0 : 3.0;
    });
    EXPECT_EQ(layer.heightAt(1010, -480, 0), 1);
    EXPECT_EQ(layer.heightAt(1011, -480, 0.5), 3);
    EXPECT_NEAR(layer.heightAt(1011, -480, std::sqrt(2.0)), 2.5, 1e-6);  // half way to the second level
    EXPECT_NEAR(layer.heightAt(1011, -480, 2), 2, 1e-6);
    EXPECT_NEAR(layer.heightAt(1011, -480, 1e9), 2, 1e-6);
    EXPECT_EQ(layer.lowest, 0);  // 1 m below by default
    EXPECT_EQ(layer.highest, 3);
}

TEST(HeightLayer, BeyondTheEdgeThereIsNone) {
    const HeightLayer layer = layerOf(8, 4, 10, [](double, double) { return 7.0; });
    for (const double footprint : {0.0, 15.0, 100.0}) {
        EXPECT_EQ(layer.heightAt(1000, -500, footprint), 7) << footprint;
        EXPECT_EQ(layer.heightAt(1070, -470, footprint), 7) << footprint;
        EXPECT_TRUE(std::isnan(layer.heightAt(999.9, -490, footprint))) << footprint;
        EXPECT_TRUE(std::isnan(layer.heightAt(1070.1, -490, footprint))) << footprint;
        EXPECT_TRUE(std::isnan(layer.heightAt(1010, -469.9, footprint))) << footprint;
        EXPECT_TRUE(std::isnan(layer.heightAt(std::nan(""), -490, footprint))) << footprint;
    }
    EXPECT_EQ(layer.at({999, -490, 6.5}, 0).extinction, 0.0f);
    EXPECT_GT(layer.at({1010, -490, 6.5}, 0).extinction, 0.0f);
}

TEST(HeightLayer, HolesStayHolesAndAreLeftOutOfMeans) {
    const float kNone = std::numeric_limits<float>::quiet_NaN();
    const HeightLayer layer = layerOf(16, 16, 1, [&](double x, double y) {
        const bool hole = x >= 1004 && x < 1006 && y >= -496 && y < -494;
        return hole || (x == 1010 && y == -490) ? kNone : 5.0f;
    });
    EXPECT_TRUE(std::isnan(layer.heightAt(1004, -496, 0)));
    EXPECT_TRUE(std::isnan(layer.heightAt(1003.5, -496, 0)));
    EXPECT_EQ(layer.heightAt(1003, -496, 0), 5);
    EXPECT_TRUE(std::isnan(layer.levels[1].at(2, 2)));  // a block of holes
    EXPECT_EQ(layer.levels[1].at(5, 5), 5);             // a block with one
    EXPECT_EQ(layer.levels[2].at(1, 1), 5);
    EXPECT_EQ(layer.at({1004, -496, 4.5}, 0).extinction, 0.0f);
    EXPECT_EQ(layer.lowest, 4);
    EXPECT_EQ(layer.highest, 5);
}

TEST(HeightLayer, TheTaperTakesWhatTheFormulaSays) {
    HeightLayer layer = layerOf(4, 4, 10, [](double, double) { return 50.0; });
    const double tau = -std::log(0.5);
    for (const auto& [below, above, taper] : {std::tuple(3.0, 1.0, 0.0), std::tuple(3.0, 1.0, 0.5),
                                              std::tuple(3.0, 1.0, 2.0), std::tuple(2.0, 0.0, 5.0)}) {
        layer.below = below;
        layer.above = above;
        layer.taper = taper;
        makeMipLevels(layer);
        const double thick = below + above;
        // Trapezoid; a triangle that does not reach 1 where the ramps meet before.
        const double truth = tau * (taper <= thick / 2 ? thick - taper : thick * thick / (4 * taper));
        constexpr int kSteps = 100000;
        double sum = 0;
        for (int n = 0; n < kSteps; ++n) {
            const double z = 40 + 20 * (n + 0.5) / kSteps;
            sum += layer.at({1011, -488, z}, 0).extinction * 20 / kSteps;
        }
        EXPECT_NEAR(sum, truth, 3e-4) << taper;
        EXPECT_EQ(layer.at({1011, -488, 50 + above + 1e-6}, 0).extinction, 0.0f) << taper;
        EXPECT_EQ(layer.at({1011, -488, 50 - below - 1e-6}, 0).extinction, 0.0f) << taper;
    }
}

TEST(HeightLayer, EmptyAndTiny) {
    HeightLayer layer;
    makeMipLevels(layer);
    EXPECT_TRUE(std::isnan(layer.heightAt(0, 0, 0)));
    EXPECT_EQ(layer.at({0, 0, 0}, 0).extinction, 0.0f);
    const HeightLayer one = layerOf(1, 1, 10, [](double, double) { return 3.0; });
    EXPECT_EQ(one.levels.size(), 1u);
    EXPECT_EQ(one.heightAt(1000, -500, 100), 3);
    const HeightLayer row = layerOf(5, 1, 10, [](double x, double) { return x; });
    EXPECT_EQ(row.heightAt(1025, -500, 100), 1025);
    const HeightLayer none = layerOf(4, 4, 1, [](double, double) { return std::nan(""); });
    EXPECT_EQ(none.at({1001, -499, 0}, 0).extinction, 0.0f);
    EXPECT_EQ(none.lowest, none.highest);
}

// Half of the ground red, half green, and a place has the colour that lies there: times the table's.
TEST(HeightLayer, ReadsItsColourAtThePlace) {
    HeightLayer layer = layerOf(41, 41, 10, plane);
    Plane<PackedColor> picture(32, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            picture.at(x, y) = packColor(x < 16 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0));
    const glm::vec3 own = layer.at({1100, -300, plane(1100, -300) - 0.5}, 0).color;
    EXPECT_EQ(layer.colorAt(1100, -300, 0), glm::vec3(1.0f)) << "none yet";
    layer.color = std::make_shared<ColorTexture>(picture, glm::dvec2(0), glm::dvec2(0.5, 0.5));
    layer.colorSpacing = {25, 25};
    EXPECT_DOUBLE_EQ(layer.colorTexel(), 12.5);
    for (const double y : {-480.0, -300.0, -120.0}) {
        EXPECT_EQ(layer.colorAt(1100, y, 0), glm::vec3(1, 0, 0));
        EXPECT_EQ(layer.colorAt(1300, y, 0), glm::vec3(0, 1, 0));
        EXPECT_EQ(layer.at({1100, y, plane(1100, y) - 0.5}, 0).color, own * glm::vec3(1, 0, 0));
    }
    // Over all of it both are as much.
    const glm::vec3 all = layer.colorAt(1200, -300, 1e6);
    EXPECT_NEAR(all.x, 0.5f, 0.01f);
    EXPECT_NEAR(all.y, 0.5f, 0.01f);
    // What is coarser than the texels blurs, what is finer does not.
    EXPECT_EQ(layer.colorAt(1190, -300, 10), layer.colorAt(1190, -300, 0));
    EXPECT_GT(layer.colorAt(1180, -300, 80).y, 0.02f);
}

}  // namespace
}  // namespace stereonav
