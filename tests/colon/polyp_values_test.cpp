// Values of a CT inside polyps whose values are known: a ball of flesh under a true normal blur, in closed
// form.
#include "colon/instruments/polyp_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "colon/instruments/finding.h"
#include "tests/colon/lumen_wall.h"

namespace stereonav::test {
namespace {

constexpr double kGasHu = -1000, kFlesh = 55, kNoiseHu = 12;

double normal(double x) {
    return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

// A ball of 1 under a blur of sigma, at a distance from its middle.
double blurredBall(double away, double radius, double sigma) {
    const double a = (radius + away) / sigma, b = (radius - away) / sigma;
    if (away < 1e-6) away = 1e-6;
    return normal(a) + normal(b) - 1 -
           sigma / (away * std::sqrt(2 * std::numbers::pi)) *
               (std::exp(-0.5 * b * b) - std::exp(-0.5 * a * a));
}

// Even values whose standard deviation is kNoiseHu.
double noise(std::size_t n) {
    const std::uint64_t hash = (n + 1) * 0x9E3779B97F4A7C15ull;
    return (static_cast<double>(hash >> 40) / (1 << 24) - 0.5) * kNoiseHu * std::sqrt(12.0);
}

// A tube with a ball on a stalk, and a CT of it; spacings: of the lumen's voxels and of the CT's, metres.
struct BlurredPolyp {
    LumenWall wall;
    GreyVolume study;
    std::optional<MeasuredPolyp> polyp;

    BlurredPolyp(double radius, double sigma)
        : wall(
              [=](const glm::dvec3& p) { return std::max(toTube(p, 0.014, -0.02, 0.02), -flesh(p, radius)); },
              {-0.019, -0.019, -0.025}, {0.019, 0.019, 0.025}, 0.0007) {
        study = GreyVolume(wall.lumen.field.frame);
        for (int k = 0; k < study.frame.size.z; ++k)
            for (int j = 0; j < study.frame.size.y; ++j)
                for (int i = 0; i < study.frame.size.x; ++i) {
                    const glm::dvec3 p = study.frame.worldFromVoxel({i, j, k});
                    const double outside = normal(toTube(p, 0.014, -0.02, 0.02) / sigma),
                                 ball = blurredBall(toBall(p, kMiddle, 0), radius, sigma),
                                 stalk = normal(-stalkOf(p) / sigma);
                    const double share = std::min(std::max({outside, ball, stalk}), 1.0);
                    study.at(i, j, k) = static_cast<std::int16_t>(
                        std::lround(kGasHu + share * (kFlesh - kGasHu) + noise(study.frame.index(i, j, k))));
                }
        std::string why;
        polyp = polypAt(wall.mesh, neighboursOf(wall.mesh), kMiddle, polypSettingOf(study.frame), why);
    }

private:
    static constexpr glm::dvec3 kMiddle{0.005, 0, 0};
    static double stalkOf(const glm::dvec3& p) {
        return std::max(std::hypot(p.y, p.z) - 0.0015, 0.005 - p.x);
    }
    static double flesh(const glm::dvec3& p, double radius) {
        return std::min(toBall(p, kMiddle, radius), stalkOf(p));
    }
};

TEST(PolypValues, TheBlurIsReadFromTheWall) {
    for (const double sigma : {0.0006, 0.001}) {
        const BlurredPolyp made(0.005, sigma);
        const auto blur = blurAcrossWall(made.study, made.wall.mesh);
        ASSERT_TRUE(blur);
        EXPECT_GE(*blur, 0.97 * sigma) << "less would let air in";
        // Trilinear interpolation is a blur of its own.
        EXPECT_LE(*blur, 1.05 * std::hypot(sigma, 0.5 * 0.0007));
    }
}

TEST(PolypValues, AreThoseOfTheFlesh) {
    for (const double sigma : {0.0006, 0.0009}) {
        const BlurredPolyp made(0.005, sigma);
        ASSERT_TRUE(made.polyp);
        const auto blur = blurAcrossWall(made.study, made.wall.mesh);
        ASSERT_TRUE(blur);
        const auto values = valuesInside(made.study, made.wall.mesh, *made.polyp, *blur);
        ASSERT_TRUE(values);
        EXPECT_GE(values->voxels, kLeastVoxels);
        EXPECT_NEAR(values->mean, kFlesh, 1 + 3 * kNoiseHu / std::sqrt(values->voxels));
        EXPECT_NEAR(values->sigma, kNoiseHu, 4);
        // The same without keeping away: air would be in it.
        const auto all = valuesInside(made.study, made.wall.mesh, *made.polyp, 0);
        ASSERT_TRUE(all);
        EXPECT_LT(all->mean, kFlesh - 100);
        const double volume = all->voxels * std::pow(0.0007, 3);
        EXPECT_NEAR(volume / made.polyp->volume, 1, 0.12) << "between the lid and the wall";
    }
}

TEST(PolypValues, AreNotToldWhereTheBlurReachesAll) {
    const BlurredPolyp made(0.003, 0.0009);
    ASSERT_TRUE(made.polyp);
    EXPECT_FALSE(valuesInside(made.study, made.wall.mesh, *made.polyp, 0.0009));
    // A mask's two values are no air and no tissue.
    GreyVolume mask(made.study.frame);
    EXPECT_FALSE(blurAcrossWall(mask, made.wall.mesh));
}

}  // namespace
}  // namespace stereonav::test
