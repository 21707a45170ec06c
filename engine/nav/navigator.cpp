// Motion in closed forms (exponential damping, critically damped spring), composed of short substeps:
// a step of a second and a hundred of ten milliseconds fly the same way.
#include "engine/nav/navigator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/base/error.h"
#include "engine/nav/damping.h"
#include "engine/nav/flight_input.h"

namespace stereonav {
namespace {

using std::numbers::pi;

constexpr double kSpeedDamping = 0.25;         // seconds in which 63 % of a wish is reached
constexpr double kTurnDamping = 0.08;          // seconds, the same for turning
constexpr double kFollowStiffness = 2.5;       // 1 / seconds, of the spring that keeps the height
constexpr double kLookAhead = 1.2;             // seconds of flight within which the ground is followed
constexpr int kLooksAhead = 6;                 // places looked at in that time
constexpr double kHeightRate = 0.8;            // e-foldings a second of the followed height
constexpr double kHighestFollow = 1e9;         // metres
constexpr double kFastestTurn = 20.0;          // radians a second
constexpr double kMostMultiplier = 1e6;        // factor on the speed
constexpr double kLongestSubstep = 1.0 / 120;  // seconds: turning and moving are composed

void checkPositive(const char* name, double value, const char* advice) {
    if (!(value > 0 && std::isfinite(value)))
        throw Error("", name, fmt::format("expected a number above 0, got {:g}", value), advice);
}

void checkPose(const Pose& pose) {
    const glm::dvec3& p = pose.position;
    const glm::dquat& q = pose.orientation;
    if (!std::isfinite(p.x + p.y + p.z) || !(glm::dot(q, q) > 0.5 && glm::dot(q, q) < 2))
        throw Error("", "pose", "expected finite numbers and a unit quaternion", "check the start pose");
}

}  // namespace

Navigator::Navigator(GroundHeight ground, const Pose& home, const FlightSetting& setting)
    : mGround(std::move(ground)), mHome(home), mSetting(setting), mFollowHeight(setting.followHeight) {
    checkPositive("clearance", setting.clearance, "give metres above the ground");
    checkPositive("speed", setting.speed, "give metres a second");
    checkPositive("ground step", setting.groundStep, "give half of the sample spacing");
    checkPositive("height over the ground", setting.followHeight, "give metres above the ground");
    mFollowHeight = std::max(mFollowHeight, mSetting.clearance);
    setPose(home);
}

double Navigator::floorAt(const glm::dvec2& place) const {
    const double ground = mGround(place);
    return std::isfinite(ground) ? ground + mSetting.clearance : -std::numeric_limits<double>::infinity();
}

double Navigator::heightAboveGround() const {
    return mPosition.z - floorAt(glm::dvec2(mPosition)) + mSetting.clearance;
}

void Navigator::keepClearance() {
    const double floor = floorAt(glm::dvec2(mPosition));
    if (mPosition.z >= floor) return;
    mPosition.z = floor;
    mVelocity.z = std::max(mVelocity.z, 0.0);
}

void Navigator::setPose(const Pose& pose) {
    checkPose(pose);
    const PoseAngles angles = anglesOf(pose);
    mPosition = pose.position;
    mHeading = angles.heading;
    mPitch = angles.pitch;
    mRoll = angles.roll;
    mVelocity = glm::dvec3(0.0);
    mYawRate = mPitchRate = mRollRate = 0;
    keepClearance();
}

void Navigator::takeUpHeight(double lowest) {
    const double height = heightAboveGround();
    mFollowHeight = std::isfinite(height) ? std::clamp(height, lowest, kHighestFollow) : lowest;
}

void Navigator::setMode(FlightMode mode) {
    if (mode == FlightMode::FollowGround && mMode != mode)
        takeUpHeight(std::max(mSetting.followHeight, mSetting.clearance));
    mMode = mode;
}

void Navigator::moveTo(const Pose& pose) {
    setPose(pose);
    const bool overGround = std::isfinite(heightAboveGround());
    if (mMode == FlightMode::FollowGround && overGround) takeUpHeight(mSetting.clearance);
}

void Navigator::setMode(int mode) {
    if (mode == 0 || mode == 1) setMode(static_cast<FlightMode>(mode));
}

std::string_view Navigator::modeName(int mode) const {
    return mode == 0 ? "free" : mode == 1 ? "over ground" : "";
}

void Navigator::turnBy(double yaw, double pitch) {
    mHeading = std::remainder(mHeading + clampedInput(yaw, -2 * pi, 2 * pi), 2 * pi);
    mPitch = std::clamp(mPitch + clampedInput(pitch, -pi, pi), -pi / 2, pi / 2);
}

void Navigator::turn(const FlightInput& input, double dt) {
    mHeading = std::remainder(mHeading + damped(mYawRate, input.yawRate, kTurnDamping, dt), 2 * pi);
    const double pitch = mPitch + damped(mPitchRate, input.pitchRate, kTurnDamping, dt);
    mPitch = std::clamp(pitch, -pi / 2, pi / 2);
    if (mPitch != pitch) mPitchRate = 0;
    mRoll = std::remainder(mRoll + damped(mRollRate, input.rollRate, kTurnDamping, dt), 2 * pi);
}

glm::dvec3 Navigator::wantedVelocity(const FlightInput& input) const {
    const double speed =
        std::min(mSetting.speed * input.speedMultiplier, mSetting.groundStep * kMostLooks / 2);
    const glm::dvec3 level(std::sin(mHeading), std::cos(mHeading), 0);
    const glm::dvec3 right(level.y, -level.x, 0);
    if (mMode == FlightMode::FollowGround) return speed * (input.forward * level + input.right * right);
    const glm::dvec3 forward = std::cos(mPitch) * level + glm::dvec3(0, 0, std::sin(mPitch));
    return speed * (input.forward * forward + input.right * right + glm::dvec3(0, 0, input.up));
}

// The height goes to that of the highest ground ahead as a critically damped spring, in closed form.
void Navigator::moveOverGround(double climb, double dt) {
    mFollowHeight =
        std::clamp(mFollowHeight * std::exp(climb * kHeightRate * dt), mSetting.clearance, kHighestFollow);
    double highest = -std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kLooksAhead; ++k) {
        const double time = kLookAhead * k / kLooksAhead;
        highest = std::max(highest, floorAt(glm::dvec2(mPosition) + time * glm::dvec2(mVelocity)));
    }
    // Over a hole the height stays.
    const double target = std::isfinite(highest) ? highest - mSetting.clearance + mFollowHeight : mPosition.z;
    const double away = mPosition.z - target, push = mVelocity.z + kFollowStiffness * away;
    const double left = std::exp(-kFollowStiffness * dt);
    mPosition.z = target + (away + push * dt) * left;
    mVelocity.z = (push - kFollowStiffness * (away + push * dt)) * left;
}

void Navigator::move(const FlightInput& input, double dt) {
    const glm::dvec3 wanted = wantedVelocity(input);
    mPosition.x += damped(mVelocity.x, wanted.x, kSpeedDamping, dt);
    mPosition.y += damped(mVelocity.y, wanted.y, kSpeedDamping, dt);
    if (mMode == FlightMode::FollowGround)
        moveOverGround(input.up, dt);
    else
        mPosition.z += damped(mVelocity.z, wanted.z, kSpeedDamping, dt);
    keepClearance();
}

void Navigator::step(const FlightInput& input, double dt) {
    if (!(dt > 0)) return;
    const FlightInput wish = cleaned(input, kFastestTurn, kMostMultiplier);
    double left = std::min(dt, kLongestStep);
    while (left > 0) {
        // No longer than to the next look at the ground, at the faster of present and wanted speed.
        const double speed =
            std::max(glm::length(glm::dvec2(mVelocity)), glm::length(glm::dvec2(wantedVelocity(wish))));
        const double part = std::min({left, kLongestSubstep, mSetting.groundStep / std::max(speed, 1e-12)});
        turn(wish, part / 2);
        move(wish, part);
        turn(wish, part / 2);
        left = part < left ? left - part : 0.0;
    }
}

}  // namespace stereonav
