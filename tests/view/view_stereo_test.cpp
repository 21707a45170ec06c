// The window's eyes: the comfortable beginning, settings by hand, and the clamp that moves them slowly.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/view/stereo.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

constexpr StereoSetting kOwn{20.0, 600.0};
constexpr double kStep = 1.0 / 60;

FakeParts sceneWith(const StereoSetting& stereo) {
    static FakeFrames frames;
    FakeParts scene;
    scene.frames = &frames;
    scene.stereo = stereo;
    return scene;
}

// Returns the frame of a request for which eyes were fitted.
ViewFrame firstFrame(const StereoSetting& fitting) {
    ViewFrame frame;
    frame.request.fitEyes = true;
    frame.request.stereo = fitting;
    frame.nearParallax = -0.0095;
    frame.farParallax = 0.019;
    return frame;
}

// Returns a frame of eyes with this separation, in a place where a metre of it gives so much parallax.
ViewFrame frameOf(const StereoSetting& eyes, double nearPerMetre, double farPerMetre) {
    ViewFrame frame;
    frame.request.stereo = eyes;
    frame.nearParallax = nearPerMetre * eyes.separation;
    frame.farParallax = farPerMetre * eyes.separation;
    return frame;
}

TEST(ViewStereo, BeginsAsTheFirstPictureFits) {
    const FakeScene scene(sceneWith(kOwn));
    ViewStereo eyes(scene);
    EXPECT_TRUE(eyes.fits());
    eyes.observe(firstFrame({11, 390}));
    EXPECT_FALSE(eyes.fits());
    EXPECT_TRUE(eyes.fitted());
    EXPECT_EQ(eyes.now().separation, 11) << "at once: what is shown is made so already";
    eyes.step(1e9, 500, kStep);
    EXPECT_EQ(eyes.now().separation, 11);
    EXPECT_FALSE(eyes.moving());
    eyes.observe(firstFrame({5, 5}));
    EXPECT_EQ(eyes.now().separation, 11) << "the first alone";
    // Changed by hand from there, and back.
    eyes.scaleSeparation(2);
    EXPECT_FALSE(eyes.fitted());
    for (int n = 0; n < 300; ++n) eyes.step(1e9, 500, kStep);
    EXPECT_DOUBLE_EQ(eyes.now().separation, 22);
    eyes.reset(scene);
    for (int n = 0; n < 300; ++n) eyes.step(1e9, 500, kStep);
    EXPECT_DOUBLE_EQ(eyes.now().separation, 11);
    EXPECT_DOUBLE_EQ(eyes.now().zeroParallax, 390);
    EXPECT_TRUE(eyes.fitted());
}

TEST(ViewStereo, BeganWithWhatFittedTheFirstPicture) {
    const FakeScene scene(sceneWith(kOwn));
    ViewStereo eyes(scene);
    EXPECT_EQ(eyes.begun(scene).separation, kOwn.separation) << "no picture yet";
    eyes.observe(firstFrame({11, 390}));
    eyes.setSeparation(30);
    eyes.setZeroParallax(900);
    EXPECT_EQ(eyes.begun(scene).separation, 11);
    EXPECT_EQ(eyes.begun(scene).zeroParallax, 390);
}

TEST(ViewStereo, WhatWasGivenStays) {
    FakeScene scene(sceneWith(kOwn));
    scene.eyesGiven = true;
    ViewStereo eyes(scene);
    EXPECT_FALSE(eyes.fits());
    eyes.observe(firstFrame({11, 390}));
    EXPECT_EQ(eyes.now().separation, 20);
    eyes.reset(scene);
    EXPECT_FALSE(eyes.fits());
}

TEST(ViewStereo, ASceneThatIsComfortableIsNotCalledFitted) {
    const FakeScene scene(sceneWith(kOwn));
    ViewStereo eyes(scene);
    eyes.observe(firstFrame(kOwn));
    EXPECT_FALSE(eyes.fits());
    EXPECT_FALSE(eyes.fitted());
}

TEST(ViewStereo, AFollowerGoesOnFromWhatFits) {
    FakeParts parts = sceneWith({0.002, 0.06});
    parts.makeFollower = [](const StereoSetting& from) {
        return [from](double, double, double) { return from; };
    };
    const FakeScene scene(parts);
    ViewStereo eyes(scene);
    ASSERT_TRUE(eyes.follows());
    EXPECT_TRUE(eyes.fits());
    eyes.observe(firstFrame({0.001, 0.04}));
    EXPECT_TRUE(eyes.follows());
    eyes.step(0.01, 0.05, kStep);
    EXPECT_DOUBLE_EQ(eyes.now().separation, 0.001);
    EXPECT_DOUBLE_EQ(eyes.now().zeroParallax, 0.04);
}

TEST(ViewStereo, AFollowerArrivesWithTheFirstPictureAndIsSlowAfterIt) {
    FakeParts parts = sceneWith({0.002, 0.06});
    parts.makeFollower = [](const StereoSetting& from) -> StereoFollower {
        return [now = from](double free, double depth, double dt) mutable {
            const double share = std::exp(-std::min(dt, 1.0) / 2);  // at most a second
            now = {share * now.separation + (1 - share) * free / 10,
                   share * now.zeroParallax + (1 - share) * depth};
            return now;
        };
    };
    const FakeScene scene(parts);
    ViewStereo eyes(scene);
    eyes.step(0.1, 0, kStep);
    EXPECT_NEAR(eyes.now().separation, 0.002, 1e-4) << "nothing was seen yet";
    eyes.observe(firstFrame({0.002, 0.06}));
    eyes.step(0.01, 0.05, kStep);
    EXPECT_NEAR(eyes.now().separation, 0.001, 3e-6);
    EXPECT_NEAR(eyes.now().zeroParallax, 0.05, 2e-4);
    for (int n = 0; n < 3; ++n) eyes.step(0.01, 0.05, kStep);
    EXPECT_FALSE(eyes.moving()) << "a picture may rest";
    eyes.step(0.02, 0.05, kStep);
    EXPECT_LT(eyes.now().separation, 0.00103) << "slowly from there";
    eyes.follow();
    eyes.step(0.03, 0.05, kStep);
    EXPECT_LT(eyes.now().separation, 0.00105);
}

TEST(ViewStereo, IsSetInMetres) {
    const FakeScene scene(sceneWith(kOwn));
    ViewStereo eyes(scene);
    eyes.setSeparation(30);
    EXPECT_FALSE(eyes.fits()) << "it is the user's now";
    EXPECT_EQ(eyes.target().separation, 30);
    EXPECT_EQ(eyes.now().separation, 20) << "nothing jumps";
    eyes.setZeroParallax(900);
    for (int n = 0; n < 300; ++n) eyes.step(1e9, 500, kStep);
    EXPECT_DOUBLE_EQ(eyes.now().separation, 30);
    EXPECT_DOUBLE_EQ(eyes.now().zeroParallax, 900);
    eyes.setSeparation(1e9);
    EXPECT_EQ(eyes.target().separation, 225) << "a quarter of the screen's distance";
    eyes.setZeroParallax(1);
    EXPECT_EQ(eyes.target().zeroParallax, 900) << "no nearer than the eyes allow";
    eyes.setSeparation(0);
    EXPECT_EQ(eyes.target().separation, 0);
    eyes.setSeparation(1e-9);
    EXPECT_EQ(eyes.target().separation, 0) << "less than a thousandth of the screen's distance is none";
    for (const double none : {std::nan(""), -1.0}) {
        eyes.setSeparation(none);
        eyes.setZeroParallax(none);
    }
    eyes.setZeroParallax(0);
    eyes.setZeroParallax(std::numeric_limits<double>::infinity());
    EXPECT_EQ(eyes.target().separation, 0);
    EXPECT_EQ(eyes.target().zeroParallax, 900);
}

TEST(ViewStereo, TheClampBringsEyesTogetherSlowlyAndBackAgain) {
    const FakeScene scene(sceneWith(kOwn));
    ViewStereo eyes(scene);
    eyes.setSeparation(20);
    EXPECT_FALSE(eyes.clamp()) << "off at first";
    for (int n = 0; n < 300; ++n) {
        eyes.observe(frameOf(eyes.now(), -0.05, 0.01));  // a wall before the head: 120 % of the width
        eyes.step(1, 1, kStep);
    }
    EXPECT_EQ(eyes.now().separation, 20);
    eyes.setClamp(true);
    double before = 20;
    for (int n = 0; n < 900; ++n) {
        eyes.observe(frameOf(eyes.now(), -0.05, 0.01));
        eyes.step(1, 1, kStep);
        ASSERT_LE(eyes.now().separation, before);
        ASSERT_LT(before - eyes.now().separation, 0.5) << "no jump";
        before = eyes.now().separation;
    }
    EXPECT_TRUE(eyes.clamping());
    EXPECT_NEAR(eyes.now().separation, 0.95 * 0.025 / 0.05, 1e-3) << "whatever it takes";
    EXPECT_EQ(eyes.target().separation, 20);
    EXPECT_FALSE(eyes.moving()) << "at rest in the end";
    for (int n = 0; n < 1200; ++n) {  // open ground again
        eyes.observe(frameOf(eyes.now(), -0.0001, 0.0005));
        eyes.step(1, 1, kStep);
        ASSERT_LT(eyes.now().separation - before, 0.5);
        before = eyes.now().separation;
    }
    EXPECT_NEAR(eyes.now().separation, 20, 1e-2);
    EXPECT_FALSE(eyes.clamping());
}

TEST(ViewStereo, AHandTakesTheClampedEyesFromWhereTheyAre) {
    const FakeScene scene(sceneWith(kOwn));
    ViewStereo eyes(scene);
    eyes.setClamp(true);
    eyes.setSeparation(20);
    for (int n = 0; n < 900; ++n) {
        eyes.observe(frameOf(eyes.now(), -0.005, 0.001));
        eyes.step(1, 1, kStep);
    }
    const double clamped = eyes.now().separation;
    ASSERT_LT(clamped, 10);
    eyes.scaleSeparation(0.5);
    EXPECT_DOUBLE_EQ(eyes.target().separation, 0.5 * clamped);
    EXPECT_EQ(eyes.now().separation, clamped) << "no jump";
    for (int n = 0; n < 300; ++n) {
        eyes.observe(frameOf(eyes.now(), -0.005, 0.001));
        eyes.step(1, 1, kStep);
    }
    EXPECT_NEAR(eyes.now().separation, 0.5 * clamped, 1e-3 * clamped);
    // Switched off while it is active: the eyes go back as slowly.
    eyes.setSeparation(20);
    for (int n = 0; n < 900; ++n) {
        eyes.observe(frameOf(eyes.now(), -0.005, 0.001));
        eyes.step(1, 1, kStep);
    }
    eyes.setClamp(false);
    const double held = eyes.now().separation;
    eyes.step(1, 1, kStep);
    EXPECT_LT(eyes.now().separation - held, 0.5);
    for (int n = 0; n < 1200; ++n) eyes.step(1, 1, kStep);
    EXPECT_EQ(eyes.now().separation, 20);
}

}  // namespace
}  // namespace stereonav
