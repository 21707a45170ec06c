#include "app/view/kept_places.h"

#include <string>

#include "app/scene/scene_type_table.h"
#include "app/view/notices.h"
#include "app/view/raised_ground.h"

namespace stereonav {

void KeptPlaces::open() {
    mPlaces.emplace(mSettings.fullName().string());
    mRecentDue = true;
    report();
}

void KeptPlaces::noteRecent(const Plane<PackedColor>& picture) {
    if (!mRecentDue || mSettings.begun()) return;
    mRecentDue = false;
    mNotices.tryTo([&] {
        const std::string kind(sceneTypeNamed(mSettings.options().scene.scene).noun);
        mRecent.add(mSettings.fullName(), kind, &picture);
    });
    report();
}

void KeptPlaces::report() {
    for (const std::string& problem :
         {mRecent.takeProblem(), mPlaces ? mPlaces->takeProblem() : std::string()})
        if (!problem.empty()) mNotices.fail(problem);
}

void KeptPlaces::add(const Plane<PackedColor>* picture) {
    if (!mSession || !mPlaces) return;
    mNotices.tryTo([&] {
        Bookmark place;
        place.pose = mSession->pose();
        place.settings = groundSettings(*mSession->open().scene);
        if (!mSession->followsClearance()) place.stereo = mSession->stereo();
        const std::string name = mPlaces->add(place, picture);
        mSession->notify("kept as " + name);
    });
    report();
}

void KeptPlaces::goTo(const Bookmark& place) {
    if (!mSession) return;
    mSession->flyTo(placeNow(place, *mSession->open().scene).pose);
    if (place.stereo && !mSession->followsClearance()) mSession->setEyes(*place.stereo);
}

}  // namespace stereonav
