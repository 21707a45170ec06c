// The viewer's part that is drawn over the picture in depth: the pointer, and names of kept places. And what
// lies under the pointer.
#include "app/view/eye_marks.h"
#include "app/view/place_labels.h"
#include "app/view/pointed_place.h"
#include "app/view/viewer.h"

namespace stereonav {

// Where two eyes' pictures are shown, of which slices have none.
bool Viewer::drawsPointer(const OutputModeInfo& mode) const {
    return mSession && mFrame && mPicture.left && mPicture.of.twoEyes && !mSession->slicesShown() &&
           !mWindow.captured() && mode.layout != OutputLayout::OneEye;
}

std::optional<glm::dvec2> Viewer::pointedShare(const OutputModeInfo& mode) const {
    glm::dvec2 share;
    if (!mInterface.pointerOverPicture(share)) return std::nullopt;
    const PicturePlace place = placeFor(mode);
    return (share * glm::dvec2(place.part) - glm::dvec2(place.corner)) / glm::dvec2(place.size);
}

// A picture that was warped has the depths of another moment: figures wait until it stands still.
Facts Viewer::pointedFacts() const {
    if (!mSession || !mFrame || !mPicture.left || mPicture.warped || mSession->slicesShown() ||
        mWindow.captured())
        return {};
    const OutputMode mode = shownMode();
    if (mode == OutputMode::Right) return {};
    const std::optional<glm::dvec2> share = pointedShare(infoOf(mode));
    if (!share) return {};
    const StereoViews views = viewsOf(mPicture.of);
    const auto world = worldUnder(views, mFrame->left.viewDepth, *share, mFrame->request.guard);
    if (!world) return {};
    return factsOfPlace(*mSession->open().scene, mSession->study().get(), *world, views.left.head);
}

void Viewer::copyPlace() {
    const Facts facts = pointedFacts();
    if (!facts.empty()) return copy(linesOf(facts));
    if (mSession) mSession->notify("nothing is under the pointer");
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
    const std::optional<glm::dvec2> share = drawsPointer(mode) ? pointedShare(mode) : std::nullopt;
    if (!share) return marks;
    const EyeMark under = markUnder(viewsOf(mPicture.of), depth, *share, guard);
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
