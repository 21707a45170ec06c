// The wall that lies flat, as it is felt: made once it is shown and not before, what is under the pointer is
// marked in the flight, and a click flies there.
#include "app/view/panel/unfolded_panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <atomic>
#include <memory>

#include "engine/base/error.h"
#include "engine/display/interface.h"
#include "engine/nav/navigator.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/surface_paint.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_frames.h"

namespace stereonav {
namespace {

constexpr int kBox = 400;               // side of the window, pixels
constexpr int kWide = 300, kHigh = 60;  // pixels of the wall

// A wall in the plane y = 0.01: a pixel is a millimetre, its rows go up along z; the line is the x axis.
class StraightFlat final : public FlatPicture {
public:
    explicit StraightFlat(double away = 0.01) : mAway(away) {}
    int width() const override { return kWide; }
    int height() const override { return kHigh; }
    double pixel() const override { return 0.001; }
    Plane<PackedColor> picture(const FlatTint& tint) const override {
        Plane<PackedColor> picture(kWide, kHigh + 20);
        const glm::vec3 grey(0.5f);
        for (int y = 0; y < picture.height(); ++y)
            for (int x = 0; x < picture.width(); ++x)
                picture.at(x, y) = packColor(tint ? tint(glm::dvec3(0), grey) : grey);
        return picture;
    }
    std::optional<FlatPlace> placeAt(int x, int y) const override {
        if (x < 0 || y < 0 || x >= kWide || y >= kHigh) return std::nullopt;
        return FlatPlace{{0.001 * x, mAway, 0.001 * y}, {0.001 * x, 0, 0}, 0.001 * x};
    }
    std::vector<glm::dvec2> pixelsOf(const glm::dvec3& world, double) const override {
        return {glm::dvec2(1000 * world.x, 1000 * world.z)};
    }
    double columnAt(double along) const override { return 1000 * along; }

private:
    double mAway;
};

class CountedPainter final : public EyePainter {
public:
    void paint(const EyeView&, EyeImage&) const override {}
    glm::vec3 paintPlace(const glm::dvec3&, const glm::vec3& color) const override {
        ++painted;
        return 0.5f * color;
    }
    mutable std::atomic<int> painted = 0;
};

class Walled final : public Scene, FlatWall, LineThrough {
public:
    Walled() {
        lens.verticalFov = 0.8;
        stereo = {0.001, 0.03};
        offer<const FlatWall>(*this);
        offer<const LineThrough>(*this);
        paint.add(painter);
        offer(paint);
    }
    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override {
        return std::make_unique<Navigator>([](const glm::dvec2&) { return -100.0; }, Pose{{0.15, 0, 0}},
                                           FlightSetting{});
    }
    PlaceOnLine placeOnLine(const glm::dvec3& world) const override { return {world.x, 0.3}; }
    std::shared_ptr<const FlatPicture> makeFlat(Progress& progress) const override {
        ++made;
        if (fails) throw Error("wall", "", "it has none", "choose another");
        progress.report(0.5, "unfolding");
        return std::make_shared<const StraightFlat>();
    }

    // Makes a picture with another place of the wall in each pixel.
    std::shared_ptr<const FlatPicture> makePanorama(Progress& progress) const override {
        ++panoramas;
        try {
            test::waitFor([&] { return !waits || (progress.report(0.5, "looking"), false); });
        } catch (const Cancelled&) {
            ++left;
            throw;
        }
        return std::make_shared<const StraightFlat>(0.02);
    }

    mutable std::atomic<int> made = 0, panoramas = 0, left = 0;
    std::atomic<bool> waits = false;
    std::shared_ptr<CountedPainter> painter = std::make_shared<CountedPainter>();
    SurfacePaint paint;
    bool fails = false;

private:
    mutable FakeFrames mFrames;
};

class UnfoldedPanelTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            mWindow = std::make_unique<Window>("test", kBox, kBox, false);
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        mInterface = std::make_unique<Interface>(*mWindow);
        mPanel = std::make_unique<UnfoldedPanel>();
    }
    void TearDown() override {
        mPanel.reset();
        mInterface.reset();
    }
    void layOut() {
        mInterface->layOut(mPlaces, 0.02, [&] {
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({kBox, kBox});
            ImGui::Begin("flat", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
            mPanel->draw(mSession, mInstruments, nullptr, std::nullopt);
            ImGui::End();
        });
    }
    // Lays out again and again until that is so.
    template <typename So>
    bool becomes(const So& so) {
        return test::waitFor([&] { return layOut(), so(); });
    }
    bool make() {
        return becomes([&] { return mPanel->flat() != nullptr; });
    }
    // The box in the upper left corner: the other view.
    void otherView() {
        mInterface->pointerAt({0.05, 0.05});
        layOut();
        mInterface->takesButton(0, true);
        layOut();
        mInterface->takesButton(0, false);
        layOut();
    }
    void pointAtMiddle() {
        mInterface->pointerAt({0.5, 0.6});
        layOut();
        layOut();
    }

    std::shared_ptr<Walled> mScene = std::make_shared<Walled>();
    ViewSession mSession{std::make_shared<OpenScene>(OpenScene{mScene, {}, {}, 0, false}), {}};
    std::optional<ViewSession> mNone;
    StudyReading mStudy{[] {}};
    Instruments mInstruments{mNone, mStudy, [] {}};
    std::unique_ptr<Window> mWindow;
    const InterfacePlaces mPlaces;
    std::unique_ptr<Interface> mInterface;
    std::unique_ptr<UnfoldedPanel> mPanel;
};

TEST_F(UnfoldedPanelTest, IsMadeOnceItIsShownAndPainted) {
    EXPECT_TRUE(UnfoldedPanel::has(&mSession));
    mPanel->hide(&mSession, mInstruments);
    EXPECT_EQ(mScene->made, 0) << "nothing before it is shown";
    ASSERT_TRUE(make());
    for (int n = 0; n < 5; ++n) layOut();
    EXPECT_EQ(mScene->made, 1);
    EXPECT_GT(mScene->painter->painted, 0) << "in what the scene is painted with";
}

TEST_F(UnfoldedPanelTest, IsPaintedAgainWhileOneFlies) {
    ASSERT_TRUE(make());
    const auto seen = std::make_shared<CountedPainter>(), more = std::make_shared<CountedPainter>();
    const int before = mScene->painter->painted;
    for (const auto& painter : {seen, more}) {
        mSession.setPaint(painter);
        EXPECT_TRUE(becomes([&] { return painter->painted > 0; }));
    }
    EXPECT_GT(mScene->painter->painted, before) << "the scene's own paint stays below";
    EXPECT_EQ(mScene->made, 1) << "the wall is not unfolded again";
}

TEST_F(UnfoldedPanelTest, MarksWhatIsUnderThePointerAndFliesThere) {
    ASSERT_TRUE(make());
    pointAtMiddle();
    ASSERT_TRUE(mInstruments.marked());
    EXPECT_NEAR(mInstruments.marked()->y, 0.01, 1e-9);
    EXPECT_NEAR(mInstruments.marked()->x, 0.15, 0.02) << "it follows the eye, which is in the middle";
    const glm::dvec3 wall = *mInstruments.marked();
    EXPECT_FALSE(mSession.moves().toGoal());
    mInterface->takesButton(0, true);
    layOut();
    mInterface->takesButton(0, false);
    layOut();
    ASSERT_TRUE(mSession.moves().toGoal());
    for (int n = 0; n < 100 && mSession.moves().toGoal(); ++n) mSession.step({}, 0.1);
    const glm::dvec3 to = wall - mSession.pose().position;
    EXPECT_LT(glm::length(to), 0.041);
    EXPECT_GT(glm::dot(glm::normalize(to), mSession.pose().forward()), 0.999) << "it looks at that wall";
    mPanel->hide(&mSession, mInstruments);
    EXPECT_FALSE(mInstruments.marked());
}

TEST_F(UnfoldedPanelTest, BothViewsAreMadeOnceTheyAreShown) {
    ASSERT_TRUE(make());
    EXPECT_EQ(mScene->panoramas, 0) << "nothing before it is shown";
    otherView();
    ASSERT_TRUE(mPanel->fromBothEnds());
    ASSERT_TRUE(make());
    pointAtMiddle();
    ASSERT_TRUE(mInstruments.marked());
    EXPECT_NEAR(mInstruments.marked()->y, 0.02, 1e-9) << "the place that this view shows there";
    otherView();
    EXPECT_FALSE(mPanel->fromBothEnds());
    ASSERT_TRUE(mPanel->flat()) << "it is still there";
    pointAtMiddle();
    ASSERT_TRUE(mInstruments.marked());
    EXPECT_NEAR(mInstruments.marked()->y, 0.01, 1e-9);
    otherView();
    EXPECT_TRUE(mPanel->flat());
    EXPECT_EQ(mScene->made, 1);
    EXPECT_EQ(mScene->panoramas, 1);
    EXPECT_GT(mScene->painter->painted, kWide * kHigh) << "both are painted";
}

TEST_F(UnfoldedPanelTest, AViewThatIsLeftIsNotWaitedFor) {
    ASSERT_TRUE(make());
    mScene->waits = true;
    otherView();
    EXPECT_FALSE(mPanel->flat());
    ASSERT_TRUE(becomes([&] { return mScene->panoramas == 1; }));
    otherView();
    EXPECT_TRUE(mPanel->flat());
    ASSERT_TRUE(becomes([&] { return mScene->left == 1; }));
    mScene->waits = false;
    otherView();
    EXPECT_TRUE(make()) << "asked for again it is made again";
    EXPECT_TRUE(mPanel->fromBothEnds());
    EXPECT_EQ(mScene->panoramas, 2);
    EXPECT_EQ(mScene->made, 1);
}

TEST_F(UnfoldedPanelTest, SaysWhyThereIsNone) {
    mScene->fails = true;
    const long before = mSession.openShared().use_count();
    layOut();
    ASSERT_TRUE(becomes([&] { return mSession.openShared().use_count() == before; }))
        << "who makes it holds the scene";
    layOut();
    layOut();
    EXPECT_FALSE(mPanel->flat());
    EXPECT_EQ(mScene->made, 1) << "what failed is not tried again by itself";
}

}  // namespace
}  // namespace stereonav
