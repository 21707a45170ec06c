// The mouse turns, pans and zooms in scenes seen from outside, and looks around in others.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "app/view/input.h"
#include "app/view/live_settings.h"
#include "app/view/seen_surface.h"
#include "app/view/session.h"
#include "tests/view/session_fixture.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace stereonav {
namespace {
using std::numbers::pi;

constexpr double kTurn60 = 1.0 / 60;  // seconds

// A box ten metres wide, seen from forty metres south of its middle.
FakeParts objectSeenFromOutside() {
    FakeParts scene = flatScene();
    scene.outside = SeenFromOutside{{-5, -5, -5}, {5, 5, 5}};
    scene.lens.nearDepth = 0.05;
    scene.stereo = {1.2, 40};
    scene.makeFlight = []() -> std::unique_ptr<Flight> {
        FlightSetting setting;
        setting.clearance = 1e-5;
        setting.speed = 1;
        const auto noGround = [](const glm::dvec2&) { return std::nan(""); };
        return std::make_unique<Navigator>(noGround, poseFromAngles({0, -40, 0}, 0, 0, 0), setting);
    };
    return scene;
}

class ViewOrbitTest : public SessionFixture {
protected:
    void SetUp() override {
        SessionFixture::SetUp();
        mScene = std::make_shared<FakeParts>(objectSeenFromOutside());
    }
    static void rest(ViewSession& s, int frames = 120) {
        for (int n = 0; n < frames; ++n) s.step({}, kTurn60);
    }
};

TEST_F(ViewOrbitTest, ObjectsBeginInOrbitAndFlightsDoNot) {
    EXPECT_TRUE(session().orbits());
    mScene = std::make_shared<FakeParts>(flatScene());
    ViewSession flight = session();
    EXPECT_FALSE(flight.orbits());
    flight.act({ViewCommand::ToggleOrbit});
    EXPECT_TRUE(flight.orbits()) << "it can be chosen anywhere";
    flight.act({ViewCommand::Reset});
    EXPECT_FALSE(flight.orbits());
}

TEST_F(ViewOrbitTest, KeysChangeBetweenOrbitAndFlight) {
    const auto orbit = actionOf({GLFW_KEY_R, 'r', false, false, true});
    ASSERT_TRUE(orbit.has_value());
    EXPECT_EQ(orbit->command, ViewCommand::ToggleOrbit) << "Ctrl+R";
    ViewSession s = session();
    s.act(*orbit);
    EXPECT_FALSE(s.orbits());
    EXPECT_NE(s.notice().find("fly"), std::string::npos);
    s.act({ViewCommand::NextFlightMode});
    EXPECT_TRUE(s.orbits()) << "F, which has no other way to fly here";
    EXPECT_NE(s.notice().find("orbit"), std::string::npos);
    EXPECT_EQ(s.flight().mode(), 0);
}

TEST_F(ViewOrbitTest, ADragTurnsAboutWhatWasUnderThePointer) {
    ViewSession s = session();
    s.takeHold(glm::dvec3(1, -5, 2));
    const double before = glm::distance(s.pose().position, glm::dvec3(1, -5, 2));
    s.drag(OrbitDrag::Turn, {0.4, 0}, 0.8);
    EXPECT_NEAR(glm::distance(s.pose().position, glm::dvec3(1, -5, 2)), before, 1e-9);
    EXPECT_NEAR(anglesOf(s.pose()).heading, pi / 2, 1e-9) << "half of the picture's height is a quarter turn";
    s.step({}, kTurn60);
    EXPECT_TRUE(s.flying()) << "pictures are warped meanwhile";
    rest(s);
    EXPECT_FALSE(s.moving());
}

TEST_F(ViewOrbitTest, WithoutASurfaceItTurnsAboutTheObjectsMiddle) {
    ViewSession s = session();
    s.takeHold(std::nullopt);
    s.drag(OrbitDrag::Turn, {0.8, 0}, 0.8);
    EXPECT_NEAR(s.pose().position.y, 40, 1e-9) << "from behind";
    EXPECT_NEAR(s.pose().forward().y, -1, 1e-9);
}

TEST_F(ViewOrbitTest, APanMovesTheHeadBesideIt) {
    ViewSession s = session();
    s.takeHold(std::nullopt);
    s.drag(OrbitDrag::Pan, {0.1, -0.05}, 0.8);
    EXPECT_NEAR(s.pose().position.x, -4, 1e-9);
    EXPECT_NEAR(s.pose().position.z, 2, 1e-9);
    EXPECT_NEAR(s.pose().position.y, -40, 1e-9);
}

TEST_F(ViewOrbitTest, TheWheelZoomsSmoothlyAndTheEyesComeTogether) {
    ViewSession s = session();
    ASSERT_TRUE(s.zoomsByWheel());
    const StereoSetting eyes = s.stereo();
    s.takeHold(glm::dvec3(0, -5, 0));
    for (int n = 0; n < 5; ++n) s.zoomBy(1);
    const double factor = std::pow(5.0 / 6, 5);
    double before = 35;
    for (int n = 0; n < 120; ++n) {
        s.step({}, kTurn60);
        const double away = glm::distance(s.pose().position, glm::dvec3(0, -5, 0));
        EXPECT_LE(away, before);
        EXPECT_GT(away, 0.8 * before) << "no jump";
        EXPECT_NEAR(s.stereo().separation / eyes.separation, away / 35, 1e-9);
        EXPECT_NEAR(s.stereo().zeroParallax / eyes.zeroParallax, away / 35, 1e-9);
        before = away;
    }
    EXPECT_NEAR(before, 35 * factor, 1e-9);
    EXPECT_FALSE(s.moving());
    // Settings say what they said: nothing was set by hand, so there is nothing to undo.
    EXPECT_FALSE(withLive(s, {}).contains("separation"));
    // Home goes back, and the eyes slowly with it.
    s.act({ViewCommand::Home});
    rest(s, 600);
    EXPECT_NEAR(s.stereo().separation, eyes.separation, 1e-3 * eyes.separation);
    EXPECT_NEAR(s.stereo().zeroParallax, eyes.zeroParallax, 1e-3 * eyes.zeroParallax);
}

TEST_F(ViewOrbitTest, EyesThatFollowTheRoomGoOnFromTheZoomedOnes) {
    mScene->makeFollower = [](const StereoSetting& from) {
        return [from](double, double, double) { return from; };
    };
    ViewSession s = session();
    ASSERT_TRUE(s.followsClearance());
    s.takeHold(std::nullopt);
    s.zoomBy(-4);
    rest(s);
    const double factor = std::pow(6.0 / 5, 4);
    EXPECT_NEAR(s.stereo().separation, 1.2 * factor, 1e-3);
    EXPECT_NEAR(s.stereo().zeroParallax, 40 * factor, 0.05);
    EXPECT_TRUE(s.followsClearance());
}

TEST_F(ViewOrbitTest, ZoomingEndsBeforeWhatCanNotBeSeenAndBeforeTheFarEnd) {
    ViewSession s = session();
    s.takeHold(std::nullopt);
    s.zoomBy(1000);
    rest(s, 600);
    EXPECT_NEAR(s.pose().position.y, -2 * 0.05, 1e-9) << "two near depths";
    EXPECT_GT(s.stereo().separation, 0);
    s.zoomBy(-1000);
    rest(s, 600);
    EXPECT_LT(s.pose().position.y, -100);
    EXPECT_GT(s.pose().position.y, -1000);
    EXPECT_FALSE(s.moving());
}

TEST_F(ViewOrbitTest, FramesMadeAheadDoNotPassThePivot) {
    ViewSession s = session();
    s.takeHold(std::nullopt);
    s.zoomBy(30);
    for (int n = 0; n < 60; ++n) {
        s.step({}, kTurn60);
        EXPECT_LT(s.poseAhead(0.15).position.y, 0.45 * s.pose().position.y);
    }
}

TEST_F(ViewOrbitTest, KeysFlyOnAndEndAZoom) {
    ViewSession s = session();
    s.takeHold(std::nullopt);
    s.zoomBy(10);
    s.step({}, kTurn60);
    EXPECT_TRUE(s.zooming());
    FlightInput ahead;
    ahead.forward = 1;
    for (int n = 0; n < 60; ++n) s.step(ahead, kTurn60);
    EXPECT_FALSE(s.zooming());
    EXPECT_TRUE(s.orbits()) << "the mouse still turns";
    EXPECT_GT(s.flight().pose().position.y, -40);
}

TEST_F(ViewOrbitTest, SomethingInTheWayEndsAZoom) {
    mScene->makeFlight = []() -> std::unique_ptr<Flight> {
        FlightSetting setting;
        setting.clearance = 1;
        return std::make_unique<Navigator>([](const glm::dvec2&) { return 0.0; },
                                           poseFromAngles({0, 0, 50}, 0, -pi / 2, 0), setting);
    };
    ViewSession s = session();
    s.takeHold(glm::dvec3(0, 0, 0.5));
    s.zoomBy(100);
    rest(s, 600);
    EXPECT_NEAR(s.pose().position.z, 1, 1e-9) << "the ground's clearance";
    EXPECT_FALSE(s.moving());
}

TEST_F(ViewOrbitTest, APictureWarpedFromElsewhereTellsWhatIsUnderThePointer) {
    Lens lens;
    lens.width = 64;
    lens.height = 48;
    const StereoSetting eyes{0.5, 10};
    const StereoViews cast = makeStereoViews(poseFromAngles({0, -10, 0}, 0, 0, 0), lens, eyes);
    Plane<float> depth(64, 48);
    // A wall at y = 0, which does not fill the picture.
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) depth.at(x, y) = x < 60 ? 10.0f : std::numeric_limits<float>::infinity();
    const auto here = surfaceUnder(cast, cast, depth, {0.5, 0.5}, {});
    ASSERT_TRUE(here.has_value());
    EXPECT_NEAR(here->y, 0, 1e-9);
    const StereoViews shown = makeStereoViews(poseFromAngles({0.7, -8, 0.2}, 0.05, 0, 0), lens, eyes);
    const glm::dvec2 share(0.4, 0.6);
    const auto place = surfaceUnder(shown, cast, depth, share, {});
    ASSERT_TRUE(place.has_value());
    const glm::dvec3 seen = shown.left.project(*place);
    EXPECT_NEAR(seen.x / 64, share.x, 1.0 / 64) << "a pixel: depths are those of pixels";
    EXPECT_NEAR(seen.y / 48, share.y, 1.0 / 48);
    EXPECT_FALSE(surfaceUnder(cast, cast, depth, {0.99, 0.5}, {}).has_value()) << "nothing is there";
    EXPECT_FALSE(surfaceUnder(shown, cast, depth, {2, 0.5}, {}).has_value());
}

}  // namespace
}  // namespace stereonav
