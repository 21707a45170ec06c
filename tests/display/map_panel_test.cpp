// The map as it is felt: keyframes are taken, dragged and let go with a mouse; beside them a click flies.
#include "app/view/panel/map_panel.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <memory>

#include "engine/base/error.h"
#include "engine/display/interface.h"
#include "engine/nav/navigator.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

constexpr int kMapSide = 400;  // side of the window, pixels

// Stands still, with walls everywhere in its way.
class WalledIn final : public Flight {
public:
    void step(const FlightInput&, double) override {}
    void turnBy(double, double) override {}
    Pose pose() const override { return mPose; }
    void setPose(const Pose& pose) override { mPose = pose; }
    void goHome() override {}
    int modeCount() const override { return 1; }
    int mode() const override { return 0; }
    void setMode(int) override {}
    std::string_view modeName(int) const override { return "still"; }
    double speed() const override { return 1; }
    double clearanceNow() const override { return 1; }
    bool wayIsClear(const glm::dvec3&, const glm::dvec3&) const override { return false; }

private:
    Pose mPose;
};

// 2000 m to each side, one pixel 10 m; the ground rises to the east.
class Rising final : public Scene, MapFromAbove {
public:
    explicit Rising(bool walled = false) : mWalled(walled) {
        lens.verticalFov = 0.8;
        stereo = {20, 600};
        offer<MapFromAbove>(*this);
    }
    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override {
        if (mWalled) return std::make_unique<WalledIn>();
        return std::make_unique<Navigator>([](const glm::dvec2& at) { return 0.1 * at.x; },
                                           poseFromAngles({1000, 1000, 500}, 0, 0, 0), FlightSetting{});
    }
    MapPicture makeMap(int, Progress&) const override {
        return {Plane<PackedColor>(200, 200), {0, 2000}, 10};
    }

private:
    bool mWalled;
    mutable FakeFrames mFrames;
};

class MapPanelTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            mWindow = std::make_unique<Window>("test", kMapSide, kMapSide, false);
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        mInterface = std::make_unique<Interface>(*mWindow);
        mPanel = std::make_unique<MapPanel>();
        awaitMap();
        edit().start(timedKeyframes({at(400, 1000, 300), at(1000, 1500, 300), at(1600, 1000, 300)}, 100));
        layOut();
    }
    void TearDown() override {
        mPanel.reset();
        mInterface.reset();
    }

    static Pose at(double x, double y, double z) { return poseFromAngles({x, y, z}, 0, 0, 0); }
    KeyframeEdit& edit() { return mEdit; }
    void layOut() {
        mInterface->layOut({}, 0.02, [&] {
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({kMapSide, kMapSide});
            ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10, 10});
            ImGui::Begin("map", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
            const float before = ImGui::GetCursorPosY();
            mPanel->draw(mSession, mEdit, {320, 200});
            const float height = ImGui::GetCursorPosY() - before - ImGui::GetStyle().ItemSpacing.y;
            mSide = height > kMapSide / 2 ? height : 0;
            ImGui::End();
            ImGui::PopStyleVar();
        });
    }
    // It is drawn beside the window's thread.
    void awaitMap() {
        mSide = 0;
        ASSERT_TRUE(test::waitFor([&] { return layOut(), mSide > 0; }));
    }
    // Returns what the panel shows once its map is there.
    std::vector<unsigned char> drawn() {
        awaitMap();
        layOut();
        glViewport(0, 0, kMapSide, kMapSide);
        glDisable(GL_SCISSOR_TEST);
        glClear(GL_COLOR_BUFFER_BIT);
        mInterface->render();
        std::vector<unsigned char> pixels(std::size_t{kMapSide} * kMapSide * 3);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, kMapSide, kMapSide, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
        return pixels;
    }
    void point(double x, double y) {
        const double pixel = mSide / 2000.0;
        mInterface->pointerAt({(10 + x * pixel) / kMapSide, (10 + (2000 - y) * pixel) / kMapSide});
        layOut();
    }
    void button(bool pressed) {
        mInterface->takesButton(0, pressed);
        layOut();
    }
    void drag(const glm::dvec2& from, const glm::dvec2& to) {
        point(from.x, from.y);
        button(true);
        for (int n = 1; n <= 4; ++n) {
            const glm::dvec2 here = from + (to - from) * (n / 4.0);
            point(here.x, here.y);
        }
        button(false);
        layOut();
    }

    ViewSession mSession{std::make_shared<OpenScene>(OpenScene{std::make_shared<Rising>(), {}, {}, 0, false}),
                         {}};
    KeyframeEdit mEdit;
    std::unique_ptr<Window> mWindow;
    std::unique_ptr<Interface> mInterface;
    std::unique_ptr<MapPanel> mPanel;
    float mSide = 0;  // side of the map, units; 0: not there yet
};

TEST_F(MapPanelTest, AKeyframeIsDraggedOverTheGround) {
    const double height = *heightOverGround(mSession.flight(), edit().keys()[1].pose.position);
    drag({1000, 1500}, {1600, 600});
    const glm::dvec3 place = edit().keys()[1].pose.position;
    EXPECT_NEAR(place.x, 1600, 15);
    EXPECT_NEAR(place.y, 600, 15);
    EXPECT_NEAR(*heightOverGround(mSession.flight(), place), height, 1e-6);
    EXPECT_GT(place.z, 340) << "the ground is higher there";
    EXPECT_EQ(edit().chosen(), 1u);
    EXPECT_TRUE(edit().canUndo());
    EXPECT_FALSE(edit().dragging());
    EXPECT_FALSE(mSession.moves().toGoal()) << "that was no click on the map";
    edit().undo();
    EXPECT_EQ(edit().keys()[1].pose.position, glm::dvec3(1000, 1500, 300));
    // Beyond the map it stays at its border.
    drag({1000, 1500}, {5000, 1500});
    EXPECT_NEAR(edit().keys()[1].pose.position.x, 2000, 1);
}

// Whether a wall is in the way of the keyframes is a matter of the scene, also where they stay as they are.
TEST_F(MapPanelTest, TheWayIsHeldAgainstTheSceneThatIsShown) {
    const std::vector<unsigned char> free = drawn();
    mSession.replaceScene(
        std::make_shared<OpenScene>(OpenScene{std::make_shared<Rising>(true), {}, {}, 0, false}));
    const std::vector<unsigned char> blocked = drawn();
    EXPECT_NE(blocked, free) << "walls are in the way";
    mPanel = std::make_unique<MapPanel>();
    EXPECT_EQ(drawn(), blocked) << "a panel that is shown for the first time";
}

TEST_F(MapPanelTest, AClickChoosesOneOrFlies) {
    drag({400, 1000}, {400, 1000});
    EXPECT_EQ(edit().chosen(), 0u);
    EXPECT_FALSE(edit().canUndo());
    EXPECT_FALSE(mSession.moves().toGoal());
    drag({700, 400}, {700, 400});
    EXPECT_TRUE(mSession.moves().toGoal()) << "beside them";
    EXPECT_EQ(edit().chosen(), 0u);
    edit().start({});
    drag({1000, 1500}, {1000, 1500});
    EXPECT_FALSE(edit().any());
}

}  // namespace
}  // namespace stereonav
