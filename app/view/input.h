// Keys, mouse and gamepad as flight input and as commands to the session.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/session.h"
#include "engine/display/space_mouse.h"
#include "engine/display/window.h"

namespace stereonav {

// Returns the meaning of a key press; empty for none. Letters are those of the user's layout. Held keys
// repeat only gradual changes.
std::optional<ViewAction> actionOf(const KeyPress& press);

// Keys and their meaning, for help and for the search for commands.
struct KeyHelp {
    std::string keys, meaning;
    std::optional<ViewAction> action = std::nullopt;  // action of choosing it there
    const char* also = "";                            // other words that people look for it by
};
const std::vector<KeyHelp>& viewKeys();
// What menus and panels have and no key does, in the same form: in place of the keys they say where it is.
const std::vector<KeyHelp>& menuEntries();

// Adds a 3-D mouse to the other input; its buttons are home and comfortable eyes.
FlightInput withSpaceMouse(FlightInput input, const SpaceMouseState& mouse);
std::vector<ViewAction> actionsOfSpaceMouse(const std::vector<int>& presses);

// Converts a place in the window to one in an eye's picture; both are shares of the size, (0, 0) top left.
glm::dvec2 placeInEye(OutputLayout layout, const glm::dvec2& place);

// Reads which keys and buttons are held; remembers the gamepad's buttons to notice new presses.
class ViewInput {
public:
    // also: another window whose keys count as well; null: none.
    FlightInput flightOf(const Window& window, const Window* also, const Gamepad& pad) const;
    // dt: seconds since the last call. The directional pad turns the light while it is held.
    std::vector<ViewAction> actionsOf(const Gamepad& pad, double dt);

private:
    Gamepad mBefore;
    double mCrossHeld = 0;  // seconds since its last action
};

}  // namespace stereonav
