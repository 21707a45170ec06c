// Computed skies: the sun is where it is asked for, values match closed forms, light stays finite.
#include "engine/light/skies/sky_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "engine/math/luminance.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

// Calls visit(direction of the pixel's middle, solid angle, radiance) for each pixel.
void visitPixels(const LightProbe& probe,
                 const std::function<void(const glm::dvec3&, double, const glm::dvec3&)>& visit) {
    for (int j = 0; j < probe.height(); ++j) {
        const double top = std::cos(kPi * j / probe.height()),
                     bottom = std::cos(kPi * (j + 1) / probe.height());
        const double z = 0.5 * (top + bottom), radius = std::sqrt(1 - z * z);
        for (int i = 0; i < probe.width(); ++i) {
            const double azimuth = 2 * kPi * ((i + 0.5) / probe.width() - 0.5);
            const glm::dvec3 w(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
            visit(w, 2 * kPi / probe.width() * (top - bottom), glm::dvec3(probe.radiance(glm::vec3(w))));
        }
    }
}

// Returns the luminance of a white horizontal surface under the sky.
double whiteSurface(const LightProbe& probe) {
    double sum = 0;
    visitPixels(probe, [&](const glm::dvec3& w, double solidAngle, const glm::dvec3& radiance) {
        if (w.z > 0) sum += luminance(radiance) * w.z * solidAngle / kPi;
    });
    return sum;
}

glm::dvec3 sunAt(double elevation_deg, double azimuth_deg) {
    const double e = elevation_deg * kPi / 180, a = azimuth_deg * kPi / 180;
    return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

std::string complaint(const ClearSky& sky) {
    try {
        clearSkyProbe(sky);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(SkyProbe, LightIsFiniteAndOfTheCommonLevel) {
    for (const double elevation : {0.0, 0.2, 3.0, 30.0, 60.0, 90.0})
        for (const double turbidity : {1.8, 2.0, 3.0, 6.0, 10.0}) {
            ClearSky sky;
            sky.sun = sunAt(elevation, 40);
            sky.turbidity = turbidity;
            sky.height = 64;
            const LightProbe probe = clearSkyProbe(sky);  // refuses what is negative or not finite
            ASSERT_NEAR(whiteSurface(probe), 1, 1e-4) << elevation << " " << turbidity;
            ASSERT_FALSE(probe.black());
            double up = 0, down = 0;
            visitPixels(probe, [&](const glm::dvec3& w, double solidAngle, const glm::dvec3& radiance) {
                (w.z > 0 ? up : down) += luminance(radiance) * solidAngle;
            });
            ASSERT_NEAR(down, 0.2 * 2 * kPi, 1e-3) << "ground of albedo 0.2 under light of level 1";
            ASSERT_GT(up, kPi);
        }
}

// The brightest pixel and the centroid of the disc's light lie where the sun is.
TEST(SkyProbe, SunIsWhereItIsAskedFor) {
    for (const glm::dvec3& sun :
         {sunAt(5, 170), sunAt(35, -179.9), sunAt(50, 0), sunAt(80, 90), sunAt(90, 0)}) {
        ClearSky sky;
        sky.sun = 7.0 * sun;
        const LightProbe probe = clearSkyProbe(sky);
        double peak = 0;
        glm::dvec3 brightest, centroid(0.0);
        visitPixels(probe, [&](const glm::dvec3& w, double solidAngle, const glm::dvec3& radiance) {
            if (luminance(radiance) > peak) peak = luminance(radiance), brightest = w;
            if (luminance(radiance) > 50) centroid += w * (luminance(radiance) * solidAngle);
        });
        const double pixel = kPi / 128;
        EXPECT_LT(std::acos(std::min(1.0, glm::dot(brightest, sun))), 1.5 * pixel);
        EXPECT_LT(std::acos(std::min(1.0, glm::dot(glm::normalize(centroid), sun))), pixel);
        EXPECT_GT(peak, 100);
    }
}

// The disc's light does not depend on the size of the pixels. Where they are fine, the disc has its true
// width.
TEST(SkyProbe, SunsLightStaysWithTheResolution) {
    double before = 0;
    for (const int height : {32, 128, 1024}) {
        ClearSky sky;
        sky.sun = sunAt(41, 20);
        sky.height = height;
        const LightProbe probe = clearSkyProbe(sky);
        double direct = 0, light = 0, squares = 0;
        visitPixels(probe, [&](const glm::dvec3& w, double solidAngle, const glm::dvec3& radiance) {
            if (glm::dot(w, sky.sun) < std::cos(0.2)) return;
            direct += luminance(radiance) * solidAngle * w.z / kPi;
            light += luminance(radiance) * solidAngle;
            squares += luminance(radiance) * luminance(radiance) * solidAngle;
        });
        if (before > 0) {
            EXPECT_NEAR(direct, before, 0.02 * before) << height;
        }
        if (height == 1024) {
            const double disc = kPi * std::pow(0.2665 * kPi / 180, 2);
            // light^2 / squares is the solid angle of a disc of uniform radiance. Pixels are two thirds of
            // the disc's radius wide, and blur it.
            EXPECT_NEAR(light * light / squares, disc, 0.4 * disc);
        }
        before = direct;
    }
}

// At 41 degrees of a clear day the sun brings most of the light; through haze and near the horizon less.
TEST(SkyProbe, SunsShareFallsWithHazeAndHeight) {
    const auto share = [](double elevation, double turbidity) {
        double sum = 0;
        ClearSky sky;
        sky.sun = sunAt(elevation, 10);
        sky.turbidity = turbidity;
        visitPixels(clearSkyProbe(sky), [&](const glm::dvec3& w, double solidAngle, const glm::dvec3& l) {
            if (w.z > 0 && luminance(l) > 30) sum += luminance(l) * solidAngle * w.z / kPi;
        });
        return sum;
    };
    const double clear = share(41, 2.5);
    EXPECT_GT(clear, 0.6);
    EXPECT_LT(clear, 0.95);
    EXPECT_LT(share(41, 8), clear);
    EXPECT_LT(share(8, 2.5), clear);
}

TEST(SkyProbe, ClearSkyIsBlueOppositeTheSunAndTheLowSunIsRed) {
    ClearSky sky;
    sky.sun = sunAt(30, 0);
    const LightProbe day = clearSkyProbe(sky);
    const glm::vec3 opposite = day.radiance(glm::vec3(sunAt(60, 180)));
    EXPECT_GT(opposite.z, 1.3f * opposite.x);
    sky.sun = sunAt(4, 0);
    const LightProbe evening = clearSkyProbe(sky);
    const glm::vec3 sun = evening.radiance(glm::vec3(sunAt(4, 0)));
    EXPECT_GT(sun.x, 2 * sun.z);
}

TEST(SkyProbe, SkyIsTheSameOnBothSidesOfTheSun) {
    ClearSky sky;
    sky.sun = sunAt(25, 0);
    sky.disc = false;
    const LightProbe probe = clearSkyProbe(sky);
    float peak = 0;
    visitPixels(probe, [&](const glm::dvec3& w, double, const glm::dvec3& radiance) {
        const glm::vec3 mirrored = probe.radiance(glm::vec3(w.x, -w.y, w.z));
        ASSERT_LT(glm::length(radiance - glm::dvec3(mirrored)), 1e-4 * glm::length(radiance));
        peak = std::max(peak, mirrored.y);
    });
    EXPECT_LT(peak, 50) << "no disc";
}

// The zenith's chromaticity for the sun at 45 degrees and turbidity 2, computed apart from this program by
// the polynomials of Preetham et al. 1999.
TEST(SkyProbe, ZenithsChromaticityOfThePaper) {
    ClearSky sky;
    sky.sun = sunAt(45, 0);
    sky.turbidity = 2;
    sky.disc = false;
    sky.height = 1024;
    const glm::dvec3 c(clearSkyProbe(sky).radiance({0, 0, 1}));
    const double X = 0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z, Y = luminance(c);
    const double Z = 0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z;
    EXPECT_NEAR(X / (X + Y + Z), 0.240952, 2e-4);
    EXPECT_NEAR(Y / (X + Y + Z), 0.243722, 2e-4);
}

// The zenith is three times as bright as the horizon, and a white surface has 7/9 of the zenith's luminance
// (the integral of (1 + 2 cos) cos / 3 over the hemisphere is 7 pi / 9).
TEST(SkyProbe, OvercastInClosedForm) {
    const LightProbe probe = overcastSkyProbe(0.0, 256);
    visitPixels(probe, [&](const glm::dvec3& w, double, const glm::dvec3& radiance) {
        const double expected = w.z > 0 ? 9.0 / 7.0 * (1 + 2 * w.z) / 3 : 0;
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(radiance[c], expected, 1e-4) << w.z;
    });
    const double zenith = probe.radiance({0, 0, 1}).y, horizon = probe.radiance({1, 0, 1e-4f}).y;
    EXPECT_NEAR(zenith / horizon, 3, 0.04);  // the lowest row reaches 0.7 degrees up
    EXPECT_NEAR(whiteSurface(probe), 1, 1e-4);
}

TEST(SkyProbe, SmallestAndGround) {
    for (const double albedo : {0.0, 1.0}) {
        const LightProbe probe = overcastSkyProbe(albedo, 2);
        EXPECT_EQ(probe.width(), 4);
        EXPECT_NEAR(probe.radiance({0, 0, -1}).y, albedo, 1e-5);
    }
    ClearSky sky;
    sky.height = 2;
    EXPECT_NEAR(whiteSurface(clearSkyProbe(sky)), 1, 1e-4);
}

TEST(SkyProbe, WhatIsNoSkyIsRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const glm::dvec3& sun :
         {glm::dvec3(0.0), glm::dvec3(nan), glm::dvec3(INFINITY, 0, 1), glm::dvec3(1, 0, -0.1)}) {
        ClearSky sky;
        sky.sun = sun;
        EXPECT_THAT(complaint(sky), HasSubstr("sky, sun: expected a direction"));
    }
    for (const double turbidity : {1.0, 11.0, nan}) {
        ClearSky sky;
        sky.turbidity = turbidity;
        EXPECT_THAT(complaint(sky), HasSubstr("turbidity: expected 1.8 to 10"));
    }
    for (const int height : {0, -2, 3, 4098}) {
        ClearSky sky;
        sky.height = height;
        EXPECT_THAT(complaint(sky), HasSubstr("height"));
        EXPECT_THROW(overcastSkyProbe(0.2, height), Error);
    }
    for (const double albedo : {-0.1, 1.1, nan}) EXPECT_THROW(overcastSkyProbe(albedo, 4), Error);
}

}  // namespace
}  // namespace stereonav
