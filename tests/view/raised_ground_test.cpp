// Heights that are exaggerated by another factor: eyes, flights and places stay at their height over the
// ground.
#include "app/view/raised_ground.h"

#include <gtest/gtest.h>

#include "app/scene/terrain/terrain_loading.h"
#include "app/view/live_settings.h"
#include "app/view/session.h"
#include "engine/base/file.h"
#include "engine/scene/live_paint.h"
#include "terrain/scene/terrain_scene.h"
#include "tests/camera/temporary_folder.h"

namespace stereonav {
namespace {

class RaisedGroundTest : public testing::Test {
protected:
    RaisedGroundTest() {
        std::string text = "ncols 40\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 30\n";
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x)
                text += std::to_string(200 + (x * x + 3 * y) % 97) + (x == 39 ? "\n" : " ");
        writeTextFile(mFolder / "ground.asc", text);
    }
    std::shared_ptr<const OpenScene> opened(double scale) {
        SceneOptions options;
        options.scene = (mFolder / "ground.asc").string();
        options.verticalScale = scale;
        Progress progress;
        auto open = std::make_shared<OpenScene>();
        open->scene = loadTerrainScene(options, SimdTarget::Auto, progress);
        open->way.method = open->scene->frames().defaultMethod();
        return open;
    }
    static double over(const Scene& scene, const glm::dvec3& place) {
        return place.z - scene.offered<const TerrainScene>()->ground.heightAt(glm::dvec2(place));
    }
    TemporaryFolder mFolder;
};

TEST_F(RaisedGroundTest, EyesAndFlightsStayAsHighOverIt) {
    const auto plain = opened(1), raised = opened(4);
    const glm::dvec3 start(100, -50, over(*plain->scene, {100, -50, 0}) * -1 + 60);
    const RecordedPath path(
        {{0, poseFromAngles(start, 1, 0, 0)}, {1, poseFromAngles({-200, 30, 500}, 2, 0, 0)}}, "test");
    ViewSession session(plain, {OutputMode::Left, path, "."});
    session.goTo(poseFromAngles(start, 1, 0, 0));
    const double before = over(*plain->scene, session.pose().position);
    EXPECT_NEAR(before, 60, 1e-6);
    session.replaceScene(raised);
    EXPECT_NEAR(over(*raised->scene, session.pose().position), before, 1e-6);
    EXPECT_GT(session.pose().position.z, start.z + 500);
    ASSERT_EQ(session.paths().path().samples().size(), 2u);
    for (std::size_t n = 0; n < 2; ++n)
        EXPECT_NEAR(over(*raised->scene, session.paths().path().samples()[n].pose.position),
                    over(*plain->scene, path.samples()[n].pose.position), 1e-6);
    session.replaceScene(plain);
    EXPECT_NEAR(glm::distance(session.pose().position, start), 0, 1e-6) << "and back";
}

TEST_F(RaisedGroundTest, KeptPlacesSayByWhatScaleTheyWereKept) {
    const auto plain = opened(1), raised = opened(4);
    Bookmark place;
    place.pose.position = {100, -50, 400};
    EXPECT_EQ(placeNow(place, *raised->scene).pose.position, place.pose.position) << "it does not say";
    place.settings = groundSettings(*plain->scene);
    EXPECT_EQ(placeNow(place, *plain->scene).pose.position, place.pose.position);
    const glm::dvec3 moved = placeNow(place, *raised->scene).pose.position;
    EXPECT_NEAR(over(*raised->scene, moved), over(*plain->scene, place.pose.position), 1e-4);
    // Outside the ground, and by settings that are not of it, nothing is lost.
    place.settings = "vertical-scale=many";
    EXPECT_EQ(placeNow(place, *raised->scene).pose.position, place.pose.position);
}

TEST_F(RaisedGroundTest, OtherGroundsMoveNothing) {
    const auto plain = opened(1);
    writeTextFile(mFolder / "ground.asc",
                  "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 30\n1 2 3\n4 5 6\n");
    EXPECT_FALSE(RaisedGround::between(*plain->scene, *opened(4)->scene));
    EXPECT_FALSE(RaisedGround::between(*plain->scene, *plain->scene));
}

TEST_F(RaisedGroundTest, WhatIsPaintedIsSaidAndGoesOnInTheNextScene) {
    const auto plain = opened(1), raised = opened(4);
    ViewSession session(plain, {OutputMode::Left, std::nullopt, "."});
    EXPECT_EQ(withLive(session, {}), SettingTexts());
    ASSERT_TRUE(isLive(session, "contours", "12"));
    setLive(session, "contours", "12");
    EXPECT_EQ(withLive(session, {}), (SettingTexts{{"contours", {"12"}}}));
    EXPECT_EQ(withLive(session, {{"contours", {"5"}}}), (SettingTexts{{"contours", {"12"}}}));
    EXPECT_EQ(valueNow(session, "contours"), "12");
    // A setting that needs loading is kept.
    EXPECT_FALSE(isLive(session, "image", "ground.png"));
    EXPECT_EQ(withLive(session, {{"image", {"ground.png"}}}),
              (SettingTexts{{"contours", {"12"}}, {"image", {"ground.png"}}}));
    session.replaceScene(raised);
    EXPECT_EQ(withLive(session, {}), (SettingTexts{{"contours", {"12"}}}));
    setLive(session, "contours", std::nullopt);
    EXPECT_EQ(withLive(session, {{"contours", {"12"}}}), SettingTexts());
    const auto before = session.requestFor(64, 48).version;
    setLive(session, "contours", "30");
    EXPECT_GT(session.requestFor(64, 48).version, before) << "another picture is asked for";
    EXPECT_EQ(session.requestFor(64, 48).paint, raised->scene->offered<LivePaint>()->version());
}

}  // namespace
}  // namespace stereonav
