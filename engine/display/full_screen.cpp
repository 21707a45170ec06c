// Through GLFW's own full screen, which asks the window manager for it: a window that is merely as large as
// the monitor stays below panels, and Wayland lets no program place a window. The mode asked for is the
// present one.
#include "engine/display/full_screen.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "engine/base/error.h"

namespace stereonav {

namespace {

// Window managers that do not know the wish for a certain monitor fill the one that the window is on.
void moveTo(GLFWwindow* window, GLFWmonitor* monitor, const GLFWvidmode& mode) {
    ScreenRect area;
    glfwGetMonitorPos(monitor, &area.x, &area.y);
    int width = 0, height = 0;
    glfwGetWindowSize(window, &width, &height);
    width = std::min(width, mode.width / 2);
    height = std::min(height, mode.height / 2);
    const int x = area.x + (mode.width - width) / 2, y = area.y + (mode.height - height) / 2;
    if (FullScreen::on(window)) {
        glfwSetWindowMonitor(window, nullptr, x, y, width, height, GLFW_DONT_CARE);
        return;
    }
    if (glfwGetWindowAttrib(window, GLFW_MAXIMIZED)) glfwRestoreWindow(window);
    glfwSetWindowSize(window, width, height);
    glfwSetWindowPos(window, x, y);
}

}  // namespace

bool FullScreen::on(GLFWwindow* window) {
    return glfwGetWindowMonitor(window) != nullptr;
}

void FullScreen::enter(GLFWwindow* window, std::size_t monitor) {
    int count = 0;
    GLFWmonitor** const handles = glfwGetMonitors(&count);
    const GLFWvidmode* const mode =
        handles && monitor < static_cast<std::size_t>(count) ? glfwGetVideoMode(handles[monitor]) : nullptr;
    if (!mode)
        throw Error("", "full screen", "there is no such monitor", "see which are connected and switched on");
    if (glfwGetWindowMonitor(window) == handles[monitor]) return;
    ScreenRect now;
    glfwGetWindowPos(window, &now.x, &now.y);
    glfwGetWindowSize(window, &now.width, &now.height);
    if (!on(window)) {
        mBefore = now;
        mMaximised = glfwGetWindowAttrib(window, GLFW_MAXIMIZED) != 0;
    }
    if (on(window) || monitorUnder(monitors(), now) != monitor) moveTo(window, handles[monitor], *mode);
    // The window stays on glasses or a projector while another monitor's window is used.
    glfwSetWindowAttrib(window, GLFW_AUTO_ICONIFY, GLFW_FALSE);
    glfwSetWindowMonitor(window, handles[monitor], 0, 0, mode->width, mode->height, mode->refreshRate);
}

void FullScreen::leave(GLFWwindow* window) {
    if (!on(window) || !mBefore) return;
    glfwSetWindowMonitor(window, nullptr, mBefore->x, mBefore->y, mBefore->width, mBefore->height,
                         GLFW_DONT_CARE);
    if (mMaximised) glfwMaximizeWindow(window);
    mBefore.reset();
}

}  // namespace stereonav
