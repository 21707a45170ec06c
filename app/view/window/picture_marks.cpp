#include "app/view/window/picture_marks.h"

#include <algorithm>
#include <string>

#include "app/output/eye_marks.h"
#include "app/view/finding_marks.h"
#include "app/view/frame_views.h"
#include "app/view/raised_ground.h"
#include "engine/scene/live_paint.h"

namespace stereonav {

// Returns kept places, at their height over the ground, and places of tracks, whose marks show where they
// are. Made again only when one of them changes: there may be a thousand, and names are drawn with each
// picture.
const std::vector<LabelledPlace>& PictureMarks::namedPlaces(const std::shared_ptr<const OpenScene>& scene) {
    const auto* const paint = scene->scene->offered<LivePaint>();
    const Bookmarks* const kept = mKept.places();
    const int places = kept ? kept->version() : 0;
    const long long painted = paint ? paint->version() : 0;
    if (mNames.of.lock() == scene && mNames.places == places && mNames.paint == painted) return mNames.list;
    mNames = {scene, places, painted, {}};
    if (kept)
        for (const Bookmark& place : kept->list())
            mNames.list.push_back({place.name, placeNow(place, *scene->scene).pose.position});
    if (!paint) return mNames.list;
    for (const PaintedPlace& place : paint->legend()->places)
        if (!place.name.empty()) mNames.list.push_back({place.name, place.world});
    return mNames.list;
}

void PictureMarks::addNames(const std::shared_ptr<const OpenScene>& scene, std::vector<OverlayMark>& marks) {
    const ViewFrame& frame = *mPictures.frame();
    const auto sizeOf = [this](const std::string& text) {
        return glm::dvec2(mStage.overPicture().textSize(text));
    };
    const double margin = 0.3 * sizeOf("0").y;
    for (const PlaceLabel& label : labelsInView(viewsOf(mPictures.picture().of), frame.left.viewDepth,
                                                namedPlaces(scene), sizeOf, margin, frame.request.guard))
        marks.push_back(
            {glm::vec2(label.mark.left), glm::vec2(label.mark.right), label.text, glm::vec2(label.textAt)});
}

// Adds the line's visible places with their numbers, and points between them on the surface.
void PictureMarks::addLine(std::vector<OverlayMark>& marks) const {
    constexpr std::size_t kMostPoints = 300, kMostNumbers = 60;
    const MeasuredLine& line = mInstruments.line();
    const ViewFrame& frame = *mPictures.frame();
    const StereoViews views = viewsOf(mPictures.picture().of);
    const float letter = mStage.overPicture().textSize("0").y;
    const auto add = [&](const glm::dvec3& world, const std::string& text, bool dot) {
        const auto at = markOf(views, frame.left.viewDepth, world, frame.request.guard);
        if (!at) return;
        const glm::vec2 beside(0.6f * letter, -1.2f * letter);
        marks.push_back({glm::vec2(at->mark.left), glm::vec2(at->mark.right), text, beside, dot});
    };
    if (const MeasuredSurface* const measured = line.measured()) {
        const std::size_t count = measured->places.size(), points = std::min(count, kMostPoints);
        for (std::size_t n = 0; n < points; ++n) add(measured->places[n * count / points], "", true);
    }
    // Many numbers would hide the line: only those of its ends are drawn.
    const std::size_t count = line.places().size();
    for (std::size_t n = 0; n < count; ++n)
        if (count <= kMostNumbers || n == 0 || n + 1 == count)
            add(line.places()[n], std::to_string(n + 1), false);
    if (mInstruments.marked()) add(*mInstruments.marked(), "*", false);
}

std::vector<OverlayMark> PictureMarks::marks(const ViewSession& session, const OutputModeInfo& mode) {
    std::vector<OverlayMark> marks;
    const ViewFrame* const frame = mPictures.frame();
    const ShownPicture& picture = mPictures.picture();
    if (!frame || !picture.left || session.slices().shown()) return marks;
    const Plane<float>& depth = frame->left.viewDepth;
    const glm::ivec2& guard = frame->request.guard;
    const ShownPanels& shown = mStage.panels().shown();
    const bool panels = !shown.hidden;
    if (shown.placeNames && panels && !shown.start) addNames(session.openShared(), marks);
    if (panels && (!mInstruments.line().places().empty() || mInstruments.marked())) addLine(marks);
    if (panels)
        addFindingMarks(mInstruments.findingList(), picture.of, depth, guard,
                        mStage.overPicture().textSize("0").y, marks);
    const std::optional<glm::dvec2> share = mPointer.isOfPicture(mode) ? mPointer.share(mode) : std::nullopt;
    if (!share) return marks;
    const EyeMark under = markUnder(viewsOf(picture.of), depth, *share, guard);
    marks.push_back({glm::vec2(under.left), glm::vec2(under.right), "", {}});
    return marks;
}

bool PictureMarks::draw(const std::optional<ViewSession>& session, const OutputModeInfo& mode) {
    const bool changed = mOverlay.draw(mStage.overPicture(), mPictures.eyeSize(),
                                       session ? marks(*session, mode) : std::vector<OverlayMark>());
    mPictures.eyes().setLayers(mOverlay.layers());
    return changed;
}

}  // namespace stereonav
