// The state of a ColonFlight between two steps. Its functions are in two sources: motion (colon_flight.cpp)
// and flights to a goal (colon_flight_goal.cpp).
#pragma once

#include <utility>

#include "colon/flight/colon_flight.h"
#include "colon/flight/colon_flight_line.h"
#include "colon/flight/colon_flight_room.h"
#include "colon/flight/colon_flight_view.h"

namespace stereonav {

// Throws Error unless the pose is finite and its quaternion has a length of about 1.
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

    // Moves and turns for one time step. In all functions h is its length in seconds, 0.01 at most; lengths
    // are in metres.
    void substep(const FlightInput& wish, double h);
    void turn(const FlightInput& wish, double h);
    void turnTo(const FlightView& wanted);
    // Turns to `next`. Where an eye comes too near to the wall the head moves away; returns false, with
    // nothing changed, where there is no room for that.
    bool turnPiece(const FlightView& next);
    void moveFree(const FlightInput& wish, double h);
    void moveGuided(const FlightInput& wish, double h);
    void pull(double along, const glm::dvec3& side, double h);
    void followLine(const glm::dvec3& moved, double length);
    void jumpBetweenRuns(double forward);
    void startRun(std::size_t next, double s);
    // Returns the part of the move `by` that the wall permits. range: metres of room below which the wall
    // slows the move and, if `pushes`, moves the viewer away.
    glm::dvec3 besideWall(const glm::dvec3& by, double range, bool pushes, double h);
    glm::dvec3 pushed(const glm::dvec3& wall, double length) const;
    // Returns the range of besideWall() in guided flight.
    double pushRange() const;
    // Returns whether the eyes have room all the way to the line's point at s.
    bool sees(double s) const;
    // Sets run and s to the nearest place of the line that is visible. Returns false where none is, and sets
    // the nearest one that is not.
    bool findOnLine();
    // Moves to a place with room near the wanted one. Returns false where there is none.
    bool findPlace(const glm::dvec3& wanted);
    bool findPlaceTowardsLine(const glm::dvec3& wanted);
    void rest();
    double towards() const { return back ? -1.0 : 1.0; }  // sign of `forward` along the line
    void turnRound();
    void stepRound(double h);

    ColonFlightSetting setting;
    FlightLine line;
    LumenRoom room;
    Pose home;
    bool guided;
    FlightView view;
    glm::dvec3 position{0.0};                         // world, metres
    glm::dvec3 velocity{0.0};                         // metres a second; in guided flight the sideways part
    double along = 0;                                 // metres a second along the line, in guided flight
    double yawRate = 0, pitchRate = 0, rollRate = 0;  // radians a second
    std::size_t run = 0;                   // in guided flight: number of the run that the viewer is on
    double s = 0;                          // in guided flight: the viewer's place, metres along the line
    bool back = false;                     // whether a positive `forward` goes towards the line's start
    double roundAngle = 0, roundTime = 0;  // turning round: total radians; seconds since its start
};

}  // namespace stereonav
