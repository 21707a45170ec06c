// One window over a whole monitor and back to where it was.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/display/monitors.h"

struct GLFWwindow;

namespace stereonav {

class FullScreen {
public:
    // Puts the window without a border over all of the monitor, in the video mode that it has. From one
    // monitor to another, too. Throws Error where there is no such monitor.
    void enter(GLFWwindow* window, std::size_t monitor);
    // Puts the window to its place and size before; nothing where it is a window already.
    void leave(GLFWwindow* window);
    // Returns whether the window is over a whole monitor, as the desktop says: unplugging the monitor ends
    // that, too.
    static bool on(GLFWwindow* window);

private:
    std::optional<ScreenRect> mBefore;
    bool mMaximised = false;
};

}  // namespace stereonav
