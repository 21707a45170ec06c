// The interface over the picture: whether its panels lie there or in a window of their own, when it is laid
// out, and which part of the window is left for the picture.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "app/view/control_window.h"
#include "app/view/panel/panels.h"
#include "app/view/picture_place.h"
#include "app/view/session.h"
#include "engine/display/interface.h"
#include "engine/display/window.h"

namespace stereonav {

class PanelStage {
public:
    // Both outlive this. mode: of the picture until a session begins.
    PanelStage(Window& window, std::optional<ViewSession>& session, OutputMode mode)
        : mWindow(window), mSession(session), mMode(mode), mInterface(window) {}
    ~PanelStage();  // what is left is deleted in the first window's context

    Panels& panels() { return mPanels; }
    const Panels& panels() const { return mPanels; }
    Interface& overPicture() { return mInterface; }
    const Interface& overPicture() const { return mInterface; }
    // The interface that has the panels.
    Interface& panelled() { return mControls ? mControls->interface() : mInterface; }
    const Interface& panelled() const { return mControls ? mControls->interface() : mInterface; }
    // Their own window; null while they lie over the picture.
    ControlWindow* controls() { return mControls.get(); }
    const ControlWindow* controls() const { return mControls.get(); }
    void toggleControls();             // throws Error where the driver grants no second window
    void close() { mWindow.close(); }  // the first window

    // The mode of the picture: the session's, or before it the one that it will begin with.
    OutputMode mode() const { return mSession ? mSession->compose().mode : mMode; }
    // The mode that the next session begins with: the one that was chosen in this.
    OutputMode keepMode() { return mMode = mSession ? mSession->mode() : mMode; }
    OutputMode firstMode() const { return mMode; }
    SizeOption windowSize() const;  // pixels
    PicturePlace placeOf(const OutputModeInfo& mode) const;
    SizeOption eyeSize() const;  // of the picture in its mode, pixels

    // What the user did, or what came, is to be seen with the next layout.
    void layOutSoon() { mDue = true; }
    // A frame came: for the small picture between the panels.
    void noteFrame() { mNewPreview = true; }
    // The interface over the picture, where one is due; draw: lays out the panels. fresh: a picture comes
    // with it; busy: something is being loaded. True: it looks otherwise than before.
    bool layOut(const InterfacePlaces& places, double dt, bool fresh, bool busy,
                const std::function<void()>& draw);
    // The panels' own window, where there is one.
    void drawControls(double dt, const ViewFrame* frame, const std::function<void()>& draw);

private:
    Window& mWindow;
    std::optional<ViewSession>& mSession;
    OutputMode mMode;
    Interface mInterface;
    Panels mPanels;
    std::unique_ptr<ControlWindow> mControls;
    double mSinceLayout = 0;  // seconds
    bool mDue = true, mLaidOutBusy = false, mNewPreview = false;
};

}  // namespace stereonav
