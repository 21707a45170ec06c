#include "app/scene/volume/flights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "colon/flight/colon_flight.h"
#include "engine/camera/recorded_path.h"

namespace stereonav {
namespace {

// Returns poses of a flight that are about `step` metres apart.
std::vector<Pose> posesAlong(const RecordedPath& path, double step) {
    double length = 0;
    const std::vector<PathSample>& samples = path.samples();
    for (std::size_t n = 1; n < samples.size(); ++n)
        length += glm::length(samples[n].pose.position - samples[n - 1].pose.position);
    constexpr double kMost = 1e6;
    return path.frames(static_cast<int>(std::min(std::ceil(length / step), kMost)) + 1);
}

// Returns the poses of the way back, looking in the direction of flight.
std::vector<Pose> backAlong(std::vector<Pose> poses) {
    std::reverse(poses.begin(), poses.end());
    for (Pose& pose : poses)
        pose.orientation = pose.orientation * glm::angleAxis(std::numbers::pi, glm::dvec3(0, 1, 0));
    return poses;
}

}  // namespace

ColonFlights colonFlights(const ColonScene& colon, const std::string& file, double step,
                          const Coverage::FreeDistance& freeDistance, const ColonInterior& inside) {
    if (!file.empty()) {
        const RecordedPath path = readPath(file);
        inside.check(path, file);
        const std::vector<Pose> poses = posesAlong(path, step);
        return {poses, backAlong(poses)};
    }
    ColonFlightSetting setting;
    setting.clearance = colon.clearance;
    setting.largestSeparation = colon.stereo.separation;
    return {posesAlong(colon.path, step),
            posesAlong(centrelineFlight(freeDistance, colon.centreline, setting, true), step)};
}

}  // namespace stereonav
