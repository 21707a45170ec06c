// A window with an OpenGL 3.3 context and its user input: keys, mouse, wheel, gamepad. All functions must be
// called on the main thread (GLFW's rule), except wake().
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/display/full_screen.h"

struct GLFWwindow;

namespace stereonav {

// Returns whether a window with the required OpenGL can be opened. Opens a hidden one to find out, unless no
// display is named at all. Not to be called while a Window exists.
bool hasDisplay();

// A key that went down.
struct KeyPress {
    int key = 0;      // GLFW_KEY_...: position on a US keyboard
    char letter = 0;  // letter of the user's layout at that position without shift, 0 when it is not ASCII
    bool shift = false;
    bool repeat = false;  // held down
    bool control = false;
};

// The pointer's motion while a button is held, or while it is captured.
struct PointerDrag {
    int button = 0;        // GLFW_MOUSE_BUTTON_...: 0 left, 1 right, 2 middle
    bool shift = false;    // held when the button went down
    bool begins = true;    // whether it is the first of this press
    glm::dvec2 from{0.0};  // where the button went down: share of the window's size, (0, 0) top left
    glm::dvec2 by{0.0};    // screen units, x right, y down
};

// Sticks in [-1, 1] (y downwards) with a dead zone taken out; triggers in [0, 1].
struct Gamepad {
    bool present = false;
    glm::dvec2 leftStick{0.0}, rightStick{0.0};  // shares of full tilt
    double leftTrigger = 0, rightTrigger = 0;    // shares of full pull
    bool a = false, b = false, x = false, y = false, leftBumper = false, rightBumper = false;
    bool up = false, down = false, left = false, right = false;  // directional pad
};

struct WindowPlace {
    ScreenRect rect;         // without its frame; where it is maximised, the area that it fills
    bool maximised = false;  // by the desktop
};

// An element over the picture that gets input first: input that it takes does not reach the picture. Places
// are shares of the window's size, (0, 0) top left.
class InputSink {
public:
    virtual ~InputSink() = default;
    virtual void pointerAt(const glm::dvec2& place) = 0;
    virtual void pointerLeft() = 0;
    virtual bool takesButton(int button, bool pressed) = 0;  // at the pointer's last place
    virtual bool takesWheel(double notches) = 0;
    virtual bool takesKey(int key, int modifiers, bool pressed) = 0;
    virtual bool takesText(unsigned codePoint) = 0;
    virtual bool holdsKeyboard() const = 0;  // a text is being written: keys do not fly
};

class Window {
public:
    // Opens a window; width, height: screen units, limited to the monitor's free area. Throws Error where
    // there is no display or no OpenGL 3.3. quadBuffer: asks the driver for one back buffer per eye; if it
    // refuses, the window has one for both.
    Window(const std::string& title, int width, int height, bool visible = true, bool quadBuffer = false);
    // Opens a window beside the first one, which must outlive it. Their contexts share textures. It opens on
    // a monitor other than the first one's, where there is one. Throws Error.
    Window(const std::string& title, int width, int height, const Window& first);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Makes the window's context current, as it is after opening.
    void use() const;

    bool shouldClose() const;
    void keepOpen();  // the wish to close it is not followed
    // Handles what happened to all windows; waits at most `seconds` for something to happen (0: not at all).
    void handleEvents(double seconds);
    // Ends a wait of handleEvents early; from any thread.
    static void wake();
    void swapBuffers();
    // Swaps, waits until that is done, and says when: seconds of a steady clock.
    double swapTimed();
    static double now();  // seconds of the same clock
    bool quadBuffered() const { return mQuadBuffered; }

    glm::ivec2 framebufferSize() const;    // pixels; 0 x 0 while minimised
    glm::ivec2 framebufferOrigin() const;  // the top left pixel, from the first one of the monitor it is on
    float contentScale() const;            // 2 on a display with twice the usual density
    bool minimised() const;
    bool redrawNeeded();  // resized or uncovered since the last call

    ScreenRect place() const;  // without its frame
    // Returns the place on the desktop; of a window over a whole monitor the one that it had before.
    WindowPlace desktopPlace() const;
    // Puts it there, as far as the monitor has room, and maximises it where it was so.
    void setDesktopPlace(const WindowPlace& place);
    // Goes over a whole monitor, one of monitors(); throws Error where there is no such one.
    void enterFullScreen(std::size_t monitor);
    void leaveFullScreen();
    bool fullScreen() const { return FullScreen::on(mHandle); }
    void toggleFullScreen();  // on the monitor that the window is on

    bool keyDown(int key) const;
    std::vector<KeyPress> takeKeys();      // pressed since the last call
    double takeWheel();                    // notches, upwards is positive
    std::vector<PointerDrag> takeDrags();  // since the last call, one a press
    // Places where the left button went down and up without the pointer moving away: shares of the
    // window's size, (0, 0) top left.
    std::vector<glm::dvec2> takeClicks();
    std::vector<std::string> takeDrops();            // files and folders that were dropped here
    void setSink(InputSink* sink) { mSink = sink; }  // outlives the window, or is unset; null: none
    void setPointerHidden(bool hidden);              // it is drawn by what lies over the picture
    std::string clipboard() const;
    void setClipboard(const std::string& text);
    void setTitle(const std::string& title);
    void close();                     // closes the window as if the user had
    void setCaptured(bool captured);  // hide the pointer and take all its motion
    bool captured() const { return mCaptured; }
    Gamepad gamepad() const;  // the first one's state now; without one, not present

    GLFWwindow* handle() const { return mHandle; }

private:
    void start(const std::string& title, int width, int height, bool visible, bool quadBuffer,
               const Window* first);
    void open(const std::string& title, int width, int height, bool visible, bool quadBuffer,
              const Window* first);
    void placeBeside(const Window& first);
    void installCallbacks();
    void onPointer(double x, double y);
    void onButton(int button, bool pressed, bool shift);
    void setPointerMode();
    // What the window system says of it. It is asked once between two calls of handleEvents: each answer
    // takes a turn to the X server and back.
    struct Told {
        unsigned turn = 0;  // number of the handleEvents call
        bool minimised = false;
        glm::ivec2 pixels{0};
        ScreenRect place;
    };
    const Told& told() const;
    glm::dvec2 shareOf(const glm::dvec2& place) const;  // screen units as a share of the window's size

    GLFWwindow* mHandle = nullptr;
    mutable Told mTold;
    FullScreen mFullScreen;
    bool mQuadBuffered = false;
    std::vector<KeyPress> mKeys;
    double mWheel = 0;         // notches
    glm::dvec2 mPointer{0.0};  // screen units
    PointerDrag mGrip;         // the last press, without motion
    std::vector<PointerDrag> mDrags;
    std::vector<glm::dvec2> mClicks;  // shares of the window's size
    glm::dvec2 mPressed{0.0};         // where the left button went down, screen units
    std::vector<std::string> mDrops;
    InputSink* mSink = nullptr;
    unsigned mTaken = 0;  // buttons that are down and the sink's, a bit each
    bool mPointerKnown = false, mCaptured = false, mHidden = false, mRedraw = true;
};

}  // namespace stereonav
