// How often values occur: counted one by one, and as bars of any width.
#include "engine/volume/value_counts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

GreyVolume volumeOf(const glm::ivec3& size) {
    VolumeFrame frame;
    frame.size = size;
    return GreyVolume(frame);
}

ValueCounts counted(const GreyVolume& grey, int border = 0, const MaskVolume* near = nullptr) {
    Progress progress;
    return countValues(grey, border, near, progress);
}

std::uint64_t sumOf(const ValueCounts& counts) {
    return std::accumulate(counts.counts.begin(), counts.counts.end(), std::uint64_t{0});
}

TEST(ValueCounts, AreThoseOfEveryVoxel) {
    GreyVolume grey = volumeOf({23, 17, 29});
    std::vector<std::uint64_t> expected(65536);
    for (std::size_t n = 0; n < grey.frame.count(); ++n) {
        grey.values[n] = static_cast<std::int16_t>((n * 7919) % 65536 - 32768);
        ++expected[static_cast<std::size_t>(grey.values[n] + 32768)];
    }
    const int threads = threadCount();
    EXPECT_EQ(counted(grey).counts, expected);
    setThreadCount(1);
    EXPECT_EQ(counted(grey).counts, expected) << "whatever the number of threads";
    setThreadCount(threads);
}

TEST(ValueCounts, LeaveABorderOut) {
    GreyVolume grey = volumeOf({5, 6, 7});
    std::fill_n(grey.values.data(), grey.frame.count(), std::int16_t{-1000});
    for (int k = 1; k < 6; ++k)
        for (int j = 1; j < 5; ++j)
            for (int i = 1; i < 4; ++i) grey.at(i, j, k) = 40;
    const ValueCounts counts = counted(grey, 1);
    EXPECT_EQ(sumOf(counts), 3u * 4 * 5);
    EXPECT_EQ(counts.lowest(), 40);
    EXPECT_EQ(counts.highest(), 40);
    EXPECT_TRUE(counted(volumeOf({2, 9, 9}), 1).empty() || sumOf(counted(volumeOf({2, 9, 9}), 1)) == 0);
}

TEST(ValueCounts, CountOnlyWhatLiesNear) {
    GreyVolume grey = volumeOf({64, 16, 16});
    grey.at(3, 3, 3) = 100;
    grey.at(60, 3, 3) = 200;
    MaskVolume near(grey.frame);
    near.at(0, 0, 0) = 3;
    const ValueCounts counts = counted(grey, 0, &near);
    EXPECT_EQ(counts.highest(), 100);
    EXPECT_EQ(sumOf(counts), 512u) << "one block";
    EXPECT_EQ(sumOf(counted(grey, 0, nullptr)), 64u * 16 * 16);
}

TEST(ValueCounts, OfNothingAreNothing) {
    const ValueCounts none = counted(GreyVolume());
    EXPECT_TRUE(none.empty());
    EXPECT_EQ(none.lowest(), 0);
    EXPECT_EQ(none.highest(), 0);
    EXPECT_EQ(barsOf(none, 0, 1, 3), std::vector<float>(3));
}

TEST(ValueCounts, AreCancelled) {
    Progress progress;
    progress.cancel();
    const GreyVolume grey = volumeOf({8, 8, 8});
    EXPECT_THROW(countValues(grey, 0, nullptr, progress), Cancelled);
}

TEST(ValueBars, AreLogarithmsOfTheHighest) {
    GreyVolume grey = volumeOf({10, 10, 10});
    for (std::size_t n = 0; n < 10; ++n) grey.values[n] = 300;
    const std::vector<float> bars = barsOf(counted(grey), -100, 500, 6);
    const float few = static_cast<float>(std::log1p(10) / std::log1p(990));
    EXPECT_EQ(bars[1], 1);
    EXPECT_FLOAT_EQ(bars[4], few);
    for (const std::size_t n : {0u, 2u, 3u, 5u}) EXPECT_EQ(bars[n], 0) << n;
}

TEST(ValueBars, OfOneValueStandWhereItIs) {
    const GreyVolume grey = volumeOf({4, 4, 4});
    const std::vector<float> bars = barsOf(counted(grey), -1e-3, 1e-3, 4);
    EXPECT_EQ(bars, std::vector<float>(4, 1)) << "finer than its step there is nothing else";
    EXPECT_EQ(barsOf(counted(grey), 10, 20, 4), std::vector<float>(4));
}

TEST(ValueBars, HaveNoGapsBetweenNumbersThatOccur) {
    GreyVolume grey = volumeOf({100, 1, 1});
    for (int i = 0; i < 100; ++i) grey.at(i, 0, 0) = static_cast<std::int16_t>(i);
    grey.scale = 0.5;
    grey.offset = 7;
    for (const int bars : {7, 99, 100, 333})
        for (const float bar : barsOf(counted(grey), 7.25, 55.75, bars)) EXPECT_GT(bar, 0) << bars;
    grey.scale = -0.5;
    for (const float bar : barsOf(counted(grey), -41.75, 6.75, 100)) EXPECT_GT(bar, 0);
}

TEST(ValueBars, OfNoViewAreFlat) {
    const ValueCounts counts = counted(volumeOf({4, 4, 4}));
    const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
    for (const auto& [low, high] :
         {std::pair{0.0, 0.0}, {1.0, -1.0}, {nan, 1.0}, {0.0, nan}, {-infinite, infinite}})
        EXPECT_EQ(barsOf(counts, low, high, 2), std::vector<float>(2)) << low << " " << high;
    EXPECT_TRUE(barsOf(counts, -1, 1, 0).empty());
    EXPECT_TRUE(barsOf(counts, -1, 1, -3).empty());
    EXPECT_GT(barsOf(counts, -1e30, 1e30, 3)[1], 0) << "huge ranges";
    ValueCounts flat = counts;
    flat.scale = 0;
    EXPECT_EQ(barsOf(flat, -1, 1, 2), std::vector<float>(2));
}

}  // namespace
}  // namespace stereonav
