#include "app/view/window/picture_pointer.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "app/output/eye_marks.h"
#include "app/view/frame_views.h"
#include "app/view/instruments.h"
#include "app/view/notices.h"
#include "app/view/pointed_place.h"
#include "app/view/seen_surface.h"

namespace stereonav {

bool PicturePointer::isOfPicture(const OutputModeInfo& mode) const {
    const ShownPicture& picture = mPictures.picture();
    return mSession && mPictures.frame() && picture.left && picture.of.twoEyes &&
           !mSession->slices().shown() && !mWindow.captured() && mode.layout != OutputLayout::OneEye;
}

std::optional<glm::dvec2> PicturePointer::share(const OutputModeInfo& mode) const {
    glm::dvec2 share;
    if (!mStage.overPicture().pointerOverPicture(share)) return std::nullopt;
    const PicturePlace place = mStage.placeOf(mode);
    return (share * glm::dvec2(place.part) - glm::dvec2(place.corner)) / glm::dvec2(place.size);
}

// Returns the place under the pointer. A warped picture has the depths of another moment, so there is none
// until it rests.
std::optional<glm::dvec3> PicturePointer::world() const {
    const ViewFrame* const frame = mPictures.frame();
    const ShownPicture& picture = mPictures.picture();
    if (!mSession || !frame || !picture.left || picture.warped || mSession->slices().shown() ||
        mWindow.captured())
        return std::nullopt;
    const OutputMode mode = mStage.mode();
    if (mode == OutputMode::Right) return std::nullopt;
    const std::optional<glm::dvec2> at = share(infoOf(mode));
    if (!at) return std::nullopt;
    return worldUnder(viewsOf(picture.of), frame->left.viewDepth, *at, frame->request.guard);
}

Facts PicturePointer::facts() const {
    const auto place = world();
    if (!place) return {};
    return factsOfPlace(*mSession->open().scene, mSession->slices().study().get(), *place,
                        viewsOf(mPictures.picture().of).left.head);
}

void PicturePointer::use(Instruments& instruments, Notices& notices) {
    const std::vector<glm::dvec2> clicks = mWindow.takeClicks();
    const OutputModeInfo& mode = infoOf(mSession->compose().mode);
    const PicturePlace place = mStage.placeOf(mode);
    useWheel(mWindow.takeWheel(), share(mode));
    const glm::dvec2 size(place.size);
    for (const PointerDrag& drag : mWindow.takeDrags())
        useDrag(drag, placeInPicture(mode, place, drag.from), size);
    const SizeOption eye = eyeSizeAt(mode, place);
    for (const glm::dvec2& click : clicks) {
        const glm::dvec2 at = placeInPicture(mode, place, click) * glm::dvec2(eye.width, eye.height);
        if (instruments.takesClicks() && !mSession->slices().shown())
            instruments.click(world());
        else
            notices.tell(mSession->slices().click(at.x, at.y));
    }
    if (mStage.controls()) useControls(notices);
}

void PicturePointer::useDrag(const PointerDrag& drag, const glm::dvec2& from, const glm::dvec2& size) {
    constexpr int kLeft = 0, kMiddle = 2;  // GLFW_MOUSE_BUTTON_...
    const bool captured = mWindow.captured();
    if (!mSession->orbits() || captured) {
        const double radiansPerUnit = mSession->lens().verticalFov / size.y;
        if (drag.button == kMiddle && !captured) return;
        return mSession->look(drag.by.x * radiansPerUnit, -drag.by.y * radiansPerUnit);
    }
    if (drag.begins) mSession->takeHold(surfaceAt(from));
    const OrbitDrag way = drag.button == kMiddle || (drag.button == kLeft && drag.shift) ? OrbitDrag::Pan
                          : drag.button == kLeft                                         ? OrbitDrag::Turn
                                                                                         : OrbitDrag::Zoom;
    const EyeView view = viewsOf(mPictures.picture().of).left;
    const glm::dvec2 plane(view.xMax - view.xMin, view.yMax - view.yMin);
    mSession->drag(way, drag.by / size * plane * glm::dvec2(1, -1), plane.y);
}

// Turns of the wheel one after another are about the same place while the pointer stays: in between the
// picture moves.
void PicturePointer::useWheel(double notches, const std::optional<glm::dvec2>& at) {
    constexpr double kSamePlace = 0.005;  // share of the picture
    if (!mSession->zoomsByWheel() || mWindow.captured()) return mSession->turnWheel(notches);
    if (notches == 0) return;
    const bool same = mSession->zooming() && mZoomedAt && at && glm::distance(*at, *mZoomedAt) < kSamePlace;
    if (!same) mSession->takeHold(at ? surfaceAt(*at) : std::nullopt);
    mZoomedAt = at;
    mSession->zoomBy(notches);
}

std::optional<glm::dvec3> PicturePointer::surfaceAt(const glm::dvec2& share) const {
    const ViewFrame* const frame = mPictures.frame();
    const ShownPicture& picture = mPictures.picture();
    if (!frame || !picture.left || mStage.mode() == OutputMode::Right) return std::nullopt;
    return surfaceUnder(viewsOf(picture.of), viewsOf(frame->request), frame->left.viewDepth, share,
                        frame->request.guard);
}

// Handles the small picture, in which the user looks around and points as in the large one.
void PicturePointer::useControls(Notices& notices) {
    ControlWindow& controls = *mStage.controls();
    Window& window = controls.window();
    useWheel(window.takeWheel(), std::nullopt);
    const double height = controls.pictureHeight();
    const SizeOption eye = mStage.eyeSize();
    const glm::dvec2 size = height * glm::dvec2(static_cast<double>(eye.width) / std::max(eye.height, 1), 1);
    for (const PointerDrag& drag : window.takeDrags())
        if (height > 0) useDrag(drag, controls.placeInPicture(drag.from), size);
    for (const glm::dvec2& click : window.takeClicks()) {
        const glm::dvec2 at = controls.placeInPicture(click);
        if (at.x < 0 || at.y < 0 || at.x >= 1 || at.y >= 1) continue;
        notices.tell(mSession->slices().click(at.x * eye.width, at.y * eye.height));
    }
}

}  // namespace stereonav
