// Ranges of a grid, and its cells between two values, against looking at every cell.
#include "engine/medium/model/medium_extent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <random>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

GreyVolume randomField(std::mt19937& random, double scale, double offset) {
    VolumeFrame frame;
    frame.size = {7, 5, 6};
    GreyVolume field(frame);
    field.scale = scale;
    field.offset = offset;
    const int most = 1 + random() % 40;  // the rarer, the smaller the box
    for (std::size_t n = 0; n < frame.count(); ++n) field.values[n] = random() % most == 0 ? 300 : -20;
    return field;
}

CellBox byLooking(const GreyVolume& field, double lowest, double highest) {
    CellBox box{glm::ivec3(1000), glm::ivec3(-1)};
    for (int k = 0; k + 1 < field.frame.size.z; ++k)
        for (int j = 0; j + 1 < field.frame.size.y; ++j)
            for (int i = 0; i + 1 < field.frame.size.x; ++i) {
                double low = kInfinity, high = -kInfinity;
                for (int c = 0; c < 8; ++c) {
                    const double v =
                        field.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) * field.scale + field.offset;
                    low = std::min(low, v);
                    high = std::max(high, v);
                }
                if (!(low < highest && high > lowest)) continue;
                box.first = glm::min(box.first, glm::ivec3(i, j, k));
                box.last = glm::max(box.last, glm::ivec3(i + 1, j + 1, k + 1));
            }
    return box;
}

TEST(MediumExtent, FindsTheCellsThatLookingFinds) {
    std::mt19937 random(5);
    const double bounds[] = {-kInfinity, -400, -20, 0, 100, 300, 301, 900, kInfinity};
    for (const double scale : {1.0, -1.0, 0.5, 0.0})
        for (int round = 0; round < 20; ++round) {
            const GreyVolume field = randomField(random, scale, round % 2 ? 0 : 100);
            for (const double low : bounds)
                for (const double high : bounds) {
                    if (!(low < high)) continue;
                    const CellBox truth = byLooking(field, low, high), found = cellsBetween(field, low, high);
                    ASSERT_EQ(found.empty(), truth.empty()) << scale << " " << low << " " << high;
                    if (truth.empty()) continue;
                    ASSERT_EQ(found.first, truth.first) << scale << " " << low << " " << high;
                    ASSERT_EQ(found.last, truth.last) << scale << " " << low << " " << high;
                }
        }
}

TEST(MediumExtent, KnowsTheRange) {
    std::mt19937 random(5);
    GreyVolume field = randomField(random, -2, 10);
    field.at(3, 2, 1) = 32767;
    field.at(6, 4, 5) = -32768;
    EXPECT_EQ(valueRange(field).lowest, -2 * 32767 + 10);
    EXPECT_EQ(valueRange(field).highest, 2 * 32768 + 10);
}

TEST(MediumExtent, FlatGridsHaveNoCells) {
    VolumeFrame frame;
    frame.size = {4, 1, 4};
    EXPECT_TRUE(cellsBetween(GreyVolume(frame), -1, 1).empty());
    frame.size = {4, 4, 1};
    EXPECT_TRUE(cellsBetween(GreyVolume(frame), -1, 1).empty());
    frame.size = {4, 4, 2};
    EXPECT_FALSE(cellsBetween(GreyVolume(frame), -1, 1).empty());
    EXPECT_TRUE(cellsBetween(GreyVolume(frame), 1, -1).empty());
}

}  // namespace
}  // namespace stereonav
