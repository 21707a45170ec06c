// Irradiance at texels where it is known in closed form: convex bodies, a ball above a plane, a wall,
// cavities whose walls all see the same (a sphere from within).
#include <gmock/gmock.h>

#include <numbers>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "tests/light/light_scenes.h"

namespace stereonav {
namespace {

using namespace test;

LightSetup skySetup(int bounces, float albedo = 0.7f) {
    LightSetup setup;
    setup.sky = glm::vec3(1.0f, 0.5f, 0.25f);
    setup.albedo = glm::vec3(albedo);
    setup.bounces = bounces;
    return setup;
}

TexelSampling naiveSampling() {
    TexelSampling sampling;
    sampling.naive = true;
    return sampling;
}

TEST(TexelTruth, ConvexBodiesSeeTheWholeSky) {
    const GreyVolume volume = ballVolume(33, glm::dvec3(16.2, 15.9, 16.1), 10);
    const TexelLighter lighter(volume, volume.frame, skySetup(0), {});
    Random random(5);
    for (int n = 0; n < 40; ++n) {
        const glm::ivec3 texel(glm::dvec3(16) + random.direction() * random.between(6, 14));
        const TexelSum sum = irradianceAt(lighter, texel, 64);
        ASSERT_EQ(sum.samples, 64);
        EXPECT_NEAR(sum.mean.x, 1, 0.02) << n;
        EXPECT_NEAR(sum.mean.y, 0.5, 0.01);
        EXPECT_NEAR(sum.mean.z, 0.25, 0.005);
    }
}

// The share of a cosine-weighted hemisphere that a ball straight above blocks is (radius / distance)^2.
TEST(TexelTruth, ABallAboveAPlaneBlocksItsShareOfTheSky) {
    const glm::dvec3 ball(24, 24, 22);
    const double radius = 10, ground = 6;
    const GreyVolume volume = solidVolume(cubeFrame(49), [&](const glm::dvec3& v) {
        return std::max(ground - v.z, radius - glm::length(v - ball));
    });
    for (const TexelSampling& sampling : {TexelSampling{}, naiveSampling()}) {
        const TexelLighter lighter(volume, volume.frame, skySetup(0), sampling);
        const TexelSum sum = irradianceAt(lighter, {24, 24, 6}, 4096);
        const double share = std::pow(radius / (ball.z - ground), 2);
        EXPECT_NEAR(sum.mean.x, 1 - share, 4 * standardError(sum) / 0.58 + 0.012);
    }
}

// A wall across the whole volume, seen from its foot at distance d: the form factor of a rectangle that is
// perpendicular to the receiver, from the middle of its lower edge.
TEST(TexelTruth, AWallBlocksItsShareOfTheSky) {
    const double wall = 30, ground = 5, d = 10;
    const int size = 41;
    const GreyVolume volume =
        solidVolume(cubeFrame(size), [&](const glm::dvec3& v) { return std::max(ground - v.z, v.x - wall); });
    const TexelLighter lighter(volume, volume.frame, skySetup(0), {});
    const TexelSum sum = irradianceAt(lighter, {20, 20, 5}, 4096);
    const double height = size - 1 - ground, half = 20, slant = std::hypot(d, height);
    const double blocked = (std::atan(half / d) - d / slant * std::atan(half / slant)) / kPi;
    EXPECT_NEAR(sum.mean.x, 1 - blocked, 4 * standardError(sum) / 0.58 + 0.012);
}

// From any point of a sphere any piece of it subtends the share of its area, so in a spherical bowl light is
// the same everywhere and each bounce brings albedo * share of the one before.
TEST(TexelTruth, ABowlFillsWithLightBounceByBounce) {
    const glm::dvec3 centre(32, 32, 34);
    const double radius = 26, top = 30;
    const GreyVolume volume = bowlVolume(65, centre, radius, top);
    const double albedo = 0.8;
    for (const int bounces : {0, 1, 2, 5, 8}) {
        const TexelLighter lighter(volume, volume.frame, skySetup(bounces, float(albedo)), {});
        for (const glm::ivec3 texel :
             {glm::ivec3(32, 32, 8), glm::ivec3(45, 32, 11), glm::ivec3(32, 52, 17)}) {
            const double moved = double(volume.at(texel)) / kSteps, r = radius + moved;
            const double share = (top - moved - (centre.z - r)) / (2 * r), each = albedo * share;
            const double expected = (1 - share) * (1 - std::pow(each, bounces + 1)) / (1 - each);
            const TexelSum sum = irradianceAt(lighter, texel, 2048);
            EXPECT_NEAR(sum.mean.x, expected, 4 * standardError(sum) / 0.58 + 0.015 * expected)
                << bounces << " " << texel.x;
        }
    }
}

// In a closed sphere with a point light in the middle all walls get the same, at every bounce.
TEST(TexelTruth, AClosedCavityKeepsItsLight) {
    const glm::dvec3 centre(20, 20, 20);
    const double radius = 14;
    const GreyVolume volume =
        solidVolume(cubeFrame(41), [&](const glm::dvec3& v) { return glm::length(v - centre) - radius; });
    for (const float albedo : {0.0f, 0.6f, 1.0f})
        for (const int bounces : {0, 1, 4}) {
            LightSetup setup = skySetup(bounces, albedo);
            setup.lights = {{centre * 1e-3, glm::vec3(2e-4f), 1e-4}};
            const TexelLighter lighter(volume, volume.frame, setup, {});
            const TexelSum sum = irradianceAt(lighter, {20, 20, 6}, 512);
            const double direct = 2e-4 / (kPi * radius * radius * 1e-6);
            double expected = 0;
            for (int b = 0; b <= bounces; ++b) expected += direct * std::pow(double(albedo), b);
            EXPECT_NEAR(luminanceOf(sum.mean), expected, 4 * standardError(sum) + 0.04 * expected)
                << albedo << " " << bounces;
        }
}

// One light of many by chance brings in the mean what all bring.
TEST(TexelTruth, OneOfManyLightsStandsForAll) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    LightSetup setup = skySetup(1, 0.6f);
    setup.sky = glm::vec3(0);
    for (int n = 0; n < 12; ++n)
        setup.lights.push_back({glm::dvec3(2e-3 * n, 30e-3 - 2e-3 * n, (n % 3 ? 12e-3 : 30e-3)),
                                glm::vec3(1e-5f * float(1 + n % 4)), 1e-3});
    TexelSampling all;
    all.naive = true;
    for (const glm::ivec3 texel : {glm::ivec3(16, 16, 6), glm::ivec3(24, 16, 10)}) {
        const TexelSum wanted = irradianceAt(TexelLighter(volume, volume.frame, setup, all), texel, 8192);
        const TexelSum chosen = irradianceAt(TexelLighter(volume, volume.frame, setup, {}), texel, 8192);
        EXPECT_GT(wanted.mean.x, 0.01f);
        EXPECT_NEAR(chosen.mean.x, wanted.mean.x,
                    4 * std::hypot(standardError(chosen), standardError(wanted)));
    }
}

// From a point of a sphere of radius R the wall is 2 R c away in a direction with the cosine c to the normal,
// so within a reach d less than 2 R it is met but for 1 - (d / 2 R)^2 of the light.
TEST(TexelTruth, WithinAReachACavityIsOpen) {
    const glm::dvec3 centre(20, 20, 20);
    const double radius = 14;
    const GreyVolume volume =
        solidVolume(cubeFrame(41), [&](const glm::dvec3& v) { return glm::length(v - centre) - radius; });
    const glm::ivec3 texel(20, 20, 6);
    for (const double share : {0.1, 0.3, 0.7, 0.95, 1.2}) {
        LightSetup setup = skySetup(0, 0.5f);
        setup.reach = share * 2 * radius * 1e-3;
        const TexelSum sum = irradianceAt(TexelLighter(volume, volume.frame, setup, {}), texel, 1024);
        EXPECT_NEAR(sum.mean.x, std::max(1 - share * share, 0.0), 0.03) << share;
    }
    LightSetup endless = skySetup(0, 0.5f);
    EXPECT_EQ(irradianceAt(TexelLighter(volume, volume.frame, endless, {}), texel, 256).mean.x, 0);
    endless.reach = -1;
    EXPECT_THROW(TexelLighter(volume, volume.frame, endless, {}), Error);
}

TEST(TexelTruth, PointLightsFallOffBySquareAndCosineAndCastHardShadows) {
    const glm::dvec3 centre(16, 16, 16);
    const GreyVolume volume = ballVolume(33, centre, 8);
    LightSetup setup;
    setup.bounces = 0;
    const glm::dvec3 light(16, 16, 80);  // beyond the volume
    setup.lights = {{light * 1e-3, glm::vec3(1e-3f), 1e-3}};
    const TexelLighter lighter(volume, volume.frame, setup, {});
    int lit = 0;
    for (const glm::ivec3 texel : {glm::ivec3(16, 16, 24), glm::ivec3(20, 16, 22), glm::ivec3(16, 11, 22),
                                   glm::ivec3(16, 16, 8), glm::ivec3(12, 16, 9)}) {
        const TexelSum sum = irradianceAt(lighter, texel, 4);
        const glm::dvec3 n = glm::normalize(glm::dvec3(texel) - centre);
        const glm::dvec3 way = light - (glm::dvec3(texel) + 0.25 * n);
        const double d = glm::length(way), cosine = std::max(glm::dot(way, n) / d, 0.0);
        const double expected = 1e-3 * cosine / (kPi * d * d * 1e-6);
        EXPECT_NEAR(sum.mean.x, expected, 0.01 * expected + 1e-9) << texel.z;
        EXPECT_NEAR(sum.squares, 0, 1e-6);
        lit += sum.mean.x > 0;
    }
    EXPECT_EQ(lit, 3);
}

TEST(TexelTruth, ALightOnTheSurfaceStaysFinite) {
    const GreyVolume volume = ballVolume(33, glm::dvec3(16), 8);
    const double radius = 0.5e-3;
    for (const double height : {0.0, 0.25, 0.3}) {
        LightSetup setup;
        setup.bounces = 0;
        setup.lights = {{glm::dvec3(16, 16, 24 + height) * 1e-3, glm::vec3(1.0f), radius}};
        const TexelLighter lighter(volume, volume.frame, setup, {});
        const TexelSum sum = irradianceAt(lighter, {16, 16, 24}, 4);
        EXPECT_GE(sum.mean.x, 0) << height;
        EXPECT_LE(sum.mean.x, 1 / (kPi * radius * radius) * 1.0001) << height;
    }
}

// Whatever the shape, nothing gets more than the sky sends.
TEST(TexelTruth, EnergyNeverExceedsTheSky) {
    Random random(11);
    const GreyVolume volume =
        greyVolume(cubeFrame(14), [&](const glm::dvec3&) { return random.between(-100, 100); });
    LightSetup setup = skySetup(8, 1.0f);
    setup.sky = glm::vec3(1.0f);
    const TexelLighter lighter(volume, volume.frame, setup, {});
    double most = 0;
    int lit = 0;
    for (int n = 0; n < 60; ++n) {
        const glm::ivec3 texel(random.below(14), random.below(14), random.below(14));
        const TexelSum sum = irradianceAt(lighter, texel, 32);
        if (sum.samples < 0) continue;  // in the middle of what is thinner than a voxel
        ++lit;
        ASSERT_EQ(sum.samples, 32);
        EXPECT_LE(sum.mean.x, 1.00001f);
        most = std::max(most, double(sum.mean.x));
    }
    EXPECT_GT(most, 0.2);
    EXPECT_GT(lit, 30);
}

TEST(TexelTruth, WhereValuesDoNotDifferThereIsNoSurface) {
    const GreyVolume volume =
        greyVolume(cubeFrame(12), [](const glm::dvec3& v) { return v.x < 6 ? 1234.0 : 40.0; });
    const TexelLighter lighter(volume, volume.frame, skySetup(1), {});
    EXPECT_EQ(irradianceAt(lighter, {2, 5, 5}, 16).samples, -1);
    EXPECT_EQ(irradianceAt(lighter, {2, 5, 5}, 16).mean, glm::vec3(0.0f));
    EXPECT_EQ(lighter.place({2, 5, 5}).normal, glm::dvec3(0.0));
    const TexelSum lit = irradianceAt(lighter, {5, 5, 5}, 16);
    EXPECT_EQ(lit.samples, 16);
    EXPECT_FLOAT_EQ(lit.mean.x, 1);  // a plane seen from the side of smaller values
    EXPECT_NEAR(lighter.place({5, 5, 5}).normal.x, 1, 1e-12);
    EXPECT_EQ(lighter.place({5, 5, 5}).isovalue, 1234.0f);
    // The least value of all: its surface is where the values begin to rise.
    EXPECT_FLOAT_EQ(irradianceAt(lighter, {6, 5, 5}, 16).mean.x, 1);
}

TEST(TexelTruth, BadVolumesAndLightsAreRefusedWithOneLine) {
    const auto errorOf = [](const VolumeFrame& frame, const LightSetup& setup) -> std::string {
        const GreyVolume volume(frame);
        try {
            TexelLighter(volume, frame, setup, {});
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    using testing::HasSubstr;
    const VolumeFrame good = cubeFrame(2);
    EXPECT_EQ(errorOf(good, {}), "");
    EXPECT_THAT(errorOf(cubeFrame(1), {}), HasSubstr("volume: expected at least 2 voxels"));
    LightSetup setup;
    setup.bounces = 9;
    EXPECT_THAT(errorOf(good, setup), HasSubstr("bounces: expected 0 to 8, got 9"));
    setup.bounces = 0;
    setup.albedo.y = 1.5f;
    EXPECT_THAT(errorOf(good, setup), HasSubstr("albedo"));
    setup.albedo.y = std::nanf("");
    EXPECT_THAT(errorOf(good, setup), HasSubstr("albedo"));
    setup.albedo.y = 0;
    setup.lights = {{glm::dvec3(0.0), glm::vec3(1.0f), 0.0}};
    EXPECT_THAT(errorOf(good, setup), HasSubstr("point light"));
}

}  // namespace
}  // namespace stereonav
