// The session's part that flies by itself: to a place, along a way, round to look back.
#include "app/view/session.h"
#include "engine/base/error.h"

namespace stereonav {

void ViewSession::startGoal(const std::function<FlightTo(const Flight&)>& goal) {
    stopPlaying();
    mResting = false;
    mLooked = true;
    try {
        mGoal = goal(*mFlight);
    } catch (const Error& error) {
        notify(error.what());
    }
}

void ViewSession::flyTo(const Pose& pose) {
    startGoal([&](const Flight& flight) { return FlightTo::pose(flight, pose); });
}

void ViewSession::flyAlong(double along) {
    startGoal([&](const Flight& flight) { return FlightTo::along(flight, along); });
}

void ViewSession::stepGoal(double dt) {
    const FlightTo::State state = mGoal->step(*mFlight, dt);
    if (state == FlightTo::State::Flying) return;
    mGoal.reset();
    mLooked = true;
    if (state == FlightTo::State::Blocked) notify("as near as there is room");
}

void ViewSession::turnRound() {
    mResting = false;
    if (mFlight->turnRound())
        notify(mFlight->goesBack() ? "flying back: forward goes to the start of the line"
                                   : "forward goes to the end of the line");
    else
        notify("turning round is of a guided flight: F");
}

}  // namespace stereonav
