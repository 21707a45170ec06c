// Input of the window, and of the panels' own window, from keys, gamepad and 3-D mouse, as actions and as
// flight input; and the actions that panels ask for.
#pragma once

#include <vector>

#include "app/view/asked_actions.h"
#include "app/view/input.h"
#include "engine/display/space_mouse.h"
#include "engine/display/window.h"

namespace stereonav {

class ControlWindow;

class WindowInput {
public:
    explicit WindowInput(Window& window) : mWindow(window) {}  // window must outlive this object

    AskedActions& panels() { return mPanels; }
    const AskedActions& panels() const { return mPanels; }
    // Returns the actions since the last turn. controls: the panels' own window, null for none. dt: seconds.
    std::vector<ViewAction> take(ControlWindow* controls, double dt);
    FlightInput flight(const ControlWindow* controls) const;
    // Returns whether something is pushed, or a gamepad has to be read.
    bool active() const;

private:
    Window& mWindow;
    ViewInput mInput;
    SpaceMouse mSpaceMouse;
    AskedActions mPanels;
};

}  // namespace stereonav
