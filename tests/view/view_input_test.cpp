// Keys and gamepad buttons have the meaning that help gives them.
#include <gmock/gmock.h>

#include "app/view/input.h"
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <optional>
#include <set>
#include <tuple>

namespace stereonav {
namespace {

std::optional<ViewCommand> commandOf(const KeyPress& press) {
    const auto action = actionOf(press);
    return action ? std::optional(action->command) : std::nullopt;
}

TEST(ViewKeys, LettersFollowTheUsersLayout) {
    EXPECT_EQ(commandOf({GLFW_KEY_Z, 'z', false, false}), ViewCommand::Record);
    EXPECT_EQ(commandOf({GLFW_KEY_Z, 'z', true, false}), ViewCommand::Play);
    // A German keyboard has z where a US one has y.
    EXPECT_EQ(commandOf({GLFW_KEY_Y, 'z', false, false}), ViewCommand::Record);
    EXPECT_EQ(commandOf({GLFW_KEY_Z, 'y', false, false}), ViewCommand::CaptureMouse);
    EXPECT_EQ(commandOf({GLFW_KEY_M, 'm', false, false}), ViewCommand::NextMode);
    EXPECT_EQ(commandOf({GLFW_KEY_M, 'm', true, false}), ViewCommand::PreviousMode);
    EXPECT_EQ(commandOf({GLFW_KEY_X, 'x', false, false}), ViewCommand::SwapEyes);
    EXPECT_EQ(commandOf({GLFW_KEY_F, 'f', false, false}), ViewCommand::NextFlightMode);
    EXPECT_EQ(commandOf({GLFW_KEY_F, 'f', true, false}), ViewCommand::SpeedByDistance);
    EXPECT_EQ(commandOf({GLFW_KEY_R, 'r', false, false}), ViewCommand::Reset);
    EXPECT_EQ(commandOf({GLFW_KEY_P, 'p', false, false}), ViewCommand::Screenshot);
}

TEST(ViewKeys, KeysWithoutLetters) {
    EXPECT_EQ(commandOf({GLFW_KEY_ESCAPE, 0, false, false}), ViewCommand::Back) << "Esc never quits";
    EXPECT_EQ(commandOf({GLFW_KEY_F1, 0, false, false}), ViewCommand::Help);
    EXPECT_EQ(commandOf({GLFW_KEY_F12, 0, false, false}), ViewCommand::Screenshot);
    EXPECT_EQ(commandOf({GLFW_KEY_SPACE, ' ', false, false}), ViewCommand::Home);
    EXPECT_EQ(commandOf({GLFW_KEY_3, '3', false, false}), ViewCommand::ToggleStereo);
    EXPECT_EQ(commandOf({GLFW_KEY_F8, 0, false, false}), ViewCommand::NextUnseen);
    EXPECT_EQ(commandOf({GLFW_KEY_F8, 0, true, false}), ViewCommand::PreviousUnseen);
    EXPECT_EQ(commandOf({GLFW_KEY_F9, 0, false, false}), ViewCommand::ToggleCoverage);
    EXPECT_EQ(commandOf({GLFW_KEY_F10, 0, false, false}), ViewCommand::Unfolded);
    EXPECT_EQ(commandOf({GLFW_KEY_F13, 0, false, false}), std::nullopt);
}

TEST(ViewKeys, LookOfVolumes) {
    EXPECT_EQ(commandOf({GLFW_KEY_T, 't', false, false}), ViewCommand::ToggleTranslucent);
    EXPECT_EQ(commandOf({GLFW_KEY_T, 't', true, false}), ViewCommand::NextTransfer);
    EXPECT_EQ(commandOf({GLFW_KEY_O, 'o', false, false}), ViewCommand::NextAmbient);
    EXPECT_EQ(commandOf({GLFW_KEY_O, 'o', true, false}), ViewCommand::PreviousAmbient);
    EXPECT_EQ(commandOf({GLFW_KEY_B, 'b', false, false}), ViewCommand::NextModulation);
    for (const bool repeat : {false, true}) {
        EXPECT_EQ(commandOf({GLFW_KEY_MINUS, '-', false, repeat}), ViewCommand::SmallerRadius);
        EXPECT_EQ(commandOf({GLFW_KEY_EQUAL, '=', false, repeat}), ViewCommand::LargerRadius);
        EXPECT_EQ(commandOf({GLFW_KEY_G, 'g', false, repeat}), ViewCommand::MoreSigma);
        EXPECT_EQ(commandOf({GLFW_KEY_G, 'g', true, repeat}), ViewCommand::LessSigma);
    }
}

TEST(ViewKeys, OnlyMattersOfDegreeRepeat) {
    for (const auto& [key, letter, command] :
         {std::tuple{GLFW_KEY_LEFT_BRACKET, '[', ViewCommand::LessSeparation},
          std::tuple{GLFW_KEY_RIGHT_BRACKET, ']', ViewCommand::MoreSeparation},
          std::tuple{GLFW_KEY_SEMICOLON, ';', ViewCommand::NearerZeroParallax},
          std::tuple{GLFW_KEY_APOSTROPHE, '\'', ViewCommand::FartherZeroParallax}}) {
        EXPECT_EQ(commandOf({key, letter, false, false}), command);
        EXPECT_EQ(commandOf({key, letter, false, true}), command);
        // A layout without that sign has something else there, outside ASCII.
        EXPECT_EQ(commandOf({key, 0, false, false}), command);
    }
    EXPECT_EQ(commandOf({GLFW_KEY_Z, 'z', false, true}), std::nullopt);
    EXPECT_EQ(commandOf({GLFW_KEY_3, '3', false, true}), std::nullopt);
    EXPECT_EQ(commandOf({GLFW_KEY_ESCAPE, 0, false, true}), std::nullopt);
}

TEST(ViewKeys, F11IsTheWholeScreen) {
    EXPECT_EQ(commandOf({GLFW_KEY_F11, 0, false, false}), ViewCommand::FullScreen);
    EXPECT_EQ(commandOf({GLFW_KEY_F11, 0, false, true}), std::nullopt) << "held, it would flicker";
}

TEST(ViewKeys, DigitsChooseDifferentModes) {
    std::set<OutputMode> seen;
    for (int key = GLFW_KEY_0; key <= GLFW_KEY_9; ++key) {
        const auto action = actionOf({key, static_cast<char>(key), false, false});
        ASSERT_TRUE(action.has_value());
        if (key == GLFW_KEY_3) continue;
        EXPECT_EQ(action->command, ViewCommand::SetMode);
        seen.insert(action->mode);
    }
    EXPECT_EQ(seen.size(), 9u);
}

TEST(ViewKeys, GamepadButtonsActOnceAPress) {
    ViewInput input;
    Gamepad pad;
    pad.present = true;
    EXPECT_TRUE(input.actionsOf(pad, 0.01).empty());
    pad.b = pad.rightBumper = true;
    const auto actions = input.actionsOf(pad, 0.01);
    ASSERT_EQ(actions.size(), 2u);
    EXPECT_EQ(actions[0].command, ViewCommand::SwapEyes);
    EXPECT_EQ(actions[1].command, ViewCommand::MoreSeparation);
    EXPECT_TRUE(input.actionsOf(pad, 0.01).empty()) << "held, not pressed again";
    pad.b = false;
    EXPECT_TRUE(input.actionsOf(pad, 0.01).empty());
    pad.b = true;
    EXPECT_EQ(input.actionsOf(pad, 0.01).size(), 1u);
}

TEST(ViewKeys, TheCrossTurnsLightWhileItIsHeld) {
    const std::pair<bool Gamepad::*, ViewCommand> ways[] = {{&Gamepad::up, ViewCommand::HigherSun},
                                                            {&Gamepad::down, ViewCommand::LowerSun},
                                                            {&Gamepad::left, ViewCommand::SunAnticlockwise},
                                                            {&Gamepad::right, ViewCommand::SunClockwise}};
    for (const auto& [way, command] : ways) {
        ViewInput input;
        Gamepad pad;
        pad.present = pad.*way = true;
        int done = 0;
        for (int n = 0; n < 100; ++n)
            for (const ViewAction& action : input.actionsOf(pad, 0.01)) {
                ASSERT_EQ(action.command, command);
                ++done;
            }
        EXPECT_NEAR(done, 20, 1) << "every 50 ms of a second";
        pad.*way = false;
        EXPECT_TRUE(input.actionsOf(pad, 0.01).empty());
        pad.*way = true;
        EXPECT_EQ(input.actionsOf(pad, 0.0).size(), 1u) << "a press counts at once";
        EXPECT_TRUE(input.actionsOf(pad, 0.0).empty()) << "and once";
    }
}

}  // namespace
}  // namespace stereonav
