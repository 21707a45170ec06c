// Light at texels of extreme volumes: walls one voxel thin, values at both ends of int16, voxels twenty times
// as long as wide, the least volume, albedo 0 and 1, light beyond measure. Nothing may leak, break or exceed
// the sky.
#include <gmock/gmock.h>

#include "tests/light/light_scenes.h"
#include "tests/light/path_kernels.h"
#include "tests/light/probe_pictures.h"

namespace stereonav {
namespace {

using namespace test;

LightSetup skyOf(float radiance, int bounces, float albedo = 0.7f) {
    LightSetup setup;
    setup.sky = glm::vec3(radiance);
    setup.bounces = bounces;
    setup.albedo = glm::vec3(albedo);
    return setup;
}

std::vector<TexelSampling> allTargets() {
    std::vector<TexelSampling> list;
    for (const SimdTarget target : simdTargets()) {
        list.emplace_back();
        list.back().simd = target;
    }
    return list;
}

bool finite(const TexelSum& sum) {
    return std::isfinite(sum.mean.x + sum.mean.y + sum.mean.z) && std::isfinite(sum.squares) &&
           sum.mean.x >= 0 && sum.mean.y >= 0 && sum.mean.z >= 0;
}

TEST(TexelExtreme, AWallOneVoxelThinLetsNoLightThrough) {
    const GreyVolume volume =
        greyVolume(cubeFrame(24), [](const glm::dvec3& v) { return v.x == 12 ? 1000.0 : 0.0; });
    LightSetup setup;
    setup.bounces = 3;
    setup.probe = std::make_shared<LightProbe>(
        probeOf(32, 16, [](const glm::dvec3& d) { return glm::dvec3(d.x > 0 ? 1.0 : 0.0); }));
    for (const TexelSampling& sampling : allTargets()) {
        const TexelLighter lighter(volume, volume.frame, setup, sampling);
        EXPECT_EQ(irradianceAt(lighter, {12, 11, 11}, 64).samples, -1);  // the gradient vanishes within
        const TexelSum lit = irradianceAt(lighter, {13, 11, 11}, 256);
        EXPECT_NEAR(lit.mean.x, 1, 0.05);
        const TexelSum dark = irradianceAt(lighter, {11, 11, 11}, 256);
        EXPECT_EQ(dark.samples, 256);
        EXPECT_NEAR(dark.mean.x, 0, 0.05);
    }
}

TEST(TexelExtreme, AClosedBoxOfThinWallsIsDarkInside) {
    const GreyVolume volume = greyVolume(cubeFrame(24), [](const glm::dvec3& v) {
        const glm::dvec3 d = glm::abs(v - glm::dvec3(12));
        return std::max({d.x, d.y, d.z}) == 7 ? 1000.0 : 0.0;
    });
    for (const TexelSampling& sampling : allTargets()) {
        const TexelLighter lighter(volume, volume.frame, skyOf(1, 8, 1), sampling);
        for (const glm::ivec3 texel : {glm::ivec3(6, 12, 12), glm::ivec3(6, 6, 6), glm::ivec3(18, 18, 12)}) {
            const TexelSum sum = irradianceAt(lighter, texel, 256);
            ASSERT_EQ(sum.samples, 256);
            EXPECT_EQ(sum.mean, glm::vec3(0.0f)) << texel.x;
        }
        EXPECT_GT(irradianceAt(lighter, {4, 12, 12}, 256).mean.x, 0.9f);
    }
}

TEST(TexelExtreme, IsovaluesAtTheEndsOfTheDataAreTraced) {
    // A step from the least number to the greatest: both texels beside it lie on surfaces.
    const GreyVolume volume =
        greyVolume(cubeFrame(16), [](const glm::dvec3& v) { return v.z < 8 ? 32767.0 : -32768.0; });
    for (const TexelSampling& sampling : allTargets()) {
        const TexelLighter lighter(volume, volume.frame, skyOf(1, 1), sampling);
        for (const int z : {7, 8}) {
            const TexelSum sum = irradianceAt(lighter, {8, 8, z}, 64);
            ASSERT_EQ(sum.samples, 64);
            EXPECT_FLOAT_EQ(sum.mean.x, 1);
        }
        EXPECT_EQ(lighter.place({8, 8, 7}).isovalue, 32767.0f);
        EXPECT_EQ(lighter.place({8, 8, 8}).isovalue, -32768.0f);
    }
}

TEST(TexelExtreme, NoiseOverAllOfInt16StaysWithinTheSky) {
    Random random(7);
    const GreyVolume volume = greyVolume(slantedFrame({12, 10, 11}),
                                         [&](const glm::dvec3&) { return random.between(-32768, 32767); });
    for (const TexelSampling& sampling : allTargets()) {
        const TexelLighter lighter(volume, volume.frame, skyOf(1, 8, 1), sampling);
        for (int n = 0; n < 200; ++n) {
            const glm::ivec3 texel(random.below(12), random.below(10), random.below(11));
            const TexelSum sum = irradianceAt(lighter, texel, 20);
            ASSERT_TRUE(finite(sum)) << n;
            ASSERT_LE(sum.mean.x, 1.00001f);
        }
    }
}

// The same ball in the world, sampled twenty times coarser along one axis.
TEST(TexelExtreme, LongVoxelsKeepTheShapeOfTheWorld) {
    VolumeFrame frame;
    frame.size = {201, 201, 11};
    frame.spacing = {1e-3, 1e-3, 20e-3};
    const glm::dvec3 centre(0.1, 0.1, 0.1);
    const double ground = 0.02;
    const GreyVolume volume = greyVolume(frame, [&](const glm::dvec3& v) {
        const glm::dvec3 p = frame.worldFromVoxel(v);
        return std::clamp(2e5 * std::max(0.05 - glm::length(p - centre), ground - p.x), -32768.0, 32767.0);
    });
    for (const TexelSampling& sampling : allTargets()) {
        const TexelLighter lighter(volume, volume.frame, skyOf(1, 0), sampling);
        const TexelSum top = irradianceAt(lighter, {150, 100, 5}, 256);  // on the ball, off the ground
        ASSERT_EQ(top.samples, 256);
        EXPECT_NEAR(top.mean.x, 1, 0.02);
        const auto place = lighter.place({150, 100, 5});
        EXPECT_NEAR(place.normal.x, 1, 0.02);
        // On the ground below, which the ball hides in part: (0.05 / 0.08)^2 of it, roughly, for the ball of
        // such voxels is a string of facets.
        const TexelSum below = irradianceAt(lighter, {20, 100, 5}, 1024);
        EXPECT_NEAR(below.mean.x, 1 - std::pow(0.05 / 0.08, 2), 0.08);
    }
}

TEST(TexelExtreme, TheLeastVolumeIsLit) {
    GreyVolume volume(cubeFrame(2));
    for (int n = 0; n < 8; ++n)
        volume.at(n & 1, n >> 1 & 1, n >> 2) = static_cast<std::int16_t>(n < 4 ? 10 : 0);
    for (const TexelSampling& sampling : allTargets()) {
        const TexelLighter lighter(volume, volume.frame, skyOf(0.5f, 2), sampling);
        for (int n = 0; n < 8; ++n) {
            const TexelSum sum = irradianceAt(lighter, {n & 1, n >> 1 & 1, n >> 2}, 16);
            EXPECT_EQ(sum.samples, 16);
            EXPECT_FLOAT_EQ(sum.mean.x, 0.5f) << n;
        }
    }
}

TEST(TexelExtreme, AlbedoNoughtStopsAtTheFirstSurfaceAndAlbedoOneLosesNothing) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    const glm::ivec3 texel(18, 14, 6);
    for (const TexelSampling& sampling : allTargets()) {
        const auto light = [&](int bounces, float albedo) {
            return irradianceAt(TexelLighter(volume, volume.frame, skyOf(1, bounces, albedo), sampling),
                                texel, 512)
                .mean.x;
        };
        EXPECT_EQ(light(8, 0), light(0, 0.5f));
        EXPECT_GT(light(8, 1), 0.97f);  // but for what is still under way after eight bounces
        EXPECT_LE(light(8, 1), 1.00001f);
    }
}

TEST(TexelExtreme, LightBeyondMeasureStaysFinite) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    LightSetup setup = skyOf(1e15f, 2);
    setup.lights = {{glm::dvec3(18, 14, 6.1) * 1e-3, glm::vec3(1e15f), 1e-12},
                    {glm::dvec3(1e30), glm::vec3(1.0f), 1e-3}};
    std::vector<glm::vec3> pixels(32, glm::vec3(1e-30f));
    pixels[3] = glm::vec3(1e30f);
    setup.probe = std::make_shared<LightProbe>(8, 4, pixels, "bright");
    for (const TexelSampling& sampling : allTargets()) {
        const TexelLighter lighter(volume, volume.frame, setup, sampling);
        TexelSum sum;
        const glm::ivec3 texel(18, 14, 6);
        for (int n = 0; n < 5; ++n) {
            lighter.addIrradiance({&texel, 1}, 100, {&sum, 1});
            ASSERT_TRUE(finite(sum)) << n << " " << sum.mean.x << " " << sum.squares;
        }
    }
}

// Texels between voxels, and beyond the last one.
TEST(TexelExtreme, OtherResolutionsLieOnTheirOwnSurfaces) {
    const GreyVolume volume = ballVolume(33, glm::dvec3(16), 10);
    for (const double perVoxel : {0.5, 2.0}) {
        VolumeFrame texels = volume.frame;
        texels.spacing /= perVoxel;
        texels.size = glm::ivec3(glm::dvec3(volume.frame.size) * perVoxel) + 1;
        const TexelLighter lighter(volume, texels, skyOf(1, 1), {});
        const glm::ivec3 texel(glm::dvec3(16.5, 24, 16) * perVoxel);
        const glm::dvec3 voxel = glm::dvec3(texel) / perVoxel;
        EXPECT_NEAR(lighter.place(texel).isovalue, kSteps * (10 - glm::length(voxel - glm::dvec3(16))), 20);
        EXPECT_NEAR(irradianceAt(lighter, texel, 64).mean.x, 1, 0.02);
        EXPECT_TRUE(finite(irradianceAt(lighter, texels.size - 1, 64)));
    }
}

}  // namespace
}  // namespace stereonav
