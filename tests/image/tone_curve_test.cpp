#include "engine/image/tone_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stereonav::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float shown(const ToneCurve& tone, float light) {
    return tone(glm::vec3(light)).x;
}

TEST(ToneCurve, PlainLeavesEveryBit) {
    const ToneCurve plain;
    EXPECT_TRUE(plain.plain());
    for (const float light : {0.0f, 1e-40f, 0.3f, 0.99999994f, 1.0f, 7.0f, 1e30f, -2.0f, kInfinity})
        EXPECT_EQ(shown(plain, light), light);
    EXPECT_TRUE(std::isnan(shown(plain, std::nanf(""))));
    EXPECT_FALSE((ToneCurve{2, 1}.plain()));
    EXPECT_FALSE((ToneCurve{1, 1.5f}.plain()));
}

// The straight line below the knee, 1 at white, and from there on; in between it rises and keeps below the
// line.
TEST(ToneCurve, ShoulderJoinsTheLineAndReachesOneAtWhite) {
    for (const float white : {1.0001f, 1.1f, 2.0f, 5.0f, 1e3f, 1e20f, 3e38f}) {
        SCOPED_TRACE(white);
        const ToneCurve tone{1, white};
        const float knee = tone.knee();
        EXPECT_GT(knee, 0.59f);
        EXPECT_LT(knee, 1);
        for (const float light : {0.0f, 1e-30f, 0.25f, 0.59f}) EXPECT_EQ(shown(tone, light), light);
        EXPECT_EQ(shown(tone, white), 1);
        EXPECT_EQ(shown(tone, kInfinity), 1);
        EXPECT_EQ(shown(tone, -1), 0);
        EXPECT_EQ(shown(tone, std::nanf("")), 0);
        float before = knee;
        for (int n = 1; n <= 1000; ++n) {
            const float light = knee * std::pow(white / knee, static_cast<float>(n) / 1000);
            const float now = shown(tone, light);
            EXPECT_GE(now, before - 1e-6f) << light;
            EXPECT_LE(now, std::min(light, 1.0f) + 1e-6f) << light;
            before = now;
        }
    }
}

TEST(ToneCurve, LeavesTheLineWithoutABend) {
    const ToneCurve tone{1, 4};
    const float step = 1e-3f, knee = tone.knee();
    EXPECT_NEAR((shown(tone, knee + step) - shown(tone, knee)) / step, 1, 0.01);
    EXPECT_NEAR((shown(tone, knee) - shown(tone, knee - step)) / step, 1, 0.001);
}

TEST(ToneCurve, ExposureComesFirst) {
    const ToneCurve tone{0.5f, 2};
    EXPECT_EQ(shown(tone, 1), 0.5f);
    EXPECT_EQ(shown(tone, 4), 1);
    EXPECT_LT(shown(tone, 3.9f), 1);
    const glm::vec3 each = tone({0.2f, 1, 4});
    EXPECT_EQ(each, glm::vec3(0.1f, 0.5f, 1));
}

}  // namespace
}  // namespace stereonav::test
