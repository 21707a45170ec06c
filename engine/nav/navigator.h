// Flies a viewer by input (keys, mouse), without knowing the scene: free flight, or at a constant height over
// the ground. Never below a clearance over the ground. The flight is the same at any frame rate.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/camera/pose.h"
#include "engine/nav/flight.h"

namespace stereonav {

// Height of the ground in metres at a world position (x, y); NaN where there is no ground.
using GroundHeight = std::function<double(const glm::dvec2&)>;

enum class FlightMode : int {
    Free,          // forward is where the viewer looks
    FollowGround,  // forward is level; the height above the ground is kept, `up` changes it
};

struct FlightSetting {
    double clearance = 2.0;      // metres kept above the ground, > 0
    double followHeight = 50.0;  // metres above the ground at the start of FollowGround, >= clearance
    double speed = 100.0;        // metres a second at full input, > 0
    // Metres between places along the way where the ground's height is asked for, > 0: half of the ground's
    // sample spacing. Also limits the speed, since at most kMostLooks places per second are asked for.
    double groundStep = 10.0;
};

// Position and angles with damped velocities; a step depends on nothing else. For one thread.
class Navigator final : public Flight {
public:
    // Throws Error when a setting or the home pose is not finite or out of range.
    Navigator(GroundHeight ground, const Pose& home, const FlightSetting& setting);

    // Moves on by dt seconds (0 to kLongestStep; longer steps are shortened, negative and NaN count as 0).
    static constexpr double kLongestStep = 1.0;
    static constexpr int kMostLooks = 20000;
    void step(const FlightInput& input, double dt) override;

    void turnBy(double yaw, double pitch) override;

    Pose pose() const override { return poseFromAngles(mPosition, mHeading, mPitch, mRoll); }
    // Places the viewer (lifted to the clearance where needed) at rest.
    void setPose(const Pose& pose) override;
    void goHome() override { setPose(mHome); }
    // Over ground, keeps the height of this pose from then on.
    void moveTo(const Pose& pose) override;

    // In FollowGround the present height above the ground is kept, or followHeight if that is higher.
    void setMode(FlightMode mode);

    // Modes by number: 0 free, 1 over ground. Other numbers change nothing.
    int modeCount() const override { return 2; }
    int mode() const override { return static_cast<int>(mMode); }
    void setMode(int mode) override;
    std::string_view modeName(int mode) const override;

    double speed() const override { return mSetting.speed; }
    double clearanceNow() const override { return heightAboveGround(); }
    double lowestAt(const glm::dvec3& place) const override { return floorAt(glm::dvec2(place)); }

    const glm::dvec3& velocity() const { return mVelocity; }  // world, metres a second
    double heightAboveGround() const;                         // metres; infinite over a hole
    double followHeight() const { return mFollowHeight; }     // metres
    const FlightSetting& setting() const { return mSetting; }

private:
    void turn(const FlightInput& input, double dt);
    void move(const FlightInput& input, double dt);
    void moveOverGround(double climb, double dt);
    void keepClearance();
    glm::dvec3 wantedVelocity(const FlightInput& input) const;
    double floorAt(const glm::dvec2& place) const;
    void takeUpHeight(double lowest);

    GroundHeight mGround;
    Pose mHome;
    FlightSetting mSetting;
    FlightMode mMode = FlightMode::Free;
    glm::dvec3 mPosition{0.0}, mVelocity{0.0};           // world: metres, metres a second
    double mHeading = 0, mPitch = 0, mRoll = 0;          // radians
    double mYawRate = 0, mPitchRate = 0, mRollRate = 0;  // radians a second
    double mFollowHeight = 0;                            // metres
};

}  // namespace stereonav
