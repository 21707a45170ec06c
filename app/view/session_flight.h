// How a session moves: its flight by hand, flights to a place by themselves, and the speed of both.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "app/view/passing_notice.h"
#include "app/view/view_action.h"
#include "engine/nav/flight.h"
#include "engine/nav/flight_to.h"
#include "engine/scene/scene.h"

namespace stereonav {

bool asksForMotion(const FlightInput& input);

class SessionFlight {
public:
    // notice: outlives this.
    SessionFlight(const Scene& scene, bool speedByDistance, PassingNotice& notice);
    // The flight goes on in another scene, from here.
    void replaceScene(const Scene& scene, const Pose& here);

    const std::unique_ptr<Flight>& shared() const { return mFlight; }
    const Flight& flight() const { return *mFlight; }
    double speed() const { return mSpeed * mPace * mFlight->speed(); }  // metres a second at full input
    // The speed follows the distance of what lies ahead (engine/nav/depth_speed.h); the wheel's is a factor.
    bool speedByDistance() const { return mByDistance; }
    void toggleSpeedByDistance();
    void turnWheel(double notches);  // each notch a fifth faster

    // Home, turning round, and ways to fly; any other command only ends a flight to a place.
    void act(const ViewAction& action);
    void reset();
    void turnBy(double yaw, double pitch);
    void goTo(const Pose& pose);
    // Flies there by itself, until the person takes over (engine/nav/flight_to.h); why not is told.
    void flyTo(const Pose& pose);
    void flyAlong(double along);  // metres along the way through
    bool toGoal() const { return mGoal.has_value(); }
    void endGoal() { mGoal.reset(); }

    // dt seconds pass. ahead: metres to what lies in the middle, 0 while it is not known.
    void stepPace(double ahead, double dt);
    // rolls: false leaves rolling out.
    void step(const FlightInput& input, double dt, bool rolls);
    // What is left of the motion may go on.
    void stir() { mResting = false; }
    // One looks otherwise, which is motion for one step.
    void noteLook() { mLooked = true; }
    bool takeLook() { return std::exchange(mLooked, false); }

private:
    void startGoal(const std::function<FlightTo(const Flight&)>& goal);
    void stepGoal(double dt);
    void turnRound();

    PassingNotice& mNotice;
    std::unique_ptr<Flight> mFlight;
    int mFirstMode;
    std::optional<FlightTo> mGoal;
    bool mByDistance;
    double mSpeed = 1;  // by the wheel
    double mPace = 1;   // by the distance ahead
    bool mResting = false, mLooked = false;
};

}  // namespace stereonav
