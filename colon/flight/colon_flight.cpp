// The motion of the colon flight, in short substeps so that a step of a second and a hundred of ten
// milliseconds fly nearly the same way. Two parts, because they differ in stiffness:
//
// - Steering and pull are velocities that follow the user's wish with exponential damping, integrated in
//   closed form: exact for any step, nothing to go unstable.
// - The wall's push is stiff (it grows without bound as the room r goes to 0), so it acts on the position
//   directly (overdamped: no momentum, so no swinging between opposite walls) and is integrated by backward
//   Euler, which in the one coordinate r is a quadratic: r1 = r0 + h (a + k (R / r1 - 1)), with a the speed
//   away from the wall that the rest of the motion has there, k and R the push's speed and range. Its root is
//   positive for any h, so a stiff wall and a long step keep off the wall as well as short ones, and
//   without overshoot. A push is taken only as far as it raises the room by half its length.
#include "colon/flight/colon_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "colon/flight/colon_flight_state.h"
#include "engine/base/error.h"
#include "engine/nav/damping.h"
#include "engine/nav/flight_input.h"

namespace stereonav {
namespace {

using std::numbers::pi;

constexpr double kLongestStep = 1.0;      // seconds
constexpr double kLongestSubstep = 0.01;  // seconds
constexpr double kSpeedDamping = 0.25;    // seconds in which 63 % of a wish is reached
constexpr double kTurnDamping = 0.08;     // seconds, the same for turning
constexpr double kViewDamping = 0.4;      // seconds, of the view that follows the travel at full speed
constexpr double kSlowestTurn = 1e-7;     // radians a second: what fades away is at rest below it
constexpr double kFastestTurn = 20.0;     // radians a second
constexpr double kEndDamping = 0.5;       // seconds: slows down before the line's very end
constexpr double kPushSpeed = 0.1;        // k above, as a share of the speed
constexpr double kFarthestPull = 0.01;    // metres: the pull aims so far ahead at most
constexpr double kNearestLook = 0.008, kFarthestLook = 0.03;  // metres ahead that the view aims at
constexpr double kLookRadii = 1.5;   // free distances of the line ahead that the view aims at
constexpr int kMostPulls = 8;        // pieces of a substep along the line
constexpr double kAtEnd = 1e-6;      // metres along the line
constexpr double kTurnPiece = 0.25;  // share of the clearance: an eye's way between two looks while turning
constexpr int kMostTurnPieces = 64;
constexpr double kFarthestPlace = 0.5;  // metres within which setPose looks for room

}  // namespace

void checkFlightPose(const Pose& pose) {
    const glm::dvec3& p = pose.position;
    const glm::dquat& q = pose.orientation;
    if (!std::isfinite(p.x + p.y + p.z) || !(glm::dot(q, q) > 0.5 && glm::dot(q, q) < 2))
        throw Error("", "pose", "expected finite numbers and a unit quaternion", "check the start pose");
}

void checkColonFlightSetting(const ColonFlightSetting& setting) {
    const auto number = [](const char* name, double value, bool zeroToo) {
        if (std::isfinite(value) && (value > 0 || (zeroToo && value == 0))) return;
        throw Error("", name,
                    fmt::format("expected a number {} 0, got {:g}", zeroToo ? "of at least" : "above", value),
                    "give metres (a second)");
    };
    number("clearance", setting.clearance, false);
    number("speed", setting.speed, false);
    number("largest separation", setting.largestSeparation, true);
}

// --- turning

void ColonFlight::State::turn(const FlightInput& wish, double h) {
    FlightView wanted = view;
    wanted.yaw += damped(yawRate, wish.yawRate, kTurnDamping, h);
    const double pitch = wanted.pitch + damped(pitchRate, wish.pitchRate, kTurnDamping, h);
    wanted.pitch = guided ? std::clamp(pitch, -pi / 2, pi / 2) : pitch;
    wanted.roll += damped(rollRate, wish.rollRate, kTurnDamping, h);
    for (double* rate : {&yawRate, &pitchRate, &rollRate})
        if (std::abs(*rate) < kSlowestTurn) *rate = 0;
    turnTo(wanted);
}

// Turns as far as the eyes have room. Where turning brings an eye too near to the wall the head gives way.
void ColonFlight::State::turnTo(const FlightView& wanted) {
    const FlightView from = view;
    const double angle = pathBetween(from, wanted);
    if (angle == 0) return;
    const double path = room.half() * angle;
    const double piece = kTurnPiece * room.allowed(position);
    const int pieces = static_cast<int>(std::clamp(std::ceil(path / piece), 1.0, 1.0 * kMostTurnPieces));
    for (int k = 1; k <= pieces; ++k)
        if (!turnPiece(between(from, wanted, static_cast<double>(k) / pieces))) break;
    view.yaw = std::remainder(view.yaw, 2 * pi);
    view.roll = std::remainder(view.roll, 2 * pi);
    if (!guided) view = view.settled();
}

bool ColonFlight::State::turnPiece(const FlightView& next) {
    const double there = room.half() > 0 ? room.room(position, next.right(), 0) : 0.0;
    if (there < 0) {
        const glm::dvec3 wall = room.away(position, next.right());
        const glm::dvec3 aside = room.moved(position, view.right(), wall * (-1.5 * there));
        if (room.room(aside, next.right(), 0) < 0) return false;
        position = aside;
    }
    view = next;
    return true;
}

// --- moving

// Returns what is left of a move beside the wall, and the push. Slows the part of it that goes towards the
// wall.
glm::dvec3 ColonFlight::State::besideWall(const glm::dvec3& by, double range, bool pushes, double h) {
    const double length = glm::length(by);
    const glm::dvec3 right = view.right();
    const double r0 = room.room(position, right, range + length);
    if (r0 >= range + length) return by;
    const glm::dvec3 wall = room.away(position, right);
    const double inward = glm::dot(by, wall);
    if (glm::dot(wall, wall) == 0 || r0 + inward >= range) return by;
    const double k = kPushSpeed * setting.speed * h, b = std::max(r0, 0.0) + inward - k;
    const double r1 = (b + std::sqrt(b * b + 4 * k * range)) / 2;
    const double change = r1 - std::max(r0, 0.0);  // change of the room, by the wall's equation
    const double slid = std::min(change, std::max(inward, 0.0));  // without being pushed
    const double push = pushes ? std::max(change - slid, 0.0) : 0.0;
    const glm::dvec3 move = by + wall * (slid - inward);
    if (push > 0) position = pushed(wall, push);
    return move;
}

// Returns the place after a push, which is taken only as far as it raises the room by half its length, so
// that it ends between opposite walls.
glm::dvec3 ColonFlight::State::pushed(const glm::dvec3& wall, double length) const {
    const glm::dvec3 right = view.right();
    const double before = room.room(position, right, 1);
    for (int halving = 0; halving < 4; ++halving, length /= 2) {
        const glm::dvec3 there = room.moved(position, right, wall * length);
        if (room.room(there, right, 1) >= before + length / 2) return there;
    }
    return position;
}

void ColonFlight::State::moveFree(const FlightInput& wish, double h) {
    const glm::dquat q = view.orientation();
    const glm::dvec3 wanted =
        q * glm::dvec3(wish.right, wish.up, -wish.forward) * (setting.speed * wish.speedMultiplier);
    const glm::dvec3 by = damped(velocity, wanted, kSpeedDamping, h);
    position = room.moved(position, view.right(), besideWall(by, room.allowed(position), false, h));
}

// Half of the room that the line itself has around here: on the line nothing pushes, so no narrow
// part of it stops the flight.
double ColonFlight::State::pushRange() const {
    const double here = line.roomAt(s), before = line.roomAt(std::max(s - here, stretch().first)),
                 after = line.roomAt(std::min(s + here, stretch().last));
    return std::min(room.clearance(), 0.5 * std::min({here, before, after}));
}

bool ColonFlight::State::sees(double place) const {
    const glm::dvec3 there = line.at(place);
    return glm::distance(position, there) <= line.roomAt(place) ||
           room.wayIsFree(position, there, view.right());
}

// One piece of the way: `length` metres towards the line ahead (or back), and sideways.
void ColonFlight::State::pull(double length, const glm::dvec3& side, double h) {
    const double ball = line.roomAt(s), off = glm::distance(position, line.at(s));
    // Within the ball around the line's point the way ahead is straight and free; outside it the
    // line's own point is what is seen.
    const double reach = std::min(ball, kFarthestPull) * (off > ball ? ball / off : 1.0);
    const double place = std::clamp(s + std::copysign(reach, length), stretch().first, stretch().last);
    const glm::dvec3 way = line.at(place) - position;
    const double distance = glm::length(way);
    glm::dvec3 by = side;
    if (distance > 0) by += way * (std::min(std::abs(length), distance) / distance);
    const glm::dvec3 start = position;
    const glm::dvec3 move = besideWall(by, pushRange(), true, h);
    const glm::dvec3 there = room.moved(position, view.right(), move);
    position = start;
    followLine(there, glm::length(by));
}

// Takes the new place if the line is seen from it. If not, goes towards the line's present point, which is.
void ColonFlight::State::followLine(const glm::dvec3& moved, double length) {
    const glm::dvec3 before = position;
    const double oldS = s, window = 2 * glm::distance(moved, position) + 2 * line.roomAt(s);
    position = moved;
    s = line.nearest(moved, std::max(s - window, stretch().first), std::min(s + window, stretch().last));
    if (sees(s)) return;
    if (sees(oldS)) {
        s = oldS;
        return;
    }
    position = before;
    s = oldS;
    const glm::dvec3 way = line.at(s) - position;
    const double off = glm::length(way);
    if (off > 0) position = room.moved(position, view.right(), way * (std::min(length, off) / off));
}

void ColonFlight::State::moveGuided(const FlightInput& wish, double h) {
    const double speed = setting.speed * wish.speedMultiplier;
    const glm::dvec3 ahead = line.direction(stretch(), s);
    const glm::dquat q = view.orientation();
    glm::dvec3 side = q * glm::dvec3(wish.right, wish.up, 0) * speed;
    side -= ahead * glm::dot(side, ahead);
    double forward = towards() * wish.forward * speed;
    const bool lastRun = forward > 0 ? run + 1 == line.runs().size() : run == 0;
    const double end = forward > 0 ? stretch().last : stretch().first;
    const double left = std::max(std::abs(end - s), glm::distance(position, line.at(end)));
    if (lastRun) forward = std::copysign(std::min(std::abs(forward), left / kEndDamping), forward);
    const glm::dvec3 sideways = damped(velocity, side, kSpeedDamping, h);
    const double length = damped(along, forward, kSpeedDamping, h);
    const double step = std::max(std::min(line.roomAt(s), kFarthestPull) / 2, 1e-9);
    const int pieces =
        static_cast<int>(std::clamp(std::ceil(std::abs(length) / step), 1.0, 1.0 * kMostPulls));
    const double piece = std::copysign(std::min(std::abs(length) / pieces, step), length);
    for (int k = 0; k < pieces; ++k) pull(piece, sideways / (1.0 * pieces), h / pieces);
    jumpBetweenRuns(towards() * wish.forward);
    if (roundAngle != 0) return stepRound(h);
    // The view follows while the user wants to get on.
    const double look = std::clamp(kLookRadii * line.widthAt(s), kNearestLook, kFarthestLook);
    const glm::dvec3 way = line.ahead(stretch(), s + towards() * look) - position;
    const double distance = glm::length(way);
    const double share = 1 - std::exp(-h * std::abs(wish.forward) / kViewDamping);
    if (distance > 0 && share > 0) turnTo(view.facing(way / distance, share));
}

void ColonFlight::State::startRun(std::size_t next, double place) {
    run = next;
    s = place;
    position = line.at(s);
    velocity = glm::dvec3(0.0);
    view = view.facing(towards() * line.direction(stretch(), s), 1);
}

// The lumen is interrupted where a run ends: on at the next one.
void ColonFlight::State::jumpBetweenRuns(double forward) {
    const double end = forward > 0 ? stretch().last : stretch().first;
    if (std::abs(forward) < 0.01 || along * forward < 0 || std::abs(s - end) > kAtEnd) return;
    if (forward > 0 && run + 1 < line.runs().size()) startRun(run + 1, line.runs()[run + 1].first);
    if (forward < 0 && run > 0) startRun(run - 1, line.runs()[run - 1].last);
}

void ColonFlight::State::substep(const FlightInput& wish, double h) {
    turn(wish, h / 2);
    if (guided)
        moveGuided(wish, h);
    else
        moveFree(wish, h);
    turn(wish, h / 2);
}

// --- places

void ColonFlight::State::rest() {
    velocity = glm::dvec3(0.0);
    along = yawRate = pitchRate = rollRate = 0;
    roundAngle = roundTime = 0;
}

// The nearest place of the line that is seen; false when only the nearest unseen one was found.
bool ColonFlight::State::findOnLine() {
    double least = -1;
    std::size_t nearestRun = 0;
    double nearestS = 0;
    bool seen = false;
    for (std::size_t k = 0; k < line.runs().size(); ++k) {
        const FlightRun& candidate = line.runs()[k];
        const double place = line.nearest(position, candidate.first, candidate.last);
        const double distance = glm::distance(position, line.at(place));
        const bool sight = sees(place);
        if (least >= 0 && (seen && !sight)) continue;
        if (least >= 0 && seen == sight && distance >= least) continue;
        least = distance;
        nearestRun = k;
        nearestS = place;
        seen = sight;
    }
    run = nearestRun;
    s = nearestS;
    return seen;
}

// Goes from the wanted place straight to the line's nearest point, to the first place with room.
bool ColonFlight::State::findPlaceTowardsLine(const glm::dvec3& wanted) {
    if (line.runs().empty()) return false;
    position = wanted;
    findOnLine();
    const glm::dvec3 there = line.at(s);
    const double length = glm::distance(wanted, there);
    constexpr int kLooks = 200;
    for (int k = 0; k <= kLooks; ++k) {
        position = glm::mix(wanted, there, static_cast<double>(k) / kLooks);
        if (freeAround(position) >= 0 && (k == kLooks || length < kFarthestPlace)) return true;
    }
    return false;
}

// Moves to a place with room near the wanted one. Returns false, with nothing changed, where there is none.
bool ColonFlight::State::findPlace(const glm::dvec3& wanted) {
    const glm::dvec3 before = position;
    position = wanted;
    if (freeAround(position) >= 0 || findPlaceTowardsLine(wanted)) return true;
    for (double away = 0.25 * setting.clearance; away < kFarthestPlace; away *= 1.25)
        for (int k = 0; k < 27; ++k) {
            if (k == 13) continue;
            const glm::dvec3 d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            position = wanted + glm::normalize(d) * away;
            if (freeAround(position) >= 0) return true;
        }
    position = before;
    return false;
}

// --- the flight

ColonFlight::ColonFlight(FreeDistance freeDistance, const Centreline& line, const Pose& home,
                         const ColonFlightSetting& setting)
    : mState(std::make_unique<State>(std::move(freeDistance), line, home, setting)) {
    checkFlightPose(home);
    mState->view.base = glm::normalize(home.orientation);
    if (!mState->findPlace(home.position))
        throw Error(
            "", "start pose",
            fmt::format("expected room for the eyes around it, found none within {:g} m", kFarthestPlace),
            "start where there is more room");
    setPose({mState->position, home.orientation});
}

ColonFlight::~ColonFlight() = default;

void ColonFlight::step(const FlightInput& input, double dt) {
    if (!(dt > 0)) return;
    const FlightInput wish = cleaned(input, kFastestTurn, kMostMultiplier);
    const double time = std::min(dt, kLongestStep);
    const int count = std::max(1, static_cast<int>(std::ceil(time / kLongestSubstep - 1e-9)));
    for (int k = 0; k < count; ++k) mState->substep(wish, time / count);
}

void ColonFlight::turnBy(double yaw, double pitch) {
    FlightView wanted = mState->view;
    wanted.yaw += clampedInput(yaw, -2 * pi, 2 * pi);
    wanted.pitch = std::clamp(wanted.pitch + clampedInput(pitch, -pi, pi), -pi / 2, pi / 2);
    mState->turnTo(wanted);
}

Pose ColonFlight::pose() const {
    return {mState->position, mState->view.orientation()};
}

void ColonFlight::setPose(const Pose& pose) {
    checkFlightPose(pose);
    State& state = *mState;
    const FlightView before = state.view;
    state.view = {glm::normalize(pose.orientation), 0, 0, 0};
    if (!state.findPlace(pose.position)) state.view = before;
    state.rest();
    if (state.guided && !state.findOnLine()) state.position = state.line.at(state.s);
}

void ColonFlight::goHome() {
    mState->back = false;
    setPose(mState->home);
}

int ColonFlight::modeCount() const {
    return mState->line.runs().empty() ? 1 : 2;
}

int ColonFlight::mode() const {
    return modeCount() == 1 || mState->guided ? 0 : 1;
}

void ColonFlight::setMode(int mode) {
    State& state = *mState;
    if (mode < 0 || mode >= modeCount() || mode == this->mode()) return;
    state.guided = mode == Guided;
    state.roundAngle = state.roundTime = 0;
    state.view = state.view.settled();
    if (!state.guided) {
        state.velocity += state.along * state.line.direction(state.stretch(), state.s);
        state.along = 0;
        return;
    }
    if (!state.findOnLine()) state.position = state.line.at(state.s);
    const glm::dvec3 ahead = state.line.direction(state.stretch(), state.s);
    state.along = glm::dot(state.velocity, ahead);
    state.velocity -= state.along * ahead;
}

std::string_view ColonFlight::modeName(int mode) const {
    if (mode < 0 || mode >= modeCount()) return "";
    return modeCount() == 2 && mode == Guided ? "guided" : "free";
}

double ColonFlight::speed() const {
    return mState->setting.speed;
}

double ColonFlight::clearanceNow() const {
    return mState->room.free(mState->position, mState->view.right(), kFarthestClearance);
}

double ColonFlight::allowedClearance() const {
    return mState->room.allowed(mState->position);
}

}  // namespace stereonav
