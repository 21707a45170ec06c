// The interface over the picture: drawn once for each eye's part, felt in each part alike, at rest when
// nothing changes.
#include "engine/display/interface.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/display/interface_font.h"

namespace stereonav {
namespace {

constexpr int kWidth = 320, kHeight = 200;

class InterfaceTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            mWindow = std::make_unique<Window>("test", kWidth, kHeight, false);
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
        mInterface = std::make_unique<Interface>(*mWindow);
    }

    // A box from (20, 20) to (120, 100) with a button in it.
    bool layOut(const InterfacePlaces& places) {
        return mInterface->layOut(places, 0.02, [&] {
            ImGui::SetNextWindowPos({20, 20});
            ImGui::SetNextWindowSize({100, 80});
            ImGui::Begin("box", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
            mClicks += ImGui::Button("press", {80, 40});
            ImGui::InputText("##text", mText, sizeof mText);
            ImGui::End();
        });
    }
    void click(double x, double y) {
        mInterface->pointerAt({x / kWidth, y / kHeight});
        mTaken = mInterface->takesButton(0, true);
        mInterface->takesButton(0, false);
    }
    // Red, green, blue of the framebuffer, from the top left.
    std::vector<unsigned char> drawn(const std::optional<InterfaceOpening>& opening = std::nullopt) {
        glViewport(0, 0, kWidth, kHeight);
        glDisable(GL_SCISSOR_TEST);
        glClearColor(1, 0, 1, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        mInterface->render(opening);
        std::vector<unsigned char> pixels(std::size_t{kWidth} * kHeight * 3);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, kWidth, kHeight, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
        return pixels;
    }
    static bool covered(const std::vector<unsigned char>& pixels, int x, int y) {
        const std::size_t at = 3 * (std::size_t(kHeight - 1 - y) * kWidth + std::size_t(x));
        return pixels[at] != 255 || pixels[at + 1] != 0 || pixels[at + 2] != 255;
    }

    std::unique_ptr<Window> mWindow;
    std::unique_ptr<Interface> mInterface;
    int mClicks = 0;
    bool mTaken = false;
    char mText[32] = "";
};

const InterfacePlaces kWhole, kBeside{{{0, 0, 0.5f, 1}, {0.5f, 0, 0.5f, 1}}, {0.5f, 1}},
    kSqueezed{{{0, 0, 0.5f, 1}, {0.5f, 0, 0.5f, 1}}, {1, 1}};

TEST_F(InterfaceTest, NothingIsNewWhereNothingChanged) {
    layOut(kWhole);
    layOut(kWhole);
    for (int n = 0; n < 3; ++n) EXPECT_FALSE(layOut(kWhole));
    mInterface->pointerAt({60.0 / kWidth, 50.0 / kHeight});
    EXPECT_TRUE(layOut(kWhole)) << "the button lights up";
    EXPECT_FALSE(layOut(kWhole));
}

TEST_F(InterfaceTest, IsDrawnForEachEye) {
    layOut(kBeside);
    auto pixels = drawn();
    for (const int left : {0, kWidth / 2}) {
        EXPECT_TRUE(covered(pixels, left + 25, 25));
        EXPECT_TRUE(covered(pixels, left + 115, 95));
        EXPECT_FALSE(covered(pixels, left + 10, 50));
        EXPECT_FALSE(covered(pixels, left + 130, 50));
    }
    layOut(kSqueezed);
    pixels = drawn();
    for (const int left : {0, kWidth / 2}) {
        EXPECT_TRUE(covered(pixels, left + 12, 25));
        EXPECT_TRUE(covered(pixels, left + 58, 95));
        EXPECT_FALSE(covered(pixels, left + 5, 50));
        EXPECT_FALSE(covered(pixels, left + 65, 50));
    }
}

// Columns beside an opening from x = 130 on, and a box that lies over its border.
TEST_F(InterfaceTest, WhatStaysBesideThePictureIsCopied) {
    int column = 0, figures = 0;
    bool bridge = false;
    const auto layOutColumns = [&](const InterfacePlaces& places) {
        constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings;
        mInterface->layOut(places, 0.02, [&] {
            const float width = ImGui::GetIO().DisplaySize.x - 30;
            ImGui::SetNextWindowPos({width, 0});
            ImGui::SetNextWindowSize({30, kHeight});
            ImGui::Begin("column", nullptr, kPlain);
            ImGui::Text("%d", column);
            ImGui::End();
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({width + 30, 18});
            ImGui::Begin("bar over both", nullptr, kPlain | ImGuiWindowFlags_NoBringToFrontOnFocus);
            ImGui::End();
            ImGui::SetNextWindowPos({10, 150});
            ImGui::SetNextWindowSize({100, 40});
            ImGui::Begin("figures", nullptr, kPlain);
            ImGui::Text("%d", figures);
            ImGui::End();
            if (!bridge) return;
            ImGui::SetNextWindowPos({width - 20, 50});
            ImGui::SetNextWindowSize({40, 40});
            ImGui::Begin("bridge", nullptr, kPlain | ImGuiWindowFlags_NoFocusOnAppearing);
            ImGui::Text("%d", figures);
            ImGui::End();
        });
    };
    for (const InterfacePlaces& places : {kWhole, kBeside, kSqueezed}) {
        const int part = int(places.areas.front().width * kWidth);
        const int beside = int(30 * part / (places.size.x * kWidth));
        const InterfaceOpening opening{{0, 0}, {part - beside, kHeight}};
        for (int step = 0; step < 6; ++step) {
            if (step % 2) ++figures;
            if (step == 2) ++column;
            bridge = step >= 3 && step < 5;
            layOutColumns(places);
            const auto whole = drawn();  // forgets what was kept
            drawn(opening);
            EXPECT_EQ(drawn(opening), whole) << "copied, step " << step << ", part " << part;
        }
        // What was kept serves while only the figures change.
        drawn(opening);
        for (int step = 0; step < 3; ++step) {
            ++figures;
            layOutColumns(places);
            const auto kept = drawn(opening);
            EXPECT_EQ(kept, drawn()) << part;
            drawn(opening);
        }
        ++column;
        layOutColumns(places);
        const auto renewed = drawn(opening);
        EXPECT_EQ(renewed, drawn()) << "the column changed";
    }
}

TEST_F(InterfaceTest, IsFeltInEachEyesPart) {
    layOut(kBeside);
    for (const int left : {0, kWidth / 2}) {
        const int before = mClicks;
        click(left + 60, 45);
        EXPECT_TRUE(mTaken);
        layOut(kBeside);
        EXPECT_EQ(mClicks, before + 1) << left;
        click(left + 140, 150);
        EXPECT_FALSE(mTaken);
        layOut(kBeside);
        EXPECT_EQ(mClicks, before + 1);
    }
}

TEST_F(InterfaceTest, EventsThatCameTogetherAreAllFelt) {
    layOut(kWhole);
    for (int n = 0; n < 3; ++n) click(60, 45);
    layOut(kWhole);
    EXPECT_EQ(mClicks, 3);
}

TEST_F(InterfaceTest, ATextKeepsItsKeys) {
    layOut(kWhole);
    EXPECT_FALSE(mInterface->takesKey('W', 0, true)) << "keys fly";
    mInterface->takesKey('W', 0, false);
    EXPECT_FALSE(mInterface->takesText('w'));
    click(60, 80);
    layOut(kWhole);
    EXPECT_TRUE(mInterface->holdsKeyboard());
    EXPECT_TRUE(mInterface->takesKey('W', 0, true));
    EXPECT_TRUE(mInterface->takesText('w'));
    layOut(kWhole);
    EXPECT_STREQ(mText, "w");
    EXPECT_FALSE(mInterface->takesKey(GLFW_KEY_Q, GLFW_MOD_CONTROL, true)) << "ends the program all the same";
    mInterface->takesKey(GLFW_KEY_Q, GLFW_MOD_CONTROL, false);
    layOut(kWhole);
    click(200, 150);
    layOut(kWhole);
    EXPECT_FALSE(mInterface->holdsKeyboard()) << "a click beside it ends writing";
}

// Enter ends the writing of a text; the box that it is in keeps the keys.
TEST_F(InterfaceTest, ABoxKeepsEveryKeyUntilItIsClosed) {
    bool open = true;
    const auto layOutBox = [&] {
        mInterface->layOut(kWhole, 0.02, [&] {
            if (!open) return;
            ImGui::Begin("box", nullptr, ImGuiWindowFlags_NoSavedSettings);
            ImGui::CaptureKeyboardFromApp(true);
            ImGui::End();
        });
    };
    layOutBox();
    EXPECT_TRUE(mInterface->holdsKeyboard());
    for (const int key : {GLFW_KEY_W, GLFW_KEY_ENTER, GLFW_KEY_TAB, GLFW_KEY_ESCAPE, GLFW_KEY_F12}) {
        EXPECT_TRUE(mInterface->takesKey(key, 0, true)) << key;
        mInterface->takesKey(key, 0, false);
        layOutBox();
    }
    EXPECT_FALSE(mInterface->takesKey(GLFW_KEY_Q, GLFW_MOD_CONTROL, true)) << "ends the program all the same";
    mInterface->takesKey(GLFW_KEY_Q, GLFW_MOD_CONTROL, false);
    open = false;
    layOutBox();
    EXPECT_FALSE(mInterface->holdsKeyboard());
    EXPECT_FALSE(mInterface->takesKey(GLFW_KEY_W, 0, true));
}

TEST_F(InterfaceTest, EscapeClosesWhatHasPoppedUpAndNoMore) {
    bool opens = true, shown = false;
    const auto layOutMenu = [&] {
        mInterface->layOut(kWhole, 0.02, [&] {
            if (std::exchange(opens, false)) ImGui::OpenPopup("menu");
            shown = ImGui::BeginPopup("menu");
            if (!shown) return;
            ImGui::MenuItem("item");
            ImGui::EndPopup();
        });
    };
    layOutMenu();
    layOutMenu();
    ASSERT_TRUE(shown);
    EXPECT_TRUE(mInterface->takesKey(GLFW_KEY_ESCAPE, 0, true));
    EXPECT_TRUE(mInterface->takesKey(GLFW_KEY_ESCAPE, 0, false));
    layOutMenu();
    EXPECT_FALSE(shown);
    EXPECT_FALSE(mInterface->takesKey(GLFW_KEY_ESCAPE, 0, true)) << "nothing has popped up: the window's";
}

TEST_F(InterfaceTest, ThePictureKnowsItsPointer) {
    layOut(kSqueezed);
    glm::dvec2 place;
    mInterface->pointerAt({0.25, 0.75});
    ASSERT_TRUE(mInterface->pointerOverPicture(place));
    EXPECT_NEAR(place.x, 0.5, 1e-9);
    EXPECT_NEAR(place.y, 0.75, 1e-9);
    mInterface->pointerAt({30.0 / kWidth, 50.0 / kHeight});
    EXPECT_FALSE(mInterface->pointerOverPicture(place)) << "the box lies there";
    mInterface->pointerLeft();
    EXPECT_FALSE(mInterface->pointerOverPicture(place));
}

TEST_F(InterfaceTest, AnotherScaleMakesLargerLetters) {
    const auto width = [&] {
        float units = 0;
        mInterface->layOut(kWhole, 0.02, [&] { units = ImGui::CalcTextSize("0123456789").x; });
        return units;
    };
    InterfaceLook look = mInterface->look();
    look.scale = 1;
    mInterface->setLook(look);
    const float once = width();
    look.scale = 2;
    mInterface->setLook(look);
    EXPECT_NEAR(width(), 2 * once, 0.05 * once);
}

// Contrast by WCAG 2.1, of encoded greys.
double contrast(const ImVec4& a, const ImVec4& b) {
    const auto luminance = [](const ImVec4& c) {
        const auto linear = [](double v) {
            return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        };
        return 0.2126 * linear(c.x) + 0.7152 * linear(c.y) + 0.0722 * linear(c.z);
    };
    const double one = luminance(a) + 0.05, other = luminance(b) + 0.05;
    return std::max(one, other) / std::min(one, other);
}

TEST_F(InterfaceTest, TextCanBeReadInEveryLook) {
    for (const bool dark : {true, false})
        for (const bool grey : {true, false}) {
            const InterfaceLook look{dark, grey, 1};
            mInterface->setLook(look);
            layOut(kWhole);
            const ImVec4* const colors = ImGui::GetStyle().Colors;
            for (const ImGuiCol back : {ImGuiCol_WindowBg, ImGuiCol_FrameBg, ImGuiCol_PopupBg,
                                        ImGuiCol_Button, ImGuiCol_Header, ImGuiCol_MenuBarBg})
                EXPECT_GE(contrast(colors[ImGuiCol_Text], colors[back]), 4.5) << back;
            for (const ImVec4& color : {accentColor(look), warningColor(look), quietColor(look)}) {
                EXPECT_GE(contrast(color, colors[ImGuiCol_WindowBg]), 4.5);
                EXPECT_EQ(color.x == color.y && color.y == color.z, grey || color.x == quietColor(look).x);
            }
        }
}

}  // namespace
}  // namespace stereonav
