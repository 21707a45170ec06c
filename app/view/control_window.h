// A second window that has all panels, so that the first one shows nothing but the eyes' pictures: for a
// projector, glasses or a television beside the desk. Between the panels lies a small picture of the left
// eye.
#pragma once

#include <functional>

#include "app/view/panel/panel_texture.h"
#include "app/view/panel/panels.h"
#include "app/view/worker.h"
#include "engine/display/interface.h"
#include "engine/display/window.h"

namespace stereonav {

class ControlWindow {
public:
    // The first window's context is current afterwards, and after each call. Throws Error where the driver
    // grants no second window.
    ControlWindow(const Window& first, const InterfaceLook& look);
    ~ControlWindow();

    Window& window() { return mWindow; }
    const Window& window() const { return mWindow; }
    Interface& interface() { return mInterface; }
    const Interface& interface() const { return mInterface; }

    // drawPanels: lays them out. fresh: the frame is another one than in the last call; null: there is none.
    void draw(const Panels& panels, const std::function<void()>& drawPanels, const ViewFrame* frame,
              bool fresh, double dt);

    // A place of this window, shares of its size, in the picture, shares of that one's.
    glm::dvec2 placeInPicture(const glm::dvec2& share) const;
    double pictureHeight() const;  // of the small one, screen units; 0: there is none

private:
    void takePicture(const ViewFrame& frame);

    const Window& mFirst;
    Window mWindow;
    Interface mInterface;
    PanelTexture mPicture;
    glm::vec2 mCorner{0}, mSize{0};  // of the small picture, units of the interface
    glm::ivec2 mMade{0};             // pixels it was made for
    bool mStale = true;
};

}  // namespace stereonav
