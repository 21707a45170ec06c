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

    // Moves on by dt seconds; longer than a second is cut to it, negative and NaN is nothing.
    virtual void step(const FlightInput& input, double dt) = 0;
    // Turns at once, radians: for a mouse, whose motion is not a rate.
    virtual void turnBy(double yaw, double pitch) = 0;

    virtual Pose pose() const = 0;
    // Places the viewer at rest, moved to where it may be.
    virtual void setPose(const Pose& pose) = 0;
    virtual void goHome() = 0;  // setPose() with the pose that the flight began with

    // The ways this flight knows ("free", "over ground", "guided", ...), numbered from 0, and the one in use.
    // Other numbers change nothing.
    virtual int modeCount() const = 0;
    virtual int mode() const = 0;
    virtual void setMode(int mode) = 0;
    virtual std::string_view modeName(int mode) const = 0;

    virtual double speed() const = 0;  // metres a second at full input
    // Distance to what the eyes must not touch, metres; infinite where there is nothing.
    virtual double clearanceNow() const = 0;

    // --- what a flight to a goal asks (flight_to.h). A flight without ground, walls or a line has none of
    // it.

    // The height below which the viewer is not let over a place, metres; minus infinity where there is none.
    virtual double lowestAt(const glm::dvec3& /*place*/) const {
        return -std::numeric_limits<double>::infinity();
    }
    // Returns whether the viewer, with the head as it is, finds room everywhere on the straight way. Of
    // ground it says nothing: that is lowestAt().
    virtual bool wayIsClear(const glm::dvec3& /*from*/, const glm::dvec3& /*to*/) const { return true; }
    // Goes straight to a pose nearby, at rest there, as far as there is room: along walls, never through
    // them.
    virtual void moveTo(const Pose& pose) { setPose(pose); }

    // Returns where it is on the line that leads it, metres from the line's start; none: nothing leads it
    // now.
    virtual std::optional<double> along() const { return std::nullopt; }
    // The mode whose `forward` goes along a line; none: it knows no line.
    virtual std::optional<int> lineMode() const { return std::nullopt; }
    // The nearest place of that line to a world point, metres from its start; NaN where there is no line.
    virtual double alongNear(const glm::dvec3& /*place*/) const {
        return std::numeric_limits<double>::quiet_NaN();
    }
    // Returns whether `forward` goes to where the line starts.
    virtual bool goesBack() const { return false; }
    // Lets `forward` go along the line the other way from now on; the view turns by half a turn while time
    // passes. Returns false where nothing leads it.
    virtual bool turnRound() { return false; }
};

}  // namespace stereonav
