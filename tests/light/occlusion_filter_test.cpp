// The separable filters of occlusion against whole boxes, voxel by voxel: sizes, radii, borders, extreme
// values, and the same bytes from every thread count and instruction set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/light/occlusion/occlusion.h"
#include "occlusion_brute.h"

namespace stereonav {
namespace {

using test::boxAt;
using test::bytesAway;
using test::opennessOf;

constexpr auto kMethods = test::kOcclusionMethods;

OpennessVolume estimate(const GreyVolume& volume, OcclusionMethod method, const glm::ivec3& radius,
                        SimdTarget target = SimdTarget::Auto) {
    Progress progress;
    return estimateOpenness(volume, method, radius, progress, target);
}

// Noise between bounds with a few smooth blobs, so that boxes differ.
GreyVolume noise(const glm::ivec3& size, unsigned seed, int low, int high) {
    GreyVolume volume(VolumeFrame{size, glm::dvec3(1e-3)});
    std::mt19937 engine(seed);
    const double range = static_cast<double>(high) - low;
    for (std::size_t n = 0; n < volume.values.size(); ++n) {
        const double wave = 0.5 + 0.5 * std::sin(0.05 * static_cast<double>(n) + seed);
        const double share = 0.5 * wave + 0.5 * static_cast<double>(engine()) / 4294967295.0;
        volume.values[n] = static_cast<std::int16_t>(std::lround(low + range * share));
    }
    return volume;
}

// In bytes: 0.5 for rounding to them, the rest for single precision: near the mean Gaussian is sqrt(1 - e), e
// near 1 and off by 2^-24, so off by up to 255 * 2^-13.
constexpr double kTolerance = 0.5 + 255.0 / 8192;

void expectLikeBrute(const GreyVolume& volume, const glm::ivec3& radius, const std::string& what) {
    const glm::ivec3 size = volume.frame.size;
    for (const OcclusionMethod method : kMethods) {
        const OpennessVolume openness = estimate(volume, method, radius);
        double worst = 0;
        for (int k = 0; k < size.z; ++k)
            for (int j = 0; j < size.y; ++j)
                for (int i = 0; i < size.x; ++i) {
                    const double truth =
                        opennessOf(boxAt(volume, {i, j, k}, radius), volume.at(i, j, k), method);
                    worst = std::max(worst, bytesAway(openness.at(i, j, k), truth));
                }
        EXPECT_LE(worst, kTolerance) << what << ", method " << static_cast<int>(method);
    }
}

TEST(OcclusionFilter, IsWhatWholeBoxesSay) {
    std::mt19937 engine(7);
    const auto below = [&](int count) { return static_cast<int>(engine() % static_cast<unsigned>(count)); };
    for (unsigned n = 0; n < 24; ++n) {
        const glm::ivec3 size(1 + below(40), 1 + below(16), 1 + below(16));
        const glm::ivec3 radius(below(7), below(7), 1 + below(9));
        const GreyVolume volume = noise(size, n, -1000, 3000);
        expectLikeBrute(volume, radius,
                        "size " + std::to_string(size.x) + " " + std::to_string(size.y) + " " +
                            std::to_string(size.z) + " radius " + std::to_string(radius.x) + " " +
                            std::to_string(radius.y) + " " + std::to_string(radius.z));
    }
}

TEST(OcclusionFilter, GivenExponentsAndDeviationsCount) {
    const GreyVolume volume = noise({37, 11, 13}, 12, -1000, 3000);
    const glm::ivec3 radius(4, 3, 5);
    Progress progress;
    for (const OcclusionMethod method : {OcclusionMethod::Reconstructed, OcclusionMethod::DrawnIn})
        for (const double number : {1.0, 1.7, 6.0, 10.0}) {
            OcclusionEstimate given(method);
            (method == OcclusionMethod::DrawnIn ? given.deviations : given.beta) = number;
            const OpennessVolume openness = estimateOpenness(volume, given, radius, progress);
            double worst = 0;
            for (int k = 0; k < 13; ++k)
                for (int j = 0; j < 11; ++j)
                    for (int i = 0; i < 37; ++i)
                        worst = std::max(worst, bytesAway(openness.at(i, j, k),
                                                          opennessOf(boxAt(volume, {i, j, k}, radius),
                                                                     volume.at(i, j, k), given)));
            EXPECT_LE(worst, kTolerance) << static_cast<int>(method) << " " << number;
        }
    const auto refused = [&](OcclusionMethod method, double beta, double deviations) {
        OcclusionEstimate wrong(method);
        wrong.beta = beta;
        wrong.deviations = deviations;
        EXPECT_THROW(estimateOpenness(volume, wrong, radius, progress), Error) << beta << " " << deviations;
    };
    for (const double beta : {-1.0, 0.001, 1000.0, std::nan("")})
        refused(OcclusionMethod::Reconstructed, beta, 3);
    for (const double deviations : {0.0, 0.5, 11.0, std::nan("")})
        refused(OcclusionMethod::DrawnIn, 0, deviations);
}

TEST(OcclusionFilter, RadiiBeyondTheVolumeTakeAllOfIt) {
    expectLikeBrute(noise({19, 7, 11}, 3, 0, 255), glm::ivec3(64), "radius 64");
    expectLikeBrute(noise({33, 5, 4}, 4, 0, 255), glm::ivec3(12, 64, 1), "radius 12 64 1");
}

TEST(OcclusionFilter, LinesAndSingleVoxels) {
    expectLikeBrute(noise({1, 1, 57}, 5, 0, 4000), glm::ivec3(5), "along k");
    expectLikeBrute(noise({1, 57, 1}, 6, 0, 4000), glm::ivec3(5), "along j");
    expectLikeBrute(noise({57, 1, 1}, 7, 0, 4000), glm::ivec3(5), "along i");
    expectLikeBrute(noise({1, 1, 1}, 8, 0, 4000), glm::ivec3(5), "one voxel");
}

TEST(OcclusionFilter, LargestRadiusAndEndsOfTheRangeStayExact) {
    // Half of the values at either end, so that sums and sums of squares are as large as they can be.
    for (const int low : {-32768, 32766}) {
        GreyVolume volume = noise({130, 131, 129}, 9, low, low < 0 ? -32767 : 32767);
        volume.at(64, 64, 64) = 0;
        const glm::ivec3 radius(64);
        for (const OcclusionMethod method : kMethods) {
            const OpennessVolume openness = estimate(volume, method, radius);
            for (const glm::ivec3& voxel : {glm::ivec3(64, 64, 64), glm::ivec3(65, 63, 60), glm::ivec3(0)}) {
                const double truth = opennessOf(boxAt(volume, voxel, radius), volume.at(voxel), method);
                EXPECT_LE(bytesAway(openness.at(voxel), truth), kTolerance)
                    << low << ", method " << static_cast<int>(method);
            }
        }
    }
}

TEST(OcclusionFilter, OneVoxelThatDiffersByOneInTheLargestBoxIsNotLost) {
    GreyVolume volume(VolumeFrame{glm::ivec3(129), glm::dvec3(1e-3)});
    std::fill_n(volume.values.data(), volume.values.size(), std::int16_t{32766});
    volume.at(64, 64, 64) = 32767;
    EXPECT_EQ(estimate(volume, OcclusionMethod::Gaussian, glm::ivec3(64)).at(64, 64, 64), 255);
    EXPECT_EQ(estimate(volume, OcclusionMethod::Chebyshev, glm::ivec3(64)).at(64, 64, 64), 255);
    for (const OcclusionMethod method : {OcclusionMethod::Reconstructed, OcclusionMethod::DrawnIn}) {
        const OpennessVolume openness = estimate(volume, method, glm::ivec3(64));
        EXPECT_EQ(openness.at(64, 64, 64), 255) << static_cast<int>(method);
        EXPECT_EQ(openness.at(64, 63, 64), 0) << static_cast<int>(method);
    }
}

template <typename Make>
void expectSameBytes(const Make& make) {
    const Volume<std::uint8_t> first = make(SimdTarget::Plain);
    const auto same = [&](const Volume<std::uint8_t>& other) {
        return std::equal(first.values.data(), first.values.data() + first.values.size(),
                          other.values.data());
    };
    for (const NamedSimdTarget& named : kSimdTargets) {
        try {
            availableTarget(named.target);
        } catch (const Error&) {
            continue;
        }
        EXPECT_TRUE(same(make(named.target))) << named.name;
    }
    const int threads = threadCount();
    for (int n = 1; n <= 4; ++n) {
        setThreadCount(n);
        EXPECT_TRUE(same(make(SimdTarget::Auto))) << n << " threads";
    }
    setThreadCount(threads);
}

TEST(OcclusionFilter, SameBytesFromEveryInstructionSetAndThreadCount) {
    const GreyVolume volume = noise({83, 41, 37}, 11, -1024, 3071);
    for (const OcclusionMethod method : kMethods)
        expectSameBytes(
            [&](SimdTarget target) { return estimate(volume, method, glm::ivec3(6, 5, 4), target); });
    expectSameBytes([&](SimdTarget target) {
        Progress progress;
        return varianceModulation(volume, glm::ivec3(5), 900, progress, target);
    });
}

TEST(OcclusionFilter, BandsOfTallVolumesMeet) {
    // A row of boxes takes 1.5 MB, with squares 3 MB: several bands.
    const GreyVolume volume = noise({16, 70, 3000}, 12, 0, 1000);
    const glm::ivec3 radius(3);
    for (const OcclusionMethod method : {OcclusionMethod::Reconstructed, OcclusionMethod::DrawnIn}) {
        const OpennessVolume openness = estimate(volume, method, radius);
        for (int j = 0; j < volume.frame.size.y; ++j) {
            const glm::ivec3 voxel(5, j, 1000 + 7 * j);
            const double truth = opennessOf(boxAt(volume, voxel, radius), volume.at(voxel), method);
            ASSERT_LE(bytesAway(openness.at(voxel), truth), kTolerance)
                << j << ", method " << static_cast<int>(method);
        }
    }
}

TEST(OcclusionFilter, EndsWithinThreeDeviationsStayWhereTheyAre) {
    // Uniform noise reaches sqrt(3) standard deviations to either side.
    GreyVolume volume(VolumeFrame{{40, 30, 20}, glm::dvec3(1e-3)});
    std::mt19937 engine(17);
    for (std::size_t n = 0; n < volume.values.size(); ++n)
        volume.values[n] = static_cast<std::int16_t>(static_cast<int>(engine() >> 20) - 2048);
    const OpennessVolume plain = estimate(volume, OcclusionMethod::Reconstructed, glm::ivec3(5));
    const OpennessVolume drawnIn = estimate(volume, OcclusionMethod::DrawnIn, glm::ivec3(5));
    for (std::size_t n = 0; n < plain.values.size(); ++n) ASSERT_EQ(drawnIn.values[n], plain.values[n]) << n;
}

TEST(OcclusionFilter, TwoFarVoxelsDrawBothEndsIn) {
    // Noise of -100..100 between a far voxel on either side: t is linear, 1/2 + (v - mean) / (6 sigma).
    GreyVolume volume = noise({11, 11, 11}, 18, -100, 100);
    volume.at(0, 0, 0) = -30000;
    volume.at(10, 10, 10) = 30000;
    const OpennessVolume drawnIn = estimate(volume, OcclusionMethod::DrawnIn, glm::ivec3(10));
    const test::Box box = boxAt(volume, glm::ivec3(5), glm::ivec3(5));
    for (const glm::ivec3& voxel : {glm::ivec3(5), glm::ivec3(4, 5, 6), glm::ivec3(1, 9, 2)}) {
        const double share = 0.5 + (volume.at(voxel) - box.mean()) / (6 * std::sqrt(box.variance()));
        EXPECT_LE(bytesAway(drawnIn.at(voxel), share), 0.501);
    }
    EXPECT_EQ(drawnIn.at(0, 0, 0), 0);
    EXPECT_EQ(drawnIn.at(10, 10, 10), 255);
}

// One voxel in `every` far away, down or up: ends that are drawn in, on one side or both.
GreyVolume noiseWithFarVoxels(unsigned seed, unsigned every, int lowest, int highest) {
    GreyVolume volume = noise({37, 15, 14}, seed, -30, 40);
    std::mt19937 engine(seed);
    for (std::size_t n = 0; n < volume.values.size(); ++n)
        if (engine() % every == 0)
            volume.values[n] = static_cast<std::int16_t>(engine() % 2 ? lowest : highest);
    return volume;
}

TEST(OcclusionFilter, FarVoxelsOnEitherSide) {
    expectLikeBrute(noiseWithFarVoxels(21, 300, -32768, 32767), glm::ivec3(4), "both");
    expectLikeBrute(noiseWithFarVoxels(22, 200, -20000, 0), glm::ivec3(5), "below");
    expectLikeBrute(noiseWithFarVoxels(23, 200, 0, 20000), glm::ivec3(5), "above");
    expectLikeBrute(noiseWithFarVoxels(24, 2500, -32768, 0), glm::ivec3(9), "few below");
    expectLikeBrute(noiseWithFarVoxels(25, 2500, 0, 32767), glm::ivec3(9), "few above");
}

TEST(OcclusionFilter, NeitherOffsetNorScaleMatters) {
    GreyVolume volume = noise({30, 20, 10}, 13, -1000, 2000);
    for (const OcclusionMethod method : kMethods) {
        const OpennessVolume plain = estimate(volume, method, glm::ivec3(4));
        volume.offset = 1e6;
        volume.scale = 0.25;
        const OpennessVolume moved = estimate(volume, method, glm::ivec3(4));
        volume.offset = 0;
        volume.scale = 1;
        for (std::size_t n = 0; n < plain.values.size(); ++n)
            ASSERT_EQ(plain.values[n], moved.values[n]) << n;
    }
}

TEST(OcclusionFilter, StoredNumbersMovedToTheEndOfTheRangeChangeNothing) {
    GreyVolume volume = noise({30, 20, 10}, 14, 0, 300), moved = noise({30, 20, 10}, 14, 0, 300);
    for (std::size_t n = 0; n < moved.values.size(); ++n)
        moved.values[n] = static_cast<std::int16_t>(moved.values[n] + 32467);
    for (const OcclusionMethod method : kMethods) {
        const OpennessVolume a = estimate(volume, method, glm::ivec3(4));
        const OpennessVolume b = estimate(moved, method, glm::ivec3(4));
        int apart = 0;
        // The mean of larger numbers is rounded to single precision once, before m is taken from it; then
        // squares are taken about another whole number, which may change the last bit.
        for (std::size_t n = 0; n < a.values.size(); ++n) {
            ASSERT_LE(std::abs(a.values[n] - b.values[n]), 1) << n;
            apart += a.values[n] != b.values[n];
        }
        EXPECT_LE(apart, 3) << static_cast<int>(method);
    }
}

void expectTurnedAround(const GreyVolume& volume) {
    GreyVolume turned(volume.frame);
    for (std::size_t n = 0; n < turned.values.size(); ++n)
        turned.values[n] = static_cast<std::int16_t>(-volume.values[n]);
    turned.scale = -1;
    for (const OcclusionMethod method : kMethods) {
        const OpennessVolume a = estimate(volume, method, glm::ivec3(3));
        const OpennessVolume b = estimate(turned, method, glm::ivec3(3));
        for (std::size_t n = 0; n < a.values.size(); ++n)
            ASSERT_LE(std::abs(a.values[n] - b.values[n]), 1) << n;
    }
}

TEST(OcclusionFilter, NegativeScaleTurnsOpenAndOccludedAround) {
    expectTurnedAround(noise({25, 14, 12}, 15, 0, 500));
    expectTurnedAround(noiseWithFarVoxels(26, 200, -20000, 100));
    expectTurnedAround(noiseWithFarVoxels(27, 200, -100, 20000));
}

TEST(OcclusionFilter, EvenBoxesAreHalfOpen) {
    GreyVolume volume(VolumeFrame{glm::ivec3(9, 8, 7), glm::dvec3(1e-3)});
    for (const int value : {-32768, -1000, 0, 32767}) {
        std::fill_n(volume.values.data(), volume.values.size(), static_cast<std::int16_t>(value));
        for (const OcclusionMethod method : kMethods) {
            const OpennessVolume openness = estimate(volume, method, glm::ivec3(3));
            for (std::size_t n = 0; n < openness.values.size(); ++n)
                ASSERT_EQ(openness.values[n], 128) << value;
        }
    }
    volume.scale = 0;
    volume.at(3, 3, 3) = -5;
    EXPECT_EQ(estimate(volume, OcclusionMethod::Gaussian, glm::ivec3(3)).at(3, 3, 3), 128);
}

TEST(OcclusionFilter, RefusesRadiiAndVolumesThatMakeNoSense) {
    const GreyVolume volume = noise({4, 4, 4}, 1, 0, 10);
    for (const glm::ivec3& radius :
         {glm::ivec3(0), glm::ivec3(65, 1, 1), glm::ivec3(1, -1, 1), glm::ivec3(1, 1, 1 << 30)})
        EXPECT_THAT([&] { estimate(volume, OcclusionMethod::Gaussian, radius); },
                    testing::ThrowsMessage<Error>(testing::HasSubstr("occlusion radius: expected 0 to 64")));
    EXPECT_THAT([&] { estimate(GreyVolume(), OcclusionMethod::Gaussian, glm::ivec3(1)); },
                testing::ThrowsMessage<Error>(testing::HasSubstr("at least one voxel")));
}

TEST(OcclusionFilter, StopsWhenCancelled) {
    Progress progress;
    progress.cancel();
    EXPECT_THROW(
        estimateOpenness(noise({4, 4, 4}, 1, 0, 10), OcclusionMethod::Gaussian, glm::ivec3(1), progress),
        Cancelled);
}

}  // namespace
}  // namespace stereonav
