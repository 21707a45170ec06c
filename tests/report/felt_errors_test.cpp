// What is felt, summed over frames: by one who sees all of them, or by several.
#include "app/report/felt_errors.h"

#include <gtest/gtest.h>

#include <random>

namespace stereonav {
namespace {

constexpr int kWidth = 24, kHeight = 16;

Plane<PackedColor> noise(std::mt19937& random) {
    Plane<PackedColor> picture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            picture.at(x, y) = packColor(glm::vec3(static_cast<float>(random() % 256) / 255));
    return picture;
}

// Adds a frame of noise, whose eyes differ from the truth everywhere.
void addFrame(unsigned seed, FeltErrors& errors) {
    std::mt19937 random(seed);
    FeltTruth truth{noise(random), noise(random), noise(random), Plane<float>(kWidth, kHeight),
                    Plane<std::uint8_t>(kWidth, kHeight)};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            truth.columns.at(x, y) = static_cast<float>(x);
            truth.edges.at(x, y) = random() % 3 == 0 ? 255 : 0;
        }
    const Plane<PackedColor> left = noise(random), right = noise(random);
    errors.add(truth, {left, right}, noise(random));
}

TEST(FeltErrors, OfFramesSummedApartAreThoseOfOneSum) {
    FeltErrors all, first, second;
    addFrame(1, all);
    addFrame(2, all);
    addFrame(1, first);
    addFrame(2, second);
    ASSERT_GT(second.butteraugli(), 0);
    ASSERT_NE(first.flicker(), second.flicker());
    FeltErrors sum;
    sum.add(first);
    sum.add(second);
    EXPECT_EQ(sum.flicker(), all.flicker());
    EXPECT_EQ(sum.rivalry(), all.rivalry());
    EXPECT_EQ(sum.butteraugli(), all.butteraugli());
    EXPECT_EQ(sum.others(), all.others());
    EXPECT_NE(sum.others(), first.others());
}

}  // namespace
}  // namespace stereonav
