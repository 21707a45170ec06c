// What the kernels colour, against what is known without them: fog by its exponential, the sky by its
// own function, a plain colour by itself; on every instruction set.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/camera/stereo_rig.h"
#include "terrain/cast/terrain_renderer.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

TerrainScene plainScene(const glm::vec3& color) {
    TerrainScene scene = test::makeScene(test::makeGround("smooth", 97, 83, 7));
    Plane<PackedColor> image(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) image.at(x, y) = packColor(color);
    scene.color = ColorTexture(image, {0.0, 0.0}, {12.0, 82.0 / 8});
    return scene;
}

EyeView viewOf(double pitch) {
    return makeEyeView(poseFromAngles({-900, -700, 500}, 0.9, pitch, 0.2), {150, 110, 0.9, 1.0, 0.1});
}

TEST(Shading, FogFollowsItsExponentialInLinearLight) {
    TerrainScene scene = plainScene({0.02f, 0.3f, 0.9f});
    scene.look.fogColor = {0.8f, 0.5f, 0.1f};
    for (const double distance : {50.0, 700.0, 1e5})
        for (const SimdTarget target : simdTargets()) {
            scene.look.fogDistance = distance;
            const TerrainRenderer renderer(scene, target);
            const EyeView view = viewOf(-0.4);
            EyeImage image;
            image.resize(view.width, view.height);
            renderEye(renderer, view, image);
            int checked = 0;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    const double depth = image.viewDepth.at(x, y);
                    if (!std::isfinite(depth)) continue;
                    const double way = depth * glm::length(view.rayDirection(x + 0.5, y + 0.5));
                    const double through = std::exp(-way / distance);
                    for (int c = 0; c < 3; ++c) {
                        const double own = unpackColor(packColor({0.02f, 0.3f, 0.9f}))[c];
                        const double root = std::sqrt(through * own + (1 - through) * scene.look.fogColor[c]);
                        const double got = image.color.at(x, y) >> (10 * c) & 1023u;
                        // Half a step for the rounding, and one for fixed point.
                        ASSERT_NEAR(got, root * 1023, 1.5) << x << "," << y << " distance " << distance;
                    }
                    ++checked;
                }
            EXPECT_GT(checked, 1000);
        }
}

TEST(Shading, APlainColourComesBackAtEveryDistance) {
    const PackedColor color = packColor({0.11f, 0.52f, 0.87f});
    const TerrainScene scene = plainScene({0.11f, 0.52f, 0.87f});
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        for (const double pitch : {0.0, -0.3, -1.5}) {
            const EyeView view = viewOf(pitch);
            EyeImage image;
            image.resize(view.width, view.height);
            renderEye(renderer, view, image);
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    if (std::isfinite(image.viewDepth.at(x, y))) {
                        ASSERT_EQ(image.color.at(x, y), color);
                    }
                }
        }
    }
}

TEST(Shading, TheSkyIsThatOfItsDirection) {
    TerrainScene scene = plainScene({0, 0, 0});
    // Linear in the direction's octahedral place would hide a wrong lookup; this is smooth and uneven.
    const auto radiance = [](const glm::vec3& d) {
        return glm::vec3(0.5f + 0.4f * d.x, 0.5f + 0.4f * d.y * d.z, 0.5f - 0.4f * d.z);
    };
    scene.sky = SkyMap(1024, radiance);
    for (const SimdTarget target : simdTargets()) {
        const TerrainRenderer renderer(scene, target);
        for (const double pitch : {0.2, 0.9, 1.5}) {
            const EyeView view = viewOf(pitch);
            EyeImage image;
            image.resize(view.width, view.height);
            renderEye(renderer, view, image);
            int checked = 0;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) {
                    if (std::isfinite(image.viewDepth.at(x, y))) continue;
                    const glm::vec3 d(glm::normalize(view.rayDirection(x + 0.5, y + 0.5)));
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(image.color.at(x, y) >> (10 * c) & 1023u,
                                    std::sqrt(radiance(d)[c]) * 1023, 2.5)
                            << x << "," << y;
                    ++checked;
                }
            EXPECT_GT(checked, 1000);
        }
    }
}

}  // namespace
}  // namespace stereonav
