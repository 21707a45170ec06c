// Keys, mouse and gamepad as wishes of the pilot and commands to the session.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/session.h"
#include "engine/display/space_mouse.h"
#include "engine/display/window.h"

namespace stereonav {

// What a key press means; nullopt when nothing. Letters are those of the user's own layout. Held keys
// repeat only what is a matter of degree.
std::optional<ViewAction> actionOf(const KeyPress& press);

// Keys and what they do, for help and for whoever looks for a command by its words.
struct KeyHelp {
    std::string keys, meaning;
    std::optional<ViewAction> action = std::nullopt;  // that a choice of it does
};
const std::vector<KeyHelp>& viewKeys();

// A mouse of six axes beside what else is pushed; its buttons, home and keeping comfortable.
FlightInput withSpaceMouse(FlightInput input, const SpaceMouseState& mouse);
std::vector<ViewAction> actionsOfSpaceMouse(const std::vector<int>& presses);

// Where in an eye's picture a place in the window lies; both are shares of the size, (0, 0) top left.
glm::dvec2 placeInEye(OutputLayout layout, const glm::dvec2& place);

// Reads what is held down now; remembers the gamepad's buttons to notice new presses.
class ViewInput {
public:
    // also: a further window whose keys count too; null: none.
    FlightInput flightOf(const Window& window, const Window* also, const Gamepad& pad) const;
    // dt: seconds since the last call. The cross turns the light on while it is held.
    std::vector<ViewAction> actionsOf(const Gamepad& pad, double dt);

private:
    Gamepad mBefore;
    double mCrossHeld = 0;  // seconds since it last did something
};

}  // namespace stereonav
