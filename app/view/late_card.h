// The late warp on the graphics card (engine/display/late_warp_gpu.h), where a card draws the window.
#pragma once

#include <array>
#include <memory>

#include "app/view/late_view.h"
#include "engine/display/late_warp_gpu.h"
#include "engine/display/window.h"

namespace stereonav {

class LateCard {
public:
    // All functions use the window's context; it has to be current at the end of this object. window must
    // outlive this object.
    explicit LateCard(const Window& window) : mWindow(window) {}

    // Returns whether the card can warp; decided by the first call. Tests set STEREONAV_LATE_WARP=gpu or cpu.
    bool works();
    // Returns textures of both eyes as seen from `now`; the second is 0 for one eye. Requires works() and
    // LateView::fits().
    std::array<GLuint, 2> warp(const std::shared_ptr<const ViewFrame>& frame, const FrameRequest& now);
    // Reads back what warp() drew last.
    std::shared_ptr<const LateView::Eyes> read(bool twoEyes) const;

private:
    const Window& mWindow;
    std::unique_ptr<LateWarpGpu> mGpu;  // null: the card can not warp
    bool mDecided = false;
    std::shared_ptr<const ViewFrame> mHas;  // frame whose planes are on the card
};

}  // namespace stereonav
