// Keys, gamepad and 3-D mouse of the window, and of the panels' own, as actions and as a wish to fly; and
// what panels ask for, which is done once they are drawn: it may open or close what is being drawn.
#pragma once

#include <utility>
#include <vector>

#include "app/view/input.h"
#include "engine/display/space_mouse.h"
#include "engine/display/window.h"

namespace stereonav {

class ControlWindow;

// Actions that panels ask for.
class AskedActions {
public:
    void ask(const ViewAction& action) { mActions.push_back(action); }
    bool any() const { return !mActions.empty(); }
    std::vector<ViewAction> take() { return std::exchange(mActions, {}); }

private:
    std::vector<ViewAction> mActions;
};

class WindowInput {
public:
    explicit WindowInput(Window& window) : mWindow(window) {}  // outlives this

    AskedActions& panels() { return mPanels; }
    const AskedActions& panels() const { return mPanels; }
    // What was asked for since the last turn. controls: the panels' own window, null for none. dt: seconds.
    std::vector<ViewAction> take(ControlWindow* controls, double dt);
    FlightInput flight(const ControlWindow* controls) const;
    // Something is pushed, or a gamepad is there to be looked at.
    bool active() const;

private:
    Window& mWindow;
    ViewInput mInput;
    SpaceMouse mSpaceMouse;
    AskedActions mPanels;
};

}  // namespace stereonav
