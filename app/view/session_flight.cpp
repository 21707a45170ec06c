#include "app/view/session_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/nav/depth_speed.h"
#include "engine/text/length_text.h"

namespace stereonav {
namespace {

constexpr double kSpeedStep = 1.2;  // factor per notch of the wheel
constexpr double kSlowestSpeed = 0.01, kFastestSpeed = 100.0;
constexpr double kEvenPace = 1e-3;  // relative difference at which the pace counts as reached
constexpr double kStill = 1e-4;     // share of the normal speed, and radians a second: at rest

// Returns whether the motion within dt seconds is so small that the flight counts as at rest.
bool atRest(const Pose& before, const Pose& after, double speed, double dt) {
    const double moved = glm::length(after.position - before.position);
    const glm::dquat turned = after.orientation - before.orientation;
    return moved <= kStill * speed * dt && glm::length(turned) <= kStill * dt;
}

}  // namespace

bool asksForMotion(const FlightInput& input) {
    for (const double v :
         {input.forward, input.right, input.up, input.yawRate, input.pitchRate, input.rollRate})
        if (v != 0) return true;
    return false;
}

SessionFlight::SessionFlight(const Scene& scene, bool speedByDistance, PassingNotice& notice)
    : mNotice(notice),
      mFlight(scene.makeFlight()),
      mFirstMode(mFlight->mode()),
      mByDistance(speedByDistance) {}

void SessionFlight::replaceScene(const Scene& scene, const Pose& here) {
    const int mode = mFlight->mode();
    std::unique_ptr<Flight> flight = scene.makeFlight();
    if (mode < flight->modeCount()) flight->setMode(mode);
    flight->setPose(here);
    mFlight = std::move(flight);
    mResting = false;
    mLooked = true;  // at least one step shows it
}

void SessionFlight::toggleSpeedByDistance() {
    mByDistance = !mByDistance;
    mNotice.say(mByDistance ? "the speed follows the distance ahead" : "the same speed everywhere");
}

void SessionFlight::turnWheel(double notches) {
    mSpeed = std::clamp(mSpeed * std::pow(kSpeedStep, notches), kSlowestSpeed, kFastestSpeed);
    mNotice.say(fmt::format("speed {}/s", lengthText(speed())));
}

void SessionFlight::act(const ViewAction& action) {
    mGoal.reset();
    if (action.command == ViewCommand::TurnRound) return turnRound();
    if (action.command == ViewCommand::Home) return mFlight->goHome();
    const bool next = action.command == ViewCommand::NextFlightMode;
    if ((!next && action.command != ViewCommand::SetFlightMode) || mFlight->modeCount() <= 0) return;
    mFlight->setMode((next ? mFlight->mode() + 1 : action.number) % mFlight->modeCount());
    mNotice.say(fmt::format("flight: {}", mFlight->modeName(mFlight->mode())));
}

void SessionFlight::turnRound() {
    mResting = false;
    if (mFlight->turnRound())
        mNotice.say(mFlight->goesBack() ? "flying back: forward goes to the start of the line"
                                        : "forward goes to the end of the line");
    else
        mNotice.say("turning round needs a guided flight: F");
}

void SessionFlight::reset() {
    mFlight->setMode(mFirstMode);
    mFlight->goHome();
    mSpeed = 1;
}

void SessionFlight::turnBy(double yaw, double pitch) {
    mGoal.reset();
    mFlight->turnBy(yaw, pitch);
    mLooked = true;
}

void SessionFlight::goTo(const Pose& pose) {
    mGoal.reset();
    mFlight->setPose(pose);
    mResting = false;
    mLooked = true;
}

void SessionFlight::moveTo(const Pose& pose) {
    mGoal.reset();
    if (mFlight->along()) mFlight->setMode(mFlight->lineMode() == 0 ? 1 : 0);
    mFlight->moveTo(pose);
    mLooked = true;
}

void SessionFlight::startGoal(const std::function<FlightTo(const Flight&)>& goal) {
    mResting = false;
    mLooked = true;
    try {
        mGoal = goal(*mFlight);
    } catch (const Error& error) {
        mNotice.say(error.what());
    }
}

void SessionFlight::flyTo(const Pose& pose) {
    startGoal([&](const Flight& flight) { return FlightTo::pose(flight, pose); });
}

void SessionFlight::flyAlong(double along) {
    startGoal([&](const Flight& flight) { return FlightTo::along(flight, along); });
}

void SessionFlight::stepGoal(double dt) {
    const FlightTo::State state = mGoal->step(*mFlight, dt);
    if (state == FlightTo::State::Flying) return;
    mGoal.reset();
    mLooked = true;
    if (state == FlightTo::State::Blocked) mNotice.say("as near as room allows");
}

// Changes the pace smoothly in both directions, also where it is switched on or off.
void SessionFlight::stepPace(double ahead, double dt) {
    const bool known = mByDistance && ahead > 0;
    const double base = mFlight->speed(), wanted = known ? speedFor(ahead, base) / base : 1;
    mPace = dampedSpeed(mPace, wanted, dt);
    if (std::abs(mPace - wanted) <= kEvenPace * wanted) mPace = wanted;
}

void SessionFlight::step(const FlightInput& input, double dt, bool rolls) {
    const bool asks = asksForMotion(input);
    if (asks) mGoal.reset();
    if (mGoal) return stepGoal(dt);
    const Pose before = mFlight->pose();
    FlightInput wish = input;
    wish.speedMultiplier *= mSpeed * mPace;
    if (!rolls) wish.rollRate = 0;
    if (!mResting || asks) mFlight->step(wish, dt);
    if (dt > 0) mResting = !asks && atRest(before, mFlight->pose(), mFlight->speed() * mSpeed, dt);
}

}  // namespace stereonav
