// Every way of choosing paths must have the same expectation: means against naive paths of the plain tracer
// by z-tests with fixed seeds. A level of 4.5 standard errors is passed by chance but for 7e-6 of the tests.
#include <gmock/gmock.h>

#include "engine/light/paths/isovalue_surface.h"
#include "engine/light/paths/path_numbers.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "tests/light/light_scenes.h"
#include "tests/light/path_kernels.h"
#include "tests/light/probe_pictures.h"
#include "tests/oracle/plain_paths.h"

namespace stereonav {
namespace {

using namespace test;
constexpr double kLevel = 4.5;

struct Estimate {
    double mean = 0, error = 0;  // luminance, and its standard error
};

// Independent runs: samples of one run of a sequence are not.
Estimate estimate(const GreyVolume& volume, const LightSetup& setup, TexelSampling sampling,
                  const glm::ivec3& texel, int runs, int samples) {
    double sum = 0, squares = 0;
    for (int run = 0; run < runs; ++run) {
        sampling.seed = static_cast<std::uint64_t>(1000 + run);
        const TexelLighter lighter(volume, volume.frame, setup, sampling);
        const double light = luminanceOf(irradianceAt(lighter, texel, samples).mean);
        sum += light;
        squares += light * light;
    }
    const double mean = sum / runs;
    return {mean, std::sqrt(std::max(squares / runs - mean * mean, 0.0) / (runs - 1))};
}

// Plain naive paths, one by one.
Estimate plainEstimate(const GreyVolume& volume, const LightSetup& setup, const glm::ivec3& texel,
                       int samples) {
    TexelSampling naive;
    naive.naive = true;
    const TexelLighter lighter(volume, volume.frame, setup, naive);
    const PlainPaths paths(volume, setup, naive);
    const auto place = lighter.place(texel);
    PlainPaths::Start start;
    start.isovalue = static_cast<double>(place.isovalue);
    start.normal = place.normal;
    start.voxel = liftedStart(volume, start.isovalue, glm::dvec3(texel), place.normal);
    start.key = 77;
    double mean = 0, squares = 0;
    for (int n = 0; n < samples; ++n) {
        const double light = luminanceOf(glm::vec3(paths.irradiance(start, static_cast<std::uint32_t>(n))));
        const double apart = light - mean;
        mean += apart / (n + 1);
        squares += apart * (light - mean);
    }
    return {mean, std::sqrt(squares / samples / samples)};
}

std::vector<TexelSampling> switches() {
    TexelSampling all, naive;
    naive.naive = true;
    std::vector<TexelSampling> list{all, naive};
    for (bool TexelSampling::*what :
         {&TexelSampling::lowDiscrepancy, &TexelSampling::cosine, &TexelSampling::nextEvent,
          &TexelSampling::roulette, &TexelSampling::leaping}) {
        TexelSampling some = all;
        some.*what = false;
        list.push_back(some);
    }
    return list;
}

LightSetup brightSetup() {
    LightSetup setup;
    setup.sky = glm::vec3(0.3f, 0.2f, 0.1f);
    setup.probe = std::make_shared<LightProbe>(probeOf(32, 16, [](const glm::dvec3& d) {
        const double lamp = glm::dot(d, glm::normalize(glm::dvec3(0.5, 0.2, 0.8)));
        return glm::dvec3(lamp > 0.9 ? 20.0 : 0.2 + 0.1 * d.x, 0.3, lamp > 0.9 ? 5.0 : 0.1);
    }));
    setup.albedo = glm::vec3(0.6f, 0.25f, 0.05f);  // dim enough for roulette
    setup.bounces = 5;
    return setup;
}

TEST(TexelSampling, AllWaysHaveTheMeanOfPlainNaivePaths) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    const LightSetup setup = brightSetup();
    for (const glm::ivec3 texel : {glm::ivec3(18, 14, 6), glm::ivec3(24, 16, 9)}) {
        const Estimate truth = plainEstimate(volume, setup, texel, 40000);
        ASSERT_LT(truth.error, 0.05 * truth.mean);
        int number = 0;
        for (const TexelSampling& sampling : switches()) {
            const Estimate e = estimate(volume, setup, sampling, texel, 24, sampling.naive ? 4096 : 256);
            EXPECT_LT(std::abs(e.mean - truth.mean), kLevel * std::hypot(e.error, truth.error))
                << number << ": " << e.mean << " +- " << e.error << ", " << truth.mean << " +- "
                << truth.error;
            ++number;
        }
    }
}

// What each gains where it should: less variance at the same number of samples.
TEST(TexelSampling, EachWayLowersTheError) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    const LightSetup setup = brightSetup();
    const auto list = switches();
    const glm::ivec3 texel(18, 14, 6);
    const double all = estimate(volume, setup, list[0], texel, 60, 64).error;
    EXPECT_LT(all, 0.3 * estimate(volume, setup, list[1], texel, 60, 64).error);   // naive
    EXPECT_LT(all, 0.85 * estimate(volume, setup, list[2], texel, 60, 64).error);  // independent numbers
    EXPECT_LT(all, 0.7 * estimate(volume, setup, list[4], texel, 60, 64).error);   // probe not sampled
}

// A pixel of a thousandth of the sphere, 1e5 times as bright as the mean of the others.
TEST(TexelSampling, APeakOfTheProbeIsFound) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    LightSetup setup;
    std::vector<glm::vec3> pixels(32 * 16, glm::vec3(1.0f));
    pixels[4 * 32 + 20] = glm::vec3(1e5f);
    setup.probe = std::make_shared<LightProbe>(32, 16, pixels, "peak");
    setup.bounces = 1;
    const glm::ivec3 texel(18, 14, 6);
    const Estimate ours = estimate(volume, setup, {}, texel, 16, 256);
    EXPECT_LT(ours.error, 0.02 * ours.mean);
    const Estimate truth = plainEstimate(volume, setup, texel, 60000);
    EXPECT_LT(std::abs(ours.mean - truth.mean), kLevel * std::hypot(ours.error, truth.error));
}

TEST(TexelSampling, ABlackProbeIsDarkAndAConstantOneIsTheSky) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    const glm::ivec3 texel(18, 14, 6);
    LightSetup black, constant, sky;
    black.probe = std::make_shared<LightProbe>(8, 4, std::vector<glm::vec3>(32, glm::vec3(0.0f)), "black");
    constant.probe =
        std::make_shared<LightProbe>(8, 4, std::vector<glm::vec3>(32, glm::vec3(0.5f)), "constant");
    sky.sky = glm::vec3(0.5f);
    for (const TexelSampling& sampling : switches()) {
        const Estimate dark = estimate(volume, black, sampling, texel, 2, 64);
        EXPECT_EQ(dark.mean, 0);
        const Estimate a = estimate(volume, constant, sampling, texel, 16, 256);
        const Estimate b = estimate(volume, sky, sampling, texel, 16, 256);
        EXPECT_LT(std::abs(a.mean - b.mean), kLevel * std::hypot(a.error, b.error) + 1e-6);
    }
}

// A texel on a convex body sees its own half of the sky: closed form for a probe that is linear in direction.
TEST(TexelSampling, ALinearProbeGivesItsCosineLobe) {
    const GreyVolume volume = ballVolume(33, glm::dvec3(16), 10);
    LightSetup setup;
    setup.bounces = 0;
    const glm::dvec3 slope(0.3, -0.2, 0.5);
    setup.probe = std::make_shared<LightProbe>(
        probeOf(128, 64, [&](const glm::dvec3& d) { return glm::dvec3(1 + glm::dot(d, slope)); }));
    for (const glm::ivec3 texel : {glm::ivec3(26, 16, 16), glm::ivec3(9, 13, 22), glm::ivec3(16, 16, 6)}) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(texel) - glm::dvec3(16));
        const Estimate e = estimate(volume, setup, {}, texel, 8, 1024);
        EXPECT_NEAR(e.mean, 1 + 2.0 / 3 * glm::dot(n, slope), 0.005);
    }
}

// Axes that are turned: the light stays where it is in the world.
TEST(TexelSampling, TurnedVolumesSeeTheSameWorld) {
    const glm::dvec3 centre(16);
    const auto ball = [&](const glm::dvec3& v) { return 400 * (10 - glm::length(v - centre)); };
    VolumeFrame frame = slantedFrame({33, 33, 33}, glm::dvec3(1e-3));
    frame.axes[2] = -frame.axes[2];  // left-handed
    const GreyVolume turned = greyVolume(frame, ball);
    LightSetup setup;
    setup.bounces = 0;
    const glm::dvec3 slope(0.3, -0.2, 0.5);
    setup.probe = std::make_shared<LightProbe>(
        probeOf(128, 64, [&](const glm::dvec3& d) { return glm::dvec3(1 + glm::dot(d, slope)); }));
    const glm::dvec3 above(16, 16, 30);
    setup.lights = {{frame.worldFromVoxel(above), glm::vec3(1e-4f), 1e-4}};
    for (const glm::ivec3 texel : {glm::ivec3(26, 16, 16), glm::ivec3(18, 16, 26)}) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(texel) - centre);
        const glm::dvec3 way = above - (glm::dvec3(texel) + 0.25 * n);
        const double d = glm::length(way), cosine = std::max(glm::dot(way, n) / d, 0.0);
        const double point = 1e-4 * cosine / (std::numbers::pi * d * d * 1e-6);
        const Estimate e = estimate(turned, setup, {}, texel, 8, 1024);
        EXPECT_NEAR(e.mean, 1 + 2.0 / 3 * glm::dot(frame.axes * n, slope) + point, 0.01 + 0.02 * point);
    }
}

// Transfer dotted with the coefficients of a light that has no more bands than it is irradiance.
TEST(TexelSampling, TransferOfBandLimitedLightIsIrradiance) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    LightSetup setup;
    setup.albedo = glm::vec3(0.9f, 0.5f, 0.2f);
    setup.bounces = 4;
    const int order = 5;
    std::vector<double> wanted(static_cast<std::size_t>(harmonicsCount(order)), 0.0);
    Random random(2);
    for (double& c : wanted) c = random.between(-0.15, 0.15);
    wanted[0] = 3;
    setup.probe = std::make_shared<LightProbe>(probeOf(128, 64, [&](const glm::dvec3& d) {
        double values[kMaxHarmonics], light = 0;
        evaluateHarmonics(d, order, values);
        for (std::size_t n = 0; n < wanted.size(); ++n) light += wanted[n] * values[n];
        return light * glm::dvec3(1.0, 0.5, 0.25);
    }));
    const std::vector<glm::vec3> light = setup.probe->project(order);
    const int samples = 8192;
    const TexelLighter lighter(volume, volume.frame, setup, {});
    for (const glm::ivec3 texel : {glm::ivec3(18, 14, 6), glm::ivec3(24, 16, 9)}) {
        const TexelSum sum = irradianceAt(lighter, texel, samples);
        for (const int channels : {1, 3}) {
            std::vector<float> sums(wanted.size() * static_cast<std::size_t>(channels), 0.0f);
            std::uint8_t alive = 0;
            lighter.addTransfer({&texel, 1}, 0, samples / 2, order, channels, sums, {&alive, 1});
            lighter.addTransfer({&texel, 1}, samples / 2, samples / 2, order, channels, sums, {&alive, 1});
            ASSERT_EQ(alive, 1);
            glm::dvec3 lit(0.0);
            for (std::size_t n = 0; n < wanted.size(); ++n)
                for (int k = 0; k < 3; ++k)
                    lit[k] += double(light[n][k]) *
                              double(sums[n * std::size_t(channels) + std::size_t(channels == 3 ? k : 0)]) /
                              samples;
            if (channels == 3) {
                for (int k = 0; k < 3; ++k)
                    EXPECT_NEAR(lit[k], double(sum.mean[k]), 0.01 * double(sum.mean[k])) << k;
            } else {  // the mean albedo for all: 1.6 / 3
                LightSetup grey = setup;
                grey.albedo = glm::vec3(1.6f / 3);
                const TexelLighter other(volume, volume.frame, grey, {});
                const TexelSum same = irradianceAt(other, texel, samples);
                EXPECT_NEAR(lit.x, double(same.mean.x), 0.01 * double(same.mean.x));
            }
        }
    }
}

// The harmonics of the kernels are those of evaluateHarmonics: transfer of paths that leave at once, summed
// here from the plain paths.
TEST(TexelSampling, TransferIsThatOfThePlainPaths) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    LightSetup setup;
    setup.albedo = glm::vec3(0.9f, 0.5f, 0.2f);
    setup.bounces = 3;
    const glm::ivec3 texel(18, 14, 6);
    for (const int order : {1, 2, 6})
        for (const SimdTarget target : simdTargets()) {
            TexelSampling sampling;
            sampling.simd = target;
            const TexelLighter lighter(volume, volume.frame, setup, sampling);
            const PlainPaths paths(volume, setup, sampling);
            const auto place = lighter.place(texel);
            PlainPaths::Start start;
            start.isovalue = static_cast<double>(place.isovalue);
            start.normal = place.normal;
            start.voxel = liftedStart(volume, start.isovalue, glm::dvec3(texel), place.normal);
            start.key = pathKey(sampling.seed, volume.frame.index(texel));
            std::vector<float> sums(static_cast<std::size_t>(3 * harmonicsCount(order)), 0.0f);
            std::vector<double> expected(sums.size(), 0.0);
            std::uint8_t alive = 0;
            lighter.addTransfer({&texel, 1}, 0, 400, order, 3, sums, {&alive, 1});
            for (std::uint32_t n = 0; n < 400; ++n) {
                const PlainPaths::Escape escape = paths.escape(start, n);
                if (escape.throughput == glm::dvec3(0.0)) continue;
                double values[kMaxHarmonics];
                evaluateHarmonics(escape.direction, order, values);
                for (int c = 0; c < harmonicsCount(order); ++c)
                    for (int k = 0; k < 3; ++k)
                        expected[static_cast<std::size_t>(3 * c + k)] += values[c] * escape.throughput[k];
            }
            // A path or two may part where it grazes.
            for (std::size_t n = 0; n < sums.size(); ++n)
                ASSERT_NEAR(double(sums[n]), expected[n], 2.5 + 1e-3 * std::abs(expected[n])) << n;
            EXPECT_GT(sums[0], 40);
        }
}

}  // namespace
}  // namespace stereonav
