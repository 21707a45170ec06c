#include "app/view/window/picture_pointer.h"

#include <vector>

#include "app/output/eye_marks.h"
#include "app/view/frame_views.h"
#include "app/view/instruments.h"
#include "app/view/notices.h"
#include "app/view/pointed_place.h"

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
    const glm::dvec2 drag = mWindow.takeDrag();
    const std::vector<glm::dvec2> clicks = mWindow.takeClicks();
    mSession->turnWheel(mWindow.takeWheel());
    const OutputModeInfo& mode = infoOf(mSession->compose().mode);
    const PicturePlace place = mStage.placeOf(mode);
    const double radiansPerUnit = mSession->lens().verticalFov / place.size.y;
    mSession->look(drag.x * radiansPerUnit, -drag.y * radiansPerUnit);
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

// Handles the small picture, in which the user looks around and points as in the large one.
void PicturePointer::useControls(Notices& notices) {
    ControlWindow& controls = *mStage.controls();
    Window& window = controls.window();
    mSession->turnWheel(window.takeWheel());
    const glm::dvec2 drag = window.takeDrag();
    const double height = controls.pictureHeight();
    if (height > 0)
        mSession->look(drag.x * mSession->lens().verticalFov / height,
                       -drag.y * mSession->lens().verticalFov / height);
    const SizeOption eye = mStage.eyeSize();
    for (const glm::dvec2& click : window.takeClicks()) {
        const glm::dvec2 at = controls.placeInPicture(click);
        if (at.x < 0 || at.y < 0 || at.x >= 1 || at.y >= 1) continue;
        notices.tell(mSession->slices().click(at.x * eye.width, at.y * eye.height));
    }
}

}  // namespace stereonav
