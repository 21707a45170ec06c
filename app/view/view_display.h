// How the viewer's window stands on its display: full screen, a buffer for each eye, eyes that take turns at
// the display's refresh, and what parallax is there in millimetres.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/options/picture_options.h"
#include "app/view/screen_sizes.h"
#include "app/view/worker.h"
#include "engine/display/frame_sequence.h"
#include "engine/display/stereo_screen.h"
#include "engine/display/window.h"

namespace stereonav {

// Of parallax on the real screen; "" for nothing to say.
struct ScreenWords {
    std::string parallax, warning;
};

// The screen that the window is on.
struct ScreenAnswer {
    std::string words;    // how large it is, and who says so
    double width_mm = 0;  // in use
    bool asks = false;    // it is a guess that nobody was asked about
};

class ViewDisplay {
public:
    // Fills the monitor that the options name. The window is asked for a quad buffer where their mode is that
    // (wantsQuadBuffer), and outlives this. Throws Error where there is no such monitor.
    ViewDisplay(Window& window, const ViewOptions& options);

    static bool wantsQuadBuffer(const ViewOptions& options) { return options.mode == OutputMode::QuadBuffer; }
    // The mode to begin with: that of the options, or what stands in where the driver grants none.
    OutputMode mode() const { return mMode; }

    void toggleFullScreen();  // a refusal is a notice
    // Options that were changed: the screen's size, and the monitor where that is another one than before.
    void follow(const ViewOptions& options);

    // Whether the window has to be drawn at each refresh, new picture or not.
    static bool alternates(const ComposeSetting& setting);
    // Seconds to wait before the next of them; only while the last picture alternated.
    std::optional<double> wait() const;
    // Draws each eye or both of them where they belong, then swaps. drawOne: fills the window by a setting.
    void draw(const ComposeSetting& setting, const std::function<void(const ComposeSetting&)>& drawOne);

    // What to tell, once; "" for nothing.
    std::string takeNotice();

    // Of the screen that the window is on: how large it is, as far as anybody knows.
    ScreenSizes& sizes() { return mSizes; }
    const ScreenSizes& sizes() const { return mSizes; }
    ScreenTold told() const;
    ScreenAnswer screen() const;
    void leaveUnknown() { mSizes.noteAsked(told().name); }  // it is not asked again
    bool fullScreen() const { return mWindow.fullScreen(); }
    double refreshPeriod() const;  // seconds: of the monitor that the window is on, as it tells

    // On the real screen: parallax for the status line, and a warning where eyes would have to turn outwards.
    ScreenWords wordsOf(const ViewFrame& frame) const { return {parallaxText(frame), warning(frame)}; }
    std::string parallaxText(const ViewFrame& frame) const;
    std::string warning(const ViewFrame& frame) const;

private:
    void fill(const std::string& monitor);
    std::optional<Monitor> monitor() const;  // that the window is on
    double pictureWidthOf(const ViewFrame& frame, const ScreenTold& on) const;

    Window& mWindow;
    OutputMode mMode;
    std::string mFullScreen;  // as the options say it
    ScreenSizes mSizes;
    std::optional<FrameSequence> mSequence;  // while eyes alternate
    ScreenRect mPlace;                       // of the window when that began
    std::string mNotice;
};

}  // namespace stereonav
