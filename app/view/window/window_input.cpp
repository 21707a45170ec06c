#include "app/view/window/window_input.h"

#include "app/view/window/control_window.h"

namespace stereonav {

std::vector<ViewAction> WindowInput::take(ControlWindow* controls, double dt) {
    std::vector<ViewAction> actions = mPanels.take();
    const Gamepad pad = mWindow.gamepad();
    const auto takeKeys = [&](Window& window) {
        for (const KeyPress& key : window.takeKeys())
            if (const auto action = actionOf(key)) actions.push_back(*action);
    };
    takeKeys(mWindow);
    if (controls) takeKeys(controls->window());
    for (const ViewAction& action : mInput.actionsOf(pad, dt)) actions.push_back(action);
    mSpaceMouse.look();
    for (const ViewAction& action : actionsOfSpaceMouse(mSpaceMouse.takePresses())) actions.push_back(action);
    return actions;
}

FlightInput WindowInput::flight(const ControlWindow* controls) const {
    return withSpaceMouse(
        mInput.flightOf(mWindow, controls ? &controls->window() : nullptr, mWindow.gamepad()),
        mSpaceMouse.state());
}

bool WindowInput::active() const {
    return mWindow.gamepad().present || mSpaceMouse.state().moved();
}

}  // namespace stereonav
