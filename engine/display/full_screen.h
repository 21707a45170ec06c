// Shows a window over a whole monitor, and restores its place afterwards.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/display/monitors.h"

struct GLFWwindow;

namespace stereonav {

class FullScreen {
public:
    // Puts the window without a border over all of the monitor, in the monitor's present video mode; also
    // from one monitor to another. Throws Error where there is no such monitor.
    void enter(GLFWwindow* window, std::size_t monitor);
    // Restores the window's former place and size; does nothing where it is not over a whole monitor.
    void leave(GLFWwindow* window);
    // Returns whether the window is over a whole monitor according to the desktop: unplugging the monitor
    // ends that as well.
    static bool on(GLFWwindow* window);
    // Return the place to restore; empty where none is, and whether the window was maximised there.
    const std::optional<ScreenRect>& before() const { return mBefore; }
    bool maximisedBefore() const { return mMaximised; }

private:
    std::optional<ScreenRect> mBefore;
    bool mMaximised = false;
};

}  // namespace stereonav
