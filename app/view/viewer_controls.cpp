// The viewer's part that has the panels in a window of their own.
#include "app/view/viewer.h"

namespace stereonav {

void Viewer::toggleControls() {
    if (mControls) {
        // Of the look, what belongs to the person goes back; the scale is each screen's own.
        InterfaceLook look = mInterface.look();
        look.dark = mControls->interface().look().dark;
        mInterface.setLook(look);
        mControls.reset();
        mWindow.use();
        return;
    }
    mNotices.tryTo([&] { mControls = std::make_unique<ControlWindow>(mWindow, mInterface.look()); });
    mNewPreview = true;
}

void Viewer::drawControls(double dt) {
    if (mControls && mControls->window().shouldClose()) toggleControls();
    if (!mControls) return;
    drawPanels([&] { mControls->draw(mPanels, *this, mPictures.frame(), mNewPreview, dt); });
    mNewPreview = false;
}

// In the small picture one looks round and points as in the large one.
void Viewer::useControls() {
    Window& window = mControls->window();
    mSession->turnWheel(window.takeWheel());
    const glm::dvec2 drag = window.takeDrag();
    const double height = mControls->pictureHeight();
    if (height > 0)
        mSession->look(drag.x * mSession->lens().verticalFov / height,
                       -drag.y * mSession->lens().verticalFov / height);
    const SizeOption eye = pictureSize();
    for (const glm::dvec2& click : window.takeClicks()) {
        const glm::dvec2 at = mControls->placeInPicture(click);
        if (at.x < 0 || at.y < 0 || at.x >= 1 || at.y >= 1) continue;
        mNotices.tell(mSession->click(at.x * eye.width, at.y * eye.height));
    }
}

}  // namespace stereonav
