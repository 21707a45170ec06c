// The monitors of the desktop, and the choice of one: by where a window lies, by number or by name.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stereonav {

// A rectangle in screen units of the desktop, y downwards.
struct ScreenRect {
    int x = 0, y = 0, width = 0, height = 0;

    bool operator==(const ScreenRect&) const = default;
};

struct Monitor {
    std::string name;                 // "DP-1"; two may have the same
    ScreenRect area;                  // all of it; its video mode's size
    ScreenRect workArea;              // without panels and docks
    int width_mm = 0, height_mm = 0;  // size that the monitor reports; 0: unknown
    double refreshRate = 0;           // Hz; 0: unknown
    double contentScale = 1;          // 2 with twice the usual density
};

// Returns the monitors in the order that the desktop gives them, the primary one first. While a Window
// exists, on its thread.
std::vector<Monitor> monitors();
// Returns the monitors as they were at most a quarter of a second ago: asking takes about six round trips to
// the X server for each, longer than all drawing of a window when it is asked at every turn.
const std::vector<Monitor>& recentMonitors();

// Returns the monitor that contains most of the window, or the nearest one if none does; the first of equals.
// Empty where there is no monitor.
std::optional<std::size_t> monitorUnder(std::span<const Monitor> monitors, const ScreenRect& window);

// Returns the monitor for a text. "auto": empty. "1" and on: in their order. Else the one with this name, or
// the only one whose name contains it, ignoring case. Throws Error that lists them.
std::optional<std::size_t> monitorNamed(std::span<const Monitor> monitors, std::string_view text);

// Returns "1 DP-1 (1920x1080), 2 HDMI-1 (3840x1080)".
std::string monitorList(std::span<const Monitor> monitors);

// Returns the window's top left pixel, counted from the monitor's own first row and column: polarisers and
// lenses of interleaved displays are fixed to these, wherever the desktop puts the monitor. scale: pixels per
// screen unit.
glm::ivec2 placeOnMonitor(const ScreenRect& window, const Monitor& monitor, double scale);

}  // namespace stereonav
