// A volume seen by eyes that stand far to the side of their shared window: a metre of view depth is then so
// many voxels long that leaps, beams and the steps between samples fall below the view depth's rounding.
// Every picture has to end, and what both casters hit is where the plain walk in double precision hits it.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/camera/stereo_rig.h"
#include "engine/volume/plain_volume_caster.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/stability_row.h"

namespace stereonav {
namespace {

using namespace test;

constexpr double kZeroParallax = 0.3;  // metres; the volume is 0.04 m wide around it

VolumeScene ball(bool translucent) {
    const VolumeFrame frame = frameOf({41, 41, 41}, glm::dvec3(1e-3));
    VolumeScene scene = surfaceScene(
        walledVolume(
            frame, [](const glm::dvec3& p) { return 0.014 - glm::length(p - glm::dvec3(0.02)); }, 4e5),
        -480);
    if (translucent)
        scene.look.transfer =
            TransferFunction({{-900, glm::vec3(1.0f), 0}, {0, glm::vec3(1.0f), 0.5}}, 0.001, "test");
    return scene;
}

StereoViews eyesApart(const VolumeScene& scene, double separation) {
    Pose head;
    const glm::dvec3 middle = scene.cells.frame.worldFromVoxel(0.5 * glm::dvec3(scene.cells.frame.size - 1));
    head.position = middle + head.orientation * glm::dvec3(0, 0, kZeroParallax);
    Lens lens;
    lens.width = 24;
    lens.height = 16;
    lens.verticalFov = 0.15;
    lens.nearDepth = 0.01;
    return makeStereoViews(head, lens, {separation, kZeroParallax});
}

class FarAside : public testing::TestWithParam<double> {};

TEST_P(FarAside, OpaquePicturesEndAtTheSurface) {
    const double factor = GetParam();
    const VolumeScene scene = ball(false);
    const StereoViews eyes = eyesApart(scene, factor * kZeroParallax);
    // A place of single precision along a ray is off by some 2^-23 of the way, which is factor times as long
    // as the view depth says; nothing is off by more than the volume is wide.
    const double bound = std::min(2e-5 + 2.4e-7 * factor, 0.15);
    StabilityRow row("far-aside/opaque/" + std::to_string(static_cast<long long>(factor)),
                     "a ball, eyes " + std::to_string(static_cast<long long>(factor)) +
                         " times the zero-parallax distance apart",
                     "view depth off against the plain walk", bound, "");
    for (const SimdTarget target : simdTargets())
        for (const EyeView* view : {&eyes.left, &eyes.right}) {
            const EyeImage image = castPicture(VolumeRenderer(scene, {target}), *view);
            for (int y = 0; y < view->height; ++y)
                for (int x = 0; x < view->width; ++x) {
                    const double plain =
                        castPlainVolume(scene.field, scene.cells.isovalue,
                                        {view->eye, view->rayDirection(x + 0.5, y + 0.5), view->nearDepth})
                            .t;
                    const double fast = image.viewDepth.at(x, y);
                    if (std::isfinite(plain) && std::isfinite(fast)) row.saw(std::abs(fast - plain) / plain);
                }
        }
}

TEST_P(FarAside, TranslucentPicturesEndWithinTheLightThereIs) {
    const double factor = GetParam();
    const VolumeScene scene = ball(true);
    const StereoViews eyes = eyesApart(scene, factor * kZeroParallax);
    StabilityRow row("far-aside/translucent/" + std::to_string(static_cast<long long>(factor)),
                     "a translucent ball, eyes " + std::to_string(static_cast<long long>(factor)) +
                         " times the zero-parallax distance apart",
                     "pixels whose first light is not in the volume", 0, "pixels");
    for (const SimdTarget target : simdTargets())
        for (const EyeView* view : {&eyes.left, &eyes.right}) {
            const EyeImage image = castPicture(VolumeRenderer(scene, {target}), *view);
            for (int y = 0; y < view->height; ++y)
                for (int x = 0; x < view->width; ++x) {
                    const double depth = image.viewDepth.at(x, y);
                    const bool good = std::isinf(depth) || std::abs(depth - kZeroParallax) < 0.03;
                    row.count(good ? 0 : 1);
                }
        }
}

INSTANTIATE_TEST_SUITE_P(Factors, FarAside, testing::Values(10.0, 1e3, 1e5, 1e6));

// Eyes as far aside as this: hardly a ray meets the volume any more.
TEST(FarAsideEnds, WhateverTheSeparation) {
    for (const bool translucent : {false, true})
        for (const double factor : {1e8, 1e12, 1e30}) {
            const VolumeScene scene = ball(translucent);
            const StereoViews eyes = eyesApart(scene, factor * kZeroParallax);
            for (const SimdTarget target : simdTargets()) {
                const EyeImage image = castPicture(VolumeRenderer(scene, {target}), eyes.right);
                for (int y = 0; y < eyes.right.height; ++y)
                    for (int x = 0; x < eyes.right.width; ++x)
                        EXPECT_FALSE(std::isnan(image.viewDepth.at(x, y))) << factor << " " << x << "," << y;
            }
        }
}

}  // namespace
}  // namespace stereonav
