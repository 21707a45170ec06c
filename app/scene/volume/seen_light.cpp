#include "app/scene/volume/seen_light.h"

#include <cmath>
#include <numbers>

namespace stereonav {

void SeenVolumeLight::seen(const EyeView& view, const EyeImage& image) {
    if (mLazy) mLazy->seen(view, image);
    if (mSky) mSky->seen(view, image);
}

void SeenVolumeLight::waitUntilDone() const {
    if (mLazy) mLazy->waitUntilDone();
}

SunPlace SeenVolumeLight::place() const {
    const SkyTurn turn = mSky ? mSky->turn() : mLazy->turn();
    return {std::remainder(-turn.turn, 2 * std::numbers::pi), turn.tilt};
}

void SeenVolumeLight::turnTo(const SunPlace& to) {
    const SkyTurn turn{-to.azimuth, to.elevation};
    if (mSky)
        mSky->turnTo(turn);
    else
        mLazy->turnTo(turn);
}

}  // namespace stereonav
