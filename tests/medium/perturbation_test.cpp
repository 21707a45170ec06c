// The noise volume: the same everywhere, repeating, sound after a long time; and what it does to properties.
#include "engine/medium/model/perturbation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/hash.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

TEST(NoiseVolume, IsTheSameOnEveryMachine) {
    const NoiseVolume noise(1);
    ASSERT_EQ(noise.bytes().size(), 32u * 32 * 32 * 4);
    EXPECT_EQ(Hash().add(noise.bytes().data(), noise.bytes().size()).value(), 11607218006995048935ull);
    EXPECT_EQ(NoiseVolume(1).bytes(), noise.bytes());
    EXPECT_NE(NoiseVolume(2).bytes(), noise.bytes());
}

TEST(NoiseVolume, HasNoBiasAndUsesItsRange) {
    const NoiseVolume noise(5);
    double sum[4] = {}, squares[4] = {}, most[4] = {};
    for (std::size_t n = 0; n < noise.bytes().size(); ++n) {
        const double v = noise.bytes()[n] / 127.5 - 1;
        sum[n % 4] += v / 32768;
        squares[n % 4] += v * v / 32768;
        most[n % 4] = std::max(most[n % 4], std::abs(v));
    }
    for (int c = 0; c < 4; ++c) {
        EXPECT_NEAR(sum[c], 0, 4e-3) << c;  // half a byte's step
        EXPECT_GT(squares[c], 0.03) << c;
        EXPECT_EQ(most[c], 1) << c;
    }
}

TEST(NoiseVolume, ChannelsAndAxesAreNotAlike) {
    const std::vector<std::uint8_t> bytes = NoiseVolume(3).bytes();
    const auto correlation = [&](int a, int b, std::size_t shift) {
        double ab = 0, aa = 0, bb = 0;
        for (std::size_t n = 0; n < 32768; ++n) {
            const double u = bytes[4 * n + a] - 127.5, v = bytes[4 * ((n + shift) % 32768) + b] - 127.5;
            ab += u * v;
            aa += u * u;
            bb += v * v;
        }
        return ab / std::sqrt(aa * bb);
    };
    // 1 2 1 blurs: neighbours share 4/6 of their variance, those three away nothing.
    for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < a; ++b) EXPECT_NEAR(correlation(a, b, 0), 0, 0.06) << a << b;
        EXPECT_NEAR(correlation(a, a, 1), 4.0 / 6, 0.06) << a;
        EXPECT_NEAR(correlation(a, a, 32), 4.0 / 6, 0.06) << a;
        EXPECT_NEAR(correlation(a, a, 1024), 4.0 / 6, 0.06) << a;
        EXPECT_NEAR(correlation(a, a, 8), 0, 0.06) << a;
    }
}

TEST(NoiseVolume, RepeatsAndIsLinearBetweenTexels) {
    const NoiseVolume noise(1);
    const auto texel = [&](int i, int j, int k) {
        return noise.bytes()[4 * (static_cast<std::size_t>(k) * 1024 + j * 32 + i) + 2] / 127.5 - 1;
    };
    EXPECT_NEAR(noise.at({3, 4, 5}).z, texel(3, 4, 5), 1e-6);
    EXPECT_NEAR(noise.at({3.25, 4, 5}).z, 0.75 * texel(3, 4, 5) + 0.25 * texel(4, 4, 5), 1e-6);
    EXPECT_NEAR(noise.at({3, 31.5, 5}).z, 0.5 * texel(3, 31, 5) + 0.5 * texel(3, 0, 5), 1e-6);
    EXPECT_NEAR(noise.at({3, 4, -0.5}).z, 0.5 * texel(3, 4, 31) + 0.5 * texel(3, 4, 0), 1e-6);
    for (const double shift : {32.0, -32.0, 32e6, -3200.0})
        EXPECT_EQ(noise.at({3.25 + shift, 4.5 + shift, 5.75 - shift}), noise.at({3.25, 4.5, 5.75})) << shift;
    for (const double far : {1e300, -1e300, 1e18}) EXPECT_LE(std::abs(noise.at({far, 0, far}).x), 1) << far;
}

TEST(NoiseOffset, ComesBackAfterEachPeriodHoweverLate) {
    NoiseScale scale;
    scale.size = 0.3;
    scale.velocity = {0.6, -0.15, 0.0};
    const NoiseVolume noise(1);
    const glm::dvec3 world(0.123, 4.56, -7.89);
    for (const double time : {0.0, 0.25, 3.75})
        for (const double periods : {2.0, 1e3, 1048576.0}) {
            const double later = time + periods;  // both moves are whole repeats every 2 s
            const glm::dvec3 a = noiseTexel(scale, world, time), b = noiseTexel(scale, world, later);
            if (std::fmod(periods, 2) != 0) continue;
            const glm::vec4 n = noise.at(a), m = noise.at(b);
            for (int c = 0; c < 4; ++c) EXPECT_NEAR(n[c], m[c], 1e-6) << time << " " << periods;
            for (int axis = 0; axis < 3; ++axis) {
                const double turns = (a[axis] - b[axis]) / 32;
                EXPECT_NEAR(turns, std::round(turns), 1e-9) << time << " " << periods;
            }
        }
}

TEST(NoiseOffset, MovesWithItsVelocityAndStaysFinite) {
    NoiseScale scale;
    scale.size = 10;
    scale.velocity = {1, -2, 0};
    EXPECT_EQ(noiseOffset(scale, 3), glm::dvec3(3, -6, 0));
    EXPECT_EQ(noiseOffset(scale, 13), glm::dvec3(3, -6, 0));
    scale.velocity.x = 1e300;
    EXPECT_EQ(noiseOffset(scale, 1e300).x, 0);
    EXPECT_EQ(noiseOffset(scale, std::numeric_limits<double>::quiet_NaN()).y, 0);
}

TEST(Perturbation, ChangesPropertiesByTheSumOfItsScales) {
    const NoiseVolume noise(1);
    Perturbation p;
    p.scales.resize(2);
    p.scales[0] = {0.5, 0, 0.4f, {0.3f, 0, 0}, {0, 0.2f, 0}, {}};
    p.scales[1] = {0.05, 0, -0.7f, {}, {0, 0.5f, 0}, {}};
    for (double x = 0; x < 1; x += 0.01) {
        const glm::dvec3 world(x, 2 * x, 0.3);
        const glm::vec4 a = noise.at(world * 32.0 / 0.5), b = noise.at(world * 32.0 / 0.05);
        OpticalProperties o{10, glm::vec3(0.5f), glm::vec3(4), 0, glm::vec3(0)};
        perturb(p, noise, world, 0, o);
        EXPECT_NEAR(o.extinction, 10 * std::max(1 + 0.4f * a.w - 0.7f * b.w, 0.0f), 1e-4) << x;
        EXPECT_NEAR(o.color.x, 0.5f * (1 + 0.3f * a.x), 1e-5) << x;
        EXPECT_EQ(o.color.y, 0.5f) << x;
        EXPECT_NEAR(o.indirectExtinction.y, 4 * (1 + 0.2f * a.y + 0.5f * b.y), 1e-4) << x;
        EXPECT_LE(o.extinction, 10 * p.largestExtinctionFactor()) << x;
    }
    EXPECT_NEAR(p.largestExtinctionFactor(), 2.1, 1e-6);
}

TEST(Perturbation, DisplacesByTheSumOfItsScales) {
    const NoiseVolume noise(1);
    Perturbation p;
    p.scales.resize(2);
    p.scales[0].size = 0.5;
    p.scales[0].displacement = 0.1;
    p.scales[1].size = 0.05;
    p.scales[1].displacement = -0.02;
    EXPECT_NEAR(p.largestDisplacement(), 0.12, 1e-12);
    for (double x = 0; x < 1; x += 0.01) {
        const glm::dvec3 world(x, 0.7, -x);
        const glm::vec4 a = noise.at(world * 32.0 / 0.5), b = noise.at(world * 32.0 / 0.05);
        const glm::dvec3 d = displacementAt(p, noise, world, 0);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(d[axis], 0.1 * a[axis] - 0.02 * b[axis], 1e-7) << x;
            EXPECT_LE(std::abs(d[axis]), p.largestDisplacement()) << x;
        }
    }
}

TEST(Perturbation, RefusesBadNumbers) {
    const auto error = [](const Perturbation& p) -> std::string {
        try {
            checkPerturbation(p, "noise.txt");
        } catch (const Error& e) {
            return e.what();
        }
        return "no error";
    };
    Perturbation p;
    EXPECT_EQ(error(p), "no error");
    p.scales.resize(4);
    EXPECT_EQ(error(p), "no error");
    p.scales[2].size = 0;
    EXPECT_THAT(error(p), HasSubstr("noise.txt:scale 3: expected a size above 0 m, got 0"));
    p.scales[2].size = std::numeric_limits<double>::infinity();
    EXPECT_THAT(error(p), HasSubstr("scale 3: expected a size"));
    p.scales[2].size = 1;
    p.scales[1].velocity.y = std::nan("");
    EXPECT_THAT(error(p), HasSubstr("scale 2: expected finite numbers"));
    p.scales.resize(5);
    EXPECT_THAT(error(p), HasSubstr("up to 4 scales of noise, got 5"));
}

}  // namespace
}  // namespace stereonav
