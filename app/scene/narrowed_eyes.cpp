#include "app/scene/narrowed_eyes.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

constexpr int kLookWidth = 64;      // width of the picture that measures the room
constexpr double kSettling = 60.0;  // time after which nothing changes any more
constexpr double kStep = 1.0;       // seconds, longest step

// Returns a lens of few pixels with exactly the same frustum.
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
    // Depths of a medium lie somewhere within it; the end of the room is given by its wall.
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
