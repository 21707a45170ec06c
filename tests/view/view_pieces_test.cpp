// Pieces of gas in the slices of a study: shown by colour, taken and left by clicks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/view/session.h"
#include "engine/nav/navigator.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

// Two pieces of gas and a pool; the lumen holds only the first piece.
class ViewPieces : public testing::Test {
protected:
    ViewPieces() : mStudy(studyOf()), mLumen(mStudy->grey.frame) {
        mScene->makeFlight = [] {
            return std::make_unique<Navigator>([](const glm::dvec2&) { return -100.0; },
                                               Pose{{0.02, 0.03, 0.04}}, FlightSetting{});
        };
        mScene->frames = &mFrames;
        mScene->way.method = mFrames.defaultMethod();
        fill({10, 10, 30}, -1000);
        fill({24, 31, 30}, -1000);
        fill({10, 40, 30}, 400);
        for (int k = 30; k < 50; ++k)
            for (int j = 10; j < 14; ++j)
                for (int i = 10; i < 14; ++i) mLumen.at(i, j, k) = 1;
        mStudy->pieces.runs = runsBelow(mStudy->grey, -700);
        mStudy->pieces.fluidAbove = 200;
        mStudy->pieces.parts = connectedComponents(mStudy->pieces.runs);
        mStudy->pieces.list = {{{0.011, 0.011, 0.040}, "0.3 ml of gas", true},
                               {{0.025, 0.032, 0.040}, "0.3 ml of gas: by itself", false}};
        mScene->readSlices = [this](Progress&) { return mStudy; };
        mScene->lumen = &mLumen;
    }
    void fill(const glm::ivec3& first, std::int16_t value) {
        for (int k = 0; k < 20; ++k)
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) mStudy->grey.at(first + glm::ivec3(i, j, k)) = value;
    }
    // 50 mm fill 400 pixels; the middle of the picture is the middle of the study.
    static void clickVoxel(ViewSession& s, double i, double j) {
        s.slices().click(200 + 8 * (i - 19.5), 200 + 8 * (j - 24.5));
    }
    static PackedColor colorAt(ViewSession& s, double i, double j) {
        const auto& picture = s.slices().picture(400, 400);
        return picture.at(static_cast<int>(200 + 8 * (i - 19.5)), static_cast<int>(200 + 8 * (j - 24.5)));
    }

    ViewSession session() {
        return ViewSession(opened(*mScene), {OutputMode::SideBySide, std::nullopt, testing::TempDir()});
    }
    // Opens the slice view.
    void openSlices(ViewSession& s) {
        s.act({ViewCommand::Slices});
        s.slices().show(mStudy);
        s.slices().picture(400, 400);
    }

    static std::shared_ptr<SliceStudy> studyOf() {
        auto study = std::make_shared<SliceStudy>();
        VolumeFrame frame;
        frame.size = {40, 50, 60};
        frame.spacing = glm::dvec3(0.001);
        study->grey = GreyVolume(frame);
        return study;
    }

    FakeFrames mFrames;
    std::shared_ptr<FakeParts> mScene = std::make_shared<FakeParts>();
    std::shared_ptr<SliceStudy> mStudy;
    MaskVolume mLumen;
};

TEST_F(ViewPieces, AClickTakesOrLeavesThePieceUnderIt) {
    ViewSession s = session();
    openSlices(s);
    const PackedColor taken = colorAt(s, 11.3, 11.3), left = colorAt(s, 25.3, 32.3);
    EXPECT_NE(taken, left);
    EXPECT_GT(unpackColor(taken).g, 2 * unpackColor(taken).r) << "green";
    EXPECT_GT(unpackColor(left).r, 5 * unpackColor(left).b) << "not sure: amber";
    clickVoxel(s, 11, 11);
    EXPECT_THAT(s.notice(), testing::HasSubstr("--exclude 11.0,11.0,40.0 leaves out 0.3 ml of gas"));
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("1 change "));
    EXPECT_GT(unpackColor(colorAt(s, 11.3, 11.3)).b, 2 * unpackColor(colorAt(s, 11.3, 11.3)).r) << "blue";
    clickVoxel(s, 25, 32);
    EXPECT_THAT(s.notice(), testing::HasSubstr("--include 25.0,32.0,40.0 takes 0.3 ml of gas: by itself"));
    EXPECT_EQ(colorAt(s, 25.3, 32.3), taken);
    clickVoxel(s, 11, 42);
    EXPECT_THAT(s.notice(), testing::HasSubstr("--include 11.0,42.0,40.0 takes tagged fluid (value 400)"));
    clickVoxel(s, 30, 20);
    EXPECT_THAT(s.notice(), testing::HasSubstr("value 0 at 30.0,20.0,40.0: click in gas"));
    s.slices().click(2, 200);
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("3 changes")) << "beside the study, and in tissue";
    s.act({ViewCommand::Back});
    EXPECT_FALSE(s.slices().shown());
    s.act({ViewCommand::Slices});
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("3 changes")) << "Esc does not take them away";
    s.act({ViewCommand::FindAgain});
    auto change = s.surface().takeChange();
    ASSERT_TRUE(change.has_value() && change->pieces.has_value());
    ASSERT_EQ(change->pieces->include.size(), 2u);
    ASSERT_EQ(change->pieces->exclude.size(), 1u);
    EXPECT_NEAR(glm::length(change->pieces->exclude[0] - glm::dvec3(0.011, 0.011, 0.040)), 0, 1e-9);
    EXPECT_NEAR(glm::length(change->pieces->include[0] - glm::dvec3(0.025, 0.032, 0.040)), 0, 1e-9);
}

TEST_F(ViewPieces, ASecondClickOrBackspaceTakesAChoiceBack) {
    ViewSession s = session();
    openSlices(s);
    clickVoxel(s, 10, 10);
    clickVoxel(s, 12, 12);
    EXPECT_THAT(s.notice(), testing::HasSubstr("as it was found: 0.3 ml of gas"));
    EXPECT_THAT(s.slices().status(), testing::HasSubstr("0 changes"));
    clickVoxel(s, 11, 42);
    for (int n = 0; n < 3; ++n) s.act({ViewCommand::RemoveSeed});
    s.act({ViewCommand::FindAgain});
    const auto change = s.surface().takeChange();
    ASSERT_TRUE(change.has_value() && change->pieces.has_value());
    EXPECT_TRUE(change->pieces->empty());
}

}  // namespace
}  // namespace stereonav
