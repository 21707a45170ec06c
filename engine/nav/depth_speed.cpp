#include "engine/nav/depth_speed.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

bool isSpeed(double speed) {
    return speed > 0 && std::isfinite(speed);
}

}  // namespace

double speedFor(double depthAhead, double base) {
    if (!std::isfinite(depthAhead)) return base;
    return std::clamp(depthAhead / kReachSeconds, kSlowestShare * base, kFastestShare * base);
}

double dampedSpeed(double now, double wanted, double dt) {
    if (!isSpeed(wanted)) return now;
    if (!isSpeed(now)) return wanted;
    if (!(dt > 0)) return now;
    return wanted * std::exp(std::log(now / wanted) * std::exp(-dt / kSpeedSeconds));
}

}  // namespace stereonav
