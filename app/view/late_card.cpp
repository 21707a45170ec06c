#include "app/view/late_card.h"

#include <epoxy/gl.h>

#include <cstdlib>
#include <string_view>
#include <utility>

#include "app/view/frame_views.h"
#include "engine/display/renderer_name.h"

namespace stereonav {

bool LateCard::works() {
    if (std::exchange(mDecided, true)) return mGpu != nullptr;
    mWindow.use();
    const char* const said = std::getenv("STEREONAV_LATE_WARP");
    const auto* const renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const bool wanted = said ? std::string_view(said) == "gpu" : renderer && !drawsInSoftware(renderer);
    if (!wanted) return false;
    auto gpu = std::make_unique<LateWarpGpu>();
    if (gpu->works()) mGpu = std::move(gpu);
    return mGpu != nullptr;
}

std::array<GLuint, 2> LateCard::warp(const std::shared_ptr<const ViewFrame>& frame, const FrameRequest& now) {
    mWindow.use();
    const StereoViews views = viewsOf(now);
    const std::size_t eyes = now.twoEyes ? 2 : 1;
    std::array<GLuint, 2> drawn{};
    for (std::size_t n = 0; n < eyes; ++n) {
        const EyeImage& eye = n == 0 ? frame->left : frame->right;
        if (mHas != frame) mGpu->take(n, frame->late[n], eye.color);
        drawn[n] = mGpu->warp(n, frame->late[n], n == 0 ? views.left : views.right);
    }
    mHas = frame;
    return drawn;
}

std::shared_ptr<const LateView::Eyes> LateCard::read(bool twoEyes) const {
    const auto eyes = std::make_shared<LateView::Eyes>();
    for (std::size_t n = 0; n < (twoEyes ? 2 : 1); ++n) mGpu->read(n, (*eyes)[n]);
    return eyes;
}

}  // namespace stereonav
