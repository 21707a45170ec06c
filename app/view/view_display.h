// The viewer's window on its display: full screen, a buffer for each eye, eyes that alternate at the
// display's refresh, and parallax in millimetres.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/options/view_options.h"
#include "app/view/screen_sizes.h"
#include "app/view/shown_mode.h"
#include "app/view/view_frame.h"
#include "engine/display/frame_sequence.h"
#include "engine/display/stereo_screen.h"
#include "engine/display/window.h"

namespace stereonav {

// Texts on parallax on the real screen; "" for none.
struct ScreenWords {
    std::string parallax, warning;
};

// The screen that the window is on.
struct ScreenAnswer {
    std::string words;    // size of the screen, and where that comes from
    double width_mm = 0;  // width in use
    bool asks = false;    // whether the width is a guess and the user has not been asked
};

class ViewDisplay {
public:
    // Fills the monitor that the options name. The window is asked for a quad buffer where their mode needs
    // it (wantsQuadBuffer); it must outlive this object. Throws Error where there is no such monitor.
    ViewDisplay(Window& window, const ViewOptions& options);

    static bool wantsQuadBuffer(const ViewOptions& options) { return options.mode == OutputMode::QuadBuffer; }
    // Returns the mode that the next session begins with: at first that of the options, or its replacement
    // where the driver does not grant it; where they have none, one eye.
    const ShownMode& mode() const { return mMode; }
    // Takes the mode that a session shows.
    void setMode(const ShownMode& mode);
    // Takes a mode that was kept, unless one was given or chosen since.
    void restoreMode(const ShownMode& kept);
    // Returns the mode to keep; empty while it is as the options say.
    std::optional<ShownMode> modeToKeep() const;
    // Returns whether both eyes are shown after a reset: the options have a mode.
    bool firstStereo() const { return mGiven.has_value(); }
    SizeOption windowSize() const;  // in pixels
    void close() { mWindow.close(); }

    void toggleFullScreen();  // a refusal becomes a notice
    // Applies options that were changed: the screen's size, and the monitor where it is another one.
    void follow(const ViewOptions& options);

    // Returns whether the window has to be drawn at each refresh, even without a new picture.
    static bool alternates(const ComposeSetting& setting);
    // Returns the seconds until the next refresh; only while the last picture alternated.
    std::optional<double> wait() const;
    // Draws each eye, or both, in its place, then swaps buffers. drawOne: fills the window with a setting.
    void draw(const ComposeSetting& setting, const std::function<void(const ComposeSetting&)>& drawOne);

    // Returns a notice once; "" for none.
    std::string takeNotice();

    // Return the size of the window's screen, as far as it is known.
    ScreenSizes& sizes() { return mSizes; }
    const ScreenSizes& sizes() const { return mSizes; }
    ScreenTold told() const;
    ScreenAnswer screen() const;
    void leaveUnknown() { mSizes.noteAsked(told().name); }  // the user is not asked again
    bool fullScreen() const { return mWindow.fullScreen(); }
    double refreshPeriod() const;  // seconds per refresh of the window's monitor, as it reports

    // Returns texts for the real screen: parallax for the status bar, and a warning where eyes would have to
    // diverge.
    ScreenWords wordsOf(const ViewFrame& frame) const;

private:
    void fill(const std::string& monitor);
    std::optional<Monitor> monitor() const;  // monitor that the window is on
    double pictureWidthOf(const ViewFrame& frame, const ScreenTold& on) const;

    Window& mWindow;
    std::optional<ShownMode> mGiven;  // by the options
    ShownMode mMode;
    bool mModeChosen;         // by the options or the user
    std::string mFullScreen;  // value of the option
    ScreenSizes mSizes;
    std::optional<FrameSequence> mSequence;  // set while eyes alternate
    ScreenRect mPlace;                       // place of the window when that began
    std::string mNotice;
};

}  // namespace stereonav
