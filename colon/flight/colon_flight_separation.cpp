// The slow control of the eye separation. Comfort: a fixed share of the zero-parallax distance, changed
// slowly (no jumps while in motion).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "colon/flight/colon_flight.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kLongestSeparationStep = 1.0;  // seconds

void checkPositive(const char* name, double value) {
    if (!(value > 0 && std::isfinite(value)))
        throw Error("", name, fmt::format("expected a number above 0, got {:g}", value),
                    "check the stereo setting");
}

// ln x goes to ln target: at a constant rate while more than ln 2 away, then exponentially.
double followed(double x, double target, double dt, double seconds) {
    const double away = std::log(target / x), distance = std::abs(away);
    const double atOnce = std::numbers::ln2, rate = atOnce / seconds;
    double left = distance;
    if (distance - rate * dt >= atOnce) {
        left = distance - rate * dt;
    } else {
        const double exponentially = std::max(0.0, dt - std::max(0.0, distance - atOnce) / rate);
        left = std::min(distance, atOnce) * std::exp(-exponentially / seconds);
    }
    return target * std::exp(away > 0 ? -left : left);
}

}  // namespace

SeparationControl::SeparationControl(const Setting& setting, double separation, double zeroParallax)
    : mSetting(setting), mSeparation(separation), mZeroParallax(zeroParallax) {
    checkPositive("share of the zero-parallax distance", setting.share);
    checkPositive("smallest separation", setting.smallest);
    checkPositive("largest separation", setting.largest);
    checkPositive("seconds to follow", setting.seconds);
    if (setting.smallest > setting.largest)
        throw Error("", "smallest separation",
                    fmt::format("expected at most the largest, {:g} m, got {:g} m", setting.largest,
                                setting.smallest),
                    "check the stereo setting");
    const double nearest = setting.smallest / setting.share;
    mSeparation =
        std::isnan(separation) ? setting.smallest : std::clamp(separation, setting.smallest, setting.largest);
    mZeroParallax = std::isnan(zeroParallax)
                        ? nearest
                        : std::clamp(zeroParallax, nearest, std::max(nearest, kFarthestZeroParallax));
}

void SeparationControl::step(double free, double typicalDepth, double dt) {
    if (!(dt > 0)) return;
    const bool knowsFree = std::isfinite(free), knowsDepth = std::isfinite(typicalDepth) && typicalDepth > 0;
    if (!knowsFree && !knowsDepth) return;
    double target = kFarthestZeroParallax;
    if (knowsDepth) target = std::min(target, typicalDepth);
    if (knowsFree) target = std::min(target, kNearest * std::max(free, 0.0));
    target = std::max(target, mSetting.smallest / mSetting.share);
    const double time = std::min(dt, kLongestSeparationStep);
    const double separation = std::clamp(mSetting.share * target, mSetting.smallest, mSetting.largest);
    mZeroParallax = followed(mZeroParallax, target, time, mSetting.seconds);
    mSeparation = std::clamp(followed(mSeparation, separation, time, mSetting.seconds), mSetting.smallest,
                             mSetting.largest);
}

}  // namespace stereonav
