#include "engine/stereo/room_seen.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/image/eye_image.h"

namespace stereonav {
namespace {

constexpr double kComfortSeconds = 1.0;  // time constant
constexpr double kComfortShare = 0.95;   // share of the parallax that is warned of
constexpr double kReleased = 1e-4;       // share of the separation: less is no limit any more

}  // namespace

double depthAhead(const Plane<float>& depth, int step) {
    std::vector<float> depths;
    for (int y = depth.height() / 3; y < depth.height() - depth.height() / 3; y += step)
        for (int x = depth.width() / 3; x < depth.width() - depth.width() / 3; x += step)
            if (depth.at(x, y) > 0) depths.push_back(depth.at(x, y));  // no holes, no NaN
    if (depths.empty()) return static_cast<double>(kMissDepth);
    const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
    std::nth_element(depths.begin(), middle, depths.end());
    return static_cast<double>(*middle);
}

RoomSeen roomSeen(const Plane<float>& viewDepth, int step) {
    float nearest = kMissDepth, farthest = 0;
    for (int y = 0; y < viewDepth.height(); y += step)
        for (int x = 0; x < viewDepth.width(); x += step) {
            nearest = std::min(nearest, viewDepth.at(x, y));
            farthest = std::max(farthest, viewDepth.at(x, y));
        }
    return {static_cast<double>(nearest), static_cast<double>(farthest), depthAhead(viewDepth, step)};
}

double parallaxAt(const StereoViews& views, double depth) {
    return (views.shiftAtInfinity - views.parallaxScale / depth) / std::max(views.left.width, 1);
}

ParallaxRange parallaxOf(const StereoViews& views, const RoomSeen& room) {
    const auto share = [&](double depth) { return depth > 0 ? parallaxAt(views, depth) : 0.0; };
    return {share(room.nearest), share(room.farthest)};
}

void ComfortLimit::observe(double separation, const ParallaxRange& parallax) {
    if (!(separation > 0)) return;
    const double used = std::max({(parallax.far - parallax.near) / kParallaxBudget,
                                  parallax.near / kNearestParallax, parallax.far / kFarthestParallax});
    // Parallax grows with the separation, so this does not depend on what the share is now.
    mSeparation = used > 0 ? kComfortShare * separation / used : 0;
}

void ComfortLimit::approach(double share, double dt) {
    if (dt > 0) mShare = share + (mShare - share) * std::exp(-dt / kComfortSeconds);
}

StereoSetting ComfortLimit::limited(StereoSetting wanted, double dt, double leastShare) {
    approach(mSeparation > 0 ? std::clamp(mSeparation / wanted.separation, leastShare, 1.0) : 1.0, dt);
    wanted.separation *= mShare;
    return wanted;
}

StereoSetting ComfortLimit::released(StereoSetting wanted, double dt) {
    approach(1, dt);
    if (1 - mShare < kReleased) mShare = 1;
    wanted.separation *= mShare;
    return wanted;
}

}  // namespace stereonav
