// Distances against a brute-force search in double precision, and against closed forms.
#include "engine/volume/distance_transform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "test_volumes.h"

namespace stereonav {
namespace {

using test::Random;

// Distance in metres to the nearest voxel that is 0, infinity without one; beyond the faces by the nearest
// layer there.
double searched(const MaskVolume& mask, const glm::ivec3& at, bool outsideIsSeed) {
    const VolumeFrame& frame = mask.frame;
    double least = std::numeric_limits<double>::infinity();
    if (outsideIsSeed)
        for (int axis = 0; axis < 3; ++axis)
            least =
                std::min(least, std::min(at[axis] + 1, frame.size[axis] - at[axis]) * frame.spacing[axis]);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                if (mask.at(i, j, k) == 0)
                    least =
                        std::min(least, glm::length(glm::dvec3(at - glm::ivec3(i, j, k)) * frame.spacing));
    return least;
}

// Checks up to `checks` voxels. Distances are rounded down, by less than a unit and what is stated.
void expectExact(const MaskVolume& mask, bool outsideIsSeed, double unit, int checks, unsigned seed) {
    const DistanceVolume distance = distanceToOutside(mask, outsideIsSeed, unit);
    const VolumeFrame& frame = mask.frame;
    ASSERT_EQ(distance.frame.size, frame.size);
    ASSERT_GT(distance.unit, 0);
    Random random(seed);
    const bool all = static_cast<std::size_t>(checks) >= frame.count();
    const int count = all ? static_cast<int>(frame.count()) : checks;
    for (int n = 0; n < count; ++n) {
        const int at = all ? n : random.below(static_cast<int>(frame.count()));
        const glm::ivec3 v(at % frame.size.x, at / frame.size.x % frame.size.y,
                           at / (frame.size.x * frame.size.y));
        if (mask.at(v) == 0) {
            ASSERT_EQ(distance.at(v), 0);
            continue;
        }
        const double truth = searched(mask, v, outsideIsSeed);
        if (std::isinf(truth)) {
            ASSERT_EQ(distance.at(v), DistanceVolume::kNoSeed);
            continue;
        }
        const double units = std::min(truth / distance.unit, 65534.0);
        ASSERT_LE(distance.at(v), units * (1 + 1e-12)) << v.x << " " << v.y << " " << v.z;
        ASSERT_GE(distance.at(v), std::floor(units * (1 - 2.5e-7))) << v.x << " " << v.y << " " << v.z;
    }
}

MaskVolume randomMask(const glm::ivec3& size, const glm::dvec3& spacing, double share, unsigned seed) {
    MaskVolume mask(test::slantedFrame(size, spacing));
    Random random(seed);
    for (std::size_t n = 0; n < mask.values.size(); ++n)
        mask.values[n] = random.between(0, 1) < share ? static_cast<std::uint8_t>(1 + random.below(255)) : 0;
    return mask;
}

TEST(DistanceTransform, IsWhatASearchFinds) {
    const glm::ivec3 sizes[] = {{1, 1, 1},    {2, 1, 1},   {1, 9, 1},   {1, 1, 33}, {17, 1, 5},
                                {16, 16, 16}, {33, 7, 20}, {15, 40, 3}, {5, 5, 5},  {40, 40, 40}};
    const glm::dvec3 spacings[] = {
        glm::dvec3(1.0), glm::dvec3(0.8, 0.8, 0.7) * 1e-3, {1, 1, 20}, {3e-3, 1e-3, 2e-3}};
    unsigned seed = 1;
    for (const glm::ivec3& size : sizes)
        for (const glm::dvec3& spacing : spacings)
            for (const double share : {0.0, 0.3, 0.9, 0.9995, 1.0})
                for (const bool outsideIsSeed : {true, false}) {
                    ++seed;
                    SCOPED_TRACE(testing::Message() << size.x << "x" << size.y << "x" << size.z << " share "
                                                    << share << " seed " << seed);
                    const MaskVolume mask = randomMask(size, spacing, share, seed);
                    const int checks = size.x * size.y * size.z > 20000 ? 40 : 400;
                    expectExact(mask, outsideIsSeed, 0, checks, seed);
                }
}

TEST(DistanceTransform, FindsOneSeedAnywhere) {
    Random random(5);
    for (int n = 0; n < 40; ++n) {
        MaskVolume mask = randomMask({21, 18, 37}, {0.8e-3, 0.8e-3, 0.7e-3}, 1.0, 1);
        mask.at(random.below(21), random.below(18), random.below(37)) = 0;
        expectExact(mask, false, 0, 60, 100 + static_cast<unsigned>(n));
    }
}

TEST(DistanceTransform, KeepsToTheMasksBox) {
    // A block of mask in one corner, at a face, and in the middle of a larger volume.
    for (const glm::ivec3& first : {glm::ivec3(0), glm::ivec3(11, 0, 8), glm::ivec3(19, 14, 10)})
        for (const bool outsideIsSeed : {true, false}) {
            MaskVolume mask(VolumeFrame{{30, 24, 18}, {1, 1.5, 0.7}});
            for (int k = 0; k < 8; ++k)
                for (int j = 0; j < 10; ++j)
                    for (int i = 0; i < 11; ++i) mask.at(first + glm::ivec3(i, j, k)) = 1;
            expectExact(mask, outsideIsSeed, 0, 2000, 3);
        }
}

TEST(DistanceTransform, IsExactForWholeNumbers) {
    MaskVolume mask(VolumeFrame{{70, 1, 1}, glm::dvec3(0.001)});
    for (int i = 1; i < 70; ++i) mask.at(i, 0, 0) = 1;
    const DistanceVolume distance = distanceToOutside(mask, false);
    for (int i = 0; i < 70; ++i) EXPECT_EQ(distance.at(i, 0, 0), 64 * i);
    EXPECT_DOUBLE_EQ(distance.unit, 0.001 / 64);
    // Three, four, five: 5 voxels across the middle axis.
    MaskVolume flat(VolumeFrame{{9, 9, 9}, glm::dvec3(2.0)});
    std::fill(flat.values.data(), flat.values.data() + flat.values.size(), std::uint8_t{1});
    flat.at(0, 4, 0) = 0;
    EXPECT_EQ(distanceToOutside(flat, false, 1.0).at(3, 4, 4), 10);
    EXPECT_EQ(distanceToOutside(flat, false, 3.0).at(3, 4, 4), 3);
    EXPECT_EQ(distanceToOutside(flat, false, 100.0).at(3, 4, 4), 0);
}

TEST(DistanceTransform, LargeDistancesEndAtTheLargestNumber) {
    MaskVolume mask(VolumeFrame{{1100, 1, 1}});
    for (int i = 1; i < 1100; ++i) mask.at(i, 0, 0) = 1;
    const DistanceVolume distance = distanceToOutside(mask, false);
    EXPECT_EQ(distance.at(1023, 0, 0), 1023 * 64);
    EXPECT_EQ(distance.at(1024, 0, 0), 65534);
    EXPECT_EQ(distance.at(1099, 0, 0), 65534);
    expectExact(randomMask({9, 9, 9}, {1, 1, 1e9}, 0.8, 4), true, 0, 800, 1);
}

TEST(DistanceTransform, IsTheSameOnAnyNumberOfThreads) {
    const MaskVolume mask = randomMask({50, 41, 33}, {0.8, 0.8, 0.7}, 0.999, 9);
    const int before = threadCount();
    setThreadCount(1);
    const DistanceVolume one = distanceToOutside(mask);
    setThreadCount(5);
    const DistanceVolume five = distanceToOutside(mask);
    setThreadCount(before);
    for (std::size_t n = 0; n < one.values.size(); ++n) ASSERT_EQ(one.values[n], five.values[n]) << n;
}

TEST(DistanceTransform, IsTheSameForEveryInstructionSet) {
    for (const glm::dvec3& spacing : {glm::dvec3(1.0), glm::dvec3(0.8, 0.8, 0.7)}) {
        const MaskVolume mask = randomMask({50, 41, 33}, spacing, 0.999, 10);
        const DistanceVolume plain = distanceToOutside(mask, true, 0, SimdTarget::Plain);
        expectExact(mask, true, 0, 30, 2);
        for (const SimdTarget target : simdTargets()) {
            const DistanceVolume wide = distanceToOutside(mask, true, 0, target);
            for (std::size_t n = 0; n < plain.values.size(); ++n)
                ASSERT_EQ(plain.values[n], wide.values[n]) << n;
        }
    }
}

TEST(DistanceTransform, UpToADistanceIsTheSame) {
    for (const glm::dvec3& spacing : {glm::dvec3(1.0), glm::dvec3(0.8, 1.1, 0.7)})
        for (const bool outside : {true, false}) {
            const MaskVolume mask = randomMask({50, 41, 33}, spacing, 0.9997, 11);
            const DistanceVolume all = distanceToOutside(mask, outside);
            const double atMost = 6.3;
            const DistanceVolume some = distanceToOutside(mask, outside, 0, SimdTarget::Auto, atMost);
            const int most = static_cast<int>(atMost / all.unit);
            int beyond = 0;
            for (std::size_t n = 0; n < all.values.size(); ++n) {
                if (all.values[n] < most - 1)
                    ASSERT_EQ(some.values[n], all.values[n]) << n;
                else
                    ASSERT_NEAR(some.values[n], most, 1) << n;
                beyond += all.values[n] > most + 1;
            }
            EXPECT_GT(beyond, 100);
        }
    MaskVolume full(VolumeFrame{{5, 5, 5}});
    std::fill_n(full.values.data(), full.values.size(), std::uint8_t{1});
    EXPECT_EQ(distanceToOutside(full, false, 1, SimdTarget::Auto, 3.5).at(2, 2, 2), 3);
    EXPECT_THROW(distanceToOutside(full, false, 1, SimdTarget::Auto, 0), Error);
    EXPECT_THROW(distanceToOutside(full, false, 1, SimdTarget::Auto, std::nan("")), Error);
}

// A mask as large as this: squares are held for some lines at a time.
TEST(DistanceTransform, OfALargeMaskIsExact) {
    MaskVolume mask(VolumeFrame{{256, 150, 1040}});
    std::fill_n(mask.values.data(), mask.values.size(), std::uint8_t{1});
    Random random(5);
    for (int n = 0; n < 20000; ++n) {
        const glm::ivec3 v(random.below(256), random.below(150), random.below(1040));
        const glm::ivec3 away = glm::abs(v - glm::ivec3(120, 65, 520));  // a hollow across blocks of lines
        if (std::max({away.x, away.y, away.z}) > 25) mask.at(v) = 0;
    }
    const DistanceVolume distance = distanceToOutside(mask, true, 0.25);
    for (int n = 0; n < 400; ++n) {
        glm::ivec3 v(random.below(256), random.below(150), random.below(1040));
        if (n % 2) v = {100 + random.below(40), 40 + random.below(50), 500 + random.below(40)};  // in it
        const int reach = distance.at(v) / 4 + 2;
        const glm::ivec3 low = glm::max(v - reach, 0), high = glm::min(v + reach, mask.frame.size - 1);
        double least = std::min({v.x + 1, v.y + 1, v.z + 1, 256 - v.x, 150 - v.y, 1040 - v.z});
        for (int k = low.z; k <= high.z; ++k)
            for (int j = low.y; j <= high.y; ++j)
                for (int i = low.x; i <= high.x; ++i)
                    if (!mask.at(i, j, k))
                        least = std::min(least, glm::length(glm::dvec3(v - glm::ivec3(i, j, k))));
        ASSERT_EQ(distance.at(v), static_cast<int>(4 * least)) << v.x << " " << v.y << " " << v.z;
    }
}

TEST(DistanceTransform, RefusesUnitsAndSpacingsThatAreNotPositive) {
    MaskVolume mask(VolumeFrame{{4, 4, 4}});
    for (const double unit :
         {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(distanceToOutside(mask, true, unit), Error) << unit;
    mask.frame.spacing.y = 0;
    EXPECT_THROW(distanceToOutside(mask), Error);
    EXPECT_TRUE(distanceToOutside(MaskVolume()).empty());
}

}  // namespace
}  // namespace stereonav
