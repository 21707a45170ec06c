// Flies through a lumen: guided along its centreline, or free, never nearer to the wall than a clearance.
#pragma once

#include <functional>
#include <memory>

#include "colon/centreline.h"
#include "engine/camera/recorded_path.h"
#include "engine/nav/flight.h"

namespace stereonav {

// Distance free of wall around a world point, in metres, at most upTo; 0 at the wall and beyond it. Never
// above the true distance, so it falls by at most a metre a metre.
using FreeDistance = std::function<double(const glm::dvec3& world, double upTo)>;

struct ColonFlightSetting {
    double clearance = 0.002;      // metres that each eye keeps from the wall, > 0
    double speed = 0.03;           // metres a second at full input, > 0
    double largestSeparation = 0;  // metres: the eyes lie this far apart at most, half to each side
};

class ColonFlight final : public Flight {
public:
    enum Mode { Guided, Free };
    // line may be empty: free flight only. Throws Error when settings are not finite or out of range.
    ColonFlight(FreeDistance freeDistance, const Centreline& line, const Pose& home,
                const ColonFlightSetting& setting);
    ~ColonFlight() override;

    void step(const FlightInput& input, double dt) override;
    void turnBy(double yaw, double pitch) override;
    Pose pose() const override;
    void setPose(const Pose& pose) override;
    void goHome() override;
    int modeCount() const override;
    int mode() const override;
    void setMode(int mode) override;
    std::string_view modeName(int mode) const override;
    double speed() const override;
    double clearanceNow() const override;

private:
    struct State;
    std::unique_ptr<State> mState;
};

// The flight along a centreline at an even speed, looking ahead, from rectum to caecum or back, as a recorded
// path whose every pose keeps the clearance.
RecordedPath centrelineFlight(const FreeDistance& freeDistance, const Centreline& line,
                              const ColonFlightSetting& setting, bool backwards = false);

// The eye separation that suits a clearance, changed slowly: follows the free distance around the head
// within the comfort limits and never jumps.
class SeparationControl {
public:
    struct Setting {
        double share = 1.0 / 30;                    // of the zero-parallax distance
        double smallest = 0.0002, largest = 0.004;  // metres
        double seconds = 2.0;                       // to follow
    };
    SeparationControl(const Setting& setting, double separation, double zeroParallax);
    // free: distance around the head; typicalDepth: view depth in the middle of the picture; metres.
    void step(double free, double typicalDepth, double dt);
    double separation() const { return mSeparation; }
    double zeroParallax() const { return mZeroParallax; }

private:
    Setting mSetting;
    double mSeparation, mZeroParallax;
};

}  // namespace stereonav
