// What a picture tells of the room around the eyes, and eyes that suit it: in the window, in pictures and in
// videos alike.
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
    double nearest = 0, farthest = 0;  // view depths, metres; what is not hit is infinitely far
    double ahead = 0;                  // the median in the picture's middle ninth, metres
};
// Returns what every step-th pixel of every step-th row shows of the room. viewDepth: metres.
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

// Makes eyes that suit the room around them: one step on by dt seconds. free: distance around the head;
// depth: view depth in the middle of the picture; metres.
using StereoFollower = std::function<StereoSetting(double free, double depth, double dt)>;

// What suits the room may still be too much for the picture's nearest and farthest things: brings eyes
// together until their parallax is comfortable, slowly.
class ComfortLimit {
public:
    // Notes that a picture was made with eyes `separation` apart, metres.
    void observe(double separation, const ParallaxRange& parallax);
    // Returns the setting with its eyes as near to each other as is comfortable; dt: seconds since the last.
    StereoSetting limited(StereoSetting wanted, double dt) { return limited(wanted, dt, kLeastShare); }
    // Returns the same, down to another share of what is wanted; 0: whatever it takes.
    StereoSetting limited(StereoSetting wanted, double dt, double leastShare);
    // Returns the setting without a limit, which goes as slowly as it came.
    StereoSetting released(StereoSetting wanted, double dt);
    // Limits settings from now on as if they had never been limited: for who begins with what is shown.
    void restart() { mShare = 1; }
    double share() const { return mShare; }  // share of the separation that was wanted last

private:
    static constexpr double kLeastShare = 0.2;  // a wall that is touched leaves some stereo

    void approach(double share, double dt);

    // The share of the wanted separation that is comfortable now; and the separation in metres that the last
    // picture would suit, 0: any.
    double mShare = 1, mSeparation = 0;
};

}  // namespace stereonav
