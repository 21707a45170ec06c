// The only file that talks to GLFW for the window and its input.
#include "engine/display/window.h"

#include <epoxy/gl.h>
// GLFW after the loader, which brings its own OpenGL declarations.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/base/error.h"
#include "engine/text/printable.h"

namespace stereonav {
namespace {

constexpr double kMonitorShare = 0.92;   // share of the monitor's free area: leaves room for decorations
constexpr int kSmallestWindow = 64;      // screen units
constexpr double kClickReach = 4.0;      // screen units that a hand shakes while it clicks
int openWindows = 0;                     // the first and the last one begin and end GLFW
unsigned turns = 1;                      // calls of handleEvents, and changes that a window made itself
constexpr double kStickDeadZone = 0.12;  // share of a stick's way: worn sticks rest that far off centre

std::string lastProblem() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

Error displayError(const std::string& problem) {
    return Error("", "window", problem,
                 "start it in a desktop session with OpenGL 3.3, or use render, play and compare, which need "
                 "no display");
}

bool environmentNamesDisplay() {
    const auto named = [](const char* variable) {
        const char* value = std::getenv(variable);
        return value && *value;
    };
    return named("DISPLAY") || named("WAYLAND_DISPLAY");
}

double withoutDeadZone(float value) {
    const double size = std::abs(value);
    if (size < kStickDeadZone) return 0;
    return std::copysign((size - kStickDeadZone) / (1 - kStickDeadZone), value);
}

// The asked-for size, or as much of it as the monitor has room for.
std::pair<int, int> fitted(int width, int height) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (!monitor) return {width, height};
    int x = 0, y = 0, areaWidth = 0, areaHeight = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &areaWidth, &areaHeight);
    if (areaWidth < 1 || areaHeight < 1) return {width, height};
    // Each side by itself: two eyes beside each other would become a narrow strip.
    const auto fit = [](int side, int area) {
        return std::max(std::min(side, static_cast<int>(kMonitorShare * area)), kSmallestWindow);
    };
    return {fit(width, areaWidth), fit(height, areaHeight)};
}

char letterOf(int key, int scancode) {
    const char* name = glfwGetKeyName(key, scancode);
    return name && name[0] > 0 && name[1] == 0 ? name[0] : 0;
}

}  // namespace

bool hasDisplay() {
    if (!environmentNamesDisplay()) return false;
    try {
        const Window probe("stereonav", kSmallestWindow, kSmallestWindow, false);
        return true;
    } catch (const Error&) {
        return false;
    }
}

Window::Window(const std::string& title, int width, int height, bool visible, bool quadBuffer) {
    start(title, width, height, visible, quadBuffer, nullptr);
}

Window::Window(const std::string& title, int width, int height, const Window& first) {
    start(title, width, height, true, false, &first);
}

void Window::start(const std::string& title, int width, int height, bool visible, bool quadBuffer,
                   const Window* first) {
    if (!environmentNamesDisplay())
        throw displayError("there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set");
    if (!glfwInit()) throw displayError("the display can not be used: " + lastProblem());
    try {
        open(printable(title), width, height, visible, quadBuffer, first);
    } catch (...) {
        if (mHandle) glfwDestroyWindow(mHandle);
        if (openWindows == 0) glfwTerminate();
        throw;
    }
    ++openWindows;
}

void Window::open(const std::string& title, int width, int height, bool visible, bool quadBuffer,
                  const Window* first) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
    // Left alone it is the title, which changes with the scene: desktops find the program's entry by it.
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "stereonav");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "stereonav");
    const auto [fitWidth, fitHeight] = fitted(width, height);
    if (quadBuffer) {
        glfwWindowHint(GLFW_STEREO, GLFW_TRUE);
        mHandle = glfwCreateWindow(fitWidth, fitHeight, title.c_str(), nullptr, nullptr);
        glfwWindowHint(GLFW_STEREO, GLFW_FALSE);  // for no other window
    }
    mQuadBuffered = mHandle != nullptr;
    if (!mHandle)
        mHandle =
            glfwCreateWindow(fitWidth, fitHeight, title.c_str(), nullptr, first ? first->mHandle : nullptr);
    if (!mHandle) throw displayError("no window with OpenGL 3.3 can be opened: " + lastProblem());
    glfwSetWindowSizeLimits(mHandle, kSmallestWindow, kSmallestWindow, GLFW_DONT_CARE, GLFW_DONT_CARE);
    glfwMakeContextCurrent(mHandle);
    // One of them waits for the display: both would halve the frames a second.
    glfwSwapInterval(first ? 0 : 1);
    if (first) placeBeside(*first);
    if (mQuadBuffered) {  // what was asked for is not always what was given
        GLboolean stereo = GL_FALSE;
        glGetBooleanv(GL_STEREO, &stereo);
        mQuadBuffered = stereo == GL_TRUE;
    }
    installCallbacks();
}

// Puts the window into the middle of the first monitor that shows nothing of the first window.
void Window::placeBeside(const Window& first) {
    const std::vector<Monitor> all = monitors();
    const auto taken = monitorUnder(all, first.place());
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (taken == n) continue;
        const ScreenRect &area = all[n].workArea, own = place();
        glfwSetWindowPos(mHandle, area.x + std::max(0, (area.width - own.width) / 2),
                         area.y + std::max(0, (area.height - own.height) / 2));
        ++turns;
        return;
    }
}

void Window::installCallbacks() {
    glfwSetWindowUserPointer(mHandle, this);
    glfwSetKeyCallback(mHandle, [](GLFWwindow* handle, int key, int scancode, int action, int mods) {
        auto* window = static_cast<Window*>(glfwGetWindowUserPointer(handle));
        if (window->mSink && window->mSink->takesKey(key, mods, action != GLFW_RELEASE)) return;
        if (action == GLFW_RELEASE) return;
        window->mKeys.push_back({key, letterOf(key, scancode), (mods & GLFW_MOD_SHIFT) != 0,
                                 action == GLFW_REPEAT, (mods & GLFW_MOD_CONTROL) != 0});
    });
    glfwSetCharCallback(mHandle, [](GLFWwindow* handle, unsigned codePoint) {
        auto* window = static_cast<Window*>(glfwGetWindowUserPointer(handle));
        if (window->mSink) window->mSink->takesText(codePoint);
    });
    glfwSetScrollCallback(mHandle, [](GLFWwindow* handle, double, double y) {
        auto* window = static_cast<Window*>(glfwGetWindowUserPointer(handle));
        if (!window->mSink || !window->mSink->takesWheel(y)) window->mWheel += y;
    });
    glfwSetDropCallback(mHandle, [](GLFWwindow* handle, int count, const char** paths) {
        auto* window = static_cast<Window*>(glfwGetWindowUserPointer(handle));
        window->mDrops.insert(window->mDrops.end(), paths, paths + count);
    });
    glfwSetCursorEnterCallback(mHandle, [](GLFWwindow* handle, int entered) {
        auto* window = static_cast<Window*>(glfwGetWindowUserPointer(handle));
        if (window->mSink && !entered) window->mSink->pointerLeft();
    });
    glfwSetCursorPosCallback(mHandle, [](GLFWwindow* handle, double x, double y) {
        static_cast<Window*>(glfwGetWindowUserPointer(handle))->onPointer(x, y);
    });
    glfwSetMouseButtonCallback(mHandle, [](GLFWwindow* handle, int button, int action, int mods) {
        static_cast<Window*>(glfwGetWindowUserPointer(handle))
            ->onButton(button, action == GLFW_PRESS, (mods & GLFW_MOD_SHIFT) != 0);
    });
    glfwSetFramebufferSizeCallback(mHandle, [](GLFWwindow* handle, int, int) {
        static_cast<Window*>(glfwGetWindowUserPointer(handle))->mRedraw = true;
    });
    glfwSetWindowRefreshCallback(mHandle, [](GLFWwindow* handle) {
        static_cast<Window*>(glfwGetWindowUserPointer(handle))->mRedraw = true;
    });
    glfwSetWindowPosCallback(mHandle, [](GLFWwindow* handle, int, int) {
        static_cast<Window*>(glfwGetWindowUserPointer(handle))->mRedraw = true;
    });
}

Window::~Window() {
    glfwDestroyWindow(mHandle);
    if (--openWindows == 0) glfwTerminate();
}

void Window::onPointer(double x, double y) {
    const auto drags = [&](int button) {
        return glfwGetMouseButton(mHandle, button) == GLFW_PRESS && (mTaken & 1u << button) == 0;
    };
    const glm::dvec2 now(x, y);
    if (mSink && !mCaptured) mSink->pointerAt(shareOf(now));
    if (mPointerKnown && (drags(mGrip.button) || mCaptured)) {
        if (mGrip.begins || mDrags.empty()) mDrags.push_back(mGrip);
        mGrip.begins = false;
        mDrags.back().by += now - mPointer;
    }
    mPointer = now;
    mPointerKnown = true;
}

void Window::onButton(int button, bool pressed, bool shift) {
    if (mCaptured || button < 0 || button > GLFW_MOUSE_BUTTON_LAST) return;
    // The pointer's place at the time of the event; asking the system would give the present one, some frames
    // later.
    glm::dvec2 now = mPointer;
    if (!mPointerKnown) glfwGetCursorPos(mHandle, &now.x, &now.y);
    const unsigned bit = 1u << button;
    if (mSink) {
        mSink->pointerAt(shareOf(now));
        // A button that was pressed over an element is also released there.
        const bool taken = mSink->takesButton(button, pressed);
        const bool was = (mTaken & bit) != 0;
        mTaken = pressed && taken ? mTaken | bit : mTaken & ~bit;
        if (pressed ? taken : was) return;
    }
    if (pressed && button <= GLFW_MOUSE_BUTTON_MIDDLE) mGrip = {button, shift, true, shareOf(now), {}};
    if (button != GLFW_MOUSE_BUTTON_LEFT) return;
    if (pressed)
        mPressed = now;
    else if (glm::length(now - mPressed) <= kClickReach)
        mClicks.push_back(shareOf(now));
}

glm::dvec2 Window::shareOf(const glm::dvec2& place) const {
    const ScreenRect& window = told().place;
    return place / glm::dvec2(std::max(window.width, 1), std::max(window.height, 1));
}

void Window::setPointerHidden(bool hidden) {
    if (hidden == mHidden) return;
    mHidden = hidden;
    setPointerMode();
}

void Window::setPointerMode() {
    glfwSetInputMode(mHandle, GLFW_CURSOR,
                     mCaptured ? GLFW_CURSOR_DISABLED
                     : mHidden ? GLFW_CURSOR_HIDDEN
                               : GLFW_CURSOR_NORMAL);
}

std::vector<std::string> Window::takeDrops() {
    return std::exchange(mDrops, {});
}

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(mHandle);
    return text ? text : "";
}

void Window::setClipboard(const std::string& text) {
    glfwSetClipboardString(mHandle, printableLines(text).c_str());
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(mHandle, printable(title).c_str());
}

void Window::close() {
    glfwSetWindowShouldClose(mHandle, GLFW_TRUE);
}

void Window::keepOpen() {
    glfwSetWindowShouldClose(mHandle, GLFW_FALSE);
}

void Window::setCaptured(bool captured) {
    if (captured == mCaptured) return;
    mCaptured = captured;
    mPointerKnown = false;  // the pointer jumps when it is hidden or shown
    setPointerMode();
}

bool Window::shouldClose() const {
    return glfwWindowShouldClose(mHandle) != 0;
}

void Window::use() const {
    glfwMakeContextCurrent(mHandle);
}

void Window::handleEvents(double seconds) {
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    ++turns;
}

void Window::wake() {
    glfwPostEmptyEvent();
}

void Window::swapBuffers() {
    glfwSwapBuffers(mHandle);
}

double Window::swapTimed() {
    glfwSwapBuffers(mHandle);
    glFinish();  // drivers return before the swap is done, some of them several swaps before
    return glfwGetTime();
}

double Window::now() {
    return glfwGetTime();
}

const Window::Told& Window::told() const {
    if (mTold.turn == turns) return mTold;
    mTold.turn = turns;
    mTold.minimised = glfwGetWindowAttrib(mHandle, GLFW_ICONIFIED) != 0;
    glfwGetFramebufferSize(mHandle, &mTold.pixels.x, &mTold.pixels.y);
    ScreenRect& place = mTold.place;
    glfwGetWindowPos(mHandle, &place.x, &place.y);
    glfwGetWindowSize(mHandle, &place.width, &place.height);
    return mTold;
}

glm::ivec2 Window::framebufferSize() const {
    return minimised() ? glm::ivec2(0) : told().pixels;
}

ScreenRect Window::place() const {
    return told().place;
}

WindowPlace Window::desktopPlace() const {
    if (fullScreen() && mFullScreen.before()) return {*mFullScreen.before(), mFullScreen.maximisedBefore()};
    return {place(), glfwGetWindowAttrib(mHandle, GLFW_MAXIMIZED) != 0};
}

void Window::setDesktopPlace(const WindowPlace& place) {
    const std::vector<Monitor> all = monitors();
    ScreenRect to = place.rect;
    if (const auto under = monitorUnder(all, to)) {
        // A monitor that is no longer there, or has another size, must not hide the window.
        const ScreenRect& area = all[*under].workArea;
        to.width = std::clamp(to.width, kSmallestWindow, std::max(area.width, kSmallestWindow));
        to.height = std::clamp(to.height, kSmallestWindow, std::max(area.height, kSmallestWindow));
        to.x = std::clamp(to.x, area.x, std::max(area.x + area.width - to.width, area.x));
        to.y = std::clamp(to.y, area.y, std::max(area.y + area.height - to.height, area.y));
    }
    glfwSetWindowSize(mHandle, to.width, to.height);
    glfwSetWindowPos(mHandle, to.x, to.y);
    if (place.maximised) glfwMaximizeWindow(mHandle);
    ++turns;
}

void Window::enterFullScreen(std::size_t monitor) {
    mFullScreen.enter(mHandle, monitor);
    ++turns;
}

void Window::leaveFullScreen() {
    mFullScreen.leave(mHandle);
    ++turns;
}

glm::ivec2 Window::framebufferOrigin() const {
    if (fullScreen()) return {0, 0};
    const ScreenRect window = place();
    const double scale = window.width > 0 ? static_cast<double>(told().pixels.x) / window.width : 1.0;
    const std::vector<Monitor>& all = recentMonitors();
    const auto under = monitorUnder(all, window);
    return placeOnMonitor(window, under ? all[*under] : Monitor{}, scale);
}

void Window::toggleFullScreen() {
    if (fullScreen()) return leaveFullScreen();
    enterFullScreen(monitorUnder(monitors(), place()).value_or(0));
}

float Window::contentScale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(mHandle, &x, &y);
    return std::max(x, 1.0f);
}

bool Window::minimised() const {
    return told().minimised;
}

bool Window::redrawNeeded() {
    return std::exchange(mRedraw, false);
}

bool Window::keyDown(int key) const {
    if (mSink && mSink->holdsKeyboard()) return false;
    const auto down = [&](int which) { return glfwGetKey(mHandle, which) == GLFW_PRESS; };
    // With Control a key is a command, not a flight.
    return down(key) && !down(GLFW_KEY_LEFT_CONTROL) && !down(GLFW_KEY_RIGHT_CONTROL);
}

std::vector<KeyPress> Window::takeKeys() {
    return std::exchange(mKeys, {});
}

double Window::takeWheel() {
    return std::exchange(mWheel, 0.0);
}

std::vector<glm::dvec2> Window::takeClicks() {
    return std::exchange(mClicks, {});
}

std::vector<PointerDrag> Window::takeDrags() {
    return std::exchange(mDrags, {});
}

Gamepad Window::gamepad() const {
    Gamepad pad;
    GLFWgamepadstate state;
    if (!glfwJoystickIsGamepad(GLFW_JOYSTICK_1) || !glfwGetGamepadState(GLFW_JOYSTICK_1, &state)) return pad;
    const auto stick = [&](int x, int y) {
        return glm::dvec2(withoutDeadZone(state.axes[x]), withoutDeadZone(state.axes[y]));
    };
    const auto pressed = [&](int button) { return state.buttons[button] == GLFW_PRESS; };
    pad.present = true;
    pad.leftStick = stick(GLFW_GAMEPAD_AXIS_LEFT_X, GLFW_GAMEPAD_AXIS_LEFT_Y);
    pad.rightStick = stick(GLFW_GAMEPAD_AXIS_RIGHT_X, GLFW_GAMEPAD_AXIS_RIGHT_Y);
    pad.leftTrigger = (state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER] + 1) / 2;
    pad.rightTrigger = (state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER] + 1) / 2;
    pad.a = pressed(GLFW_GAMEPAD_BUTTON_A);
    pad.b = pressed(GLFW_GAMEPAD_BUTTON_B);
    pad.x = pressed(GLFW_GAMEPAD_BUTTON_X);
    pad.y = pressed(GLFW_GAMEPAD_BUTTON_Y);
    pad.leftBumper = pressed(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER);
    pad.rightBumper = pressed(GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER);
    pad.up = pressed(GLFW_GAMEPAD_BUTTON_DPAD_UP);
    pad.down = pressed(GLFW_GAMEPAD_BUTTON_DPAD_DOWN);
    pad.left = pressed(GLFW_GAMEPAD_BUTTON_DPAD_LEFT);
    pad.right = pressed(GLFW_GAMEPAD_BUTTON_DPAD_RIGHT);
    return pad;
}

}  // namespace stereonav
