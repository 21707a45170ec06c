// Along a line the flight's own guidance flies: it is given the speed that follows an eased course, ahead of
// its damping, and keeps off the wall as ever. Straight ways are followed pose by pose.
#include "engine/nav/flight_to.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/base/error.h"

namespace stereonav {
namespace {

using std::numbers::pi;

constexpr double kFarthestGoal = 1e9;  // metres, each coordinate
constexpr double kSecondsOfWay = 0.9;  // seconds for a way that takes one second at the flight's speed
constexpr double kTurnSpeed = 1.8;     // radians a second on average
constexpr double kGoalSubstep = 0.01;  // seconds
constexpr double kLongestStepTo = kLongestFlightTo + 4;  // seconds
constexpr double kLineLag = 0.25;                        // seconds: a guided flight's damping
constexpr double kLineGain = 2.0;                        // 1 / seconds, of what it is behind its course
constexpr double kRest = 0.02;                           // share of the flight's speed
constexpr double kPatience = 3.0;                        // seconds more than planned, on a line
constexpr double kTolerance = 0.02;                      // seconds of flight: so near is there
constexpr double kWayTolerance = 0.002;                  // share of the way along a line, the same
constexpr double kUpright = 80 * pi / 180, kLevelRoll = 0.002;  // radians: what counts as a level head

// Place, speed and acceleration from 0 to 1: all but the place are 0 at both ends.
struct Eased {
    double place, speed, acceleration;
};

Eased eased(double share) {
    const double t = std::clamp(share, 0.0, 1.0), left = 1 - t;
    return {t * t * t * (10 + t * (6 * t - 15)), 30 * t * t * left * left, 60 * t * left * (1 - 2 * t)};
}

double secondsFor(double way, double angle, double speed, double most) {
    const double moving = kShortestFlightTo + kSecondsOfWay * std::sqrt(way / speed),
                 turning = kShortestFlightTo + angle / kTurnSpeed;
    return std::clamp(std::max(moving, turning), kShortestFlightTo, most);
}

double angleBetween(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat turn = glm::conjugate(a) * b;
    return 2 * std::asin(std::min(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), 1.0));
}

bool isLevel(const PoseAngles& angles) {
    return std::abs(angles.pitch) < kUpright && std::abs(angles.roll) < kLevelRoll;
}

void checkNumber(const char* what, double value, bool holds) {
    if (!holds)
        throw Error("", what, fmt::format("expected a finite number, got {:g}", value), "name another place");
}

// Returns the goal with a unit quaternion.
Pose checkedGoal(const Pose& goal) {
    for (const double number : {goal.position.x, goal.position.y, goal.position.z})
        checkNumber("goal", number, std::abs(number) <= kFarthestGoal);
    const double size = glm::length(goal.orientation);
    if (!(size > 1e-9 && std::isfinite(size)))
        throw Error("", "goal", "expected a rotation that is finite and not 0", "name another place");
    return {goal.position, goal.orientation / size};
}

}  // namespace

FlightTo FlightTo::pose(const Flight& flight, const Pose& asked) {
    FlightTo to;
    Pose goal = checkedGoal(asked);
    goal.position.z = std::max(goal.position.z, flight.lowestAt(goal.position));
    to.mGoal = goal;
    const Pose from = flight.pose();
    const bool byLine = flight.lineMode() && !flight.wayIsClear(from.position, goal.position);
    const double near = byLine ? flight.alongNear(from.position) : std::nan("");
    if (std::isfinite(near))
        to.planLine(flight, near, flight.alongNear(goal.position), kLongestFlightTo - kShortestFlightTo);
    to.mFrom = from;
    to.planDirect(flight, kLongestFlightTo - to.mLineSeconds);
    return to;
}

FlightTo FlightTo::along(const Flight& flight, double place) {
    checkNumber("place on the line", place, !std::isnan(place));
    const double near = flight.lineMode() ? flight.alongNear(flight.pose().position) : std::nan("");
    if (!std::isfinite(near))
        throw Error("", "place on the line", "there is no line that leads through here",
                    "fly freely, or to a place that you name");
    FlightTo to;
    to.planLine(flight, flight.along().value_or(near), std::clamp(place, -kFarthestGoal, kFarthestGoal),
                kLongestFlightTo);
    return to;
}

void FlightTo::planLine(const Flight& flight, double from, double goal, double most) {
    mOnLine = true;
    mLineStart = from;
    mLineGoal = goal;
    mLineSeconds = secondsFor(std::abs(goal - from), 0, flight.speed(), most);
}

void FlightTo::planDirect(const Flight& flight, double most) {
    // After a leg along the line the way begins where that ends, which is near the goal.
    const glm::dvec3 from = mOnLine ? mGoal->position : mFrom.position;
    mWay = wayBetween(flight, from, mGoal->position);
    mDirectSeconds = secondsFor(mWay.length(), angleBetween(mFrom.orientation, mGoal->orientation),
                                flight.speed(), std::max(most, kShortestFlightTo));
}

void FlightTo::begin(Flight& flight) {
    mBegun = true;
    mModeBefore = flight.mode();
    if (!mOnLine) return;
    flight.setMode(flight.lineMode().value_or(mModeBefore));
    mLineStart = flight.along().value_or(mLineStart);
    const bool back = mLineGoal < mLineStart;
    if (back != flight.goesBack() && mLineGoal != mLineStart) flight.turnRound();
}

FlightTo::State FlightTo::step(Flight& flight, double dt) {
    if (!(dt > 0) || mState != State::Flying) return mState;
    if (!mBegun) begin(flight);
    double left = std::min(dt, kLongestStepTo);
    while (left > 0 && mState == State::Flying) {
        const double part = std::min(left, kGoalSubstep);
        mTime += part;
        mState = mOnLine ? stepAlong(flight, part) : stepDirect(flight);
        left -= part;
    }
    return mState;
}

FlightTo::State FlightTo::stepAlong(Flight& flight, double dt) {
    const std::optional<double> now = flight.along();
    if (!now) return State::Blocked;
    const double way = std::abs(mLineGoal - mLineStart), sign = mLineGoal < mLineStart ? -1 : 1;
    const double done = sign * (*now - mLineStart), left = way - done;
    const double tolerance = std::max(kWayTolerance * way, kTolerance * flight.speed());
    const bool near = std::abs(left) <= tolerance, late = mTime >= mLineSeconds;
    // Beyond it where a corner is cut, or the line is.
    const bool rests = mLineSpeed <= kRest * flight.speed();
    if (rests && ((late && near) || left < -tolerance)) return endLine(flight, State::Arrived);
    if (mTime >= mLineSeconds + kPatience) return endLine(flight, near ? State::Arrived : State::Blocked);
    const Eased course = eased(mTime / mLineSeconds);
    const double speed = course.speed * way / mLineSeconds +
                         kLineLag * course.acceleration * way / (mLineSeconds * mLineSeconds) +
                         kLineGain * (course.place * way - done);
    // The flight may brake, but not go back: that could lead back over a place where the line is cut.
    const double kept = std::exp(-dt / kLineLag), brake = -mLineSpeed * kept / (1 - kept);
    const double wished = std::max(speed, brake);
    mLineSpeed = wished + (mLineSpeed - wished) * kept;
    FlightInput input;
    input.forward = wished < 0 ? -1 : 1;
    input.speedMultiplier = std::abs(wished) / flight.speed();
    flight.step(input, dt);
    return State::Flying;
}

// Leaves the line, towards the goal's pose where there is one.
FlightTo::State FlightTo::endLine(Flight& flight, State state) {
    mOnLine = false;
    if (!mGoal) return state;
    flight.setMode(mModeBefore);
    mFrom = flight.pose();
    planDirect(flight, kLongestFlightTo - mLineSeconds);
    mDirectStart = mTime;
    return State::Flying;
}

FlightTo::State FlightTo::stepDirect(Flight& flight) {
    const double share = (mTime - mDirectStart) / mDirectSeconds;
    const double place = eased(share).place;
    Pose pose = poseBetween(mFrom, *mGoal, place);
    pose.position = mWay.at(place);
    flight.moveTo(pose);
    if (share < 1) return State::Flying;
    const double off = glm::distance(flight.pose().position, mGoal->position);
    return off <= kTolerance * flight.speed() ? State::Arrived : State::Blocked;
}

Pose poseLookingAt(const glm::dvec3& point, double distance, const Pose& from) {
    for (const double number : {point.x, point.y, point.z})
        checkNumber("point", number, std::abs(number) <= kFarthestGoal);
    checkNumber("distance", distance, distance > 0 && distance <= kFarthestGoal);
    const Pose seen = checkedGoal(from);
    const glm::dvec3 way = point - seen.position;
    const double length = glm::length(way);
    const PoseAngles before = anglesOf(seen);
    if (!(length > 0))
        return poseFromAngles(point - distance * seen.forward(), before.heading, before.pitch, 0);
    const glm::dvec3 ahead = way / length;
    const double level = std::hypot(ahead.x, ahead.y);
    // Straight up or down any heading will do: the one there was.
    const double heading = level > 1e-9 ? std::atan2(ahead.x, ahead.y) : before.heading;
    return poseFromAngles(point - distance * ahead, heading, std::atan2(ahead.z, level), 0);
}

Pose poseBetween(const Pose& a, const Pose& b, double t) {
    const glm::dvec3 position = glm::mix(a.position, b.position, t);
    const PoseAngles from = anglesOf(a), to = anglesOf(b);
    if (!isLevel(from) || !isLevel(to))
        return {position, glm::normalize(glm::slerp(a.orientation, b.orientation, t))};
    const double turn = std::remainder(to.heading - from.heading, 2 * pi);
    return poseFromAngles(position, from.heading + t * turn, glm::mix(from.pitch, to.pitch, t),
                          glm::mix(from.roll, to.roll, t));
}

}  // namespace stereonav
