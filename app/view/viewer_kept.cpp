// The viewer's part that is kept for the user between runs: places, recent files, how the window was left.
#include <algorithm>
#include <filesystem>

#include "app/scene/scene_type.h"
#include "app/view/live_settings.h"
#include "app/view/raised_ground.h"
#include "app/view/viewer.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr const char* kSidePanels = "side";
constexpr const char* kLeftPanels = "left";
constexpr const char* kOwnWindow = "own window";

bool contains(const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void Viewer::readConfig() {
    const ReadConfig read = readWindowConfig();
    mConfig = read.config;
    mNotices.fail(read.problem);
    InterfaceLook look = mInterface.look();
    look.dark = mConfig.theme != "light";
    if (mConfig.scale) look.scale = static_cast<float>(*mConfig.scale);
    mInterface.setLook(look);
    mPanels.setSide(contains(mConfig.openPanels, kSidePanels), static_cast<float>(mConfig.rightWidth));
    mPanels.setLeft(contains(mConfig.openPanels, kLeftPanels), static_cast<float>(mConfig.leftWidth));
    mPanels.setFolder(mConfig.lastFolder);
    mDisplay.sizes().setKept(mConfig.screens);
    mLabels = mConfig.placeLabels;
    if (contains(mConfig.openPanels, kOwnWindow)) toggleControls();
}

// Nothing is written where nothing was changed.
void Viewer::keepConfig() {
    WindowConfig config = mConfig;
    const InterfaceLook& look = mInterface.look();
    config.theme = look.dark ? "dark" : "light";
    if (mConfig.scale || look.scale != mWindow.contentScale()) config.scale = look.scale;
    config.rightWidth = mPanels.sideWidth();
    config.leftWidth = mPanels.leftWidth();
    config.openPanels.clear();
    if (mPanels.sideShown()) config.openPanels.emplace_back(kSidePanels);
    if (mPanels.leftShown()) config.openPanels.emplace_back(kLeftPanels);
    if (mControls) config.openPanels.emplace_back(kOwnWindow);
    config.lastFolder = mPanels.folder();
    config.placeLabels = mLabels;
    if (mSession) config.speedByDistance = mSession->speedByDistance();
    config.screens = mDisplay.sizes().kept();
    if (!(config == mConfig)) writeWindowConfig(config);
}

// With the first picture that was made of it.
void Viewer::noteRecent() {
    if (!mRecentDue || mSettings.begun()) return;
    mRecentDue = false;
    mNotices.tryTo([&] {
        const std::string kind(sceneTypeNamed(mSettings.options().scene.scene).noun);
        mRecent.add(mSettings.fullName(), kind, &mPictures.frame()->left.color);
    });
    reportKept();
}

void Viewer::reportKept() {
    for (const std::string& problem :
         {mRecent.takeProblem(), mPlaces ? mPlaces->takeProblem() : std::string()})
        if (!problem.empty()) mNotices.fail(problem);
}

void Viewer::addPlace() {
    if (!mSession || !mPlaces) return;
    mNotices.tryTo([&] {
        Bookmark place;
        place.pose = mSession->pose();
        place.settings = groundSettings(*mScene->scene);
        if (!mSession->followsClearance()) place.stereo = mSession->stereo();
        const std::string name =
            mPlaces->add(place, mPictures.frame() ? &mPictures.frame()->left.color : nullptr);
        mSession->notify("kept as " + name);
    });
    reportKept();
}

void Viewer::goToPlace(const Bookmark& place) {
    if (!mSession) return;
    mSession->flyTo(placeNow(place, *mScene->scene).pose);
    if (place.stereo && !mSession->followsClearance()) mSession->setEyes(*place.stereo);
}

}  // namespace stereonav
