// Half floats against another library's, over all there are.
#include "engine/math/half_float.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

namespace stereonav {
namespace {

TEST(HalfFloat, EveryHalfIsTheLibrarys) {
    for (int n = 0; n < 0x10000; ++n) {
        const auto half = static_cast<std::uint16_t>(n);
        if ((half & 0x7c00) == 0x7c00) continue;  // infinities and NaN: never written
        ASSERT_EQ(floatFromHalf(half), glm::unpackHalf1x16(half)) << n;
        ASSERT_EQ(std::signbit(floatFromHalf(half)), std::signbit(glm::unpackHalf1x16(half))) << n;
        ASSERT_EQ(halfFromFloat(floatFromHalf(half)), half) << n;
    }
}

TEST(HalfFloat, RoundsToTheNearestAndTiesToEven) {
    for (int n = 0; n < 0x7bff; ++n) {
        const auto low = static_cast<std::uint16_t>(n), high = static_cast<std::uint16_t>(n + 1);
        const float middle = 0.5f * (floatFromHalf(low) + floatFromHalf(high));
        ASSERT_EQ(halfFromFloat(middle), n % 2 ? high : low) << n;
        ASSERT_EQ(halfFromFloat(std::nextafter(middle, 0.0f)), low) << n;
        ASSERT_EQ(halfFromFloat(std::nextafter(middle, 1e9f)), high) << n;
        ASSERT_EQ(halfFromFloat(-middle), (n % 2 ? high : low) | 0x8000) << n;
    }
}

TEST(HalfFloat, StaysFinite) {
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float v : {65504.0f, 65519.0f, 65520.0f, 1e30f, infinity}) {
        EXPECT_EQ(floatFromHalf(halfFromFloat(v)), 65504.0f);
        EXPECT_EQ(floatFromHalf(halfFromFloat(-v)), -65504.0f);
    }
    EXPECT_EQ(floatFromHalf(halfFromFloat(std::numeric_limits<float>::quiet_NaN())), 65504.0f);
    EXPECT_EQ(halfFromFloat(std::numeric_limits<float>::denorm_min()), 0);
    EXPECT_EQ(halfFromFloat(-0.0f), 0x8000);
}

}  // namespace
}  // namespace stereonav
