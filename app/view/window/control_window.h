// A second window with all panels, so that the first one shows only the eyes' pictures: for a projector,
// glasses or a television beside the desk. Between the panels lies a small picture of the left eye.
#pragma once

#include <functional>

#include "app/view/panel/panel_texture.h"
#include "app/view/panel/shown_panels.h"
#include "app/view/view_frame.h"
#include "engine/display/interface.h"
#include "engine/display/window.h"

namespace stereonav {

class ControlWindow {
public:
    // Makes the first window's context current afterwards, as all functions do. Throws Error where the driver
    // grants no second window.
    ControlWindow(const Window& first, const InterfaceLook& look);
    ~ControlWindow();

    Window& window() { return mWindow; }
    const Window& window() const { return mWindow; }
    Interface& interface() { return mInterface; }
    const Interface& interface() const { return mInterface; }

    // Draws the window. drawPanels: lays out the panels. fresh: the frame differs from that of the last call;
    // null: there is none.
    void draw(const ShownPanels& panels, const std::function<void()>& drawPanels, const ViewFrame* frame,
              bool fresh, double dt);

    // Converts a place of this window, as shares of its size, to shares of the picture's size.
    glm::dvec2 placeInPicture(const glm::dvec2& share) const;
    double pictureHeight() const;  // height of the small picture in screen units; 0: there is none

private:
    void takePicture(const ViewFrame& frame);

    const Window& mFirst;
    Window mWindow;
    Interface mInterface;
    PanelTexture mPicture;
    glm::vec2 mCorner{0}, mSize{0};  // place of the small picture in units of the interface
    glm::ivec2 mMade{0};             // size in pixels that it was made for
    bool mStale = true;
};

}  // namespace stereonav
