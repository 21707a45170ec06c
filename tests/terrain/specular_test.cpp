// The highlight: its table against the power function, packed normals, and where there is none.
#include "terrain/cast/specular.h"

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
    const glm::dvec3 up(0, 0, 1), level(1, 0, 0);
    EXPECT_NEAR(specular.highlight(up, up).x, 0.5f, 1e-6f);
    EXPECT_EQ(specular.highlight(-up, up), glm::vec3(0.0f));  // turned away from the sun
    EXPECT_LT(specular.highlight(up, level).x, 0.01f);
    EXPECT_FALSE(Specular(TerrainLook()).active());
}

TEST(Specular, HasTheSunsLightAndSetsWithIt) {
    TerrainLook look;
    look.specular = 0.5f;
    const glm::vec3 red(1.0f, 0.5f, 0.25f);
    const auto towardsTheSun = [&](double elevation) {
        look.sunElevation = elevation;
        const Specular specular(look, red);
        return specular.highlight(specular.toSun(), specular.toSun());
    };
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(towardsTheSun(0.3)[c], 0.5f * red[c], 1e-6f);
    EXPECT_NEAR(towardsTheSun(0).x, 0.25f, 1e-6f) << "half of the disc";
    for (const double set : {-0.01, -0.3, -1.5}) EXPECT_EQ(towardsTheSun(set), glm::vec3(0.0f)) << set;
}

}  // namespace
}  // namespace stereonav
