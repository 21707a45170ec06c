// Slices are drawn again only where something changed: whatever was shown before, they are those of a panel
// that is shown for the first time.
#include "app/view/panel/slices_panel.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>
#include <memory>

#include "engine/base/error.h"
#include "engine/display/interface.h"
#include "engine/nav/navigator.h"
#include "tests/view/fake_frames.h"

namespace stereonav {
namespace {

constexpr int kSlicesAcross = 200, kSlicesDown = 560;  // size of the window, pixels

VolumeFrame slicedFrame() {
    VolumeFrame frame;
    frame.size = {24, 20, 16};
    frame.spacing = glm::dvec3(0.002);
    return frame;
}

std::shared_ptr<SliceStudy> sliced(int step) {
    auto study = std::make_shared<SliceStudy>();
    study->grey = GreyVolume(slicedFrame());
    const glm::ivec3 size = study->grey.frame.size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                study->grey.at(i, j, k) = static_cast<std::int16_t>(step * (i + 2 * j + 3 * k) - 700);
    return study;
}

// A ball whose lumen is outlined.
class Sliced final : public Scene, SliceSource {
public:
    explicit Sliced(double radius) : mLumen(slicedFrame()) {
        lens.verticalFov = 0.8;
        stereo = {0.001, 0.03};
        const glm::ivec3 size = mLumen.frame.size;
        for (int k = 0; k < size.z; ++k)
            for (int j = 0; j < size.y; ++j)
                for (int i = 0; i < size.x; ++i)
                    mLumen.at(i, j, k) = std::hypot(i - 12.0, j - 10.0, k - 8.0) < radius;
        offer<SliceSource>(*this);
    }
    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override {
        return std::make_unique<Navigator>([](const glm::dvec2&) { return -100.0; },
                                           Pose{{0.024, 0.02, 0.016}}, FlightSetting{});
    }
    std::shared_ptr<const SliceStudy> readSlices(Progress&) const override { return nullptr; }
    const MaskVolume* lumen() const override { return &mLumen; }
    const std::vector<glm::dvec3>& seeds() const override { return mSeeds; }
    const PieceChoices& pieceChoices() const override { return mChoices; }

private:
    mutable FakeFrames mFrames;
    MaskVolume mLumen;
    std::vector<glm::dvec3> mSeeds;
    PieceChoices mChoices;
};

std::shared_ptr<const OpenScene> openSliced(double radius) {
    return std::make_shared<OpenScene>(OpenScene{std::make_shared<Sliced>(radius), {}, {}, 0, false});
}

class SlicesPanelTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            mWindow = std::make_unique<Window>("test", kSlicesAcross, kSlicesDown, false);
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        mInterface = std::make_unique<Interface>(*mWindow);
        mPanel = std::make_unique<SlicesPanel>();
        mSession.slices().keepStudy(sliced(9));
    }
    void TearDown() override {
        mPanel.reset();
        mInterface.reset();
    }
    // Twice, since a window of the interface takes its size with the second frame.
    std::vector<unsigned char> drawnBy(SlicesPanel& panel) {
        for (int n = 0; n < 2; ++n)
            mInterface->layOut({}, 0.02, [&] {
                ImGui::SetNextWindowPos({0, 0});
                ImGui::SetNextWindowSize({static_cast<float>(mWidth), static_cast<float>(kSlicesDown)});
                ImGui::Begin("slices", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
                panel.draw(mSession, mStudy, mInstruments);
                ImGui::End();
            });
        glViewport(0, 0, kSlicesAcross, kSlicesDown);
        glDisable(GL_SCISSOR_TEST);
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        mInterface->render();
        std::vector<unsigned char> pixels(std::size_t{kSlicesAcross} * kSlicesDown * 3);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, kSlicesAcross, kSlicesDown, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
        return pixels;
    }
    // What a panel shows that showed other things before; `place`: that it was set to.
    void expectAsShownFirst(const std::string& what, const std::optional<glm::dvec3>& place = std::nullopt) {
        if (place) mPanel->show(*place);
        const std::vector<unsigned char> now = drawnBy(*mPanel);
        EXPECT_NE(now, mBefore) << what << " changes nothing";
        SlicesPanel fresh;
        if (place) fresh.show(*place);
        EXPECT_EQ(now, drawnBy(fresh)) << what;
        mBefore = now;
    }

    ViewSession mSession{openSliced(5), {}};
    std::optional<ViewSession> mNone;
    StudyReading mStudy{[] {}};
    Instruments mInstruments{mNone, mStudy, [] {}};
    std::unique_ptr<Window> mWindow;
    std::unique_ptr<Interface> mInterface;
    std::unique_ptr<SlicesPanel> mPanel;
    int mWidth = kSlicesAcross;
    std::vector<unsigned char> mBefore;
};

TEST_F(SlicesPanelTest, ShowsWhatIsThereNow) {
    expectAsShownFirst("the first picture");
    mSession.replaceScene(openSliced(7));
    expectAsShownFirst("another lumen");
    Pose pose = mSession.pose();
    pose.position.x += 0.006;
    mSession.goTo(pose);
    expectAsShownFirst("another place of the eye");
    mSession.slices().keepStudy(sliced(13));
    expectAsShownFirst("another study");
    mWidth -= 40;
    expectAsShownFirst("another width");
    expectAsShownFirst("slices that do not follow the eye", mSession.pose().position);
    expectAsShownFirst("another place of the slices", mSession.pose().position + glm::dvec3(0, 0.004, 0.004));
}

}  // namespace
}  // namespace stereonav
