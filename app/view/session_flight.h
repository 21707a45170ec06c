// Motion of a session: flight by hand, automatic flights to a place, and the speed of both.
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
    // notice must outlive this object.
    SessionFlight(const Scene& scene, bool speedByDistance, PassingNotice& notice);
    // Goes on in another scene, from `here`.
    void replaceScene(const Scene& scene, const Pose& here);

    const std::unique_ptr<Flight>& shared() const { return mFlight; }
    const Flight& flight() const { return *mFlight; }
    double speed() const { return mSpeed * mPace * mFlight->speed(); }  // metres per second at full input
    // Returns whether the speed follows the distance ahead (engine/nav/depth_speed.h); the wheel's factor is
    // applied to it.
    bool speedByDistance() const { return mByDistance; }
    void toggleSpeedByDistance();
    void turnWheel(double notches);  // each notch a fifth faster

    // Handles home, turning round, and flight modes; any other command only ends a flight to a place.
    void act(const ViewAction& action);
    void reset();
    void turnBy(double yaw, double pitch);
    void goTo(const Pose& pose);
    // Moves straight to a pose nearby, as far as there is room (Flight::moveTo); leaves a line that guides.
    void moveTo(const Pose& pose);
    // Flies to a pose until the user takes over (engine/nav/flight_to.h); a notice says why it can not.
    void flyTo(const Pose& pose);
    void flyAlong(double along);  // metres along the line through the scene
    bool toGoal() const { return mGoal.has_value(); }
    void endGoal() { mGoal.reset(); }

    // Lets dt seconds pass. ahead: metres to the middle of the picture's content, 0 while it is not known.
    void stepPace(double ahead, double dt);
    // rolls: false ignores rolling.
    void step(const FlightInput& input, double dt, bool rolls);
    // Resumes remaining motion.
    void stir() { mResting = false; }
    // Notes a change of direction, which counts as motion for one step.
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
    double mSpeed = 1;  // set by the wheel
    double mPace = 1;   // set by the distance ahead
    bool mResting = false, mLooked = false;
};

}  // namespace stereonav
