// A thin sheet of flesh under light from one side: the side that faces it is lit, the other one is not, and
// both are alike where light comes from everywhere. By irradiance and by transfer.
#include <gtest/gtest.h>

#include "engine/math/constants.h"
#include "tests/light/light_scenes.h"

namespace stereonav {
namespace {

using namespace test;

constexpr int kLitSize = 33, kMiddle = 16;

// Across `axis`, so many voxels thick; the surface through a texel beside it is moved by the texel's
// distance.
GreyVolume sheetAcross(int axis, double thick) {
    return solidVolume(cubeFrame(kLitSize),
                       [=](const glm::dvec3& v) { return 0.5 * thick - std::abs(v[axis] - kMiddle); });
}

// On one face or the other of the sheet, next to its middle.
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

}  // namespace
}  // namespace stereonav
