#include "app/view/window/panel_stage.h"

#include <utility>

namespace stereonav {
namespace {

constexpr double kFiguresWait = 0.1;      // seconds between redraws of figures and notices in flight
constexpr double kMostFiguresWait = 0.3;  // seconds between redraws while no new picture comes

}  // namespace

PanelStage::~PanelStage() {
    mControls.reset();
    mWindow.use();
    mPanels.forget();
}

void PanelStage::toggleControls() {
    if (mControls) {
        // The main window takes over the look that the user chose in the control window, but not its scale:
        // each screen has its own.
        InterfaceLook look = mInterface.look();
        look.dark = mControls->interface().look().dark;
        mInterface.setLook(look);
        mControls.reset();
        mWindow.use();
        return;
    }
    mNewPreview = true;
    mControls = std::make_unique<ControlWindow>(mWindow, mInterface.look());
}

PicturePlace PanelStage::placeOf(const OutputModeInfo& mode) const {
    const SizeOption window = mDisplay.windowSize();
    const glm::ivec2 size(window.width, window.height);
    const glm::vec2 units = glm::vec2(size) * interfacePlaces(mode).size;
    return picturePlace(mode, size,
                        mControls ? ShownPanels::Rest{{0, 0}, units} : mPanels.shown().rest(units), units);
}

SizeOption PanelStage::eyeSize() const {
    const OutputModeInfo& mode = infoOf(this->mode());
    return eyeSizeAt(mode, placeOf(mode));
}

// Lays out the interface in each turn, but less often in flight: for user input, ten times a second at most
// together with new pictures, and after kMostFiguresWait without one. In flight each picture has other
// figures, but nobody reads them that fast, and drawing the window only for its figures would delay the next
// picture.
bool PanelStage::layOut(const InterfacePlaces& places, double dt, bool fresh, bool busy,
                        const std::function<void()>& draw) {
    mSinceLayout += dt;
    const bool flying = mSession && mSession->moving() && busy == mLaidOutBusy;
    const bool due = fresh ? mSinceLayout >= kFiguresWait : mSinceLayout >= kMostFiguresWait;
    if (flying && !mDue && !due && !mInterface.waits(places)) return false;
    mLaidOutBusy = busy;
    mDue = false;
    return mInterface.layOut(places, std::exchange(mSinceLayout, 0), [&] {
        if (!mControls) draw();
    });
}

void PanelStage::drawControls(double dt, const ViewFrame* frame, const std::function<void()>& draw) {
    if (mControls && mControls->window().shouldClose()) toggleControls();
    if (!mControls) return;
    mControls->draw(mPanels.shown(), draw, frame, std::exchange(mNewPreview, false), dt);
}

}  // namespace stereonav
