// What a ColonFlight is between two steps, shared by its sources: its motion (colon_flight.cpp) and flights
// to a goal (colon_flight_goal.cpp).
#pragma once

#include <utility>

#include "colon/flight/colon_flight.h"
#include "colon/flight/colon_flight_line.h"
#include "colon/flight/colon_flight_room.h"
#include "colon/flight/colon_flight_view.h"

namespace stereonav {

// Throws Error unless finite, with a unit quaternion.
void checkFlightPose(const Pose& pose);

struct ColonFlight::State {
    State(FreeDistance freeDistance, const Centreline& centreline, const Pose& homePose,
          const ColonFlightSetting& given)
        : setting((checkColonFlightSetting(given), given)),
          line(centreline, freeDistance, setting.clearance, setting.largestSeparation / 2),
          room(std::move(freeDistance), setting.clearance, setting.largestSeparation / 2, line.narrow()),
          home(homePose),
          guided(!line.runs().empty()) {}

    const FlightRun& stretch() const { return line.runs()[run]; }
    double freeAround(const glm::dvec3& p) const { return room.room(p, view.right(), 1); }

    // h: seconds, 0.01 at most; lengths: metres.
    void substep(const FlightInput& wish, double h);
    void turn(const FlightInput& wish, double h);
    void turnTo(const FlightView& wanted);
    // Returns false where the eyes have no room, even aside.
    bool turnPiece(const FlightView& next);
    void moveFree(const FlightInput& wish, double h);
    void moveGuided(const FlightInput& wish, double h);
    void pull(double along, const glm::dvec3& side, double h);
    void followLine(const glm::dvec3& moved, double length);
    void jumpBetweenRuns(double forward);
    void startRun(std::size_t next, double s);
    // range: where the wall pushes.
    glm::dvec3 besideWall(const glm::dvec3& by, double range, bool pushes, double h);
    glm::dvec3 pushed(const glm::dvec3& wall, double length) const;
    // The range in guided flight.
    double pushRange() const;
    // Whether there is room all the way to the line at s.
    bool sees(double s) const;
    // Sets run and s; false where no place of the line is seen.
    bool findOnLine();
    // Moves to where there is room near a place; false where there is none.
    bool findPlace(const glm::dvec3& wanted);
    bool findPlaceTowardsLine(const glm::dvec3& wanted);
    void rest();
    double towards() const { return back ? -1.0 : 1.0; }  // along the line, of `forward`
    void turnRound();
    void stepRound(double h);

    ColonFlightSetting setting;
    FlightLine line;
    LumenRoom room;
    Pose home;
    bool guided;
    FlightView view;
    glm::dvec3 position{0.0};                         // world, metres
    glm::dvec3 velocity{0.0};                         // metres a second: in free flight, or sideways
    double along = 0;                                 // metres a second along the line, guided
    double yawRate = 0, pitchRate = 0, rollRate = 0;  // radians a second
    std::size_t run = 0;                              // guided: the stretch of the line
    double s = 0;                                     // and the place on it that the viewer is at, metres
    bool back = false;                                // `forward` goes to the line's start
    double roundAngle = 0, roundTime = 0;             // radians to turn in all, and seconds since then
};

}  // namespace stereonav
