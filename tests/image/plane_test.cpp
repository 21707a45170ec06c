// Planes: alignment and padding that vector code relies on, zeroed memory, copies and moves.
#include "engine/image/plane.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "engine/image/eye_image.h"

namespace stereonav {
namespace {

TEST(Plane, RowsAreAlignedAndPadded) {
    for (const int width : {1, 15, 16, 17, 48, 499, 500, 1280}) {
        Plane<float> plane(width, 3);
        EXPECT_GE(plane.stride(), width + Plane<float>::kPadding);
        for (int y = 0; y < 3; ++y)
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(plane.row(y)) % 64, 0u) << width;
    }
}

TEST(Plane, NewMemoryIsZeroPaddingToo) {
    Plane<std::uint32_t> plane(5, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < plane.stride(); ++x) EXPECT_EQ(plane.row(y)[x], 0u) << x << ", " << y;
}

TEST(Plane, PaddingMayBeOverwrittenWithoutHarm) {
    Plane<int> plane(7, 2);
    plane.at(0, 1) = 42;
    for (int x = plane.width(); x < plane.stride(); ++x) plane.row(0)[x] = -1;
    EXPECT_EQ(plane.at(0, 1), 42);
}

TEST(Plane, SameSizeKeepsTheMemoryOtherSizesDoNot) {
    Plane<int> plane(8, 8);
    plane.at(3, 3) = 5;
    const int* before = plane.row(0);
    plane.resize(8, 8);
    EXPECT_EQ(plane.row(0), before);
    EXPECT_EQ(plane.at(3, 3), 5);
    plane.resize(9, 8);
    EXPECT_EQ(plane.at(3, 3), 0);
}

TEST(Plane, NoPixelsHoldNoMemory) {
    for (const auto& [width, height] : {std::pair{0, 0}, std::pair{0, 5}, std::pair{5, 0}}) {
        Plane<int> plane(width, height);
        EXPECT_TRUE(plane.empty());
        EXPECT_EQ(plane.byteCount(), 0u);
    }
    EXPECT_TRUE(Plane<int>().empty());
}

TEST(Plane, CopyIsDeep) {
    Plane<int> first(4, 4);
    first.at(1, 2) = 9;
    Plane<int> second(first);
    second.at(1, 2) = 1;
    EXPECT_EQ(first.at(1, 2), 9);
    Plane<int> third(100, 1);
    third = first;
    EXPECT_EQ(third.width(), 4);
    EXPECT_EQ(third.at(1, 2), 9);
    const Plane<int>& self = third;
    third = self;
    EXPECT_EQ(third.at(1, 2), 9);
}

TEST(Plane, MoveTakesTheMemory) {
    Plane<int> first(4, 4);
    first.at(1, 2) = 9;
    const int* memory = first.row(0);
    Plane<int> second(std::move(first));
    EXPECT_EQ(second.row(0), memory);
    EXPECT_EQ(second.at(1, 2), 9);
}

TEST(EyeImage, HoldsShadingPlanesOnlyWhenAsked) {
    EyeImage image;
    image.resize(30, 20);
    EXPECT_TRUE(image.normal.empty());
    EXPECT_TRUE(image.baseColor.empty());
    image.resize(30, 20, ViewDependence::Highlight);
    EXPECT_EQ(image.normal.width(), 30);
    EXPECT_EQ(image.baseColor.height(), 20);
    image.resize(30, 20);
    EXPECT_TRUE(image.normal.empty()) << "a scene without view-dependent shading pays for it";
}

}  // namespace
}  // namespace stereonav
