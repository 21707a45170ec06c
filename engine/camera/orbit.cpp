#include "engine/camera/orbit.h"

#include <utility>
#include <vector>

#include "engine/math/constants.h"

namespace stereonav {

Pose poseOn(const Orbit& orbit, double turn) {
    Pose pose = poseFromAngles(orbit.middle, turn, orbit.pitch, 0);
    pose.position -= orbit.distance * pose.forward();
    return pose;
}

RecordedPath flightAround(const Orbit& orbit, const std::string& name, double from) {
    constexpr double kSeconds = 15;
    constexpr int kSamples = 180;
    std::vector<PathSample> samples;
    for (int n = 0; n <= kSamples; ++n)
        samples.push_back({n * kSeconds / kSamples, poseOn(orbit, from + 2 * kPi * n / kSamples)});
    return {std::move(samples), name};
}

}  // namespace stereonav
