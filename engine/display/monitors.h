// The monitors of the desktop, and which one is meant: by where a window lies, by number or by name.
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
    int width_mm = 0, height_mm = 0;  // what it tells; 0: unknown
    double refreshRate = 0;           // Hz; 0: unknown
    double contentScale = 1;          // 2 with twice the usual density
};

// Returns the monitors in the order that the desktop gives them, the primary one first. While a Window
// exists, on its thread.
std::vector<Monitor> monitors();
// The monitors as they were a quarter of a second ago at most: each of them is asked for in some six turns to
// the X server and back, which take longer than all that a window draws when it is asked at every turn.
const std::vector<Monitor>& recentMonitors();

// Returns which one most of the window lies on, or, where it lies on none, which one is nearest; the first of
// equals. Nullopt where there is none.
std::optional<std::size_t> monitorUnder(std::span<const Monitor> monitors, const ScreenRect& window);

// Returns the monitor that a text means. "auto": nullopt. "1" and on: in their order. Else the one with this
// name, or the only one whose name contains it, in whatever case. Throws Error that lists them.
std::optional<std::size_t> monitorNamed(std::span<const Monitor> monitors, std::string_view text);

// Returns "1 DP-1 (1920x1080), 2 HDMI-1 (3840x1080)".
std::string monitorList(std::span<const Monitor> monitors);

// Returns the window's top left pixel, counted from the monitor's own first row and column: those are what
// the polarisers and lenses of interleaved displays are fixed to, wherever the desktop puts the monitor.
// scale: pixels a screen unit.
glm::ivec2 placeOnMonitor(const ScreenRect& window, const Monitor& monitor, double scale);

}  // namespace stereonav
