// Paths traced from every pixel: the furnace's value, closed forms, the oracle path by path, baked light
// looked up at the same hits, independence of threads.
#include "engine/light/paths/pixel_path.h"

#include <gtest/gtest.h>

#include <cstring>

#include "engine/base/parallel.h"
#include "engine/camera/stereo_rig.h"
#include "engine/light/bake/bake_job.h"
#include "engine/light/paths/isovalue_surface.h"
#include "engine/light/paths/path_numbers.h"
#include "engine/math/constants.h"
#include "engine/volume/volume_renderer.h"
#include "tests/light/light_scenes.h"
#include "tests/oracle/plain_paths.h"

namespace stereonav {
namespace {

using namespace test;

VolumeScene sceneOf(GreyVolume field) {
    VolumeScene scene;
    scene.field = std::move(field);
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, {}, progress);  // at 0
    scene.look.specular = 0;
    return scene;
}

// Returns the view from `from` along -z and a little aside, in voxels of a millimetre.
EyeView viewFrom(const glm::dvec3& from, int width, int height, double halfWidth) {
    EyeView view;
    view.eye = view.head = from * 1e-3;
    view.forward = glm::normalize(glm::dvec3(0.05, 0.03, -1));
    view.right = glm::normalize(glm::cross(view.forward, glm::dvec3(0, 1, 0)));
    view.up = glm::cross(view.right, view.forward);
    view.xMax = halfWidth;
    view.yMax = halfWidth * height / width;
    view.xMin = -view.xMax;
    view.yMin = -view.yMax;
    view.width = width;
    view.height = height;
    view.nearDepth = 1e-4;
    return view;
}

struct Traced {
    EyeImage image;
    Plane<TexelSum> sums;
};

Traced trace(const VolumeScene& scene, const EyeView& view, const LightSetup& setup, int samples,
             const TexelSampling& sampling = {}, std::uint32_t stream = 0) {
    Traced traced;
    const VolumeRenderer renderer(scene);
    traced.image.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, traced.image);
    Progress progress;
    PixelPaths(scene, setup, sampling)
        .add(view, traced.image.viewDepth, stream, samples, traced.sums, progress);
    return traced;
}

template <typename Visit>
int eachPixel(const Traced& traced, const Visit& visit) {
    int count = 0;
    for (int y = 0; y < traced.sums.height(); ++y)
        for (int x = 0; x < traced.sums.width(); ++x)
            if (traced.sums.at(x, y).samples > 0) {
                visit(x, y, traced.sums.at(x, y));
                ++count;
            }
    return count;
}

LightSetup whiteSky(int bounces, float albedo = 0.7f) {
    LightSetup setup;
    setup.sky = glm::vec3(1);
    setup.albedo = glm::vec3(albedo);
    setup.bounces = bounces;
    return setup;
}

// A point light in the middle of a closed sphere lights all of it alike, at every bounce.
TEST(PixelPath, AFurnaceHasItsValueInEveryPixel) {
    const glm::dvec3 centre(20, 20, 20);
    const double radius = 14;
    const VolumeScene scene = sceneOf(
        solidVolume(cubeFrame(41), [&](const glm::dvec3& v) { return glm::length(v - centre) - radius; }));
    const EyeView view = viewFrom({20, 20, 24}, 14, 10, 1.0);
    for (const float albedo : {0.0f, 0.6f, 1.0f}) {
        LightSetup setup = whiteSky(3, albedo);
        setup.sky = glm::vec3(0);
        setup.lights = {{centre * 1e-3, glm::vec3(2e-4f), 1e-4}};
        double expected = 0;
        for (int b = 0; b <= 3; ++b)
            expected += 2e-4 / (kPi * radius * radius * 1e-6) * std::pow(double(albedo), b);
        const int pixels = eachPixel(trace(scene, view, setup, 64), [&](int x, int y, const TexelSum& sum) {
            EXPECT_NEAR(luminanceOf(sum.mean), expected, 4 * standardError(sum) + 0.04 * expected)
                << albedo << " " << x << " " << y;
        });
        EXPECT_EQ(pixels, 14 * 10);
    }
}

// Without bounces under a constant sky it is what vicinity shading (Stewart 2003) gives: the open share. In a
// spherical bowl that is the same everywhere.
TEST(PixelPath, WithoutBouncesItIsTheOpenShare) {
    const glm::dvec3 centre(32, 32, 34);
    const double radius = 26, top = 30;
    const VolumeScene scene = sceneOf(bowlVolume(65, centre, radius, top));
    const EyeView view = viewFrom({32, 32, 29}, 12, 12, 0.6);  // the bowl's floor alone
    const double share = (top - (centre.z - radius)) / (2 * radius);
    const int pixels = eachPixel(trace(scene, view, whiteSky(0), 256), [&](int, int, const TexelSum& sum) {
        EXPECT_NEAR(sum.mean.x, 1 - share, 4 * standardError(sum) + 0.01);
    });
    EXPECT_EQ(pixels, 12 * 12);
}

// A block with a bowl beside a ball: shade, bounces and edges.
GreyVolume shadedPlace(int size) {
    return solidVolume(cubeFrame(size), [=](const glm::dvec3& v) {
        const double bowl = std::min(glm::length(v - glm::dvec3(12, 15, 14)) - 8, 12 - v.z);
        return std::max(bowl, 5 - glm::length(v - glm::dvec3(23, 17, 18)));
    });
}

LightSetup mixedLight() {
    LightSetup setup = whiteSky(2, 0.8f);
    setup.sky = glm::vec3(0.3f, 0.5f, 0.7f);
    setup.lights = {{glm::dvec3(0.01, 0.03, 0.06), glm::vec3(2e-3f, 1e-3f, 5e-4f), 1e-3}};
    return setup;
}

TEST(PixelPath, SamplesAreThoseOfTheOracle) {
    const VolumeScene scene = sceneOf(shadedPlace(32));
    const EyeView view = viewFrom({16, 16, 60}, 16, 14, 0.3);
    const LightSetup setup = mixedLight();
    TexelSampling sampling;
    sampling.seed = 77;
    const Traced traced = trace(scene, view, setup, 8, sampling, 3);
    const PlainPaths plain(scene.field, setup, sampling);
    double apart = 0, whole = 0;
    const int pixels = eachPixel(traced, [&](int x, int y, const TexelSum& sum) {
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const glm::dvec3 voxel = scene.field.frame.voxelFromWorld(
            view.eye + static_cast<double>(traced.image.viewDepth.at(x, y)) * ray);
        const glm::dvec3 normal = surfaceNormal(scene.field, voxel);
        ASSERT_NE(normal, glm::dvec3(0.0));
        const std::uint64_t number = std::uint64_t{3} << 40 | static_cast<std::uint64_t>(y * view.width + x);
        const PlainPaths::Start start{0, liftedStart(scene.field, 0, voxel, normal), normal,
                                      pathKey(77, number)};
        glm::dvec3 mean(0.0);
        for (std::uint32_t s = 0; s < 8; ++s) mean += plain.irradiance(start, s) / 8.0;
        apart += std::pow(luminanceOf(glm::vec3(mean)) - luminanceOf(sum.mean), 2);
        whole += std::pow(luminanceOf(sum.mean), 2);
    });
    EXPECT_GT(pixels, 150);
    // Rays that graze an edge may turn out otherwise in single precision: few do.
    EXPECT_LT(std::sqrt(apart / whole), 1e-3);
}

// Means of independent samples with two seeds: the squares of their differences over their variances are
// chi-square; bounds at about four of its standard deviations.
TEST(PixelPath, MeansOfTwoSeedsDifferAsChanceHasIt) {
    const VolumeScene scene = sceneOf(shadedPlace(32));
    const EyeView view = viewFrom({16, 16, 60}, 16, 14, 0.3);
    TexelSampling first, second;
    first.lowDiscrepancy = second.lowDiscrepancy = false;
    second.seed = 2;
    const Traced a = trace(scene, view, mixedLight(), 256, first);
    const Traced b = trace(scene, view, mixedLight(), 256, second);
    double sum = 0, squares = 0;
    int counted = 0;
    eachPixel(a, [&](int x, int y, const TexelSum& one) {
        const TexelSum& other = b.sums.at(x, y);
        const double variance = std::pow(standardError(one), 2) + std::pow(standardError(other), 2);
        if (!(variance > 1e-8)) return;  // direct light alone: no chance in it
        const double z = (luminanceOf(one.mean) - luminanceOf(other.mean)) / std::sqrt(variance);
        sum += z;
        squares += z * z;
        ++counted;
    });
    ASSERT_GT(counted, 100);
    EXPECT_LT(std::abs(sum), 4 * std::sqrt(counted));
    EXPECT_NEAR(squares, counted, 4 * std::sqrt(2.0 * counted));
}

TEST(PixelPath, LowDiscrepancyComesToTheSameMean) {
    const VolumeScene scene = sceneOf(shadedPlace(32));
    const EyeView view = viewFrom({16, 16, 60}, 16, 14, 0.3);
    TexelSampling naive;
    naive.naive = true;
    const Traced a = trace(scene, view, mixedLight(), 256), b = trace(scene, view, mixedLight(), 512, naive);
    double off = 0, variance = 0;
    eachPixel(a, [&](int x, int y, const TexelSum& one) {
        const TexelSum& other = b.sums.at(x, y);
        off += luminanceOf(one.mean) - luminanceOf(other.mean);
        variance += std::pow(standardError(one), 2) + std::pow(standardError(other), 2);
    });
    EXPECT_LT(std::abs(off), 4 * std::sqrt(variance));
    EXPECT_LT(std::sqrt(variance), 0.01 * std::abs(factsOf(a.sums).mean * double(factsOf(a.sums).pixels)));
}

IlluminationVolume baked(const GreyVolume& field, double perVoxel, const LightSetup& setup, int samples) {
    const VolumeFrame texels = texelFrame(field.frame, perVoxel);
    Progress progress;
    BakeSums sums(texels, wantedBricks(field, texels, {0, 0, nullptr, false}, progress), {});
    const TexelLighter lighter(field, texels, setup, {});
    runBake(sums, sourceOf(lighter), {samples, 0, 0}, progress);
    return illuminationOf(sums);
}

// Relative RMS difference of light looked up from that traced at the same hits.
double lookupError(const EyeView& view, const Traced& traced, const IlluminationVolume& light) {
    double apart = 0, whole = 0;
    eachPixel(traced, [&](int x, int y, const TexelSum& sum) {
        const auto depth = static_cast<double>(traced.image.viewDepth.at(x, y));
        const IlluminationVolume::Light found = light.at(view.pointAt(x + 0.5, y + 0.5, depth));
        EXPECT_GT(found.weight, 0.99f);
        apart += std::pow(luminanceOf(found.value) - luminanceOf(sum.mean), 2);
        whole += std::pow(luminanceOf(sum.mean), 2);
    });
    EXPECT_GT(whole, 0);
    return std::sqrt(apart / whole);
}

// The shadow of a ball on a plane is wide and smooth under a sky: what is interpolated between texels is
// wrong by what light bends within a texel, and by the noise of both.
TEST(PixelPath, BakedLightComesToTheSamePicture) {
    const VolumeScene scene = sceneOf(solidVolume(cubeFrame(33), [](const glm::dvec3& v) {
        return std::max(6.3 - v.z, 6 - glm::length(v - glm::dvec3(16, 16, 15)));
    }));
    const EyeView view = viewFrom({10, 4, 90}, 20, 20, 0.14);
    const LightSetup setup = whiteSky(2);
    const Traced traced = trace(scene, view, setup, 1024);
    EXPECT_LT(factsOf(traced.sums).error, 0.02);
    const double coarse = lookupError(view, traced, baked(scene.field, 0.25, setup, 128));
    const double usual = lookupError(view, traced, baked(scene.field, 1, setup, 512));
    EXPECT_LT(usual, 0.01);
    EXPECT_GT(coarse, 2 * usual);
}

TEST(PixelPath, ThreadsAndSplitsChangeNothing) {
    const VolumeScene scene = sceneOf(shadedPlace(24));
    const EyeView view = viewFrom({12, 12, 50}, 17, 9, 0.3);
    const int before = threadCount();
    setThreadCount(1);
    const Traced one = trace(scene, view, mixedLight(), 24);
    setThreadCount(3);
    Traced many = trace(scene, view, mixedLight(), 24), halves = trace(scene, view, mixedLight(), 12);
    Progress progress;
    PixelPaths(scene, mixedLight()).add(view, halves.image.viewDepth, 0, 12, halves.sums, progress);
    setThreadCount(before);
    const Traced other = trace(scene, view, mixedLight(), 24, {}, 1);
    int differ = 0;
    const int pixels = eachPixel(one, [&](int x, int y, const TexelSum& sum) {
        EXPECT_EQ(std::memcmp(&sum, &many.sums.at(x, y), sizeof(sum)), 0) << x << " " << y;
        EXPECT_NEAR(halves.sums.at(x, y).mean.y, sum.mean.y, 1e-5) << x << " " << y;
        EXPECT_EQ(halves.sums.at(x, y).samples, 24);
        differ += other.sums.at(x, y).mean != sum.mean;
    });
    EXPECT_GT(differ, pixels / 4);  // another stream, other noise; direct light has none
}

// The colours equal those of the caster's lookups, to the last bit but one of ten.
TEST(PixelPath, ShowsLightAsTheCasterDoes) {
    VolumeScene scene = sceneOf(ballVolume(25, glm::dvec3(12.2, 12.1, 11.9), 7));
    scene.look.background = glm::vec3(0.1f, 0.2f, 0.3f);
    const EyeView view = viewFrom({12, 12, 60}, 20, 16, 0.2);
    auto light = std::make_shared<IlluminationVolume>(scene.field.frame);
    const glm::vec3 constant(0.5f, 0.25f, 2.0f);
    for (std::size_t n = 0; n < light->layout.count(); ++n) light->texels[n] = packTexel(constant, 1);
    scene.look.baked.light = light;
    scene.look.baked.exposure = 0.8f;
    const VolumeRenderer renderer(scene);
    EyeImage image, shown;
    image.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, image);
    shown = image;
    Plane<TexelSum> sums(view.width, view.height);
    int hits = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const bool hit = image.viewDepth.at(x, y) < kMissDepth;
            sums.at(x, y) = {hit ? constant : glm::vec3(0), hit ? 4.0f : -1.0f, 0};
            if (hit) shown.color.at(x, y) = 0, ++hits;
        }
    ASSERT_GT(hits, 60);
    ASSERT_LT(hits, 20 * 16);
    showPixelLight(scene.look, sums, 0.8f, shown);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            for (const int shift : {0, 10, 20})
                EXPECT_NEAR(int(shown.color.at(x, y) >> shift & 1023),
                            int(image.color.at(x, y) >> shift & 1023), 1)
                    << x << " " << y;
}

TEST(PixelPath, NothingSeenAndNoLightAreExact) {
    const VolumeScene scene = sceneOf(ballVolume(17, glm::dvec3(8), 4));
    EyeView away = viewFrom({8, 8, 60}, 6, 4, 0.2);
    away.forward = -away.forward;
    const PixelLightFacts none = factsOf(trace(scene, away, whiteSky(0), 4).sums);
    EXPECT_EQ(none.pixels, 0u);
    EXPECT_EQ(none.mean, 0);
    EXPECT_EQ(none.error, 0);
    LightSetup dark;
    const EyeView view = viewFrom({8, 8, 60}, 6, 4, 0.1);
    const PixelLightFacts black = factsOf(trace(scene, view, dark, 4).sums);
    EXPECT_GT(black.pixels, 4u);
    EXPECT_EQ(black.mean, 0);
    EXPECT_EQ(black.error, 0);
    EXPECT_EQ(factsOf(trace(scene, view, whiteSky(0), 1).sums).error,
              std::numeric_limits<double>::infinity());
    Progress progress;
    Plane<TexelSum> empty;
    PixelPaths(scene, dark).add(view, Plane<float>(), 0, 4, empty, progress);
    EXPECT_TRUE(empty.empty());
}

TEST(PixelPath, IsStoppedInBetween) {
    const VolumeScene scene = sceneOf(ballVolume(17, glm::dvec3(8), 4));
    const EyeView view = viewFrom({8, 8, 60}, 6, 8, 0.1);
    Traced traced = trace(scene, view, whiteSky(0), 1);
    Progress progress;
    progress.cancel();
    EXPECT_THROW(
        PixelPaths(scene, whiteSky(0)).add(view, traced.image.viewDepth, 0, 4, traced.sums, progress),
        Cancelled);
}

}  // namespace
}  // namespace stereonav
