// Palettes of maps: tints by height, relief after Imhof, grey; their names and legends.
#include "terrain/scene/map_tones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "terrain/scene/ground_color.h"
#include "terrain/scene/ground_recolor.h"
#include "terrain/scene/slope_color.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using glm::vec3;

float luminance(const vec3& c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}
glm::dvec3 facing(double east, double north, double steep) {
    return glm::normalize(glm::dvec3(steep * east, steep * north, 1));
}

TEST(MapTones, HypsometricTintsRunFromGreenToWhiteWithoutSteps) {
    const vec3 low = hypsometricColor(0), middle = hypsometricColor(0.6f), high = hypsometricColor(1);
    EXPECT_GT(low.y, 1.15f * low.x);
    EXPECT_GT(middle.x, 1.15f * middle.z);
    EXPECT_GT(luminance(high), 1.5f * luminance(middle));
    for (int k = 0; k < 2000; ++k)
        ASSERT_LT(glm::distance(hypsometricColor(k / 2000.0f), hypsometricColor((k + 1) / 2000.0f)), 0.002f);
    EXPECT_EQ(hypsometricColor(-3), low);
    EXPECT_EQ(hypsometricColor(7), high);
}

TEST(MapTones, SwissReliefIsLitFromTheNorthWestMostAtTheSummits) {
    const glm::dvec3 level(0, 0, 1), lit = facing(-0.7, 0.7, 0.6), dark = facing(0.7, -0.7, 0.6);
    const auto contrast = [&](float share) {
        return luminance(swissColor(share, lit)) / luminance(swissColor(share, dark));
    };
    EXPECT_GT(contrast(0.1f), 1.1f);
    EXPECT_GT(contrast(1), 1.5f * contrast(0.1f));
    // Yellowish in the light, bluish away from it; lowlands bluish.
    const auto warmth = [](const vec3& c) { return c.x / c.z; };
    EXPECT_GT(warmth(swissColor(0.8f, lit)), warmth(swissColor(0.8f, level)));
    EXPECT_LT(warmth(swissColor(0.8f, dark)), warmth(swissColor(0.8f, level)));
    EXPECT_LT(warmth(swissColor(0, level)), warmth(swissColor(1, level)));
}

TEST(MapTones, EveryPaletteHasAColourForEveryGround) {
    for (const GroundPalette palette : {GroundPalette::Natural, GroundPalette::Hypsometric,
                                        GroundPalette::Swiss, GroundPalette::Grey, GroundPalette::Tint})
        for (const std::string& kind : test::groundKinds()) {
            const Heightfield ground = test::makeGround(kind, 40, 30, 5);
            const TintPlace place{1, {}, palette};
            Progress progress;
            const GroundColor color = tintedGround(ground, TerrainLook(), place, progress);
            const auto level = color.texture.level(0);
            for (int y = 0; y < level.height(); ++y)
                for (int x = 0; x < level.width(); ++x)
                    ASSERT_GT(unpackColor(level.at(x, y)).y, 0.004f) << kind << static_cast<int>(palette);
            EXPECT_EQ(color.source, describePalette(place) + ", lit");
        }
}

TEST(MapTones, GreyIsGrey) {
    const Heightfield ground = test::makeGround("smooth", 40, 30, 5);
    const vec3 color = groundTones(ground, {1, {}, GroundPalette::Grey}, ground)->at({9, 9}, 20).color;
    EXPECT_EQ(color.x, color.y);
    EXPECT_EQ(color.y, color.z);
}

TEST(MapTones, PaintsThatArePalettesSayWhatTheyMean) {
    for (const char* const word : {"natural", "hypsometric", "swiss", "grey"})
        EXPECT_TRUE(paletteOf(groundPaintNamed(word).value())) << word;
    for (const GroundPaint paint :
         {GroundPaint::None, GroundPaint::Slope, GroundPaint::Aspect, GroundPaint::Hillshade})
        EXPECT_FALSE(paletteOf(paint));
    const Legend legend = legendOfPalette(GroundPalette::Hypsometric, -20, 1980);
    ASSERT_EQ(legend.entries.size(), 5u);
    EXPECT_EQ(legend.entries.front().text, "1980 m");
    EXPECT_EQ(legend.entries.back().text, "-20 m");
    EXPECT_TRUE(legendOfPalette(GroundPalette::Hypsometric, 5, 5).entries.empty());
    EXPECT_TRUE(legendOfPalette(GroundPalette::Swiss, 0, 9).entries.empty());
}

}  // namespace
}  // namespace stereonav
