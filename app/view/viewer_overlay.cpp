// The viewer's part that is drawn over the picture in depth: the pointer, and names of kept places.
#include "app/view/eye_marks.h"
#include "app/view/place_labels.h"
#include "app/view/viewer.h"

namespace stereonav {

// Where two eyes' pictures are shown, of which slices have none.
bool Viewer::drawsPointer(const OutputModeInfo& mode) const {
    return mSession && mFrame && mPicture.left && mPicture.of.twoEyes && !mSession->slicesShown() &&
           !mWindow.captured() && mode.layout != OutputLayout::OneEye;
}

std::vector<OverlayMark> Viewer::marks(const OutputModeInfo& mode) const {
    std::vector<OverlayMark> marks;
    if (!mSession || !mFrame || !mPicture.left || mSession->slicesShown()) return marks;
    const Plane<float>& depth = mFrame->left.viewDepth;
    const glm::ivec2& guard = mFrame->request.guard;
    if (mLabels && mPlaces && !mPanels.hidden() && !mPanels.startShown()) {
        const auto sizeOf = [this](const std::string& text) { return glm::dvec2(mInterface.textSize(text)); };
        const double margin = 0.3 * sizeOf("0").y;
        for (const PlaceLabel& label :
             labelsInView(mPicture.of, depth, mPlaces->list(), sizeOf, margin, guard))
            marks.push_back({glm::vec2(label.mark.left), glm::vec2(label.mark.right), label.text,
                             glm::vec2(label.textAt)});
    }
    glm::dvec2 share;
    if (!drawsPointer(mode) || !mInterface.pointerOverPicture(share)) return marks;
    const PicturePlace place = placeFor(mode);
    share = (share * glm::dvec2(place.part) - glm::dvec2(place.corner)) / glm::dvec2(place.size);
    const EyeMark under = markUnder(viewsOf(mPicture.of), depth, share, guard);
    marks.push_back({glm::vec2(under.left), glm::vec2(under.right), "", {}});
    return marks;
}

bool Viewer::drawOverlay(const OutputModeInfo& mode) {
    const glm::ivec2 size = mOnGpu          ? glm::ivec2(mPicture.of.lens.width, mPicture.of.lens.height)
                            : mPicture.left ? glm::ivec2(mPicture.left->width(), mPicture.left->height())
                                            : glm::ivec2(0);
    const bool changed = mOverlay.draw(mInterface, size, marks(mode));
    mPresenter.setLayers(mOverlay.layers());
    return changed;
}

}  // namespace stereonav
