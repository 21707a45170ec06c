// Fog as the right eye sees it: warped pixels bring the colours that the left eye saw through its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "engine/stereo/right_eye.h"
#include "terrain/cast/fog_row.h"
#include "terrain/cast/terrain_renderer.h"
#include "tests/support/test_grounds.h"

namespace stereonav::fog_between_eyes_test {
namespace {

int channel(PackedColor color, int c) {
    return static_cast<int>(color >> 10 * c & 1023u);
}

TerrainScene waves(double fogDistance) {
    TerrainScene scene = test::makeScene(test::makeGround("smooth", 65, 65, 3));
    Plane<PackedColor> image(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) image.at(x, y) = packColor({0.1f, 0.2f, 0.02f});
    scene.color = ColorTexture(image, {0.0, 0.0}, {8.0, 8.0});
    scene.look.fogDistance = fogDistance;
    return scene;
}

// separation: of the ground's extent.
StereoViews viewsOf(const TerrainScene& scene, double separation) {
    const double extent = scene.ground.spacing().x * (scene.ground.width() - 1);
    const Pose pose = poseFromAngles({-0.2 * extent, -0.4 * extent, 420.0}, 0.2, -0.35, 0.05);
    return makeStereoViews(pose, {203, 150, 1.6, 1.0, 1.0}, {separation * extent, 0.5 * extent});
}

struct Pair {
    EyeImage left, right, full;
    Plane<std::uint8_t> holes;
};
Pair renderBoth(const TerrainRenderer& renderer, const StereoViews& v, RightEyeMethod method) {
    Pair pair;
    pair.left.resize(203, 150, renderer.viewDependence());
    pair.full.resize(203, 150, renderer.viewDependence());
    renderEye(renderer, v.left, pair.left);
    renderEye(renderer, v.right, pair.full);
    RightEye eye;
    WarpSetting setting;
    setting.method = method;
    eye.render(renderer, v, pair.left, setting, pair.right);
    pair.holes = eye.holeMask();
    return pair;
}

// Pixels that are ground, warped or cast, by how many steps they differ from a full cast.
struct Differences {
    int ground = 0, beyond = 0, most = 0;
};
Differences differences(const Pair& pair, int steps) {
    Differences d;
    for (int y = 0; y < pair.full.height(); ++y)
        for (int x = 0; x < pair.full.width(); ++x) {
            if (pair.full.viewDepth.at(x, y) == kMissDepth || pair.right.viewDepth.at(x, y) == 0) continue;
            int apart = 0;
            for (int c = 0; c < 3; ++c)
                apart = std::max(apart, std::abs(channel(pair.full.color.at(x, y), c) -
                                                 channel(pair.right.color.at(x, y), c)));
            ++d.ground;
            d.beyond += apart > steps;
            d.most = std::max(d.most, apart);
        }
    return d;
}

// With the left eye's fog nearly all of the warped pixels would be further off.
TEST(FogBetweenEyes, WarpedPixelsAreSeenThroughTheRightEyesOwn) {
    const TerrainScene scene = waves(900);
    const StereoViews v = viewsOf(scene, 0.04);
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        for (const RightEyeMethod method :
             {RightEyeMethod::Linear, RightEyeMethod::Cubic, RightEyeMethod::Selective}) {
            const Differences d = differences(renderBoth(renderer, v, method), 2);
            EXPECT_GT(d.ground, 14000);
            EXPECT_LE(d.beyond, d.ground / 100) << nameOf(method) << ", most " << d.most;
        }
    }
}

// A splat reaches its neighbours, of which the nearest says from where rays may start; a highlight and the
// fog before it are as far away as the pixel itself. On rough ground 1.6 % of the pixels are off by more than
// 6 steps, at the depths of the nearest splats 2.4 %.
TEST(FogBetweenEyes, SplatsAreShadedAtTheirOwnDepths) {
    TerrainScene scene = waves(400);
    scene.ground = test::makeGround("rough", 65, 65, 3);
    scene.look.specular = 0.6f;
    scene.look.shininess = 3;
    const Pose pose = poseFromAngles({0, 0, scene.ground.maxHeight() + 30.0}, 0.2, -0.15, 0.0);
    const StereoViews v = makeStereoViews(pose, {203, 150, 1.6, 1.0, 1.0}, {20, 190});
    const TerrainRenderer renderer(scene);
    const Differences d = differences(renderBoth(renderer, v, RightEyeMethod::Paper), 6);
    EXPECT_GT(d.ground, 14000);
    EXPECT_LE(d.beyond, d.ground / 50) << "most " << d.most;
}

// By definition, in double precision.
TEST(FogBetweenEyes, IsThatOfTheDifferenceOfTheWays) {
    constexpr int kWidth = 77;
    const StereoViews v =
        makeStereoViews(poseFromAngles({5e5, -3e5, 900}, 1, 0.3, 0.2), {kWidth, 9, 1.2, 1.0, 1.0}, {40, 300});
    const glm::dvec3 fogColor(0.6, 0.7, 0.1);
    const double perMetre = 1 / 700.0;
    for (const SimdTarget target : simdTargets()) {
        const auto changeFog =
            kernelsOf<FogRowFunction>(target, plain::changeFog, avx2::changeFog, avx512::changeFog);
        EyeImage image;
        image.resize(kWidth, 9);
        for (int x = 0; x < kWidth; ++x) {
            const double depth = std::exp2(0.2 * x);
            image.viewDepth.at(x, 4) = x % 11 == 3   ? 0.0f
                                       : x % 11 == 7 ? kMissDepth
                                                     : static_cast<float>(depth);
            image.color.at(x, 4) = packColor({0.01f * static_cast<float>(x), 0.9f, 0.2f});
        }
        const EyeImage before = image;
        FogRow row;
        row.color = image.color.row(4);
        row.depth = image.viewDepth.row(4);
        row.width = kWidth;
        row.firstX = static_cast<float>(v.right.xMin + 0.5 * v.right.pixelWidth());
        row.perX = static_cast<float>(v.right.pixelWidth());
        row.y = static_cast<float>(v.right.yMax - 4.5 * v.right.pixelHeight());
        row.offset[0] = 40;
        row.perMetre = static_cast<float>(perMetre);
        for (int c = 0; c < 3; ++c) row.linear[c] = static_cast<float>(fogColor[c]);
        changeFog(row);
        for (int x = 0; x < kWidth; ++x) {
            const float depth = image.viewDepth.at(x, 4);
            EXPECT_EQ(depth, before.viewDepth.at(x, 4));
            if (depth == 0 || depth == kMissDepth) {
                EXPECT_EQ(image.color.at(x, 4), before.color.at(x, 4));
                continue;
            }
            const glm::dvec3 point = v.right.pointAt(x + 0.5, 4.5, depth);
            const double nearer = glm::length(point - v.left.eye) - glm::length(point - v.right.eye);
            const glm::dvec3 seen(unpackColor(before.color.at(x, 4)));
            for (int c = 0; c < 3; ++c) {
                const double linear = fogColor[c] + (seen[c] - fogColor[c]) * std::exp(nearer * perMetre);
                EXPECT_NEAR(channel(image.color.at(x, 4), c), 1023 * std::sqrt(std::clamp(linear, 0.0, 1.0)),
                            0.6)
                    << x << " at " << depth;
            }
        }
    }
}

// Thin fog costs nothing.
TEST(FogBetweenEyes, IsLeftAloneWhereItIsThin) {
    const TerrainScene hazy = waves(40000), without = waves(0);
    const TerrainRenderer renderer(hazy), clear(without);
    EXPECT_FALSE(renderer.airDiffers(70));
    EXPECT_TRUE(renderer.airDiffers(90));
    EXPECT_FALSE(clear.airDiffers(1e6));
}

}  // namespace
}  // namespace stereonav::fog_between_eyes_test
