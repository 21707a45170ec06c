// The highlight: its table against the power function, packed normals, and where there is none.
#include "terrain/specular.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

namespace stereonav {
namespace {

TEST(Specular, TableStaysWithinItsStatedErrorOfThePower) {
    for (const float shininess : {1.0f, 8.0f, 32.0f, 200.0f}) {
        TerrainLook look;
        look.specular = 1;
        look.shininess = shininess;
        const Specular specular(look);
        const double entries = Specular::kEntries;
        const double bound = shininess * shininess / (8 * entries * entries) + 1e-6;
        for (int k = 0; k <= 100000; ++k) {
            const float cosine = static_cast<float>(k) / 100000;
            ASSERT_NEAR(specular.power(cosine), std::pow(static_cast<double>(cosine), shininess), bound)
                << cosine;
        }
    }
}

TEST(Specular, PackedNormalsComeBackWithinHalfAStep) {
    std::mt19937 random(5);
    std::normal_distribution<double> gauss;
    for (int k = 0; k < 10000; ++k) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
        ASSERT_LT(glm::length(unpackNormal(packNormal(n)) - n), 1e-4);
    }
}

TEST(Specular, ShinesTowardsTheMirroredSunOnly) {
    TerrainLook look;
    look.specular = 0.5f;
    look.sunElevation = 1.5707963267948966;  // straight above
    const Specular specular(look);
    const PackedColor base = packColor({0.1f, 0.2f, 0.3f});
    const glm::dvec3 up(0, 0, 1), level(1, 0, 0);
    EXPECT_NEAR(unpackColor(specular.shade(base, up, up)).x, 0.6f, 2e-3f);
    EXPECT_EQ(specular.shade(base, -up, up), base);  // turned away from the sun
    EXPECT_LT(unpackColor(specular.shade(base, up, level)).x, 0.11f);
    EXPECT_FALSE(Specular(TerrainLook()).active());
}

}  // namespace
}  // namespace stereonav
