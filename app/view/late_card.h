// The late warp on the graphics card (engine/display/late_warp_gpu.h), where one draws the window.
#pragma once

#include <array>
#include <memory>

#include "app/view/late_view.h"
#include "engine/display/late_warp_gpu.h"
#include "engine/display/window.h"

namespace stereonav {

class LateCard {
public:
    // The window's context is used by all calls, and current when this ends. window: outlives this.
    explicit LateCard(const Window& window) : mWindow(window) {}

    // Decided by the first call. STEREONAV_LATE_WARP=gpu or cpu decides it for tests.
    bool works();
    // Textures of both eyes as they are seen from where `now` is; the second is 0 of one eye. works() and
    // LateView::fits() hold.
    std::array<GLuint, 2> warp(const std::shared_ptr<const ViewFrame>& frame, const FrameRequest& now);
    // What warp() drew last.
    std::shared_ptr<const LateView::Eyes> read(bool twoEyes) const;

private:
    const Window& mWindow;
    std::unique_ptr<LateWarpGpu> mGpu;  // null: none that can
    bool mDecided = false;
    std::shared_ptr<const ViewFrame> mHas;  // what lies there to be warped
};

}  // namespace stereonav
