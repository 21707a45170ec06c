// A thin sheet of flesh under light from one side: the side that faces it is lit, the other one is not, and
// both are alike where light comes from everywhere. By irradiance and by transfer.
#include <gtest/gtest.h>

#include "engine/light/paths/isovalue_surface.h"
#include "engine/math/constants.h"
#include "engine/volume/plain_volume_caster.h"
#include "tests/light/light_scenes.h"

namespace stereonav {
namespace {

using namespace test;

constexpr int kLitSize = 33, kMiddle = 16;

// A sheet across `axis`, `thick` voxels thick; the surface through a texel beside it is moved by the texel's
// distance.
GreyVolume sheetAcross(int axis, double thick) {
    return solidVolume(cubeFrame(kLitSize),
                       [=](const glm::dvec3& v) { return 0.5 * thick - std::abs(v[axis] - kMiddle); });
}

// Returns a texel on one face or the other of the sheet, next to its middle.
glm::ivec3 texelOn(int axis, int side) {
    glm::ivec3 texel(kMiddle);
    texel[axis] += 2 * side;
    return texel;
}

TEST(LitSheet, IsLitOnTheSideThatFacesTheLight) {
    for (const int axis : {0, 1, 2})
        for (const int from : {-1, 1})
            for (const double thick : {1.0, 3.0}) {
                SCOPED_TRACE(testing::Message() << axis << " " << from << " " << thick);
                const GreyVolume volume = sheetAcross(axis, thick);
                LightSetup setup;
                setup.bounces = 0;
                glm::dvec3 light(kMiddle);
                light[axis] += from * 60;
                light[(axis + 1) % 3] += 9;
                setup.lights = {{light * 1e-3, glm::vec3(1e-3f), 1e-3}};
                const TexelLighter lighter(volume, volume.frame, setup, {});
                for (const int side : {-1, 1}) {
                    const glm::ivec3 texel = texelOn(axis, side);
                    glm::dvec3 outwards(0.0);
                    outwards[axis] = side;
                    EXPECT_GT(glm::dot(lighter.place(texel).normal, outwards), 0.999) << side;
                    const glm::dvec3 way = light - (glm::dvec3(texel) + 0.25 * outwards);
                    const double d = glm::length(way);
                    const double expected =
                        std::max(glm::dot(way, outwards) / d, 0.0) * 1e-3 / (kPi * d * d * 1e-6);
                    const TexelSum sum = irradianceAt(lighter, texel, 4);
                    EXPECT_NEAR(sum.mean.x, expected, 0.01 * expected + 1e-9) << side;
                    EXPECT_EQ(sum.mean.x > 0, side == from);
                }
            }
}

TEST(LitSheet, IsLitAlikeByAnEvenSky) {
    for (const int axis : {0, 1, 2}) {
        const GreyVolume volume = sheetAcross(axis, 2);
        LightSetup setup;
        setup.sky = glm::vec3(1.0f, 0.5f, 0.25f);
        setup.bounces = 1;
        const TexelLighter lighter(volume, volume.frame, setup, {});
        for (const int side : {-1, 1}) {
            const TexelSum sum = irradianceAt(lighter, texelOn(axis, side), 256);
            ASSERT_EQ(sum.samples, 256);
            EXPECT_NEAR(sum.mean.x, 1, 0.01) << "half of the sky is its own, whole";
            EXPECT_NEAR(sum.mean.z, 0.25, 0.003);
        }
    }
}

// A septum of one voxel as smoothing leaves it of a mask: hardly above the wall's value, and uneven beside
// it, so that the smoothed gradient in its middle leads to either side. Solid walls all around it.
constexpr double kSeptumWall = -500;
GreyVolume septumAcross(int axis, double uneven) {
    Random random(5);
    return greyVolume(cubeFrame(kLitSize), [&](const glm::dvec3& v) {
        const double off = std::abs(v[axis] - kMiddle), by = uneven * random.between(-1, 1);
        for (int k = 0; k < 3; ++k)
            if (v[k] < 3 || v[k] > kLitSize - 4) return 0.0;
        return off == 0 ? -490 : off == 1 ? -725 + by : -950.0;
    });
}

TexelSampling ofThatWall(SimdTarget simd = SimdTarget::Auto) {
    TexelSampling sampling;
    sampling.lowest = sampling.highest = kSeptumWall;
    sampling.simd = simd;
    return sampling;
}

TEST(LitSeptum, ThinnerThanAVoxelIsLitOnTheSideThatFacesTheLight) {
    for (const int axis : {0, 1, 2})
        for (const int from : {-1, 1})
            for (const double uneven : {0.0, 40.0}) {
                SCOPED_TRACE(testing::Message() << axis << " " << from << " " << uneven);
                const GreyVolume volume = septumAcross(axis, uneven);
                LightSetup setup;
                setup.bounces = 0;
                glm::dvec3 light(kMiddle);
                light[axis] += from * 9;
                setup.lights = {{light * 1e-3, glm::vec3(1e-3f), 1e-3}};
                const TexelLighter lighter(volume, volume.frame, setup, ofThatWall());
                // In its middle a texel would have the light of one side, which the other would show.
                EXPECT_LT(irradianceAt(lighter, glm::ivec3(kMiddle), 4).samples, 0);
                IlluminationVolume lit(volume.frame);
                for (const int side : {-1, 0, 1}) {
                    glm::ivec3 texel(kMiddle);
                    texel[axis] += side;
                    const TexelSum sum = irradianceAt(lighter, texel, 4);
                    lit.texels[lit.layout.index(texel.x, texel.y, texel.z)] =
                        packTexel(sum.mean, sum.samples > 0 ? 1.0f : 0.0f);
                }
                const double d = 9 - 0.04;
                const double expected = 1e-3 / (kPi * d * d * 1e-6);
                for (const int side : {-1, 1}) {
                    glm::dvec3 outwards(0.0), start(kMiddle);
                    outwards[axis] = side;
                    start[axis] += 4 * side;
                    const PlainHit hit =
                        castPlainVolume(volume, kSeptumWall, {1e-3 * start, -1e-3 * outwards, 0});
                    ASSERT_TRUE(hit.hit());
                    EXPECT_LT(std::abs(hit.voxel()[axis] - kMiddle), 0.06) << "as thin as it is said to be";
                    // On the line of voxels itself there are two slopes: beside it.
                    glm::dvec3 beside = hit.voxel();
                    beside[(axis + 1) % 3] += 0.01, beside[(axis + 2) % 3] -= 0.01;
                    EXPECT_GT(glm::dot(surfaceNormal(volume, beside), outwards), 0.95) << side;
                    const TexelLighter::SurfacePoint point{beside, kSeptumWall, glm::dvec3(0.0), 1};
                    TexelSum sum;
                    lighter.addIrradianceAt({&point, 1}, 4, {&sum, 1});
                    const IlluminationVolume::Light known = lit.at(1e-3 * hit.voxel());
                    EXPECT_GT(known.weight, 0);
                    for (const double found : {double(sum.mean.x), double(known.value.x)})
                        if (side == from)
                            EXPECT_NEAR(found, expected, (uneven > 0 ? 0.12 : 0.06) * expected);
                        else
                            EXPECT_EQ(found, 0);
                }
            }
}

// Two rooms with such a septum between them, and a light in one of them: none of it comes through, however
// often it bounces.
TEST(LitSeptum, ThinnerThanAVoxelLetsNoLightThrough) {
    for (const int axis : {0, 1, 2})
        for (const SimdTarget target : simdTargets()) {
            SCOPED_TRACE(testing::Message() << axis << " " << nameOf(target));
            const GreyVolume volume = septumAcross(axis, 40);
            LightSetup setup;
            setup.bounces = 3;
            setup.albedo = glm::vec3(0.9f);
            glm::dvec3 light(kMiddle);
            light[axis] -= 6;
            setup.lights = {{light * 1e-3, glm::vec3(1e-3f), 1e-3}};
            const TexelLighter lighter(volume, volume.frame, setup, ofThatWall(target));
            for (const int side : {-1, 1}) {
                glm::ivec3 texel(kMiddle);
                texel[axis] = side < 0 ? 2 : kLitSize - 3;
                const TexelSum sum = irradianceAt(lighter, texel, 512);
                ASSERT_EQ(sum.samples, 512);
                if (side < 0)
                    EXPECT_GT(sum.mean.x, 1);
                else
                    EXPECT_EQ(sum.mean.x, 0);
            }
        }
}

}  // namespace
}  // namespace stereonav
