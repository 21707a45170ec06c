// The turns of the blur's taps: another one for each texel and each slab, so that no pattern is seen.
#include <gtest/gtest.h>

#include "engine/math/constants.h"
#include "tests/oracle/sweep_formulas.h"
#include "tests/support/chance.h"

namespace stereonav {
namespace {

test::ChanceField turnsOf(int width, int height, int slab) {
    constexpr int kFar = 1 << 14;
    test::ChanceField field(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            field.at(x, y) = {tapTurn(x, y, slab), tapTurn(x + kFar, y, slab), tapTurn(x, y + kFar, slab)};
    return field;
}

TEST(TapTurn, IsAnotherForEveryTexel) {
    for (const int slab : {0, 1, 255})
        for (const auto& [width, height] : {std::pair(128, 48), {48, 128}, {96, 96}}) {
            SCOPED_TRACE(testing::Message() << slab << " " << width);
            const test::ChanceField field = turnsOf(width, height, slab);
            test::expectUnrelated(field);
            // Even over a quarter of a turn: its variance is a twelfth of that squared.
            EXPECT_NEAR(test::spreadOfAll(field.first()) * 12 / (kPi * kPi / 4), 1, 0.1);
        }
}

TEST(TapTurn, IsAnotherForEverySlab) {
    const test::ChanceField base = turnsOf(96, 64, 4);
    for (const int slab : {0, 3, 5, 6, 68}) test::expectUnrelated(base, turnsOf(96, 64, slab));
}

}  // namespace
}  // namespace stereonav
