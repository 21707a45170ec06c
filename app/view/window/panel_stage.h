// The interface over the picture: whether its panels are there or in a window of their own, when it is laid
// out, and which part of the window is left for the picture.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "app/view/panel/panels.h"
#include "app/view/session.h"
#include "app/view/view_display.h"
#include "app/view/window/control_window.h"
#include "app/view/window/picture_place.h"
#include "engine/display/interface.h"
#include "engine/display/window.h"

namespace stereonav {

class PanelStage {
public:
    // The arguments must outlive this object.
    PanelStage(Window& window, std::optional<ViewSession>& session, const ViewDisplay& display)
        : mWindow(window), mSession(session), mDisplay(display), mInterface(window) {}
    ~PanelStage();  // deletes what is left in the first window's context

    Panels& panels() { return mPanels; }
    const Panels& panels() const { return mPanels; }
    Interface& overPicture() { return mInterface; }
    const Interface& overPicture() const { return mInterface; }
    // Returns the interface that has the panels.
    Interface& panelled() { return mControls ? mControls->interface() : mInterface; }
    const Interface& panelled() const { return mControls ? mControls->interface() : mInterface; }
    // Returns the panels' own window; null while they are over the picture.
    ControlWindow* controls() { return mControls.get(); }
    const ControlWindow* controls() const { return mControls.get(); }
    void toggleControls();  // throws Error where the driver grants no second window

    // Returns the mode of the picture: the session's, or before it the one that it will begin with.
    OutputMode mode() const { return mSession ? mSession->compose().mode : mDisplay.mode().shown(); }
    PicturePlace placeOf(const OutputModeInfo& mode) const;
    SizeOption eyeSize() const;  // size of the picture in its mode in pixels

    // Makes the next layout due, since something has changed.
    void layOutSoon() { mDue = true; }
    // Notes a new frame, for the small picture between the panels.
    void noteFrame() { mNewPreview = true; }
    // Lays out the interface over the picture if it is due; draw: lays out the panels. fresh: a new picture
    // comes with it; busy: something is being loaded. Returns true where it looks different.
    bool layOut(const InterfacePlaces& places, double dt, bool fresh, bool busy,
                const std::function<void()>& draw);
    // Draws the panels' own window, where there is one.
    void drawControls(double dt, const ViewFrame* frame, const std::function<void()>& draw);

private:
    Window& mWindow;
    std::optional<ViewSession>& mSession;
    const ViewDisplay& mDisplay;
    Interface mInterface;
    Panels mPanels;
    std::unique_ptr<ControlWindow> mControls;
    double mSinceLayout = 0;  // in seconds
    bool mDue = true, mLaidOutBusy = false, mNewPreview = false;
};

}  // namespace stereonav
