// The window's first picture of every kind of scene is comfortable, unless somebody said how far apart the
// eyes are; and what it tells of a picture's parallax is what its depths say.
#include <gtest/gtest.h>

#include <cstdlib>

#include "app/options/option_table.h"
#include "app/options/parsed_options.h"
#include "app/options/view_options.h"
#include "app/scene/shown_as.h"
#include "app/view/loading.h"
#include "app/view/session.h"
#include "app/view/status.h"
#include "app/view/worker.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;

class ViewStart : public VolumeTest {
protected:
    static std::shared_ptr<const OpenScene> open(const std::string& scene, const SceneOptions& given = {}) {
        ViewOptions options;
        options.scene = given;
        options.scene.scene = scene;
        options.scene.given = GivenOptions{};
        Progress progress;
        return std::make_shared<const OpenScene>(openScene(options, false, {320, 180}, nullptr, progress));
    }

    // The session's next frame, of one window's size.
    static std::shared_ptr<const ViewFrame> frameOf(ViewWorker& worker, ViewSession& session) {
        worker.request(session.requestFor(640, 180));
        auto frame = waitFor([&] { return worker.takeFrame(); });
        if (!frame) throw std::runtime_error("no frame came");
        return frame;
    }

    static ParallaxRange plainRange(const ViewFrame& frame) {
        const FrameRequest& request = frame.request;
        const StereoViews views = makeStereoViews(request.pose, request.lens, request.stereo);
        ParallaxRange range{1e30, -1e30};
        for (int y = 0; y < frame.left.height(); ++y)
            for (int x = 0; x < frame.left.width(); ++x) {
                const double depth = static_cast<double>(frame.left.viewDepth.at(x, y));
                const double share = (views.shiftAtInfinity - views.parallaxScale / depth) / views.left.width;
                range = {std::min(range.near, share), std::max(range.far, share)};
            }
        return range;
    }

    // Expects a comfortable first picture: as the scene has it, and as the window shows it.
    static void expectComfortableStart(const std::string& scene, const SceneOptions& given = {}) {
        const auto opened = open(scene, given);
        ASSERT_FALSE(opened->scene->eyesGiven);
        const StereoSetting own = opened->scene->stereo;
        ViewWorker worker([&](Progress&) { return *opened; }, [] {});
        ViewSession session(opened, {OutputMode::SideBySide, std::nullopt, "."});
        ASSERT_TRUE(session.requestFor(640, 180).fitEyes);
        const auto first = frameOf(worker, session);
        const ComfortReading reading = comfortReading(*first);
        EXPECT_EQ(reading.state, ComfortState::Comfortable) << scene << " " << reading.advice;
        EXPECT_EQ(reading.advice, "");
        const ParallaxRange plain = plainRange(*first);
        EXPECT_EQ(first->nearParallax, plain.near) << scene;
        EXPECT_EQ(first->farParallax, plain.far) << scene;
        EXPECT_EQ(first->parallax.known(), 320 * 180) << scene;
        session.observe(*first);
        EXPECT_EQ(session.stereo().separation, first->request.stereo.separation);
        EXPECT_LE(session.stereo().separation, own.separation);
        EXPECT_FALSE(session.requestFor(640, 180).fitEyes) << "once";
        const auto second = frameOf(worker, session);
        EXPECT_EQ(second->request.stereo.separation, first->request.stereo.separation)
            << "and no jump after it";
        EXPECT_EQ(second->request.stereo.zeroParallax, first->request.stereo.zeroParallax);
    }
};

TEST_F(ViewStart, BuiltInTerrainAndGround) {
    expectComfortableStart("terrain");
    expectComfortableStart(hills());
}

TEST_F(ViewStart, BuiltInColon) {
    expectComfortableStart("colon");
}

TEST_F(ViewStart, BuiltInMedia) {
    expectComfortableStart("cloud");
    expectComfortableStart("wax");
}

TEST_F(ViewStart, MeshesAndVolumes) {
    const std::string mesh = (mFolder / "hills.glb").string();
    ASSERT_EQ(run({"mesh", hills(), "--out", mesh, "--error", "0"}).status, 0);
    expectComfortableStart(mesh);
    SceneOptions options;
    options.volume.cache = false;
    expectComfortableStart(ball(), options);
    expectComfortableStart(maskedTube(), options);
}

TEST_F(ViewStart, RealGround) {
    const char* named = std::getenv("STEREONAV_TEST_DATA");
    const fs::path folder =
        named && *named ? fs::path(named) : fs::path(STEREONAV_SOURCE_DIR) / "../shared/data";
    const fs::path dem = folder / "terrain/srtm_bigtujunga30m_utm11.tif";
    if (!fs::exists(dem)) GTEST_SKIP() << "no real data beside the project";
    expectComfortableStart(dem.string());
}

TEST_F(ViewStart, WhoSaidWhereTheEyesAreGetsThat) {
    SceneOptions options;
    options.separation_m = 1000;
    const auto opened = open("terrain", options);
    EXPECT_TRUE(opened->scene->eyesGiven);
    ViewWorker worker([&](Progress&) { return *opened; }, [] {});
    ViewSession session(opened, {OutputMode::SideBySide, std::nullopt, "."});
    const auto frame = frameOf(worker, session);
    EXPECT_EQ(frame->request.stereo.separation, 1000);
    EXPECT_EQ(comfortReading(*frame).state, ComfortState::TooMuch);
    EXPECT_NE(warningLine(*frame), "");
    for (const char* said : {"separation_m = 20.0", "zero_parallax_m = 500.0"}) {
        const std::string file =
            input("eyes.toml", std::string("[terrain]\nbuiltin = true\n[stereo]\n") + said + "\n");
        EXPECT_TRUE(open(file)->scene->eyesGiven) << said;
    }
    EXPECT_FALSE(open(input("none.toml", "[terrain]\nbuiltin = true\n"))->scene->eyesGiven);
    EXPECT_FALSE(
        open(input("lens.toml", "[terrain]\nbuiltin = true\n[stereo]\nfov_deg = 50.0\n"))->scene->eyesGiven);
}

// What is shown as the truth, made the scene's exact way, and what pictures at rest are measured against,
// cast or swept by itself, are one and the same.
TEST_F(ViewStart, TheTruthIsTheExactMethods) {
    SceneOptions options;
    options.volume.cache = false;
    for (const std::string& scene : {std::string("terrain"), ball(), std::string("wax")}) {
        const auto opened = open(scene, options);
        ViewWorker worker([&](Progress&) { return *opened; }, [] {});
        ViewSession session(opened, {OutputMode::SideBySide, std::nullopt, "."});
        session.eyes().setSeparation(opened->scene->stereo.separation);  // no fit: three times the same eyes
        const auto made = frameOf(worker, session);
        session.setTruth(TruthView::FullCast);
        const auto full = frameOf(worker, session);
        session.setTruth(TruthView::Difference);
        const auto difference = frameOf(worker, session);
        ASSERT_TRUE(difference->truthError) << scene;
        const PictureError error = errorOf(full->right.color, made->right.color);
        EXPECT_EQ(difference->truthError->psnr_db, error.psnr_db) << scene;
        EXPECT_EQ(difference->truthError->largest, error.largest) << scene;
        EXPECT_EQ(difference->truthError->wrongShare, error.wrongShare) << scene;
        EXPECT_GT(error.wrongShare, 0) << scene;
        EXPECT_GT(error.psnr_db, 30) << scene;
    }
}

// Eyes that were set before the first picture came stay as they were set.
TEST_F(ViewStart, AHandIsFasterThanThePicture) {
    const auto opened = open("terrain");
    ViewWorker worker([&](Progress&) { return *opened; }, [] {});
    ViewSession session(opened, {OutputMode::SideBySide, std::nullopt, "."});
    const auto frame = frameOf(worker, session);
    session.act({ViewCommand::MoreSeparation});
    session.observe(*frame);
    for (int n = 0; n < 300; ++n) session.step({}, 0.02);
    EXPECT_NEAR(session.stereo().separation, 1.1 * opened->scene->stereo.separation,
                1e-9 * opened->scene->stereo.separation);
    session.act({ViewCommand::Reset});
    EXPECT_TRUE(session.requestFor(640, 180).fitEyes) << "the start is to be comfortable yet";
}

// A desktop's menu starts it in this way: packaging/entry.desktop.
TEST(StartPageAtFirst, IsShownWhereViewIsGivenNothing) {
    const auto shown = [](const char* key, const std::string& text) {
        ParsedOptions parsed(sceneTypeOf);
        chooseCommand(command::kView, parsed);
        if (key) takeOption(*findOption(command::kView, key), text, key, parsed);
        finishOptions(parsed);
        return parsed.to.of<ViewOptions>().scene.given.empty();
    };
    EXPECT_TRUE(shown(nullptr, ""));
    EXPECT_FALSE(shown("SCENE", "colon"));
    EXPECT_FALSE(shown("mode", "ml"));
}

}  // namespace
}  // namespace stereonav::test
