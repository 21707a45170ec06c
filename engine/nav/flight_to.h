// An automatic flight to a goal: eased at both ends, as long as the distance requires, never through ground
// or wall. The window makes one where the user asks for a place, and steps it instead of the flight until it
// arrives, or until the user takes over.
#pragma once

#include <optional>

#include "engine/nav/flight.h"
#include "engine/nav/flight_way.h"

namespace stereonav {

// Seconds that a flight takes.
constexpr double kShortestFlightTo = 0.5, kLongestFlightTo = 6.0;

class FlightTo {
public:
    enum class State { Flying, Arrived, Blocked };  // Blocked: as near as obstacles permit

    // Plans a flight to a pose. Where the flight has a line and the straight way is not clear, it goes along
    // the line first. Throws Error when the goal is not finite, or more than 1e9 metres away from the origin.
    static FlightTo pose(const Flight& flight, const Pose& goal);
    // Plans a flight to a place on the flight's line, metres from its start, clamped to the line; turns round
    // where the place lies behind. Throws Error when the flight has no line, or the place is NaN.
    static FlightTo along(const Flight& flight, double along);

    // Moves on by dt seconds; negative and NaN count as 0. The flight must take no other steps meanwhile.
    // Afterwards it has the same mode as before, except that along() leaves it guided.
    State step(Flight& flight, double dt);
    double duration() const { return mLineSeconds + mDirectSeconds; }  // seconds, planned
    double elapsed() const { return mTime; }  // seconds; along a line the flight may take longer than planned

private:
    FlightTo() = default;
    void planLine(const Flight& flight, double from, double goal, double most);
    void planDirect(const Flight& flight, double most);
    void begin(Flight& flight);
    State stepAlong(Flight& flight, double dt);
    State stepDirect(Flight& flight);
    State endLine(Flight& flight, State state);

    // The first leg, along the line, where there is one.
    bool mOnLine = false;
    double mLineStart = 0, mLineGoal = 0, mLineSeconds = 0;  // metres, seconds
    double mLineSpeed = 0;                                   // metres a second, towards the goal
    // The second leg, straight to a pose, where there is one.
    std::optional<Pose> mGoal;
    Pose mFrom;
    FlightWay mWay;
    double mDirectSeconds = 0, mDirectStart = 0;  // seconds
    int mModeBefore = 0;
    double mTime = 0;  // seconds since it began
    bool mBegun = false;
    State mState = State::Flying;
};

// Returns a pose that looks at a point from a distance in metres, > 0, on the side where `from` is, as
// upright as possible. Where `from` is at the point, the pose looks in the same direction as `from`. Throws
// Error for numbers that are not finite or a distance that is not above 0.
Pose poseLookingAt(const glm::dvec3& point, double distance, const Pose& from);

// Returns a pose between two, t from 0 to 1. Positions lie on a straight line. Heads that are level and do
// not look straight up or down turn by heading and pitch, so that they stay level; others turn by the
// shortest arc.
Pose poseBetween(const Pose& a, const Pose& b, double t);

}  // namespace stereonav
