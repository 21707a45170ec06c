// Memory that is taken page by page, given back in parts, and read as another type.
#include "engine/base/lazy_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/pages.h"

namespace stereonav {
namespace {

TEST(LazyArray, IsReadAsAnotherType) {
    LazyArray<unsigned char> bytes(7);
    bytes[0] = 1;
    bytes[1] = 2;
    bytes[6] = 9;
    const unsigned char* at = bytes.data();
    const LazyArray<std::int16_t> numbers = std::move(bytes).as<std::int16_t>();
    EXPECT_EQ(static_cast<const void*>(numbers.data()), at);
    ASSERT_EQ(numbers.size(), 3u);  // whole ones
    EXPECT_EQ(numbers[0], 0x0201);
    EXPECT_TRUE(bytes.empty());
    EXPECT_EQ(bytes.data(), nullptr);
    EXPECT_TRUE(LazyArray<unsigned char>().as<std::int16_t>().empty());
}

TEST(LazyArray, GivesWholePagesBack) {
    constexpr std::size_t kCount = 1 << 20;
    LazyArray<std::uint8_t> array(kCount);
    std::fill_n(array.data(), kCount, std::uint8_t{7});
    ASSERT_EQ(residentBytes(array), kCount);
    array.release(100, kCount / 2);
    EXPECT_LT(residentBytes(array), kCount / 2 + (1 << 17));
    EXPECT_EQ(array[99], 7);  // what is beside it stays
    EXPECT_EQ(array[100 + kCount / 2], 7);
    EXPECT_EQ(array[kCount / 4], 0);
    array.release(kCount - 1, 1);  // less than a page: nothing
    EXPECT_EQ(array[kCount - 1], 7);
    array.release(0, 0);
    EXPECT_EQ(array[0], 7);
}

TEST(LazyArray, GivesPagesOfZerosBack) {
    constexpr std::size_t kCount = 1 << 20, kSteps = 8, kStep = kCount / kSteps;
    LazyArray<std::uint8_t> array(kCount);
    std::fill_n(array.data(), kCount, std::uint8_t{7});
    std::fill_n(&array[kStep], kStep * (kSteps - 1), std::uint8_t{0});
    array[kCount - 1] = array[kCount / 2 + 1] = 9;
    const std::vector<std::uint8_t> before(array.data(), array.data() + kCount);
    releaseZeroPages(array, 1, 0);
    releaseZeroPages(array, 1, 100);
    releaseZeroPages(array, 1, kCount / 4);  // what lies beyond these elements stays
    EXPECT_GT(residentBytes(array), 3 * kCount / 4);
    releaseZeroPages(array, 0, kCount);
    EXPECT_LT(residentBytes(array), kStep + kCount / 2);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), array.data()));
}

}  // namespace
}  // namespace stereonav
