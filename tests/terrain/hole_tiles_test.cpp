// Where a ground may have holes, against a look at each sample.
#include "terrain/survey/hole_tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <random>
#include <vector>

namespace stereonav {
namespace {

TEST(HoleTiles, AreWhereSamplesAreMissingOnWideAndOnTallGround) {
    constexpr int kTile = 16;  // samples: tiles are told of as a whole
    for (const glm::ivec2& size : {glm::ivec2(150, 20), {20, 150}, {65, 64}, {3, 200}}) {
        std::mt19937 random(static_cast<unsigned>(size.x));
        std::vector<float> heights(static_cast<std::size_t>(size.x) * size.y, 7.0f);
        // Few holes, the last sample of all among them, and one in the last column and row each.
        std::vector<glm::ivec2> holes{size - 1, {size.x - 1, size.y / 3}, {size.x / 3, size.y - 1}};
        for (const glm::ivec2& hole : holes)
            heights[static_cast<std::size_t>(hole.y) * size.x + hole.x] = std::nanf("");
        const HoleTiles tiles(Heightfield(size.x, size.y, {10, 14}, heights, "holed"));
        int some = 0, none = 0;
        for (int n = 0; n < 4000; ++n) {
            const glm::ivec2 low(std::uniform_int_distribution(-3, size.x - 1)(random),
                                 std::uniform_int_distribution(-3, size.y - 1)(random)),
                high = glm::max(low + glm::ivec2(std::uniform_int_distribution(0, 9)(random),
                                                 std::uniform_int_distribution(0, 9)(random)),
                                glm::ivec2(0));
            bool inTiles = false;  // any hole in a tile that they touch
            for (const glm::ivec2& hole : holes) {
                const glm::ivec2 tile = hole / kTile;
                inTiles = inTiles || (high.x >= tile.x * kTile && low.x < (tile.x + 1) * kTile &&
                                      high.y >= tile.y * kTile && low.y < (tile.y + 1) * kTile);
            }
            ASSERT_EQ(tiles.any(low, high), inTiles) << low.x << " " << low.y << " " << size.x;
            ++(inTiles ? some : none);
        }
        EXPECT_GT(some, 50);
        EXPECT_GT(none, 50);
    }
    EXPECT_FALSE(
        HoleTiles(Heightfield(3, 9, {1, 2}, std::vector<float>(27, 1.0f), "whole")).any({0, 0}, {2, 8}));
}

}  // namespace
}  // namespace stereonav
