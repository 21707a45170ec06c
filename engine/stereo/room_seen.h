// Distances in a picture of the room around the eyes, and eye settings that suit them: for windows, pictures
// and videos.
#pragma once

#include <functional>

#include "engine/camera/stereo_rig.h"
#include "engine/image/plane.h"

namespace stereonav {

// Parallax that is comfortable, as shares of the picture's width: the whole range, and the short excursions
// that broadcasters allow before and behind the screen.
constexpr double kParallaxBudget = 0.03, kNearestParallax = -0.025, kFarthestParallax = 0.04;

// How near and how far things are in a picture.
struct RoomSeen {
    double nearest = 0, farthest = 0;  // view depths, metres; infinite for pixels that hit nothing
    double ahead = 0;                  // median view depth in the middle ninth of the picture, metres
};
// Returns the distances in every step-th pixel of every step-th row. viewDepth: metres.
RoomSeen roomSeen(const Plane<float>& viewDepth, int step);
// Returns RoomSeen::ahead alone, metres. Infinite where no depth is known there.
double depthAhead(const Plane<float>& viewDepth, int step);

// Range of parallax, as shares of the picture's width: negative before the screen.
struct ParallaxRange {
    double near = 0, far = 0;
};
// Returns the parallax of the room's nearest and farthest things.
ParallaxRange parallaxOf(const StereoViews& views, const RoomSeen& room);
// Returns the parallax of one view depth above 0, metres, which may be infinite, as a share of the picture's
// width.
double parallaxAt(const StereoViews& views, double depth);

// Returns the next setting of eyes that follow the room around them. free: distance around the head; depth:
// view depth in the middle of the picture, both in metres; dt: seconds since the last call.
using StereoFollower = std::function<StereoSetting(double free, double depth, double dt)>;

// Limits the parallax of a setting: what suits the room may still be too much for the picture's nearest and
// farthest objects. Brings the eyes together, slowly, until their parallax is comfortable.
class ComfortLimit {
public:
    // Notes that a picture was made with eyes `separation` apart, metres.
    void observe(double separation, const ParallaxRange& parallax);
    // Returns the setting with its eyes brought together as far as comfort requires; dt: seconds since the
    // last call.
    StereoSetting limited(StereoSetting wanted, double dt) { return limited(wanted, dt, kLeastShare); }
    // Returns the same, but at least leastShare of the wanted separation; 0: no such bound.
    StereoSetting limited(StereoSetting wanted, double dt, double leastShare);
    // Removes the limit as slowly as it was imposed, and returns the setting.
    StereoSetting released(StereoSetting wanted, double dt);
    // Forgets all limits, for callers that begin with the setting that is shown.
    void restart() { mShare = 1; }
    double share() const { return mShare; }  // share of the separation that was wanted last

private:
    static constexpr double kLeastShare = 0.2;  // some stereo remains even when the eye touches a wall

    void approach(double share, double dt);

    // Share of the wanted separation that is comfortable now; separation in metres that would suit the last
    // picture, 0: any.
    double mShare = 1, mSeparation = 0;
};

}  // namespace stereonav
