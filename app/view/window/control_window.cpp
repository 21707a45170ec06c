#include "app/view/window/control_window.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>

#include "app/view/view_frame.h"

namespace stereonav {
namespace {

constexpr int kControlsWidth = 1180,
              kControlsHeight = 760;  // in screen units: for both columns and a picture between them
constexpr glm::vec3 kGround{0.06f};   // background of the picture, nearly black as in the first window

}  // namespace

ControlWindow::ControlWindow(const Window& first, const InterfaceLook& look)
    : mFirst(first),
      mWindow("stereonav - controls", kControlsWidth, kControlsHeight, first),
      mInterface(mWindow) {
    InterfaceLook own = look;
    own.scale = mInterface.look().scale;  // scale of the monitor that it is on
    own.grey = false;                     // not seen through coloured glasses
    mInterface.setLook(own);
    mFirst.use();
}

ControlWindow::~ControlWindow() {
    mWindow.use();  // objects of the members are deleted in their own context
}

// Takes a picture with not many more pixels than are shown: sampling larger ones would flicker.
void ControlWindow::takePicture(const ViewFrame& frame) {
    const Plane<PackedColor>& eye = frame.left.color;
    const glm::ivec2 wanted = glm::max(glm::ivec2(mSize), glm::ivec2(1));
    const int step = std::min(eye.width() / wanted.x, eye.height() / wanted.y);
    mPicture.set(eye, true, std::max(step, 1));
    mMade = wanted;
    mStale = false;
}

void ControlWindow::draw(const ShownPanels& panels, const std::function<void()>& drawPanels,
                         const ViewFrame* frame, bool fresh, double dt) {
    mStale = mStale || fresh;
    if (mWindow.minimised()) return;
    mWindow.use();
    bool drawn = false;
    const bool changed = mInterface.layOut({}, dt, [&] {
        drawPanels();
        if (!frame || frame->left.color.empty()) return;
        const glm::vec2 whole(ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y);
        const ShownPanels::Rest rest = panels.rest(whole);
        const glm::vec2 room(rest.size.x, rest.size.y - rest.top - rest.bottom);
        const glm::vec2 picture(frame->left.color.width(), frame->left.color.height());
        mSize = glm::max(glm::floor(picture * std::min(room.x / picture.x, room.y / picture.y)), 0.0f);
        mCorner = rest.corner + glm::vec2(0, rest.top) + glm::floor((room - mSize) / 2.0f);
        if (mSize.x < 1 || mSize.y < 1) return;
        if (mStale || mMade != glm::ivec2(mSize)) {
            takePicture(*frame);
            drawn = true;
        }
        ImGui::GetBackgroundDrawList()->AddImage(mPicture.id(), {mCorner.x, mCorner.y},
                                                 {mCorner.x + mSize.x, mCorner.y + mSize.y});
    });
    if (changed || drawn || mWindow.redrawNeeded()) {
        const glm::ivec2 size = mWindow.framebufferSize();
        glDisable(GL_SCISSOR_TEST);
        glViewport(0, 0, size.x, size.y);
        glClearColor(kGround.r, kGround.g, kGround.b, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        mInterface.render();
        mWindow.swapBuffers();
    }
    mFirst.use();
}

glm::dvec2 ControlWindow::placeInPicture(const glm::dvec2& share) const {
    return (share * glm::dvec2(mInterface.size()) - glm::dvec2(mCorner)) /
           glm::max(glm::dvec2(mSize), glm::dvec2(1));
}

double ControlWindow::pictureHeight() const {
    const double units = mInterface.size().y;
    return units > 0 ? mSize.y / units * mWindow.place().height : 0;
}

}  // namespace stereonav
