#include "engine/stereo/comfort.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

constexpr double kUsedShare = 0.95;  // share of the limits: eyes that move see a little nearer or farther

bool within(const ParallaxRange& parallax, double nearest, double farthest) {
    return parallax.near >= nearest && parallax.far <= farthest;
}

// Returns the change of parallax that brings both ends into the usual bounds; positive moves farther away.
double missingTo(const ParallaxRange& parallax) {
    const double nearest = kUsedShare * kUsualNearest, farthest = kUsedShare * kUsualFarthest;
    if (parallax.near < nearest) return nearest - parallax.near;
    return std::min(farthest - parallax.far, 0.0);
}

}  // namespace

ComfortState comfortOf(const ParallaxRange& parallax) {
    if (within(parallax, kUsualNearest, kUsualFarthest)) return ComfortState::Comfortable;
    const bool excursion = within(parallax, kNearestParallax, kFarthestParallax) &&
                           parallax.far - parallax.near <= kParallaxBudget;
    return excursion ? ComfortState::Excursion : ComfortState::TooMuch;
}

StereoSetting comfortableEyes(const StereoSetting& setting, const ParallaxRange& parallax,
                              double atInfinity) {
    const double range = parallax.far - parallax.near;
    if (comfortOf(parallax) == ComfortState::Comfortable || !(atInfinity > 0) || !(range >= 0))
        return setting;
    // Parallax grows with the separation, and moves as a whole with the reciprocal of the screen's distance.
    const double share = std::min(1.0, range > 0 ? kUsedShare * kParallaxBudget / range : 1.0);
    const double moved = missingTo({share * parallax.near, share * parallax.far});
    const StereoSetting changed{setting.separation * share,
                                setting.zeroParallax / (1 + moved / (share * atInfinity))};
    const bool valid =
        std::isfinite(changed.separation) && std::isfinite(changed.zeroParallax) && changed.zeroParallax > 0;
    return valid ? changed : setting;
}

}  // namespace stereonav
