// A way of flying, as the viewer's window drives it: over ground, or through a lumen.
#pragma once

#include <limits>
#include <optional>
#include <string_view>

#include "engine/camera/pose.h"

namespace stereonav {

// The pilot's input during one step. Values outside their range are clamped, NaN counts as 0.
struct FlightInput {
    double forward = 0, right = 0, up = 0;  // -1 to 1, shares of the speed
    double yawRate = 0;                     // radians a second, clockwise seen from above
    double pitchRate = 0;                   // radians a second, upwards
    double rollRate = 0;                    // radians a second, right side down
    double speedMultiplier = 1;             // >= 0
};

class Flight {
public:
    virtual ~Flight() = default;

    // Moves on by dt seconds, at most one; negative and NaN count as 0.
    virtual void step(const FlightInput& input, double dt) = 0;
    // Turns at once, radians: for a mouse, whose motion is not a rate.
    virtual void turnBy(double yaw, double pitch) = 0;

    virtual Pose pose() const = 0;
    // Places the viewer at rest, moved to the nearest permitted position.
    virtual void setPose(const Pose& pose) = 0;
    virtual void goHome() = 0;  // setPose() with the pose that the flight began with

    // The modes of this flight ("free", "over ground", "guided", ...), numbered from 0, and the present one.
    // Numbers of other modes change nothing.
    virtual int modeCount() const = 0;
    virtual int mode() const = 0;
    virtual void setMode(int mode) = 0;
    virtual std::string_view modeName(int mode) const = 0;

    virtual double speed() const = 0;  // metres a second at full input
    // Returns the distance to the nearest obstacle for the eyes, metres; infinite without one.
    virtual double clearanceNow() const = 0;

    // --- functions for a flight to a goal (flight_to.h). A flight without ground, walls or a line has the
    // defaults.

    // Returns the lowest permitted height over a place, metres; minus infinity where there is none.
    virtual double lowestAt(const glm::dvec3& /*place*/) const {
        return -std::numeric_limits<double>::infinity();
    }
    // Returns whether the viewer, with the head as it is, has room everywhere on the straight line between
    // two places. Does not consider ground: see lowestAt().
    virtual bool wayIsClear(const glm::dvec3& /*from*/, const glm::dvec3& /*to*/) const { return true; }
    // Moves straight to a pose nearby and rests there, as far as there is room: along walls, never through
    // them.
    virtual void moveTo(const Pose& pose) { setPose(pose); }

    // Returns the place on the line that guides the flight, metres from the line's start; empty where no line
    // guides it now.
    virtual std::optional<double> along() const { return std::nullopt; }
    // Returns the mode in which `forward` follows a line; empty without a line.
    virtual std::optional<int> lineMode() const { return std::nullopt; }
    // Returns the place on that line nearest to a world point, metres from its start; NaN without a line.
    virtual double alongNear(const glm::dvec3& /*place*/) const {
        return std::numeric_limits<double>::quiet_NaN();
    }
    // Returns whether `forward` goes towards the line's start.
    virtual bool goesBack() const { return false; }
    // Reverses the direction of `forward` along the line; the view turns by half a turn in the coming steps.
    // Returns false where no line guides the flight.
    virtual bool turnRound() { return false; }
};

}  // namespace stereonav
