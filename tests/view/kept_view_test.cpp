// The view of a scene is there again as it was left: place, mode, and eyes that were set by hand.
#include "app/view/kept_view.h"

#include <gmock/gmock.h>

#include "tests/view/session_fixture.h"

namespace stereonav {
namespace {

constexpr ShownMode kAnaglyph{OutputMode::RedCyanDubois, true}, kOneEye{OutputMode::TopBottom, false};

class KeptViewTest : public SessionFixture {
protected:
    KeptView view(const std::string& scene = "hills.tif") const { return KeptView(scene, mFolder / "views"); }
};

TEST_F(KeptViewTest, NothingIsThereAtFirst) {
    ViewSession s = session();
    EXPECT_EQ(view().mode(), std::nullopt);
    EXPECT_FALSE(view().restore(s));
    EXPECT_EQ(s.pose().position, kStart.position);
}

TEST_F(KeptViewTest, PlaceAndModeAreThereAgain) {
    const Pose there = poseFromAngles({120, -40, 700}, 1, -0.3, 0);
    ViewSession s = session();
    s.goTo(there);
    view().keep(s, kAnaglyph);
    ViewSession next = session();
    EXPECT_TRUE(view().restore(next));
    EXPECT_LT(glm::length(next.pose().position - there.position), 1e-9);
    EXPECT_LT(glm::length(next.pose().orientation - there.orientation), 1e-9);
    EXPECT_EQ(view().mode(), kAnaglyph);
    EXPECT_EQ(view("other.tif").mode(), std::nullopt) << "of each file";
    next.act({ViewCommand::Home});
    EXPECT_EQ(next.pose().position, kStart.position) << "the start is where it was";

    view().keep(next, kOneEye);
    EXPECT_EQ(view().mode(), kOneEye) << "with the mode that key 3 goes to";
    EXPECT_FALSE(view().restore(next)) << "it is there";
    view().keep(next, std::nullopt);
    EXPECT_EQ(view().mode(), kOneEye) << "a mode of the command line is not kept";
}

TEST_F(KeptViewTest, OnlyEyesSetByHandAreKept) {
    ViewSession s = session();
    s.goTo(poseFromAngles({120, -40, 700}, 1, -0.3, 0));
    view().keep(s, kAnaglyph);
    ViewSession next = session();
    view().restore(next);
    EXPECT_EQ(next.eyesWanted(), next.eyes().begun(*next.open().scene));
    s.setEyes({7, 300});
    view().keep(s, kAnaglyph);
    view().restore(next);
    EXPECT_EQ(next.eyesWanted().separation, 7);
    EXPECT_EQ(next.eyesWanted().zeroParallax, 300);
}

TEST_F(KeptViewTest, WithoutAFolderNothingIsKeptOrFails) {
    ViewSession s = session();
    KeptView none("hills.tif", "");
    none.keep(s, kAnaglyph);
    EXPECT_EQ(KeptView("hills.tif", "").mode(), std::nullopt);
}

}  // namespace
}  // namespace stereonav
