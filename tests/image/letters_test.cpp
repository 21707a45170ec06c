// Text in pictures: what the font has is drawn, what it has not is one sign, and nothing beside the picture
// is touched.
#include "engine/letters/letters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "engine/letters/blend.h"

namespace stereonav {
namespace {

const PackedColor kLetterWhite = packColor(glm::vec3(1));

// The ink of each pixel of a picture that was black.
std::vector<PackedColor> inkOf(const Letters& letters, const std::string& text,
                               const glm::ivec2& corner = glm::ivec2(4, 3)) {
    Plane<PackedColor> image(120, 40);
    letters.draw(text, corner, kLetterWhite, image);
    std::vector<PackedColor> ink;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) ink.push_back(image.at(x, y));
    return ink;
}

long inked(const std::vector<PackedColor>& ink) {
    return std::count_if(ink.begin(), ink.end(), [](PackedColor color) { return color != 0; });
}

TEST(Letters, OfMuchOfTheWorldDiffer) {
    const Letters letters(20);
    std::set<std::vector<PackedColor>> seen;
    const std::vector<std::string> has{"e",      "\u00e9", "\u00fc", "\u0142",
                                       "\u03b1", "\u0436", "\u05d0", "\u0633"};
    for (const std::string& letter : has) {
        const auto ink = inkOf(letters, letter);
        EXPECT_GT(inked(ink), 20) << letter;
        EXPECT_TRUE(seen.insert(ink).second) << letter;
    }
    const auto none = inkOf(letters, "\ufffd");
    EXPECT_GT(inked(none), 20);
    EXPECT_FALSE(seen.count(none));
    for (const std::string text : {"\u4e2d", "\xff", "\xe4"}) EXPECT_EQ(inkOf(letters, text), none);
    for (const std::string text : {"", " ", "\t", "\n", "\x7f"}) EXPECT_EQ(inked(inkOf(letters, text)), 0);
}

TEST(Letters, TakeTheRoomTheySay) {
    for (const int height : {5, 18, 40}) {
        const Letters letters(height);
        EXPECT_EQ(letters.height(), height);
        for (const std::string text : {"Summit", "\u00c5gy|", "i"}) {
            const glm::dvec2 size = letters.sizeOf(text);
            EXPECT_EQ(size.y, height);
            Plane<PackedColor> image(300, 60);
            letters.draw(text, {10, 8}, kLetterWhite, image);
            for (int y = 0; y < image.height(); ++y)
                for (int x = 0; x < image.width(); ++x)
                    if (x < 9 || x > 10 + size.x || y < 7 || y > 8 + size.y) {
                        ASSERT_EQ(image.at(x, y), 0u) << text << " of " << height << " at " << x << " " << y;
                    }
        }
        EXPECT_EQ(letters.sizeOf("").x, 0);
        EXPECT_NEAR(letters.sizeOf("Summitsummit").x, letters.sizeOf("Summit").x + letters.sizeOf("summit").x,
                    1);
    }
    EXPECT_EQ(Letters(-3).height(), Letters::kLeastHeight);
    EXPECT_EQ(Letters(1 << 30).height(), Letters::kMostHeight);
}

TEST(Letters, AreCutAtTheBorder) {
    const Letters letters(20);
    const auto whole = inkOf(letters, "Summit", {20, 10});
    for (const glm::ivec2& corner : {glm::ivec2(-9, 10), glm::ivec2(90, 10), glm::ivec2(20, -7),
                                     glm::ivec2(20, 33), glm::ivec2(5000, 10), glm::ivec2(20, -5000)}) {
        const auto cut = inkOf(letters, "Summit", corner);
        const glm::ivec2 moved = corner - glm::ivec2(20, 10);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 120; ++x) {
                const int fromX = x - moved.x, fromY = y - moved.y;
                const bool inside = fromX >= 0 && fromY >= 0 && fromX < 120 && fromY < 40;
                ASSERT_EQ(cut[static_cast<std::size_t>(y * 120 + x)],
                          inside ? whole[static_cast<std::size_t>(fromY * 120 + fromX)] : 0u);
            }
    }
    Plane<PackedColor> none;
    letters.draw("Summit", {0, 0}, kLetterWhite, none);
    drawPlate({0, 0}, {9, 9}, 2, 255, none);
}

TEST(Letters, StandOnAPlateWithRoundCorners) {
    Plane<PackedColor> image(40, 30);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) image.at(x, y) = kLetterWhite;
    drawPlate({10, 8}, {30, 20}, 4, 255, image);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const bool inside = x >= 10 && x < 30 && y >= 8 && y < 20;
            const bool whole = (x >= 14 && x < 26) || (y >= 12 && y < 16);
            if (!inside) {
                ASSERT_EQ(image.at(x, y), kLetterWhite);
            } else if (whole) {
                ASSERT_EQ(image.at(x, y), 0u);
            }
        }
    EXPECT_NE(image.at(10, 8), 0u) << "a corner is round";
    drawPlate({-5, -5}, {2, 2}, 100, 128, image);  // a radius that is too large
    EXPECT_EQ(image.at(20, 14), 0u);
    drawPlate({6, 6}, {5, 5}, 1, 255, image);
    EXPECT_EQ(image.at(5, 5), kLetterWhite) << "an empty one";
}

TEST(Letters, BlendFromNoneToAll) {
    for (const PackedColor under : {0u, 1023u, packColor({0.1f, 0.5f, 0.9f})})
        for (const PackedColor over : {0u, packColor({1, 0.3f, 0}), packColor(glm::vec3(1))}) {
            EXPECT_EQ(blended(under, over, 0), under);
            EXPECT_EQ(blended(under, over, 255), over);
            EXPECT_EQ(blended(under, under, 77), under);
        }
}

}  // namespace
}  // namespace stereonav
