// Light probes: looked up, chosen from by brightness, refused when their pixels are no light.
#include "engine/light/skies/light_probe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>

#include "engine/base/error.h"
#include "engine/math/constants.h"
#include "engine/math/luminance.h"
#include "probe_pictures.h"
#include "sphere_quadrature.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using test::pixelDirection;
using test::probeOf;
using test::randomProbe;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

double solidAngle(int row, int width, int height) {
    return 2 * kPi / width * (std::cos(kPi * row / height) - std::cos(kPi * (row + 1) / height));
}

// Returns a point made of floats of 24 bits, like those of a caster.
glm::vec2 randomPoint(std::mt19937& random) {
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    const float first = unit();
    return {first, unit()};
}

std::string complaintOf(int width, int height, std::vector<glm::vec3> pixels) {
    try {
        LightProbe(width, height, std::move(pixels), "some.hdr");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(LightProbe, LooksUpTheDirectionsOfItsHeader) {
    std::vector<glm::vec3> pixels(8, glm::vec3(1.0f));
    for (int n = 0; n < 8; ++n) pixels[n].x = static_cast<float>(n);  // 4 x 2
    const LightProbe probe(4, 2, pixels, "numbered");
    EXPECT_EQ(probe.radiance({-0.9f, -0.1f, 0.1f}).x, 0);  // row 0 is up, column 0 begins at -x
    EXPECT_EQ(probe.radiance({0.1f, -0.9f, 0.1f}).x, 1);
    EXPECT_EQ(probe.radiance({0.9f, 0.1f, 0.1f}).x, 2);
    EXPECT_EQ(probe.radiance({-0.1f, 0.9f, 0.1f}).x, 3);
    EXPECT_EQ(probe.radiance({0.9f, 0.1f, -0.1f}).x, 6);
}

TEST(LightProbe, EveryPixelsCentreIsItsOwn) {
    const LightProbe probe = probeOf(37, 19, [](const glm::dvec3& w) { return w * 0.5 + 0.5; });
    for (int j = 0; j < 19; ++j)
        for (int i = 0; i < 37; ++i) {
            const glm::dvec3 w = pixelDirection(i, j, 37, 19);
            ASSERT_EQ(probe.radiance(glm::vec3(w)), glm::vec3(w * 0.5 + 0.5)) << i << " " << j;
        }
}

TEST(LightProbe, LooksUpAnyDirectionWithoutHarm) {
    const LightProbe probe = randomProbe(16, 8, 3);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::vec3& w : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(-1, 0, 0),
                               glm::vec3(-1, -0.0f, 0), glm::vec3(0), glm::vec3(nan)}) {
        EXPECT_GE(probe.radiance(w).x, 0);
        EXPECT_GE(probe.density(w), 0);
    }
}

TEST(LightProbe, DensityIsLuminanceOverItsIntegralExactly) {
    const int width = 23, height = 11;
    const LightProbe probe = randomProbe(width, height, 5);
    double total = 0;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            total += luminance(glm::dvec3(probe.radiance(glm::vec3(pixelDirection(i, j, width, height))))) *
                     solidAngle(j, width, height);
    double integral = 0;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const glm::vec3 w(pixelDirection(i, j, width, height));
            const double expected = luminance(glm::dvec3(probe.radiance(w))) / total;
            ASSERT_NEAR(probe.density(w), expected, 1e-6 * expected) << i << " " << j;
            integral += probe.density(w) * solidAngle(j, width, height);
        }
    EXPECT_NEAR(integral, 1, 1e-6);
}

// Chi-square over the pixels at the level 0.001 with a fixed seed; quantile by Wilson and Hilferty.
TEST(LightProbe, SamplesFollowTheDensity) {
    const int width = 12, height = 6, count = 400000;
    const LightProbe probe = randomProbe(width, height, 11);
    std::vector<int> met(width * height, 0);
    std::mt19937 random(1);
    for (int n = 0; n < count; ++n) {
        const glm::vec3 w = probe.sample(randomPoint(random)).direction;
        const int i = std::min(width - 1, static_cast<int>((std::atan2(w.y, w.x) / (2 * kPi) + 0.5) * width));
        const int j = std::min(height - 1, static_cast<int>(std::acos(w.z) / kPi * height));
        ++met[j * width + i];
    }
    double chiSquare = 0, pooled = 0;
    int pooledMet = 0, freedom = -1;
    const auto add = [&](double expected, int counted) {
        chiSquare += (counted - expected) * (counted - expected) / expected;
        ++freedom;
    };
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const double expected = count * solidAngle(j, width, height) *
                                    probe.density(glm::vec3(pixelDirection(i, j, width, height)));
            if (expected >= 5) {
                add(expected, met[j * width + i]);
            } else {
                pooled += expected;
                pooledMet += met[j * width + i];
            }
        }
    if (pooled > 0) add(pooled, pooledMet);
    ASSERT_GT(freedom, 30);
    const double third = 2.0 / (9.0 * freedom);
    EXPECT_LT(chiSquare, freedom * std::pow(1 - third + 3.0902 * std::sqrt(third), 3));
}

// Within a pixel directions are uniform in azimuth and in z: chi-square at the level 0.001, 63 degrees.
TEST(LightProbe, SamplesSpreadOverTheSolidAngleOfOnePixel) {
    const LightProbe probe(1, 1, {glm::vec3(2.0f)}, "one");
    std::vector<int> met(64, 0);
    std::mt19937 random(2);
    const int count = 100000;
    for (int n = 0; n < count; ++n) {
        const auto s = probe.sample(randomPoint(random));
        ASSERT_NEAR(s.density, 1 / (4 * kPi), 1e-7);
        ASSERT_EQ(s.radiance, glm::vec3(2.0f));
        const int i =
            std::min(7, static_cast<int>((std::atan2(s.direction.y, s.direction.x) / (2 * kPi) + 0.5) * 8));
        const int j = std::min(7, static_cast<int>((1 - s.direction.z) / 2 * 8));
        ++met[j * 8 + i];
    }
    double chiSquare = 0;
    for (const int m : met) chiSquare += (m - count / 64.0) * (m - count / 64.0) / (count / 64.0);
    EXPECT_LT(chiSquare, 103.44);
}

void expectSamplesAgreeWithLookups(const LightProbe& probe, unsigned seed, int count) {
    std::mt19937 random(seed);
    for (int n = 0; n < count; ++n) {
        const auto s = probe.sample(randomPoint(random));
        ASSERT_GT(s.density, 0);
        ASSERT_EQ(s.density, probe.density(s.direction)) << n;
        ASSERT_EQ(s.radiance, probe.radiance(s.direction)) << n;
        ASSERT_EQ(probe.seen(s.direction).density, s.density);
        ASSERT_EQ(probe.seen(s.direction).radiance, s.radiance);
        ASSERT_NEAR(glm::length(glm::dvec3(s.direction)), 1, 1e-6);
    }
}

TEST(LightProbe, SampledDensityIsTheDensityOfTheDirection) {
    expectSamplesAgreeWithLookups(randomProbe(256, 128, 7), 3, 200000);
    expectSamplesAgreeWithLookups(randomProbe(1, 64, 8), 4, 20000);
    expectSamplesAgreeWithLookups(randomProbe(64, 1, 9), 5, 20000);
}

// Fine pixels, where many rounded directions fall into the neighbour.
TEST(LightProbe, SampledDensityIsTheDensityOfTheDirectionInFinePixels) {
    expectSamplesAgreeWithLookups(randomProbe(4096, 2048, 10), 6, 200000);
}

TEST(LightProbe, EndsOfTheSampleSquare) {
    const LightProbe probe = randomProbe(32, 16, 12);
    const float last = std::nextafter(1.0f, 0.0f), nan = std::numeric_limits<float>::quiet_NaN();
    for (const float x : {0.0f, 1e-30f, 0.5f, last, 1.0f, nan})
        for (const float y : {0.0f, 1e-30f, 0.5f, last, 1.0f, nan}) {
            const auto s = probe.sample({x, y});
            ASSERT_GT(s.density, 0) << x << " " << y;
            ASSERT_EQ(s.density, probe.density(s.direction)) << x << " " << y;
        }
}

// Radiance over density has the probe's mean for its expectation: |z| < 3.29 (level 0.001) in each channel.
void expectMeanBySampling(const LightProbe& probe, unsigned seed) {
    const int count = 200000;
    std::mt19937 random(seed);
    glm::dvec3 sum(0.0), squares(0.0);
    for (int n = 0; n < count; ++n) {
        const auto s = probe.sample(randomPoint(random));
        const glm::dvec3 value = glm::dvec3(s.radiance) / (4 * kPi * s.density);
        sum += value;
        squares += value * value;
    }
    const glm::dvec3 mean = sum / static_cast<double>(count);
    const glm::dvec3 error = glm::sqrt((squares / static_cast<double>(count) - mean * mean) / (count - 1.0));
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(std::abs(mean[c] - probe.mean()[c]), 3.29 * error[c] + 1e-6 * mean[c]) << c;
}

TEST(LightProbe, MeanBySampling) {
    expectMeanBySampling(randomProbe(64, 32, 13), 21);
}

TEST(LightProbe, MeanOfKnownPictures) {
    EXPECT_EQ(LightProbe(1, 1, {{1, 2, 3}}, "one").mean(), glm::vec3(1, 2, 3));
    const LightProbe half = probeOf(40, 20, [](const glm::dvec3& w) { return glm::dvec3(w.z > 0 ? 4 : 0); });
    EXPECT_NEAR(half.mean().x, 2, 1e-6);
    const LightProbe constant = probeOf(40, 21, [](const glm::dvec3&) { return glm::dvec3(0.3); });
    EXPECT_NEAR(constant.mean().y, 0.3, 1e-7);
}

// One pixel of 512 x 256 a hundred thousand times the mean of the others.
TEST(LightProbe, PeakOfAHundredThousandTimesTheMean) {
    std::vector<glm::vec3> pixels(512 * 256, glm::vec3(1.0f));
    pixels[512 * 60 + 300] = glm::vec3(1e5f);
    const LightProbe probe(512, 256, pixels, "peak");
    const double peak = 1e5 * solidAngle(60, 512, 256), rest = 4 * kPi - solidAngle(60, 512, 256);
    EXPECT_NEAR(probe.mean().x, (peak + rest) / (4 * kPi), 1e-5);
    EXPECT_NEAR(probe.density(glm::vec3(pixelDirection(300, 60, 512, 256))), 1e5 / (peak + rest), 1e-2);
    expectSamplesAgreeWithLookups(probe, 8, 100000);
    expectMeanBySampling(probe, 22);
}

TEST(LightProbe, HugeAndTinyRadianceStayFinite) {
    for (const float level : {std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min()}) {
        const LightProbe probe(8, 4, std::vector<glm::vec3>(32, glm::vec3(level)), "level");
        EXPECT_FALSE(probe.black());
        EXPECT_EQ(probe.mean(), glm::vec3(level));
        EXPECT_NEAR(probe.density({1, 0, 0}), 1 / (4 * kPi), 1e-7);
        expectSamplesAgreeWithLookups(probe, 9, 1000);
    }
}

TEST(LightProbe, BlackProbe) {
    const LightProbe probe(8, 4, std::vector<glm::vec3>(32, glm::vec3(0.0f)), "black");
    EXPECT_TRUE(probe.black());
    EXPECT_EQ(probe.mean(), glm::vec3(0.0f));
    const auto s = probe.sample({0.3f, 0.6f});
    EXPECT_EQ(s.density, 0);
    EXPECT_EQ(s.radiance, glm::vec3(0.0f));
    EXPECT_EQ(glm::length(s.direction), 1);
    for (int j = 0; j < 4; ++j) ASSERT_EQ(probe.density(glm::vec3(pixelDirection(3, j, 8, 4))), 0);
    EXPECT_FALSE(LightProbe(1, 1, {glm::vec3(0, 0, 1e-30f)}, "blue").black());
}

TEST(LightProbe, PixelsThatAreNoLightAreRefused) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, inf, -inf, -1e-30f})
        for (int c = 0; c < 3; ++c) {
            std::vector<glm::vec3> pixels(12, glm::vec3(1.0f));
            pixels[7][c] = bad;
            EXPECT_THAT(complaintOf(4, 3, pixels),
                        AllOf(HasSubstr("some.hdr:pixel 3, 1: expected radiance of 0 or more"),
                              Not(HasSubstr("\n"))));
        }
    EXPECT_THAT(complaintOf(0, 0, {}), HasSubstr("some.hdr: expected a light probe of at least one pixel"));
    EXPECT_THAT(complaintOf(2, 2, std::vector<glm::vec3>(3)), HasSubstr("2 x 2 with 3 pixels"));
    EXPECT_THAT(complaintOf(-2, -2, std::vector<glm::vec3>(4)), HasSubstr("got -2 x -2"));
}

TEST(LightProbe, GraceCathedral) {
    const auto file = test::realProbe("grace.hdr");
    if (file.empty()) GTEST_SKIP() << "no real data: set STEREONAV_TEST_DATA";
    const LightProbe probe = readLightProbe(file);
    ASSERT_EQ(probe.width(), 256);
    ASSERT_EQ(probe.height(), 128);
    float peak = 0;
    for (int j = 0; j < 128; ++j)
        for (int i = 0; i < 256; ++i) {
            const glm::vec3 c = probe.radiance(glm::vec3(pixelDirection(i, j, 256, 128)));
            peak = std::max({peak, c.x, c.y, c.z});
        }
    EXPECT_NEAR(peak, 3504, 0.5);  // the data's own description
    expectSamplesAgreeWithLookups(probe, 10, 100000);
    expectMeanBySampling(probe, 23);
}

TEST(LightProbe, Uffizi) {
    const auto file = test::realProbe("uffizi.hdr");
    if (file.empty()) GTEST_SKIP() << "no real data: set STEREONAV_TEST_DATA";
    const LightProbe probe = readLightProbe(file);
    ASSERT_EQ(probe.width(), 256);
    ASSERT_EQ(probe.height(), 128);
    expectSamplesAgreeWithLookups(probe, 11, 100000);
    expectMeanBySampling(probe, 24);
}

// A panorama as one sees it from inside: ahead (+y) in its middle, +x to the right of it, -x to the left.
TEST(LightProbe, APictureIsSeenFromInside) {
    const auto file = std::filesystem::temp_directory_path() / "stereonav_probe_sides.hdr";
    std::ofstream out(file, std::ios::binary);
    out << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
    const std::array<std::array<unsigned char, 4>, 4> columns{
        {{128, 0, 0, 129}, {0, 128, 0, 129}, {0, 0, 128, 129}, {128, 128, 128, 129}}};
    for (int row = 0; row < 2; ++row)
        for (const auto& c : columns) out.write(reinterpret_cast<const char*>(c.data()), 4);
    out.close();
    const LightProbe probe = readLightProbe(file);
    const auto at = [&](double heading_deg) {  // clockwise from +y
        const double h = glm::radians(heading_deg);
        return probe.radiance(glm::normalize(glm::vec3(std::sin(h), std::cos(h), 0.1)));
    };
    EXPECT_EQ(at(-135), glm::vec3(1, 0, 0));
    EXPECT_EQ(at(-45), glm::vec3(0, 1, 0));
    EXPECT_EQ(at(45), glm::vec3(0, 0, 1));
    EXPECT_EQ(at(135), glm::vec3(1, 1, 1));
    std::filesystem::remove(file);
}

TEST(LightProbe, AFileThatIsMissing) {
    EXPECT_THROW(readLightProbe("/nowhere/probe.hdr"), Error);
}

// DICOM by its name in its place; the library behind pictures knows that, too.
TEST(LightProbe, AFileThatIsNoPicture) {
    const TemporaryFolder folder;
    for (const char* name : {"sky.hdr", "sky.png"}) {
        std::ofstream(folder / name, std::ios::binary)
            << std::string(128, '\0') << "DICM" << std::string(99, 'a');
        EXPECT_THAT(test::errorOf([&] { readLightProbe(folder / name); }),
                    AllOf(HasSubstr(std::string(name) + ": is not a picture"), Not(HasSubstr("\n"))));
    }
}

}  // namespace
}  // namespace stereonav
