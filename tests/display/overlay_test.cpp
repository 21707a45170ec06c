// Text over the picture: panels that are hidden cost nothing, those that are shown are laid out once an area.
#include "engine/display/overlay.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include "engine/base/error.h"
#include "engine/display/window.h"

namespace stereonav {
namespace {

const std::vector<OverlayArea> kTwoAreas{{0, 0, 0.5f, 1}, {0.5f, 0, 0.5f, 1}};

class OverlayTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            mWindow = std::make_unique<Window>("test", 320, 200, false);
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        mOverlay = std::make_unique<Overlay>(*mWindow);
    }

    // Frames of Dear ImGui that are laid out, and triangles' corners in the last of them.
    int framesOf(const OverlayContent& content) const {
        const int before = ImGui::GetFrameCount();
        mOverlay->draw(content, kTwoAreas);
        return ImGui::GetFrameCount() - before;
    }

    std::unique_ptr<Window> mWindow;
    std::unique_ptr<Overlay> mOverlay;
};

TEST_F(OverlayTest, NothingIsLaidOutWhereAllIsHidden) {
    for (int n = 0; n < 3; ++n) EXPECT_EQ(framesOf({}), 0);
    OverlayContent status;
    status.status = "12 ms";
    EXPECT_GT(framesOf(status), 0);
    EXPECT_EQ(framesOf({}), 0);
}

TEST_F(OverlayTest, APanelThatIsHiddenAddsNoTriangle) {
    const auto corners = [&](const OverlayContent& content) {
        for (int n = 0; n < 2; ++n) framesOf(content);
        return ImGui::GetDrawData()->TotalVtxCount;
    };
    OverlayContent status, help;
    status.status = help.status = "12 ms";
    help.help = {{"H", "this"}, {"Q", "quits"}};
    const int alone = corners(status);
    EXPECT_GT(alone, 0);
    EXPECT_GT(corners(help), alone);
    EXPECT_EQ(corners(status), alone);
}

}  // namespace
}  // namespace stereonav
