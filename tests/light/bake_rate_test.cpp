// Rates of lighting texels: what is measured and how it is scaled.
#include "engine/light/bake/bake_rate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

TEST(BakeRate, WithTimeEnoughIsTheWholeOfIt) {
    const std::vector<std::size_t> sizes{5, 7, 1, 64, 3};
    std::mutex mutex;
    std::multiset<std::size_t> seen;
    const BakeRate rate = bakeRate(sizes, 1e9, 10, [&](std::size_t n) {
        const std::lock_guard<std::mutex> lock(mutex);
        seen.insert(n);
        return sizes[n] / 2;
    });
    EXPECT_EQ(seen, (std::multiset<std::size_t>{0, 1, 2, 3, 4}));
    EXPECT_DOUBLE_EQ(rate.part, 1.0);
    EXPECT_NEAR(rate.all_s * rate.texels, 80.0, 1e-6);
    EXPECT_DOUBLE_EQ(rate.onSurface, (2 + 3 + 0 + 32 + 1) / 80.0);
}

// Without any time each thread lights one piece; the rest is scaled by texels, not by pieces.
TEST(BakeRate, WithoutTimeIsScaledFromWhatWasLit) {
    const std::vector<std::size_t> sizes(1000, 8);
    const BakeRate rate = bakeRate(sizes, 0, 1, [&](std::size_t) { return std::size_t{8}; });
    const double pieces = rate.part * 1000;
    EXPECT_GE(pieces, 1);
    EXPECT_LE(pieces, threadCount() + 1e-9);
    EXPECT_NEAR(rate.all_s, 8000 / rate.texels, 1e-9 * rate.all_s);
    EXPECT_DOUBLE_EQ(rate.onSurface, 1.0);
}

TEST(BakeRate, BricksHoldEveryTexelOnce) {
    const glm::ivec3 size(17, 9, 20);
    for (const auto& pieces : {shuffledBricks(size), inSmallPieces(shuffledBricks(size))}) {
        std::vector<int> count(static_cast<std::size_t>(size.x * size.y * size.z), 0);
        for (const TexelPiece& piece : pieces) {
            EXPECT_LE(piece.size(), 512u);
            for (const glm::ivec3& t : piece)
                ++count[static_cast<std::size_t>((t.z * size.y + t.y) * size.x + t.x)];
        }
        EXPECT_TRUE(std::all_of(count.begin(), count.end(), [](int n) { return n == 1; }));
    }
    for (const TexelPiece& piece : inSmallPieces(shuffledBricks(size))) EXPECT_LE(piece.size(), 64u);
}

}  // namespace
}  // namespace stereonav
