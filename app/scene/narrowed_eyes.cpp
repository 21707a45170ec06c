#include "app/scene/narrowed_eyes.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

constexpr int kLookWidth = 64;      // pixels of the picture that tells of the room
constexpr double kSettling = 60.0;  // seconds until nothing changes any more
constexpr double kStep = 1.0;       // seconds, no more at once

// The same frustum, whatever is rounded.
Lens smallOf(const Lens& whole) {
    Lens lens = whole;
    lens.width = std::min(whole.width, kLookWidth);
    lens.height = std::max(1, static_cast<int>(std::lround(1.0 * whole.height * lens.width / whole.width)));
    lens.pixelAspect =
        whole.pixelAspect * whole.width * lens.height / (static_cast<double>(whole.height) * lens.width);
    return lens;
}

}  // namespace

void NarrowedEyes::step(const Pose& head, double free, const RoomSeen& room, double dt) {
    StereoSetting wanted = mFollower(free, room.ahead, dt);
    if (wanted.separation >= mScene.stereo.separation) wanted = mScene.stereo;
    wanted.zeroParallax = std::min(wanted.zeroParallax, mScene.stereo.zeroParallax);
    mNow = mComfort.limited(wanted, dt);
    mComfort.observe(mNow.separation, parallaxOf(makeStereoViews(head, mScene.lens, mNow), room));
}

StereoSetting NarrowedEyes::at(const Pose& head, double time) {
    // A medium's own depths are somewhere within it; where the room ends its wall says.
    const EyeRenderer* const seen = mRoom ? mRoom->wallForPictures() : nullptr;
    if (!seen) return mScene.stereo;
    const EyeView view = makeEyeView(head, smallOf(mScene.lens));
    mLook.resize(view.width, view.height, seen->viewDependence());
    renderEye(*seen, view, mLook);
    const RoomSeen room = roomSeen(mLook.viewDepth, 1);
    const double free = mRoom->clearanceAt(head);
    double left = time - mTime;
    if (!mFollower) {
        mFollower = mRoom->makeFollower(mScene.stereo);
        left = kSettling;
    }
    for (; left > 0; left -= kStep) step(head, free, room, std::min(left, kStep));
    mTime = time;
    return mNow;
}

}  // namespace stereonav
