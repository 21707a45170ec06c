// The viewer's part that is drawn over the picture in depth: the pointer, names of kept places, the measured
// line. And what the pointer does on the picture, and what lies under it.
#include <fmt/format.h>

#include <algorithm>

#include "app/output/eye_marks.h"
#include "app/output/place_labels.h"
#include "app/view/finding_marks.h"
#include "app/view/frame_views.h"
#include "app/view/pointed_place.h"
#include "app/view/viewer.h"

namespace stereonav {

// Where two eyes' pictures are shown, of which slices have none.
bool Viewer::drawsPointer(const OutputModeInfo& mode) const {
    return mSession && mPictures.frame() && mPictures.picture().left && mPictures.picture().of.twoEyes &&
           !mSession->slicesShown() && !mWindow.captured() && mode.layout != OutputLayout::OneEye;
}

std::optional<glm::dvec2> Viewer::pointedShare(const OutputModeInfo& mode) const {
    glm::dvec2 share;
    if (!mInterface.pointerOverPicture(share)) return std::nullopt;
    const PicturePlace place = placeFor(mode);
    return (share * glm::dvec2(place.part) - glm::dvec2(place.corner)) / glm::dvec2(place.size);
}

// A picture that was warped has the depths of another moment: what lies there waits until it stands still.
std::optional<glm::dvec3> Viewer::pointedWorld() const {
    if (!mSession || !mPictures.frame() || !mPictures.picture().left || mPictures.picture().warped ||
        mSession->slicesShown() || mWindow.captured())
        return std::nullopt;
    const OutputMode mode = shownMode();
    if (mode == OutputMode::Right) return std::nullopt;
    const std::optional<glm::dvec2> share = pointedShare(infoOf(mode));
    if (!share) return std::nullopt;
    return worldUnder(viewsOf(mPictures.picture().of), mPictures.frame()->left.viewDepth, *share,
                      mPictures.frame()->request.guard);
}

Facts Viewer::pointedFacts() const {
    const auto world = pointedWorld();
    if (!world) return {};
    return factsOfPlace(*mSession->open().scene, mSession->study().get(), *world,
                        viewsOf(mPictures.picture().of).left.head);
}

void Viewer::measureHere() {
    if (!mSession) return;
    const auto world = pointedWorld();
    if (!world) return mSession->notify("nothing is under the pointer");
    if (!mMeasured.add(*world)) return mSession->notify("the line is there already");
    mSession->notify(fmt::format("place {} of the measured line", mMeasured.places().size()));
    if (!mPanels.leftShown() && mMeasured.places().size() == 2) mPanels.toggleLeft();
}

// Its places with their numbers, and points between them as the line lies on the surface; what is hidden is
// left out.
void Viewer::addLineMarks(std::vector<OverlayMark>& marks) const {
    constexpr std::size_t kMostPoints = 300, kMostNumbers = 60;
    const StereoViews views = viewsOf(mPictures.picture().of);
    const auto add = [&](const glm::dvec3& world, const std::string& text, bool dot) {
        const auto at =
            markOf(views, mPictures.frame()->left.viewDepth, world, mPictures.frame()->request.guard);
        if (!at) return;
        const glm::vec2 beside(0.6f * mInterface.textSize("0").y, -1.2f * mInterface.textSize("0").y);
        marks.push_back({glm::vec2(at->mark.left), glm::vec2(at->mark.right), text, beside, dot});
    };
    if (const MeasuredSurface* const measured = mMeasured.measured()) {
        const std::size_t count = measured->places.size(), points = std::min(count, kMostPoints);
        for (std::size_t n = 0; n < points; ++n) add(measured->places[n * count / points], "", true);
    }
    // Numbers of many would hide the line: those of its ends are left.
    const std::size_t count = mMeasured.places().size();
    for (std::size_t n = 0; n < count; ++n)
        if (count <= kMostNumbers || n == 0 || n + 1 == count)
            add(mMeasured.places()[n], std::to_string(n + 1), false);
    if (mMarked) add(*mMarked, "*", false);
}

void Viewer::usePointer() {
    const glm::dvec2 drag = mWindow.takeDrag();
    const std::vector<glm::dvec2> clicks = mWindow.takeClicks();
    mSession->turnWheel(mWindow.takeWheel());
    const OutputModeInfo& mode = infoOf(mSession->compose().mode);
    const PicturePlace place = placeFor(mode);
    const double radiansPerUnit = mSession->lens().verticalFov / place.size.y;
    mSession->look(drag.x * radiansPerUnit, -drag.y * radiansPerUnit);
    const SizeOption eye = eyeSizeAt(mode, place);
    for (const glm::dvec2& click : clicks) {
        const glm::dvec2 at = placeInPicture(mode, place, click) * glm::dvec2(eye.width, eye.height);
        if ((mMeasuring || mSeesFrom || mFindings.clicks()) && !mSession->slicesShown()) {
            if (mSeesFrom) seeFromHere();
            if (mMeasuring) measureHere();
            if (mFindings.clicks()) findHere();
            continue;
        }
        mNotices.tell(mSession->click(at.x, at.y));
    }
}

void Viewer::copyPlace() {
    const Facts facts = pointedFacts();
    if (!facts.empty()) return copy(linesOf(facts));
    if (mSession) mSession->notify("nothing is under the pointer");
}

std::vector<OverlayMark> Viewer::marks(const OutputModeInfo& mode) const {
    std::vector<OverlayMark> marks;
    if (!mSession || !mPictures.frame() || !mPictures.picture().left || mSession->slicesShown()) return marks;
    const Plane<float>& depth = mPictures.frame()->left.viewDepth;
    const glm::ivec2& guard = mPictures.frame()->request.guard;
    if (mLabels && !mPanels.hidden() && !mPanels.startShown()) {
        const auto sizeOf = [this](const std::string& text) { return glm::dvec2(mInterface.textSize(text)); };
        const double margin = 0.3 * sizeOf("0").y;
        for (const PlaceLabel& label :
             labelsInView(viewsOf(mPictures.picture().of), depth, namedPlaces(), sizeOf, margin, guard))
            marks.push_back({glm::vec2(label.mark.left), glm::vec2(label.mark.right), label.text,
                             glm::vec2(label.textAt)});
    }
    if (!mPanels.hidden() && (!mMeasured.places().empty() || mMarked)) addLineMarks(marks);
    if (!mPanels.hidden())
        addFindingMarks(mFindings, mPictures.picture().of, depth, guard, mInterface.textSize("0").y, marks);
    const std::optional<glm::dvec2> share = drawsPointer(mode) ? pointedShare(mode) : std::nullopt;
    if (!share) return marks;
    const EyeMark under = markUnder(viewsOf(mPictures.picture().of), depth, *share, guard);
    marks.push_back({glm::vec2(under.left), glm::vec2(under.right), "", {}});
    return marks;
}

bool Viewer::drawOverlay(const OutputModeInfo& mode) {
    const bool changed = mOverlay.draw(mInterface, mPictures.eyeSize(), marks(mode));
    mPictures.eyes().setLayers(mOverlay.layers());
    return changed;
}

}  // namespace stereonav
