// Eyes come together where a lumen is narrow, in pictures and videos as in the window.
#include "app/scene/narrowed_eyes.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/output/stereo_frame.h"
#include "app/scene/volume/volume_loading.h"
#include "app/view/stereo.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

constexpr int kLength = 100;  // voxels of 1 mm

class NarrowedEyesTest : public VolumeTest {
protected:
    // A lumen along z, 3 mm in radius at both ends and 11 mm in the middle.
    std::string narrowAtItsEnds() const {
        return nrrd("lumen.nrrd", {32, 32, kLength, 1, "uchar", ""}, [](int i, int j, int k) {
            const double end = std::min(k, kLength - 1 - k),
                         radius = 3 + 8 * std::clamp((end - 12) / 15, 0.0, 1.0);
            return end >= 2 && std::hypot(i - 15.5, j - 15.5) < radius ? 1 : 0;
        });
    }
    std::unique_ptr<Scene> loaded(const SceneOptions& options) const {
        Progress progress;
        return loadScene(options, {96, 72}, progress);
    }
    SceneOptions optionsOf(const std::string& scene) const {
        SceneOptions options;
        options.scene = scene;
        options.volume.cache = false;
        return options;
    }
};

// Returns where the window's eyes come to rest at a pose: its own control, fed with its own frames.
StereoSetting settledInWindow(const Scene& scene, const Pose& head) {
    ViewStereo stereo(scene);
    ViewFrame frame;
    for (int step = 0; step < 400; ++step) {
        frame.request.stereo = stereo.now();
        const StereoViews views = makeStereoViews(head, scene.lens, stereo.now());
        frame.left.resize(scene.lens.width, scene.lens.height, rendererOf(scene).viewDependence());
        renderEye(rendererOf(scene), views.left, frame.left);
        const RoomSeen room = roomSeen(frame.left.viewDepth, 4);
        const ParallaxRange parallax = parallaxOf(views, room);
        frame.nearParallax = parallax.near;
        frame.farParallax = parallax.far;
        stereo.observe(frame);
        stereo.step(scene.offered<RoomAround>()->clearanceAt(head), room.ahead, 0.1);
    }
    return stereo.now();
}

TEST_F(NarrowedEyesTest, RestWhereTheWindowsDoInANarrowStart) {
    const SceneOptions options = optionsOf(narrowAtItsEnds());
    const std::unique_ptr<Scene> sceneLoaded = loaded(options);
    const Scene& scene = *sceneLoaded;
    ASSERT_TRUE(scene.offered<RoomAround>()->wallForPictures());
    const StereoSetting narrowed = NarrowedEyes(scene).at(scene.startPose, 0);
    EXPECT_LT(narrowed.separation, 0.6 * scene.stereo.separation);
    EXPECT_LT(narrowed.zeroParallax, scene.stereo.zeroParallax);
    const StereoSetting window = settledInWindow(scene, scene.startPose);
    EXPECT_NEAR(narrowed.separation, window.separation, 0.05 * window.separation);
    EXPECT_NEAR(narrowed.zeroParallax, window.zeroParallax, 0.05 * window.zeroParallax);
}

TEST_F(NarrowedEyesTest, AreNeverWiderThanTheScenesAndFollowSlowly) {
    const std::unique_ptr<Scene> sceneLoaded = loaded(optionsOf(narrowAtItsEnds()));
    const Scene& scene = *sceneLoaded;
    NarrowedEyes eyes(scene);
    double before = eyes.at(scene.path.at(0), 0).separation, widest = before;
    for (double t = 0.04; t < scene.path.duration(); t += 0.04) {
        const double now = eyes.at(scene.path.at(t), t).separation;
        EXPECT_LE(now, scene.stereo.separation);
        EXPECT_NEAR(std::log(now / before), 0, 0.1) << "a jump at " << t;
        widest = std::max(widest, now);
        before = now;
    }
    EXPECT_GT(widest, 1.5 * NarrowedEyes(scene).at(scene.startPose, 0).separation);
}

TEST_F(NarrowedEyesTest, LeaveFewerPixelsToCastAgain) {
    SceneOptions options = optionsOf(narrowAtItsEnds());
    const std::unique_ptr<Scene> followsLoaded = loaded(options);
    const Scene& follows = *followsLoaded;
    options.separation_m = follows.stereo.separation;
    const std::unique_ptr<Scene> staysLoaded = loaded(options);
    const Scene& stays = *staysLoaded;
    EXPECT_FALSE(stays.offered<RoomAround>()->wallForPictures()) << "what is asked for is what is shown";
    EXPECT_EQ(NarrowedEyes(stays).at(stays.startPose, 0).separation, stays.stereo.separation);
    StereoFrame narrow(follows, "auto"), wide(stays, "auto");
    narrow.render(follows.startPose);
    wide.render(stays.startPose);
    EXPECT_LT(narrow.timings().warped->holePixels,
              0.7 * static_cast<double>(wide.timings().warped->holePixels));
}

TEST_F(NarrowedEyesTest, OfAMediumLookAtTheWallAroundIt) {
    SceneOptions options = optionsOf(narrowAtItsEnds());
    const StereoSetting cast = NarrowedEyes(*loaded(options)).at(loaded(options)->startPose, 0);
    options.medium.medium = "tissue";
    const std::unique_ptr<Scene> mediumLoaded = loaded(options);
    const Scene& medium = *mediumLoaded;
    ASSERT_TRUE(medium.offered<RoomAround>()->wallForPictures());
    const StereoSetting narrowed = NarrowedEyes(medium).at(medium.startPose, 0);
    EXPECT_NEAR(narrowed.separation, cast.separation, 1e-9);
    EXPECT_LT(narrowed.separation, 0.6 * medium.stereo.separation);
    options.separation_m = medium.stereo.separation;
    const std::unique_ptr<Scene> staysLoaded = loaded(options);
    const Scene& stays = *staysLoaded;
    EXPECT_EQ(NarrowedEyes(stays).at(stays.startPose, 0).separation, stays.stereo.separation);
}

TEST_F(NarrowedEyesTest, AreThoseOfCompare) {
    const std::string scene = narrowAtItsEnds();
    const std::vector<std::string> compare{"compare",  scene,    "--size",    "64x48", "--no-cache",
                                           "--frames", "1",      "--repeats", "1",     "--images",
                                           "images",   "--json", "a.json"};
    const Outcome outcome = run(compare);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto json = nlohmann::json::parse(contentOf(place() / "a.json"));
    EXPECT_LT(json["least_separation_m"].get<double>(), 0.6 * json["separation_m"].get<double>());
    EXPECT_NE((outcome.out + outcome.err).find("where narrow"), std::string::npos);
    ASSERT_EQ(run({"render", scene, "--look", "plain", "--size", "64x48", "--no-cache", "--method", "full",
                   "--edges", "0", "--mode", "mr", "--out", "a.png"})
                  .status,
              0);
    EXPECT_EQ(contentOf(place() / "a.png"), contentOf(place() / "images/full_right.png"));
    std::vector<std::string> asked = compare;
    asked.insert(asked.end(), {"--relative-separation", "0.0333"});
    ASSERT_EQ(run(asked).status, 0);
    const auto kept = nlohmann::json::parse(contentOf(place() / "a.json"));
    EXPECT_EQ(kept["least_separation_m"], kept["separation_m"]);
}

TEST_F(NarrowedEyesTest, AreThoseOfRenderAndPlayAlike) {
    const std::string scene = narrowAtItsEnds();
    ASSERT_EQ(run({"render", scene, "--size", "64x48", "--no-cache", "--out", "a.png"}).status, 0);
    ASSERT_EQ(
        run({"play", scene, "--size", "64x48", "--no-cache", "--frames", "1", "--out", "frames"}).status, 0);
    EXPECT_EQ(contentOf(place() / "a.png"), contentOf(place() / "frames/frame_00000.png"));
    ASSERT_EQ(
        run({"render", scene, "--size", "64x48", "--no-cache", "--zero-parallax", "0.02", "--out", "b.png"})
            .status,
        0);
    EXPECT_NE(contentOf(place() / "a.png"), contentOf(place() / "b.png"));
}

}  // namespace
}  // namespace stereonav::test
