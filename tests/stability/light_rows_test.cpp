// Light at its extremes: probes whose peak is up to 1e30 times their mean, or that are black; occlusion in
// degenerate boxes and at any offset of the values; one bright texel on the ground.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "engine/light/skies/light_probe.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/math/constants.h"
#include "engine/stereo/right_eye.h"
#include "terrain/cast/terrain_renderer.h"
#include "tests/light/occlusion_brute.h"
#include "tests/light/probe_pictures.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/stability_row.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using namespace test;

// ---- probes

// Solid angle of a pixel of row j.
double solidAngle(int width, int height, int j) {
    return 2 * kPi / width * (std::cos(kPi * j / height) - std::cos(kPi * (j + 1) / height));
}

class PeakRow : public testing::TestWithParam<double> {};

// A dim sky with one bright pixel beside the zenith, one at the horizon: peaks, over the rest.
LightProbe peakedProbe(double peak) {
    std::vector<glm::vec3> pixels(64 * 32, glm::vec3(1.0f));
    pixels[16 * 64 + 40] = pixels[7] = glm::vec3(static_cast<float>(peak));
    return LightProbe(64, 32, std::move(pixels), "peaked");
}

TEST_P(PeakRow, SamplesFollowTheBrightness) {
    const double peak = GetParam();
    const LightProbe probe = peakedProbe(peak);
    double total = 0;  // radiance times solid angle
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 64; ++i)
            total += double(probe.pixels()[static_cast<std::size_t>(j) * 64 + i].x) * solidAngle(64, 32, j);
    // A grey probe is sampled exactly by its brightness: radiance over density is the same everywhere. Both
    // are floats, the directions' rows and columns too: 16 roundings of 2^-24.
    StabilityRow even("probe/sample/" + shortNumber(peak),
                      "a probe with peaks of " + shortNumber(peak) + " times the rest, sampled",
                      "relative error of radiance over density", 16 * 0x1p-24, "");
    StabilityRow same("probe/density/" + shortNumber(peak),
                      "a probe with peaks of " + shortNumber(peak) + " times the rest, looked up again",
                      "relative difference of a sample's density and its direction's", 16 * 0x1p-24, "");
    std::mt19937 random(5);
    const auto unit = [&] { return static_cast<float>(random() % 65536) / 65536.0f; };
    constexpr float kLast = 0x1.fffffep-1f;
    for (int n = 0; n < 4000; ++n) {
        const glm::vec2 u = n == 0   ? glm::vec2(0)
                            : n == 1 ? glm::vec2(kLast)
                            : n == 2 ? glm::vec2(0, kLast)
                            : n == 3 ? glm::vec2(kLast, 0)
                                     : glm::vec2(unit(), unit());
        const LightProbe::Sample s = probe.sample(u);
        even.saw(std::abs(double(s.radiance.x) / s.density / total - 1));
        // A direction on a pixel's very edge may be taken for the next pixel's.
        if (probe.radiance(s.direction) == s.radiance)
            same.saw(std::abs(double(probe.density(s.direction)) / s.density - 1));
    }
}

TEST_P(PeakRow, ProjectionKeepsTheMean) {
    const double peak = GetParam();
    const LightProbe probe = peakedProbe(peak);
    double total = 0;
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 64; ++i)
            total += double(probe.pixels()[static_cast<std::size_t>(j) * 64 + i].x) * solidAngle(64, 32, j);
    StabilityRow row("probe/project/" + shortNumber(peak),
                     "a probe with peaks of " + shortNumber(peak) + " times the rest, projected",
                     "relative error of the mean, and coefficients beyond what the light can make", 1e-6, "");
    row.saw(std::abs(probe.mean().x * 4 * kPi / total - 1));
    for (int order = 1; order <= kMaxHarmonicsOrder; ++order) {
        const std::vector<glm::vec3> c = probe.project(order);
        row.saw(std::abs(c[0].x / (total / std::sqrt(4 * kPi)) - 1));
        // Y_lm is nowhere more than sqrt((2 l + 1) / (4 pi)).
        for (int l = 0; l < order; ++l)
            for (int m = l * l; m < (l + 1) * (l + 1); ++m)
                row.saw(std::abs(c[m].x) / (total * std::sqrt((2 * l + 1) / (4 * kPi))) - 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, PeakRow, testing::Values(1e-30, 1.0, 1e2, 1e5, 1e10, 1e30),
                         [](const auto& given) { return testName(shortNumber(given.param)); });

TEST(ProbeRows, Black) {
    StabilityRow row("probe/black", "a black probe, sampled and projected",
                     "densities, radiances and coefficients", 0, "");
    for (const LightProbe& probe :
         {LightProbe(1, 1, {glm::vec3(0)}, "b"), LightProbe(64, 32, std::vector<glm::vec3>(64 * 32), "b")}) {
        EXPECT_TRUE(probe.black());
        for (const float u : {0.0f, 0.3f, 0x1.fffffep-1f}) {
            const LightProbe::Sample s = probe.sample({u, u});
            row.saw(std::abs(s.density));
            row.saw(glm::length(s.radiance));
            row.saw(std::isfinite(s.direction.x + s.direction.y + s.direction.z) ? 0 : 1);
            row.saw(std::abs(probe.density(glm::normalize(glm::vec3(u, 1 - u, 0.2f)))));
        }
        for (const glm::vec3& c : probe.project(6)) row.saw(glm::length(c));
    }
}

// ---- occlusion

struct BoxCase {
    const char* id;
    const char* words;
    glm::ivec3 size, radius;
    int (*value)(const glm::ivec3& v);
};

int anyValue(const glm::ivec3& v) {
    return (v.x * 7919 + v.y * 10007 + v.z * 13007) % 2003 - 1000;
}

class BoxRow : public testing::TestWithParam<BoxCase> {};

TEST_P(BoxRow, IsWhatWholeBoxesSay) {
    const BoxCase& c = GetParam();
    // Half a byte is rounding; 0.04 for exp and pow in single precision (occlusion_extreme_test.cpp).
    StabilityRow row(std::string("occlusion/") + c.id, c.words, "difference from whole boxes", 0.54, "bytes");
    GreyVolume volume(frameOf(c.size, glm::dvec3(1e-3)));
    for (int k = 0; k < c.size.z; ++k)
        for (int j = 0; j < c.size.y; ++j)
            for (int i = 0; i < c.size.x; ++i)
                volume.at(i, j, k) = static_cast<std::int16_t>(c.value({i, j, k}));
    Progress quiet;
    for (const OcclusionMethod method : {OcclusionMethod::Reconstructed, OcclusionMethod::DrawnIn,
                                         OcclusionMethod::Gaussian, OcclusionMethod::Chebyshev})
        for (const SimdTarget target : simdTargets()) {
            const OpennessVolume open = estimateOpenness(volume, method, c.radius, quiet, target);
            for (int n = 0; n < 60; ++n) {
                const auto at = static_cast<int>(static_cast<long long>(n) *
                                                 (static_cast<long long>(volume.frame.count()) - 1) / 59);
                const glm::ivec3 v(at % c.size.x, at / c.size.x % c.size.y, at / (c.size.x * c.size.y));
                row.saw(bytesAway(open.at(v), opennessOf(boxAt(volume, v, c.radius), volume.at(v), method)));
            }
        }
}

INSTANTIATE_TEST_SUITE_P(
    Stability, BoxRow,
    testing::Values(
        BoxCase{"one-voxel", "a volume of one voxel", {1, 1, 1}, {3, 3, 3}, anyValue},
        BoxCase{"line", "a volume of one row", {300, 1, 1}, {64, 1, 1}, anyValue},
        BoxCase{"slice", "a volume of one slice", {40, 30, 1}, {5, 5, 5}, anyValue},
        BoxCase{"radius/0,0,1", "boxes three voxels high and one wide", {9, 8, 7}, {0, 0, 1}, anyValue},
        BoxCase{"radius/64", "boxes larger than the volume", {20, 18, 16}, {64, 64, 64}, anyValue},
        BoxCase{"even/0", "all values 0", {9, 9, 9}, {2, 2, 2}, [](const glm::ivec3&) { return 0; }},
        BoxCase{"even/top",
                "all values at the top of 16 bits",
                {9, 9, 9},
                {2, 2, 2},
                [](const glm::ivec3&) { return 32767; }},
        BoxCase{"even/bottom",
                "all values at the bottom of 16 bits",
                {9, 9, 9},
                {2, 2, 2},
                [](const glm::ivec3&) { return -32768; }},
        BoxCase{"two-values",
                "the two ends of 16 bits by turns",
                {20, 20, 20},
                {7, 7, 7},
                [](const glm::ivec3& v) { return (v.x + v.y + v.z) % 2 ? 32767 : -32768; }},
        BoxCase{"one-bright",
                "one voxel at the top of 16 bits, all others at the bottom",
                {21, 21, 21},
                {10, 10, 10},
                [](const glm::ivec3& v) { return v == glm::ivec3(10) ? 32767 : -32768; }},
        BoxCase{"one-above",
                "one voxel one above all others",
                {21, 21, 21},
                {10, 10, 10},
                [](const glm::ivec3& v) { return v == glm::ivec3(10) ? -32767 : -32768; }}),
    [](const auto& given) { return testName(given.param.id); });

class OcclusionOffsetRow : public testing::TestWithParam<int> {};

TEST_P(OcclusionOffsetRow, ChangesNoBit) {
    const int offset = GetParam();
    StabilityRow row("offset/occlusion/" + std::to_string(offset),
                     "values moved by " + std::to_string(offset) + ", to the end of 16 bits",
                     "bytes that differ", 0, "bytes");
    row.count(0);
    GreyVolume plain(frameOf({24, 20, 18}, glm::dvec3(1e-3))), moved(plain.frame);
    moved.offset = -1e6;
    for (std::size_t n = 0; n < plain.frame.count(); ++n) {
        const glm::ivec3 v(n % 24, n / 24 % 20, n / 480);
        plain.values[n] = static_cast<std::int16_t>(anyValue(v));
        moved.values[n] = static_cast<std::int16_t>(anyValue(v) + offset);
    }
    Progress quiet;
    for (const OcclusionMethod method : {OcclusionMethod::Reconstructed, OcclusionMethod::DrawnIn,
                                         OcclusionMethod::Gaussian, OcclusionMethod::Chebyshev}) {
        const OpennessVolume a = estimateOpenness(plain, method, glm::ivec3(4), quiet),
                             b = estimateOpenness(moved, method, glm::ivec3(4), quiet);
        for (std::size_t n = 0; n < plain.frame.count(); ++n) row.count(a.values[n] != b.values[n]);
    }
}

INSTANTIATE_TEST_SUITE_P(Stability, OcclusionOffsetRow, testing::Values(-31768, -1024, 1, 1024, 31765));

// ---- one bright texel

class BrightTexelRow : public testing::TestWithParam<RightEyeMethod> {};

// Black ground with one white texel, from above. A pixel takes from texels that its footprint meets and, by
// mip levels and the warp's four taps, from at most four pixels and two footprints around.
TEST_P(BrightTexelRow, LightsNothingFarFromIt) {
    const RightEyeMethod method = GetParam();
    StabilityRow row("texel/" + std::string(nameOf(method)),
                     "one white texel on black ground, right eye by " + std::string(nameOf(method)),
                     "pixels lit more than six pixels from it", 0, "pixels");
    row.count(0);
    TerrainScene scene = makeScene(makeGround("flat", 65, 65, 1));
    Plane<PackedColor> color(128, 128);
    color.at(64, 63) = packColor(glm::vec3(1.0f));
    scene.color = ColorTexture(color, {0.0, 0.0}, glm::dvec2(0.5));
    const TerrainRenderer renderer(scene);
    const Pose head = poseFromAngles({5, -8, 500}, 0, -kPi / 2, 0);
    const StereoViews views = makeStereoViews(head, {160, 120, 0.9, 1.0, 1}, {20, 400});
    const glm::dvec2 place = scene.ground.worldFromGrid(0.5 * glm::dvec2(64.5, 128 - 63.5));
    const glm::dvec3 at = views.right.project({place, 0});
    WarpSetting setting;
    setting.method = method;
    RightEye eye;
    EyeImage right;
    eye.render(renderer, views, castPicture(renderer, views.left), setting, right);
    int lit = 0;
    for (int y = 0; y < right.height(); ++y)
        for (int x = 0; x < right.width(); ++x) {
            if (right.color.at(x, y) == 0 || std::isinf(right.viewDepth.at(x, y))) continue;
            ++lit;
            row.count(std::max(std::abs(x + 0.5 - at.x), std::abs(y + 0.5 - at.y)) > 6);
        }
    EXPECT_GT(lit, 0) << "the texel is not seen at all";
}

INSTANTIATE_TEST_SUITE_P(Stability, BrightTexelRow,
                         testing::Values(RightEyeMethod::Full, RightEyeMethod::Paper, RightEyeMethod::Linear,
                                         RightEyeMethod::Cubic, RightEyeMethod::McMillan),
                         [](const auto& given) { return testName(std::string(nameOf(given.param))); });

}  // namespace
}  // namespace stereonav
