#include "app/scene/type/outside_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/camera/orbit.h"
#include "engine/math/constants.h"
#include "engine/nav/navigator.h"

namespace stereonav {
namespace {

constexpr double kFov = 40 * kRadians;
constexpr double kFraming = 0.85;      // share of the distance where a ball around the bounds fills the view
constexpr double kExtentSeconds = 10;  // time to cross the extent at normal speed
constexpr double kPointRadius = 1e-6;  // metres: of the ball around a point

// Returns the radius, metres, below which an object counts as a point: floats tell no smaller parts apart
// where its places are.
double leastRadius(const std::vector<SurfaceSample>& samples) {
    constexpr double kToldApart = 1e-6;
    double reach = 0;
    for (const SurfaceSample& sample : samples)
        for (int k = 0; k < 3; ++k) reach = std::max(reach, std::abs(sample.place[k]));
    return reach > 0 ? kToldApart * reach : kPointRadius;
}

}  // namespace

void seeFromOutside(const glm::dvec3& low, const glm::dvec3& high, SeenAs seen, const std::string& flight,
                    Scene& scene) {
    const glm::dvec3 middle = 0.5 * (low + high);
    const double half = 0.5 * glm::length(high - low), radius = half > 0 ? half : kPointRadius;
    const double distance = kFraming * radius / std::sin(0.5 * kFov);
    scene.lens.verticalFov = kFov;
    scene.lens.nearDepth = 0.005 * radius;
    scene.stereo = defaultEyes(seen, distance);
    const Orbit orbit{middle, distance, -0.15};
    scene.startPose = poseOn(orbit, 0);
    scene.path = flightAround(orbit, flight);
}

std::optional<double> seeFromBestSide(const std::vector<SurfaceSample>& samples, const SceneOptions& options,
                                      SeenAs seen, const std::string& flight, Scene& scene) {
    constexpr double kFront = 0.05;
    ViewWanted wanted;
    wanted.verticalFov = options.fov_deg ? *options.fov_deg * kRadians : kFov;
    wanted.aspect = options.aspect;
    wanted.front = kFront;
    wanted.least = leastRadius(samples);
    const std::optional<FirstView> view = firstViewOf(samples, wanted);
    if (!view) return std::nullopt;
    scene.lens.verticalFov = kFov;
    scene.lens.nearDepth = 0.005 * view->radius;
    scene.stereo = defaultEyes(seen, view->orbit.distance);
    scene.startPose = view->pose();
    scene.path = flightAround(view->flight, flight, view->turn);
    return view->turn;
}

std::unique_ptr<Flight> freeFlight(const Pose& home, double extent) {
    FlightSetting setting;
    setting.clearance = 1e-6 * extent;
    setting.followHeight = 1e-3 * extent;
    setting.speed = extent / kExtentSeconds;
    setting.groundStep = 0.1 * extent;
    const auto noGround = [](const glm::dvec2&) { return std::nan(""); };
    return std::make_unique<Navigator>(noGround, home, setting);
}

}  // namespace stereonav
