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

// Returns the distance in metres from a world point to the wall, at most upTo; 0 at the wall and beyond it.
// Never above the true distance, so that it falls by at most a metre per metre.
using FreeDistance = std::function<double(const glm::dvec3& world, double upTo)>;

struct ColonFlightSetting {
    double clearance = 0.002;      // metres that each eye keeps from the wall, > 0
    double speed = 0.03;           // metres a second at full input, > 0
    double largestSeparation = 0;  // metres: largest distance between the eyes, half of it to each side
};

// Position, orientation and damped velocities; a step depends on nothing else. For one thread.
//
// Guided: `forward` follows the centreline, +1 towards the caecum wherever the viewer looks, or after
// turnRound() towards the rectum; `right` and `up` move sideways as the viewer sees it. During this motion
// the view follows the line's direction ahead, and the user's own turning is added to it. Free: `forward` is
// where the viewer looks, and turning is about the viewer's own axes.
class ColonFlight final : public Flight {
public:
    enum Mode { Guided, Free };
    // line: may be empty, or have no place with room for the eyes: then there is only one mode, free, with
    // the number 0. Throws Error when settings or home are not finite or out of range, or when there is no
    // room for the eyes around home.
    ColonFlight(FreeDistance freeDistance, const Centreline& line, const Pose& home,
                const ColonFlightSetting& setting);
    ~ColonFlight() override;

    static constexpr double kMostMultiplier = 100;  // largest factor on the speed
    void step(const FlightInput& input, double dt) override;
    void turnBy(double yaw, double pitch) override;
    Pose pose() const override;
    // Where there is no room for the eyes, the head is moved to a place nearby, towards the centreline if
    // there is one; if there is none, the viewer stays. Throws Error when the pose is not finite.
    void setPose(const Pose& pose) override;
    void goHome() override;  // makes the head as level as in the home pose
    int modeCount() const override;
    int mode() const override;
    // Guided: where the centreline can not be seen from the present place, jumps onto it.
    void setMode(int mode) override;
    std::string_view modeName(int mode) const override;
    double speed() const override;
    // Returns the distance of the nearer eye to the wall, with the eyes at their largest separation, metres;
    // at most kFarthestClearance.
    double clearanceNow() const override;
    static constexpr double kFarthestClearance = 0.1;  // metres
    // Returns whether the straight way is clear for the head in its present orientation, with the eyes at
    // their largest separation.
    bool wayIsClear(const glm::dvec3& from, const glm::dvec3& to) const override;
    void moveTo(const Pose& pose) override;
    std::optional<double> along() const override;  // only in guided flight
    std::optional<int> lineMode() const override;
    double alongNear(const glm::dvec3& place) const override;
    bool goesBack() const override;
    static constexpr double kRoundSeconds = 1.2;  // duration of turning round
    bool turnRound() override;                    // only in guided flight
    // Returns the clearance that is kept here, metres: the setting's, or a smaller one around a narrow part
    // of the centreline.
    double allowedClearance() const;

private:
    struct State;
    std::unique_ptr<State> mState;
};

// Returns the flight along a centreline at an even speed, looking ahead, from rectum to caecum or back, as a
// recorded path. Every pose lies on the centreline and keeps the clearance by ColonFlight's rule. Stretches
// over which guided flight jumps are cut out: the path changes to the next stretch within kFlightCut, which
// falls between frames at 24, 25, 30, 50 and 60 frames per second. Throws Error when no stretch has room.
RecordedPath centrelineFlight(const FreeDistance& freeDistance, const Centreline& line,
                              const ColonFlightSetting& setting, bool backwards = false);
constexpr double kFlightCut = 0.0005;  // seconds

// The smallest distance to the wall during a whole flight, for the head and for the nearer of two eyes
// `separation` apart, metres. Never above the true distance, and at most 0.01 mm below the smallest free
// distance; at most ColonFlight::kFarthestClearance. The cuts of centrelineFlight(), which no frame shows,
// are left out.
struct FlightClearance {
    double head = 0, eyes = 0;  // metres
};
// Returns the smallest of these distances, of head and both eyes, for one place, metres.
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
        double share = kUsualShare;                 // separation divided by the zero-parallax distance
        double smallest = 0.0002, largest = 0.004;  // metres
        double seconds = 2.0;                       // time in which it follows
    };
    // Largest zero-parallax distance divided by the free distance. At share 1/30 and 90 degrees of view, wall
    // at a third of the zero-parallax distance has a crossed parallax of 3.3 % of the picture's width: within
    // the 4 % allowed for short excursions.
    static constexpr double kNearest = 3;
    static constexpr double kFarthestZeroParallax = 10;  // metres

    // Begins with this setting in metres. Throws Error when a setting is not finite or not above 0, or
    // smallest > largest. The start values are brought within the limits; NaN becomes the smallest.
    SeparationControl(const Setting& setting, double separation, double zeroParallax);
    // Follows for dt seconds, at most 1. free: distance around the head; typicalDepth: view depth in the
    // middle of the picture; metres. A value that is infinite or NaN, or a depth that is not above 0, is
    // ignored.
    void step(double free, double typicalDepth, double dt);
    double separation() const { return mSeparation; }      // metres
    double zeroParallax() const { return mZeroParallax; }  // metres

private:
    Setting mSetting;
    double mSeparation, mZeroParallax;  // metres
};

}  // namespace stereonav
