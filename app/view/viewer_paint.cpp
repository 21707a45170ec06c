// The viewer's part that exchanges what is painted on the ground, and names what is painted there.
#include <fmt/format.h>

#include "app/view/measured_command.h"
#include "app/view/raised_ground.h"
#include "app/view/viewer.h"
#include "engine/base/error.h"
#include "engine/scene/live_paint.h"

namespace stereonav {

// What is worked out beside the frames has come, or could not be had.
void Viewer::followPaint() {
    auto* const paint = mScene->scene->offered<LivePaint>();
    if (!paint) return;
    if (!paint->work()) mPaintWatch.lap_ms();
    if (const std::string problem = paint->takeProblem(); !problem.empty()) mNotices.fail(problem);
    if (paint->version() == mPaintSeen) return;
    mPaintSeen = paint->version();
    mFacts.forget();  // they tell what is painted
    mLayoutDue = true;
}

std::optional<PaintWork> Viewer::painting() const {
    constexpr double kPatience_ms = 500;
    const auto* const paint = mScene ? mScene->scene->offered<LivePaint>() : nullptr;
    return paint && mPaintWatch.elapsed_ms() > kPatience_ms ? paint->work() : std::nullopt;
}

void Viewer::seeFromHere() {
    auto* const paint = mScene->scene->offered<LivePaint>();
    if (!paint) return;
    const auto world = pointedWorld();
    if (!world) return mSession->notify("nothing is under the pointer");
    paint->askSeenFrom(glm::dvec2(*world), *mSeesFrom);
}

// Kept places, as high over the ground as they were; and those of tracks, whose marks say where they are.
// Made when one of them changes: there may be a thousand, and names are drawn with each picture.
const std::vector<LabelledPlace>& Viewer::namedPlaces() const {
    const auto* const paint = mScene->scene->offered<LivePaint>();
    const int places = mPlaces ? mPlaces->version() : 0;
    const long long painted = paint ? paint->version() : 0;
    if (mNames.of.lock() == mScene && mNames.places == places && mNames.paint == painted) return mNames.list;
    mNames = {mScene, places, painted, {}};
    if (mPlaces)
        for (const Bookmark& place : mPlaces->list())
            mNames.list.push_back({place.name, placeNow(place, *mScene->scene).pose.position});
    if (!paint) return mNames.list;
    for (const PaintedPlace& place : paint->legend()->places)
        if (!place.name.empty()) mNames.list.push_back({place.name, place.world});
    return mNames.list;
}

}  // namespace stereonav
