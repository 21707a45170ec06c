// Functions of ColonFlight that flights to a goal need: straight moves beside the wall, the place on the
// line, and turning round on it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "colon/flight/colon_flight_state.h"

namespace stereonav {
namespace {

// Returns the eased share, from 0 to 1: at rest at both ends.
double easedTurn(double share) {
    const double t = std::clamp(share, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

}  // namespace

// Turns round about the head's own up, so that it is no somersault. Called again half way it turns back.
void ColonFlight::State::turnRound() {
    back = !back;
    const double left = roundAngle * (1 - easedTurn(roundTime / kRoundSeconds));
    roundAngle = std::remainder(left + std::numbers::pi, 2 * std::numbers::pi);
    roundTime = 0;
}

void ColonFlight::State::stepRound(double h) {
    const double before = easedTurn(roundTime / kRoundSeconds);
    roundTime += h;
    const double turned = roundAngle * (easedTurn(roundTime / kRoundSeconds) - before);
    FlightView wanted = view;
    wanted.base = glm::normalize(view.base * glm::angleAxis(-turned, glm::dvec3(0, 1, 0)));
    turnTo(wanted);
    if (roundTime >= kRoundSeconds) roundAngle = roundTime = 0;
}

bool ColonFlight::wayIsClear(const glm::dvec3& from, const glm::dvec3& to) const {
    return mState->room.wayIsFree(from, to, mState->view.right());
}

void ColonFlight::moveTo(const Pose& pose) {
    checkFlightPose(pose);
    State& state = *mState;
    state.rest();
    state.view = state.view.settled();
    state.turnTo({glm::normalize(pose.orientation), 0, 0, 0});
    const glm::dvec3 before = state.position;
    state.position = state.room.moved(before, state.view.right(), pose.position - before);
    // In guided flight the line must be seen: the viewer moves no further than that.
    if (!state.guided || state.findOnLine()) return;
    state.position = before;
    state.findOnLine();
}

std::optional<double> ColonFlight::along() const {
    if (!mState->guided) return std::nullopt;
    return mState->s;
}

std::optional<int> ColonFlight::lineMode() const {
    if (modeCount() == 1) return std::nullopt;
    return Guided;
}

double ColonFlight::alongNear(const glm::dvec3& place) const {
    const FlightLine& line = mState->line;
    double best = std::numeric_limits<double>::quiet_NaN(), least = std::numeric_limits<double>::infinity();
    for (const FlightRun& run : line.runs()) {
        const double s = line.nearest(place, run.first, run.last);
        const double distance = glm::distance(place, line.at(s));
        if (!(distance < least)) continue;
        least = distance;
        best = s;
    }
    return best;
}

bool ColonFlight::goesBack() const {
    return mState->guided && mState->back;
}

bool ColonFlight::turnRound() {
    if (!mState->guided) return false;
    mState->turnRound();
    return true;
}

}  // namespace stereonav
