// A way of flying, as the viewer's window drives it: over ground, or through a lumen.
#pragma once

#include <string_view>

#include "engine/camera/pose.h"

namespace stereonav {

// What the pilot wants during one step. Values outside their range are clamped, NaN counts as 0.
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
    virtual void goHome() = 0;

    // The ways this flight knows ("free", "over ground", "guided", ...), and the one in use.
    virtual int modeCount() const = 0;
    virtual int mode() const = 0;
    virtual void setMode(int mode) = 0;
    virtual std::string_view modeName(int mode) const = 0;

    virtual double speed() const = 0;  // metres a second at full input
    // Distance to what the eyes must not touch, metres; infinite where there is nothing.
    virtual double clearanceNow() const = 0;
};

}  // namespace stereonav
