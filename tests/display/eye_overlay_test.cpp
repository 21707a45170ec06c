// What lies over the picture in depth: each eye's part of the window shows it at that eye's place, in every
// layout, and nothing is drawn again where nothing changed.
#include "engine/display/eye_overlay.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <memory>
#include <vector>

#include "engine/base/error.h"
#include "engine/display/interface.h"
#include "engine/display/stereo_presenter.h"
#include "engine/display/window.h"

namespace stereonav {
namespace {

constexpr int kAcross = 320, kDown = 200;

class EyeOverlayTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            mWindow = std::make_unique<Window>("test", kAcross, kDown, false);
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        mInterface = std::make_unique<Interface>(*mWindow);
        mInterface->layOut({}, 0.02, [] {});
        mPresenter = std::make_unique<StereoPresenter>();
        mOverlay = std::make_unique<EyeOverlay>();
    }
    void TearDown() override {
        mOverlay.reset();
        mPresenter.reset();
        mInterface.reset();
    }

    // Two dark eyes of this size with the marks over them.
    void draw(const ComposeSetting& setting, int width, int height, const std::vector<OverlayMark>& marks) {
        const Plane<PackedColor> eye(width, height);
        mPresenter->upload(eye, eye);
        mOverlay->draw(*mInterface, {width, height}, marks);
        mPresenter->setLayers(mOverlay->layers());
        glDisable(GL_SCISSOR_TEST);
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        mPresenter->draw(setting, {0, 0, kAcross, kDown});
        mPixels.resize(std::size_t{kAcross} * kDown * 3);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, kAcross, kDown, GL_RGB, GL_UNSIGNED_BYTE, mPixels.data());
    }
    int byteAt(int x, int y, int channel) const {
        return mPixels[3 * (std::size_t(kDown - 1 - y) * kAcross + std::size_t(x)) + std::size_t(channel)];
    }
    // The middle of what is bright between two columns, of a channel; -1 where all is dark.
    double brightMiddle(int from, int to, int channel = 1) const {
        double sum = 0, weight = 0;
        for (int y = 0; y < kDown; ++y)
            for (int x = from; x < to; ++x) {
                sum += (x + 0.5) * byteAt(x, y, channel);
                weight += byteAt(x, y, channel);
            }
        return weight > 0 ? sum / weight : -1;
    }

    std::unique_ptr<Window> mWindow;
    std::unique_ptr<Interface> mInterface;
    std::unique_ptr<StereoPresenter> mPresenter;
    std::unique_ptr<EyeOverlay> mOverlay;
    std::vector<unsigned char> mPixels;
};

OverlayMark labelAt(float left, float right, float y) {
    return {{left, y}, {right, y}, "i", {-2, -20}};
}

TEST_F(EyeOverlayTest, EachHalfShowsItAtItsEyesPlace) {
    const ComposeSetting beside{OutputMode::SideBySide, false, false};
    const double own = [&] {
        draw(beside, kAcross / 2, kDown, {labelAt(80, 80, 100)});
        return brightMiddle(0, kAcross / 2) - 80;
    }();
    draw(beside, kAcross / 2, kDown, {labelAt(60, 52, 100)});
    EXPECT_NEAR(brightMiddle(0, kAcross / 2), 60 + own, 0.1);
    EXPECT_NEAR(brightMiddle(kAcross / 2, kAcross), kAcross / 2 + 52 + own, 0.1);
    draw({OutputMode::SideBySide, true, false}, kAcross / 2, kDown, {labelAt(60, 52, 100)});
    EXPECT_NEAR(brightMiddle(0, kAcross / 2), 52 + own, 0.1) << "eyes are swapped";
    draw({OutputMode::SideBySideHalf, false, false}, kAcross, kDown, {labelAt(120, 104, 100)});
    EXPECT_NEAR(brightMiddle(0, kAcross / 2), 60 + own / 2, 0.6);
    EXPECT_NEAR(brightMiddle(kAcross / 2, kAcross), kAcross / 2 + 52 + own / 2, 0.6);
    // A row lies where it is, not upside down.
    draw(beside, kAcross / 2, kDown, {labelAt(60, 52, 150)});
    EXPECT_GT(byteAt(60, 150, 1), 200);
    EXPECT_LT(byteAt(60, kDown - 1 - 150, 1), 50);
}

TEST_F(EyeOverlayTest, ColouredGlassesAndRowsSeparateIt) {
    const std::vector<OverlayMark> marks{labelAt(100, 140, 100)};
    draw({OutputMode::RedCyanColor, false, false}, kAcross, kDown, marks);
    EXPECT_GT(byteAt(100, 100, 0), 200);
    EXPECT_LT(byteAt(100, 100, 1), 50) << "the right eye's";
    EXPECT_LT(byteAt(140, 100, 0), 50);
    EXPECT_GT(byteAt(140, 100, 1), 200);
    draw({OutputMode::Rows, false, false}, kAcross, kDown, marks);
    EXPECT_GT(byteAt(100, 100, 1), 200);
    EXPECT_LT(byteAt(100, 101, 1), 50) << "the right eye's row";
    EXPECT_GT(byteAt(140, 101, 1), 200);
}

TEST_F(EyeOverlayTest, NothingIsDrawnAgainWhereNothingChanged) {
    EXPECT_FALSE(mOverlay->draw(*mInterface, {160, 200}, {}));
    EXPECT_FALSE(mOverlay->layers()) << "nothing is there, and costs nothing";
    const std::vector<OverlayMark> marks{labelAt(60, 52, 100), {{20, 20}, {22, 20}, "", {}}};
    EXPECT_TRUE(mOverlay->draw(*mInterface, {160, 200}, marks));
    EXPECT_FALSE(mOverlay->draw(*mInterface, {160, 200}, marks));
    EXPECT_TRUE(mOverlay->draw(*mInterface, {170, 200}, marks)) << "another size";
    EXPECT_TRUE(mOverlay->layers());
    EXPECT_TRUE(mOverlay->draw(*mInterface, {170, 200}, {}));
    EXPECT_FALSE(mOverlay->layers());
    EXPECT_FALSE(mOverlay->draw(*mInterface, {170, 200}, {}));
}

TEST_F(EyeOverlayTest, ThePointerOverThePictureIsNotTheInterfaces) {
    mInterface->setPointerOfPicture(true);
    mInterface->pointerAt({0.5, 0.5});
    const InterfacePlaces beside{{{0, 0, 0.5f, 1}, {0.5f, 0, 0.5f, 1}}, {0.5f, 1}};
    const auto drawsIt = [&] {
        mInterface->layOut(beside, 0.02, [] {
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({40, 40});
            ImGui::Begin("box", nullptr, ImGuiWindowFlags_NoDecoration);
            ImGui::End();
        });
        return ImGui::GetIO().MouseDrawCursor;
    };
    drawsIt();
    EXPECT_FALSE(drawsIt());
    mInterface->pointerAt({0.05, 0.1});
    drawsIt();
    EXPECT_TRUE(drawsIt()) << "over a box";
    mInterface->setPointerOfPicture(false);
    mInterface->pointerAt({0.3, 0.5});
    drawsIt();
    EXPECT_TRUE(drawsIt());
}

}  // namespace
}  // namespace stereonav
