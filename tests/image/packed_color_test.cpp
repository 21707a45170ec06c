// Packed colours: round trips, order, clamping, and the sRGB tables against the standard's formula.
#include "engine/image/packed_color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stereonav {
namespace {

TEST(PackedColor, EveryChannelValueSurvivesARoundTrip) {
    for (std::uint32_t v = 0; v < 1024; ++v) {
        const PackedColor c = v | (1023 - v) << 10 | (v * 7 % 1024) << 20;
        EXPECT_EQ(packColor(unpackColor(c)), c) << "value " << v;
    }
}

TEST(PackedColor, ChannelsLieWhereTheHeaderSays) {
    EXPECT_EQ(packColor({1, 0, 0}), 1023u);
    EXPECT_EQ(packColor({0, 1, 0}), 1023u << 10);
    EXPECT_EQ(packColor({0, 0, 1}), 1023u << 20);
    EXPECT_EQ(packColor({1, 1, 1}) >> 30, 0u);
}

TEST(PackedColor, RisesWithLightAndErrsByHalfAStep) {
    PackedColor last = 0;
    for (int i = 0; i <= 100000; ++i) {
        const float linear = static_cast<float>(i) / 100000.0f;
        const PackedColor c = packColor({linear, 0, 0});
        ASSERT_GE(c, last) << "linear " << linear;
        ASSERT_NEAR(std::sqrt(unpackColor(c).x), std::sqrt(linear), 0.5001f / 1023.0f) << "linear " << linear;
        last = c;
    }
    EXPECT_EQ(last, 1023u);
}

TEST(PackedColor, ClampsWhatIsOutOfRange) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(packColor({-1.0f, -kInfinity, -0.0f}), 0u);
    EXPECT_EQ(packColor({kNan, kNan, kNan}), 0u);
    EXPECT_EQ(packColor({1.5f, kInfinity, 1e30f}), packColor({1, 1, 1}));
    EXPECT_EQ(packColor({std::numeric_limits<float>::denorm_min(), 0, 0}), 0u);
}

// The points IEC 61966-2-1 itself fixes, and middle gray as published: sRGB 188 is 0.5029 linear.
TEST(Srgb, MeetsTheStandardsPoints) {
    EXPECT_EQ(linearFromSrgb(0.0f), 0.0f);
    EXPECT_NEAR(linearFromSrgb(1.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(linearFromSrgb(0.04045f), 0.0031308f, 1e-7f);
    EXPECT_NEAR(srgbFromLinear(0.0031308f), 0.04045f, 1e-5f);
    EXPECT_NEAR(linearFromSrgb(188.0f / 255.0f), 0.5029f, 1e-4f);
}

TEST(Srgb, FormulasAreEachOthersInverse) {
    for (int i = 0; i <= 1000; ++i) {
        const float v = static_cast<float>(i) / 1000.0f;
        EXPECT_NEAR(srgbFromLinear(linearFromSrgb(v)), v, 2e-6f);
    }
}

TEST(Srgb, EveryByteSurvivesPacking) {
    for (int byte = 0; byte < 256; ++byte) {
        const auto packed = packedFromSrgbByte()[byte];
        ASSERT_LT(packed, 1024);
        EXPECT_EQ(srgbByteFromPacked()[packed], byte);
    }
}

TEST(Srgb, TableIsTheFormulaRounded) {
    for (int i = 0; i < 1024; ++i) {
        const double root = i / 1023.0;
        const double linear = root * root;
        const double encoded =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
        EXPECT_NEAR(srgbByteFromPacked()[i], encoded * 255, 0.501) << "packed " << i;
    }
}

// What the header promises of the layout. The slope of sRGB over the square root is greatest where the
// standard's straight part ends, 0.35 bytes a step.
TEST(Srgb, APackedStepIsFinerThanFourTenthsOfAByte) {
    double widest = 0;
    for (int i = 1; i < 1024; ++i) {
        const auto encoded = [](int v) {
            return srgbFromLinear(static_cast<float>(v) * v / (1023.0f * 1023.0f));
        };
        widest = std::max(widest, 255.0 * (encoded(i) - encoded(i - 1)));
    }
    EXPECT_LT(widest, 0.4);
    EXPECT_GT(widest, 0.2);
}

}  // namespace
}  // namespace stereonav
