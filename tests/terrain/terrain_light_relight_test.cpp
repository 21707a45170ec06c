// Baked light under suns and skies: closed forms, path tracing, and that scenes without it stay as they were.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "engine/base/parallel.h"
#include "engine/math/luminance.h"
#include "engine/stereo/frame_plan.h"
#include "engine/stereo/right_eye.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/light/terrain_path_light.h"
#include "terrain/light/terrain_relight.h"
#include "terrain/scene/terrain_illumination.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Heightfield groundOf(int width, int height, glm::dvec2 spacing,
                     const std::function<double(double, double)>& at) {
    std::vector<float> heights;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            heights.push_back(static_cast<float>(
                at((i - 0.5 * (width - 1)) * spacing.x, (j - 0.5 * (height - 1)) * spacing.y)));
    return Heightfield(width, height, spacing, std::move(heights), "test");
}

TerrainLight bakeForRelight(const Heightfield& ground, const TerrainLightSettings& settings = {}) {
    Progress quiet;
    return bakeTerrainLight(ground, settings, quiet);
}

glm::vec3 gradient(const glm::dvec3& d) {
    return gradientSky(glm::vec3(d));
}

SunAndSky lightAt(double azimuth_deg, double elevation_deg) {
    TerrainLook look;
    look.sunAzimuth = azimuth_deg * kDegree;
    look.sunElevation = elevation_deg * kDegree;
    return sunAndSky(look, skyRadiance(gradient));
}

TEST(SunAndSky, IsWhiteAndOneWithTheSunHalfWayUp) {
    const SunAndSky light = lightAt(77, 45);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.level()[c], 1, 1e-5);
    EXPECT_NEAR(luminance(glm::dvec3(light.sky.level)), TerrainLook().ambient, 1e-5);
    EXPECT_NEAR(exposureOf(light), 1, 1e-5);
    EXPECT_NEAR(
        glm::dot(light.toSun, glm::dvec3(std::sin(77 * kDegree), std::cos(77 * kDegree), 1)) / std::sqrt(2.0),
        1, 1e-9);
}

TEST(SunAndSky, GetsRedderAndDarkerAsTheSunSinks) {
    double before = 1e9, red = 0;
    for (const double elevation : {60.0, 30.0, 10.0, 3.0, 0.0}) {
        const SunAndSky light = lightAt(0, elevation);
        const double level = luminance(glm::dvec3(light.level()));
        EXPECT_LT(level, before) << elevation;
        EXPECT_GT(light.sun.x / light.sun.z, red) << elevation;
        before = level;
        red = light.sun.x / light.sun.z;
    }
    const SunAndSky night = lightAt(0, -20);
    EXPECT_EQ(night.sun, glm::vec3(0.0f));
    EXPECT_GT(night.sky.level.y, 0.0f);
    EXPECT_LT(night.sky.level.y, 0.01f);
    EXPECT_LE(exposureOf(night), 4.0f);
}

TEST(SunAndSky, TakesAnySky) {
    TerrainLook look;
    look.ambient = 1;
    const SunAndSky black = sunAndSky(look, skyRadiance([](const glm::dvec3&) { return glm::vec3(0.0f); }));
    EXPECT_EQ(black.sun, glm::vec3(0.0f));
    EXPECT_GT(black.sky.level.y, 0.5f);
    look.ambient = 0;
    const SunAndSky harsh = sunAndSky(look, skyRadiance(gradient));
    EXPECT_EQ(harsh.sky.level, glm::vec3(0.0f));
    EXPECT_GT(harsh.sun.y, 1.0f);
}

TEST(TerrainRelight, LevelGroundGetsExactlyTheSunAndTheSky) {
    const Heightfield ground = groundOf(40, 23, {30, 30}, [](double, double) { return -12.0; });
    for (const TerrainLightKind kind : {TerrainLightKind::Transfer, TerrainLightKind::Openness}) {
        TerrainLightSettings settings;
        settings.kind = kind;
        const TerrainRelight relight(ground, bakeForRelight(ground, settings));
        for (const double elevation : {90.0, 33.0, 2.0, -1.0})
            for (const double azimuth : {0.0, 123.0, 359.9}) {
                const SunAndSky now = lightAt(azimuth, elevation);
                GroundBrightness brightness;
                relight.relight(now, brightness);
                ASSERT_EQ(brightness.width, 40);
                ASSERT_EQ(brightness.height, 23);
                const glm::vec3 expected = now.level();
                for (int j = 0; j < 23; j += 2)
                    for (int i = 0; i < 40; i += 3)
                        for (int c = 0; c < 3; ++c)
                            // Openness is exact; order 4 leaves out a little of the sky's shape.
                            ASSERT_NEAR(brightness.at(i, j)[c], expected[c],
                                        kind == TerrainLightKind::Openness ? 1e-5 : 0.03 * now.sky.level[c])
                                << elevation << " " << azimuth;
            }
    }
}

TEST(TerrainRelight, AWallsShadowEndsWhereTheSunClearsIt) {
    const double wall = 100;
    const Heightfield ground =
        groundOf(81, 41, {10, 10}, [&](double x, double) { return x > 295 ? wall : 0.0; });
    TerrainLightSettings settings;
    settings.bounces = 0;
    const TerrainRelight relight(ground, bakeForRelight(ground, settings));
    GroundBrightness brightness;
    int dark = 0, lit = 0;
    for (const double elevation : {10.0, 20.0, 40.0}) {
        const SunAndSky now = lightAt(90, elevation);  // from the east, beyond the wall
        relight.relight(now, brightness);
        for (int i = 0; i < 69; ++i) {
            const double rim = std::atan2(wall, 300 - (i - 40) * 10.0) / kDegree;
            const double bright = brightness.at(i, 20).y;
            // The byte's step is 0.22 degrees of a low horizon.
            if (rim > elevation + 0.8) {
                EXPECT_LT(bright, 1.02 * now.sky.level.y) << elevation << " " << i;
                ++dark;
            }
            if (rim < elevation - 0.8) {
                EXPECT_GT(bright, now.sun.y * now.toSun.z + 0.5 * now.sky.level.y) << elevation << " " << i;
                ++lit;
            }
        }
    }
    EXPECT_GT(dark, 50);
    EXPECT_GT(lit, 50);
}

// The truth knows neither horizons nor harmonics. Bounds are twice what was measured.
TEST(TerrainRelight, AgreesWithPathTracing) {
    const Heightfield ground = groundOf(97, 97, {25, 25}, [](double x, double y) {
        return 260 * std::sin(x / 310) * std::cos(y / 270) + 60 * std::sin(x / 95 + y / 120);
    });
    TerrainLightSettings settings;
    settings.albedo = 0.5;
    const TerrainLight light = bakeForRelight(ground, settings);
    const TerrainRelight relight(ground, light);
    const GroundRays rays(ground);
    for (const double elevation : {50.0, 15.0}) {
        const SunAndSky now = lightAt(200, elevation);
        const float scale = now.sky.level.y / skyRadiance(gradient).level.y;
        GroundBrightness brightness;
        relight.relight(now, brightness);
        constexpr int kPlaces = 150;
        std::vector<double> truth(kPlaces), found(kPlaces), variance(kPlaces);
        parallelFor(kPlaces, [&](int k) {
            const int i = 4 + k * 37 % 89, j = 4 + k * 61 % 89;
            const PathLight path =
                tracePathLight(rays, ground.worldFromGrid({i, j}), now,
                               [&](const glm::dvec3& d) { return scale * gradient(d); },
                               {settings.albedo, settings.bounces, 1024, static_cast<std::uint64_t>(k + 1)});
            truth[k] = luminance(path.mean);
            variance[k] = path.variance;
            found[k] = luminance(glm::dvec3(brightness.at(i, j)));
        });
        double square = 0, bias = 0, mean = 0;
        for (int k = 0; k < kPlaces; ++k) {
            square += (std::pow(found[k] - truth[k], 2) - variance[k]) / kPlaces;
            bias += (found[k] - truth[k]) / kPlaces;
            mean += truth[k] / kPlaces;
        }
        const double rms = std::sqrt(std::max(0.0, square)) / mean;
        RecordProperty("rms_at_" + std::to_string(static_cast<int>(elevation)), std::to_string(rms));
        std::printf("sun at %.0f degrees: rms %.4f, bias %.4f of the mean\n", elevation, rms, bias / mean);
        EXPECT_LT(rms, 0.04) << elevation;
        EXPECT_LT(std::abs(bias / mean), 0.016) << elevation;
    }
}

TEST(TerrainRelight, EveryInstructionSetGivesTheSameLight) {
    const Heightfield ground = test::makeGround("rough", 75, 31, 5);
    const TerrainLight light = bakeForRelight(ground);
    const SunAndSky now = lightAt(30, 35);
    const ColorTexture albedo = test::makeScene(test::makeGround("rough", 75, 31, 5)).color;
    GroundBrightness plain;
    ColorTexture plainLit = albedo;
    const TerrainRelight oracle(ground, light, SimdTarget::Plain);
    oracle.relight(now, plain);
    oracle.lightTexture(albedo, plain, {1.3f, 1}, plainLit);
    for (const SimdTarget target : simdTargets()) {
        const TerrainRelight relight(ground, light, target);
        GroundBrightness brightness;
        ColorTexture lit = albedo;
        relight.relight(now, brightness);
        relight.lightTexture(albedo, brightness, {1.3f, 1}, lit);
        ASSERT_EQ(brightness.planes.size(), plain.planes.size());
        for (std::size_t k = 0; k < plain.planes.size(); ++k)
            ASSERT_NEAR(brightness.planes[k], plain.planes[k], 1e-5f) << k;
        for (int y = 0; y < lit.level(0).height(); ++y)
            for (int x = 0; x < lit.level(0).width(); ++x)
                for (int c = 0; c < 3; ++c) {
                    const auto channel = [&](PackedColor p) { return static_cast<int>(p >> 10 * c & 1023u); };
                    ASSERT_NEAR(channel(lit.level(0).at(x, y)), channel(plainLit.level(0).at(x, y)), 1);
                }
    }
}

TEST(TerrainRelight, TexelsAreColoursTimesLight) {
    const Heightfield ground = test::makeGround("smooth", 33, 29, 1);
    const TerrainScene scene = test::makeScene(test::makeGround("smooth", 33, 29, 1));
    const TerrainRelight relight(ground, bakeForRelight(ground));
    GroundBrightness brightness;
    relight.relight(lightAt(100, 40), brightness);
    for (const float share : {0.0f, 0.5f, 1.0f}) {
        ColorTexture lit = scene.color;
        relight.lightTexture(scene.color, brightness, {0.8f, share}, lit);
        const auto texels = scene.color.level(0);
        for (int y = 0; y < texels.height(); ++y)
            for (int x = 0; x < texels.width(); ++x) {
                const glm::dvec2 grid =
                    scene.color.gridOrigin() + glm::dvec2(x + 0.5, y + 0.5) * scene.color.gridPerTexel();
                const LightGrid& places = relight.light().grid;
                const auto px = places.placeX(grid.x), py = places.placeY(grid.y);
                glm::vec3 light(0.0f);
                for (int c = 0; c < 4; ++c)
                    light += (c & 1 ? px.next : 1 - px.next) * (c & 2 ? py.next : 1 - py.next) *
                             brightness.at(px.index + (c & 1), py.index + (c >> 1));
                const glm::vec3 expected =
                    unpackColor(texels.at(x, y)) * (1.0f + share * (0.8f * light - 1.0f));
                const glm::vec3 found = unpackColor(lit.level(0).at(x, y));
                // Ten bits of the root, and roots that are mixed across rather than light.
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(found[c], std::min(1.0f, expected[c]), 0.004 + 0.02 * expected[c])
                        << x << " " << y;
            }
    }
}

TerrainScene litScene(SimdTarget target = SimdTarget::Auto) {
    TerrainScene scene = test::makeScene(test::makeGround("smooth", 65, 65, 3));
    scene.illumination = std::make_unique<TerrainIllumination>(scene.ground, scene.color, scene.sky,
                                                               bakeForRelight(scene.ground), 1.0f, target);
    scene.illumination->apply(scene.look, scene.color);
    return scene;
}

std::vector<PackedColor> texelsOf(const ColorTexture& color) {
    std::vector<PackedColor> all;
    for (int k = 0; k < color.levelCount(); ++k)
        for (int y = 0; y < color.level(k).height(); ++y)
            all.insert(all.end(), color.level(k).row(y), color.level(k).row(y) + color.level(k).width());
    return all;
}

TEST(TerrainIllumination, TheSunMovesInPlaceAndComesBack) {
    TerrainScene scene = litScene();
    const TerrainLook before = scene.look;
    const PackedColor* place = scene.color.data();
    const std::vector<PackedColor> first = texelsOf(scene.color);
    moveSun(scene, 1.0, 0.2);
    EXPECT_EQ(scene.color.data(), place) << "renderers keep the address";
    EXPECT_EQ(scene.look.sunElevation, 0.2);
    EXPECT_NE(texelsOf(scene.color), first);
    moveSun(scene, before.sunAzimuth, before.sunElevation);
    EXPECT_EQ(texelsOf(scene.color), first);
}

StereoViews viewsOf(const TerrainScene& scene) {
    const double extent = scene.ground.spacing().x * (scene.ground.width() - 1);
    const Pose pose = poseFromAngles({-0.2 * extent, -0.4 * extent, 420.0}, 0.4, -0.35, 0.05);
    return makeStereoViews(pose, {320, 240, 0.9, 1.0, 1.0}, {0.02 * extent, 0.5 * extent});
}

double rightEyePsnr(const TerrainScene& scene) {
    const TerrainRenderer renderer(scene);
    const StereoViews views = viewsOf(scene);
    EyeImage left, right, full;
    for (EyeImage* image : {&left, &full}) image->resize(320, 240);
    renderEye(renderer, views.left, left);
    renderEye(renderer, views.right, full);
    RightEye eye;
    eye.render(renderer, views, left, {}, right);
    double square = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x)
            for (int c = 0; c < 3; ++c) {
                const double d = double(right.color.at(x, y) >> 10 * c & 1023u) -
                                 double(full.color.at(x, y) >> 10 * c & 1023u);
                square += d * d / (320 * 240 * 3);
            }
    return 10 * std::log10(1023.0 * 1023.0 / square);
}

TEST(TerrainIllumination, TheRightEyeIsAsGoodAsWithout) {
    const TerrainScene without = test::makeScene(test::makeGround("smooth", 65, 65, 3));
    const double plain = rightEyePsnr(without), lit = rightEyePsnr(litScene());
    std::printf("right eye against the full cast: %.2f dB, under baked light %.2f dB\n", plain, lit);
    EXPECT_GT(plain, 30);
    EXPECT_GT(lit, plain - 1);
}

TEST(TerrainIllumination, AddsNothingToAFrame) {
    const TerrainScene without = test::makeScene(test::makeGround("smooth", 65, 65, 3)), with = litScene();
    EXPECT_EQ(without.illumination, nullptr);
    const TerrainRenderer plain(without), lit(with);
    EXPECT_EQ(plain.viewDependence(), ViewDependence::None);
    EXPECT_EQ(lit.viewDependence(), ViewDependence::None);
    const StereoViews views[] = {viewsOf(without)};
    EXPECT_EQ(planFrame(plain, views, std::nullopt, 1).bytes, planFrame(lit, views, std::nullopt, 1).bytes);
    EyeImage a, b;
    a.resize(320, 240);
    b.resize(320, 240);
    renderEye(plain, views[0].left, a);
    renderEye(lit, views[0].left, b);
    int shown = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
            ASSERT_EQ(a.viewDepth.at(x, y), b.viewDepth.at(x, y));
            shown += a.color.at(x, y) != b.color.at(x, y);
        }
    EXPECT_GT(shown, 1000);
}

}  // namespace
}  // namespace stereonav
