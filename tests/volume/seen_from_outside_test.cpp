// A volume seen from outside: where the left eye saw nothing before the edge of its picture there is nothing,
// so the right eye is warped and few of its rays are cast again.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "engine/stereo/right_eye.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {
namespace {

// A ball of 20 mm around the origin in 64 voxels of 1 mm along each axis.
VolumeScene ball() {
    VolumeScene scene;
    VolumeFrame frame;
    frame.size = glm::ivec3(64);
    frame.spacing = glm::dvec3(0.001);
    frame.origin = glm::dvec3(-0.0315);
    scene.field = GreyVolume(frame);
    for (int k = 0; k < 64; ++k)
        for (int j = 0; j < 64; ++j)
            for (int i = 0; i < 64; ++i) {
                const double r = glm::length(frame.worldFromVoxel({i, j, k}));
                scene.field.at(i, j, k) = static_cast<std::int16_t>(std::lround((0.02 - r) * 100000));
            }
    Progress progress;
    scene.cells = findSurfaceCells(scene.field, SurfaceSetting{}, progress);
    return scene;
}

struct Eyes {
    EyeImage left, linear, full;
    double holes = 0;
};

Eyes eyesAt(const VolumeRenderer& renderer, double distance) {
    Lens lens;
    lens.width = 200;
    lens.height = 160;
    lens.nearDepth = 0.001;
    const Pose head = poseFromAngles({0, -distance, 0}, 0, 0, 0);
    const StereoViews views = makeStereoViews(head, lens, {distance / 30, distance});
    Eyes eyes;
    eyes.left.resize(lens.width, lens.height, renderer.viewDependence());
    renderEye(renderer, views.left, eyes.left);
    RightEye rightEye;
    WarpSetting setting;
    const RightEyeTimings timings = rightEye.render(renderer, views, eyes.left, setting, eyes.linear);
    eyes.holes = static_cast<double>(timings.holePixels) / (lens.width * lens.height);
    setting.method = RightEyeMethod::Full;
    rightEye.render(renderer, views, eyes.left, setting, eyes.full);
    return eyes;
}

TEST(SeenFromOutside, TheRightEyeIsWarped) {
    const VolumeScene scene = ball();
    const VolumeRenderer renderer(scene);
    for (const double distance : {0.06, 0.1, 0.3}) {
        const Eyes eyes = eyesAt(renderer, distance);
        EXPECT_LT(eyes.holes, 0.15) << distance;
        int hits = 0, wrong = 0;
        for (int y = 0; y < 160; ++y)
            for (int x = 0; x < 200; ++x) {
                const bool hit = eyes.full.viewDepth.at(x, y) < kMissDepth;
                hits += hit;
                wrong += hit != (eyes.linear.viewDepth.at(x, y) < kMissDepth);
            }
        EXPECT_GT(hits, 100) << distance;
        EXPECT_LT(wrong, 0.01 * 200 * 160) << distance;
    }
}

// What lies before the left eye's edge is found: a ball that only the right eye sees.
TEST(SeenFromOutside, WhatOnlyTheRightEyeSeesIsCast) {
    const VolumeScene scene = ball();
    const VolumeRenderer renderer(scene);
    Lens lens;
    lens.width = 200;
    lens.height = 160;
    lens.nearDepth = 0.001;
    // The ball stands right of the middle, half in the picture's edge, well before the screen's distance.
    for (const double right : {0.05, 0.055, 0.06}) {
        const Pose head = poseFromAngles({-right, -0.1, 0}, 0, 0, 0);
        const StereoViews views = makeStereoViews(head, lens, {0.02, 0.4});
        EyeImage left, linear, full;
        left.resize(lens.width, lens.height, renderer.viewDependence());
        renderEye(renderer, views.left, left);
        RightEye rightEye;
        WarpSetting setting;
        rightEye.render(renderer, views, left, setting, linear);
        setting.method = RightEyeMethod::Full;
        rightEye.render(renderer, views, left, setting, full);
        int hits = 0, wrong = 0;
        for (int y = 0; y < 160; ++y)
            for (int x = 0; x < 200; ++x) {
                const bool hit = full.viewDepth.at(x, y) < kMissDepth;
                hits += hit;
                wrong += hit != (linear.viewDepth.at(x, y) < kMissDepth);
            }
        EXPECT_GT(hits, 500) << right;
        EXPECT_LT(wrong, 60) << right;
    }
}

}  // namespace
}  // namespace stereonav
