// The sky: the octahedral map's two directions agree, and pictures stand where they should.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "raster_files.h"
#include "terrain/light/sky_source.h"

namespace stereonav {
namespace {

using test::errorOf;
using test::RasterSpec;
using test::TempFolder;
using test::writeRaster;
using testing::HasSubstr;

// The header's formula from direction to map, written out a second time.
glm::vec2 mapPlaceOf(const glm::vec3& d) {
    const float s = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    const glm::vec2 p(d.x / s, d.y / s);
    if (d.z >= 0) return p;
    return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

glm::vec3 colorTowards(const SkyMap& sky, const glm::vec3& d) {
    const glm::vec2 p = mapPlaceOf(d);
    const int n = sky.map().width();
    const auto index = [n](float v) { return std::clamp(static_cast<int>((v * 0.5f + 0.5f) * n), 0, n - 1); };
    return unpackColor(sky.map().at(index(p.x), index(p.y)));
}

glm::vec3 towards(double heading, double elevation) {
    return {std::cos(elevation) * std::sin(heading), std::cos(elevation) * std::cos(heading),
            std::sin(elevation)};
}

TEST(SkyMap, DirectionAndPlaceAreInverse) {
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) {
            const glm::vec2 p((i + 0.5f) / 32 - 1, (j + 0.5f) / 32 - 1);
            const glm::vec3 d = SkyMap::directionOf(p.x, p.y);
            EXPECT_NEAR(glm::length(d), 1, 1e-6);
            const glm::vec2 back = mapPlaceOf(d);
            EXPECT_NEAR(back.x, p.x, 2e-6);
            EXPECT_NEAR(back.y, p.y, 2e-6);
        }
    EXPECT_NEAR(SkyMap::directionOf(0, 0).z, 1, 1e-6);
    EXPECT_NEAR(SkyMap::directionOf(1, 1).z, -1, 1e-6);
    EXPECT_NEAR(SkyMap::directionOf(0, 1).y, 1, 1e-6);
}

TEST(SkyMap, HoldsTheRadianceOfEveryDirection) {
    const SkyMap sky(512, [](const glm::vec3& d) { return 0.5f + 0.5f * d; });
    for (double heading = 0; heading < 6.2; heading += 0.17)
        for (double elevation = -1.5; elevation < 1.5; elevation += 0.13) {
            const glm::vec3 d = towards(heading, elevation), seen = colorTowards(sky, d);
            for (int k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], 0.5f + 0.5f * d[k], 0.01f) << heading;
        }
}

TEST(SkyMap, GradientIsBlueAboveAndHazyBelow) {
    const glm::vec3 zenith = gradientSky({0, 0, 1}), horizon = gradientSky({1, 0, 0});
    EXPECT_GT(zenith.z, 2 * zenith.x);
    EXPECT_GT(horizon.x, zenith.x);
    const SkySource sky = readSky("");
    EXPECT_EQ(sky.source, "built-in gradient");
    EXPECT_NEAR(colorTowards(sky.map, {0.01f, 0.01f, 0.999f}).z, zenith.z, 0.02);
}

RasterSpec skyPictureSpec(int width, int height) {
    RasterSpec spec;
    spec.driver = "PNG";
    spec.type = GDT_Byte;
    spec.bands = 3;
    spec.width = width;
    spec.height = height;
    spec.placed = false;
    return spec;
}

TEST(SkySource, WholeSphereStandsUprightWithNorthInTheMiddle) {
    const TempFolder folder;
    RasterSpec spec = skyPictureSpec(256, 128);
    // Red: above the horizon. Green: the eastern half. Blue: within 45 degrees of north.
    spec.value = [](int c, int r, int band) {
        const bool on = band == 0 ? r < 64 : band == 1 ? c >= 128 : std::abs(c - 127.5) < 32;
        return on ? 255.0 : 0.0;
    };
    const SkySource sky = readSky(writeRaster(folder / "sphere.png", spec));
    EXPECT_THAT(sky.source, HasSubstr("the whole sphere"));
    for (double heading = 0.1; heading < 6.2; heading += 0.25)
        for (const double elevation : {-1.0, -0.5, -0.1, 0.1, 0.5, 1.0}) {
            const double signedHeading = heading > M_PI ? heading - 2 * M_PI : heading;
            if (std::abs(std::abs(signedHeading) - M_PI / 4) < 0.05) continue;
            const glm::vec3 seen = colorTowards(sky.map, towards(heading, elevation));
            EXPECT_EQ(seen.x > 0.5f, elevation > 0) << heading << " " << elevation;
            EXPECT_EQ(seen.y > 0.5f, signedHeading > 0) << heading << " " << elevation;
            EXPECT_EQ(seen.z > 0.5f, std::abs(signedHeading) < M_PI / 4) << heading << " " << elevation;
        }
}

TEST(SkySource, OtherAspectsArePanoramasAboveTheHorizon) {
    const TempFolder folder;
    RasterSpec spec = skyPictureSpec(400, 90);
    spec.value = [](int, int r, int band) { return band == 0 ? 255.0 * (r < 45) : 255.0 * (r >= 45); };
    const SkySource sky = readSky(writeRaster(folder / "panorama.png", spec));
    EXPECT_THAT(sky.source, HasSubstr("panorama"));
    for (double heading = 0; heading < 6.2; heading += 0.3) {
        EXPECT_GT(colorTowards(sky.map, towards(heading, 1.0)).x, 0.5f);
        EXPECT_LT(colorTowards(sky.map, towards(heading, 0.5)).x, 0.5f);
        EXPECT_GT(colorTowards(sky.map, towards(heading, 0.5)).y, 0.5f);
        EXPECT_GT(colorTowards(sky.map, towards(heading, -0.8)).y, 0.5f);  // the bottom row goes on
    }
}

// A minimal Radiance file, one colour: flat pixels of mantissa and exponent.
std::string radianceFile(int width, int height, const std::function<int(int, int)>& exponent) {
    std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
                       std::to_string(width) + "\n";
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            file += {static_cast<char>(128), static_cast<char>(100), static_cast<char>(90)};
            file += static_cast<char>(exponent(x, y));
        }
    return file;
}

TEST(SkySource, LightProbeBecomesDisplayable) {
    const TempFolder folder;
    // Light from 2^-4 to 2^9 around the horizon: far beyond what a display shows.
    const auto file = folder.text("probe.hdr", radianceFile(28, 14, [](int x, int) { return 125 + x / 2; }));
    const SkySource sky = readSky(file);
    EXPECT_THAT(sky.source, HasSubstr("light probe probe.hdr 28x14"));
    double sum = 0;
    float before = 0;
    for (int k = 1; k < 27; ++k) {
        const glm::vec3 seen = colorTowards(sky.map, towards((k + 0.5) / 28 * 2 * M_PI - M_PI, 0.1));
        EXPECT_GE(seen.x, before - 0.005f) << k;  // brighter stays brighter
        before = seen.x;
        sum += seen.x;
    }
    EXPECT_GT(before, 0.6f);
    EXPECT_GT(sum / 26, 0.1);
    EXPECT_LT(sum / 26, 0.7);
}

TEST(SkySource, BadPicturesAreRefused) {
    const TempFolder folder;
    const auto text = folder.text("sky.png", "clouds"), probe = folder.text("sky.hdr", "#?RADIANCE\nclouds");
    EXPECT_THAT(errorOf([&] { readSky(text); }), HasSubstr("sky.png: expected a picture of the sky"));
    EXPECT_THAT(errorOf([&] { readSky(probe); }), HasSubstr("sky.hdr:header: is cut off"));
    EXPECT_THAT(errorOf([&] { readSky(folder / "none.jpg"); }), HasSubstr("none.jpg: there is no such file"));
    EXPECT_THAT(errorOf([&] { readSky(folder / "none.hdr"); }), HasSubstr("none.hdr: "));
}

}  // namespace
}  // namespace stereonav
