// Flies through a lumen: guided along its centreline, or free, never nearer to the wall than a clearance.
//
// The guided flight is the physical camera of virtual colonoscopy (Hong et al., "Virtual voyage: interactive
// navigation in the human colon", SIGGRAPH 97): pulled along, pushed off by the wall, steered and damped.
// There the pull and the push come from potentials kept for every voxel; here the pull aims at a point of the
// centreline ahead and the push follows the gradient of the free distance.
//
// The rule: at every pose, with the eyes at their largest separation, both eyes and the head midway keep
// the allowed clearance. Allowed is what was asked for, except around narrow parts of the centreline: where
// its own free distance does not leave the clearance beside both eyes however the head is turned, the
// allowed clearance shrinks to FlightLine::kShare of what it leaves, and grows again by half a metre a metre
// from there. Where less than FlightLine::kLeast of the clearance would be left, and where the lumen is
// interrupted (CentrelinePoint::segment changes), the guided flight jumps to where it goes on.
#pragma once

#include <functional>
#include <memory>

#include "colon/centreline/centreline.h"
#include "engine/camera/default_eyes.h"
#include "engine/camera/recorded_path.h"
#include "engine/nav/flight.h"

namespace stereonav {

// Returns the distance free of wall around a world point, in metres, at most upTo; 0 at the wall and beyond
// it. Never above the true distance, so it falls by at most a metre a metre.
using FreeDistance = std::function<double(const glm::dvec3& world, double upTo)>;

struct ColonFlightSetting {
    double clearance = 0.002;      // metres that each eye keeps from the wall, > 0
    double speed = 0.03;           // metres a second at full input, > 0
    double largestSeparation = 0;  // metres: the eyes lie this far apart at most, half to each side
};

// Position, orientation and damped velocities; between steps nothing else is remembered. One thread.
//
// Guided: `forward` goes along the centreline, +1 towards the caecum whatever way the viewer looks, or after
// turnRound() towards the rectum; `right` and `up` sideways as the viewer sees it. While it goes along, the
// view follows the line's direction ahead, and what the user turned stays on top of it. Free: `forward` is
// where the viewer looks, turning is about the viewer's own axes.
class ColonFlight final : public Flight {
public:
    enum Mode { Guided, Free };
    // line: may be empty, or without a place that has room for the eyes: then there is one mode, free, and
    // its number is 0. Throws Error when settings or home are not finite or out of range, or when there is no
    // room for the eyes around home.
    ColonFlight(FreeDistance freeDistance, const Centreline& line, const Pose& home,
                const ColonFlightSetting& setting);
    ~ColonFlight() override;

    static constexpr double kMostMultiplier = 100;  // factor on the speed; more is cut to it
    void step(const FlightInput& input, double dt) override;
    void turnBy(double yaw, double pitch) override;
    Pose pose() const override;
    // Where there is no room for the eyes the head is moved to a place nearby, on the way to the centreline
    // if there is one; without any the viewer stays. Throws Error when the pose is not finite.
    void setPose(const Pose& pose) override;
    void goHome() override;  // with the head as level as home's
    int modeCount() const override;
    int mode() const override;
    // Guided: from a place that the centreline can not be seen from, jumps onto it.
    void setMode(int mode) override;
    std::string_view modeName(int mode) const override;
    double speed() const override;
    // Returns the clearance of the nearer eye, at the largest separation, metres; at most kFarthestClearance.
    double clearanceNow() const override;
    static constexpr double kFarthestClearance = 0.1;  // metres
    // Returns whether the way is clear for the head as it is turned, with the eyes at their largest
    // separation.
    bool wayIsClear(const glm::dvec3& from, const glm::dvec3& to) const override;
    void moveTo(const Pose& pose) override;
    std::optional<double> along() const override;  // while guided
    std::optional<int> lineMode() const override;
    double alongNear(const glm::dvec3& place) const override;
    bool goesBack() const override;
    static constexpr double kRoundSeconds = 1.2;  // time that turning round takes
    bool turnRound() override;                    // while guided
    // Returns the clearance that is kept here, metres: the setting's, or less around a narrow part of the
    // centreline.
    double allowedClearance() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

// Returns the flight along a centreline at an even speed, looking ahead, from rectum to caecum or back, as a
// recorded path. Every pose lies on the centreline and keeps the clearance by ColonFlight's rule. Stretches
// that the guided flight jumps over are cut out: the path changes to the next one within kFlightCut, which
// lies between the frames at 24, 25, 30, 50 and 60 a second. Throws Error when no stretch has room.
RecordedPath centrelineFlight(const FreeDistance& freeDistance, const Centreline& line,
                              const ColonFlightSetting& setting, bool backwards = false);
constexpr double kFlightCut = 0.0005;  // seconds

// The least distance to the wall over the whole of a flight, of the head and of the nearer of two eyes
// `separation` apart, metres: never above the truth, and below the least free distance by no more than 0.01
// mm; at most ColonFlight::kFarthestClearance. What lies in centrelineFlight's cuts, which no frame shows, is
// left out.
struct FlightClearance {
    double head = 0, eyes = 0;  // metres
};
// Returns the same for one place, metres, the least of head and both eyes.
double clearanceAt(const FreeDistance& freeDistance, const Pose& head, double separation);
FlightClearance clearanceOf(const RecordedPath& path, const FreeDistance& freeDistance, double separation);

// The eye separation that suits a clearance, changed slowly: follows the free distance around the head within
// the comfort limits and never jumps. Zero parallax goes to the typical depth, but no further than kNearest
// free distances; the separation to its share of that. Logarithms are followed, so that near and far changes
// feel alike: exponentially, no faster than a doubling or halving in Setting::seconds, and in closed form, so
// that steps of any length end at the same value.
class SeparationControl {
public:
    struct Setting {
        double share = kUsualShare;                 // separation over the zero-parallax distance
        double smallest = 0.0002, largest = 0.004;  // metres
        double seconds = 2.0;                       // to follow
    };
    // Zero-parallax distance over the free distance, at most. At share 1/30 and 90 degrees of view, the wall
    // at a third of the zero-parallax distance has a crossed parallax of 3.3 % of the picture's width: within
    // the 4 % that short excursions may have.
    static constexpr double kNearest = 3;
    static constexpr double kFarthestZeroParallax = 10;  // metres

    // Begins at these metres. Throws Error when a setting is not finite or not above 0, or smallest >
    // largest. The start values are brought within the limits; NaN starts at the smallest.
    SeparationControl(const Setting& setting, double separation, double zeroParallax);
    // Follows for dt seconds, cut to 1. free: distance around the head; typicalDepth: view depth in the
    // middle of the picture; metres. What is infinite, NaN or, of a depth, not above 0 tells nothing and is
    // left out.
    void step(double free, double typicalDepth, double dt);
    double separation() const { return mSeparation; }      // metres
    double zeroParallax() const { return mZeroParallax; }  // metres

private:
    Setting mSetting;
    double mSeparation, mZeroParallax;  // metres
};

}  // namespace stereonav
