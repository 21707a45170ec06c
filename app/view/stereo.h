// The viewer's eyes: how far apart they are and what distance lies in the screen, by hand or following the
// room around them; never in jumps.
#pragma once

#include "app/view/worker.h"

namespace stereonav {

class ViewStereo {
public:
    // The follower, where the scene has one, is at work from the start.
    explicit ViewStereo(const Scene& scene);

    // The scene's own setting; follows as at the start.
    void reset(const Scene& scene);
    // Another scene: the eyes stay as they are and go on from there.
    void replaceScene(const Scene& scene);

    void scaleSeparation(double factor);
    void scaleZeroParallax(double factor);  // both end following
    void setSeparation(double separation);  // metres; as scaleSeparation()
    bool follows() const { return static_cast<bool>(mFollower); }
    void follow();

    // A frame has come: the parallax that it shows limits what is followed.
    void observe(const ViewFrame& frame);
    // free: distance around the head; depth: in the middle of the last picture; metres.
    void step(double free, double depth, double dt);

    const StereoSetting& now() const { return mNow; }
    // Where it goes by hand.
    const StereoSetting& target() const { return follows() ? mNow : mTarget; }
    bool moving() const { return mMoving; }  // since the last step

private:
    void look(const Scene& scene);

    StereoSetting mNow, mTarget;        // and where it slowly goes, by hand
    double mLargest;                    // metres
    const RoomAround* mRoom = nullptr;  // the scene's, which outlives this or is replaced first
    StereoFollower mFollower;
    ComfortLimit mComfort;
    bool mMoving = false;
};

}  // namespace stereonav
