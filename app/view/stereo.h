// The viewer's eyes: their separation and the distance of the screen, set by hand or following the room;
// without jumps once the first picture was seen.
#pragma once

#include <optional>

#include "app/view/view_frame.h"

namespace stereonav {

class ViewStereo {
public:
    // Begins with the scene's follower, where it has one.
    explicit ViewStereo(const Scene& scene);

    // Restores the beginning: the scene's own setting, or the one that fitted its first picture, and
    // following.
    void reset(const Scene& scene);
    // Scales separation and zero parallax with the distance from what is looked at, which zooming has changed
    // by this factor, > 0: what was comfortable stays so. Eyes that follow the room go on from there.
    // Settings by hand stay those of the distance before zooming, which endZoom() slowly goes back to.
    void zoom(double factor);
    void endZoom() { mZoomTo = 1; }
    // Returns the setting that reset() goes to.
    const StereoSetting& begun(const Scene& scene) const { return mStart ? *mStart : scene.stereo; }
    // Goes on in another scene with the present setting.
    void replaceScene(const Scene& scene);

    // Change the setting by hand, which ends following.
    void scaleSeparation(double factor);
    void scaleZeroParallax(double factor);
    // Take metres, limited to what is possible; values that are no numbers, or a screen that is not ahead,
    // change nothing.
    void setSeparation(double metres);
    void setZeroParallax(double metres);
    bool follows() const { return static_cast<bool>(mFollower); }
    void follow();

    // Returns whether the eyes, which nobody has set (Scene::eyesGiven), are still to be fitted to the first
    // picture; until it is there requests say so (FrameRequest::fitEyes).
    bool fits() const { return mFits; }
    // Returns whether the eyes are as they were fitted, and differ from the scene's.
    bool fitted() const { return mFitted; }
    // Sets the clamp for eyes set by hand: it slowly brings them together while the parallax of pictures is
    // too large, and then back. Off at first.
    void setClamp(bool on) { mClamp = on; }
    bool clamp() const { return mClamp; }
    bool clamping() const;  // whether the eyes are closer than asked for

    // Fits the eyes to pictures of another shape, where they were fitted and not changed since.
    void refit(const Scene& scene);

    // Takes a frame, whose parallax limits following. fitsNow: it has the shape of the pictures asked for;
    // otherwise eyes fitted to it are ignored.
    void observe(const ViewFrame& frame, bool fitsNow = true);
    // free: distance around the head; depth: in the middle of the last picture; metres.
    void step(double free, double depth, double dt);

    StereoSetting now() const;
    // Returns the setting that the eyes go to, without the clamp.
    const StereoSetting& target() const { return follows() ? mNow : mTarget; }
    bool moving() const { return mMoving; }  // in the last step

private:
    void look(const Scene& scene);
    void takeOver();
    void setTarget(const StereoSetting& target);
    void adopt(const StereoSetting& fitting);
    void stepByHand(double dt);
    void arrive(double free, double depth, double dt);

    // Settings before zooming: shown; gone to slowly, by hand; and the latter before the clamp.
    StereoSetting mNow, mTarget, mByHand;
    double mZoom = 1, mZoomTo = 1;      // factor of all three, and the one that it goes to
    double mLargest;                    // in metres
    const RoomAround* mRoom = nullptr;  // the scene's; it outlives this object or is replaced first
    StereoFollower mFollower;
    ComfortLimit mComfort;
    bool mGiven = false;  // whether the user or the scene's file has set them
    bool mFits = false, mFitted = false, mClamp = false;
    std::optional<StereoSetting> mStart;  // the one that fitted the first picture
    bool mMoving = false;
    bool mArrives = false, mSeen = false;  // arrive with the first picture; one was seen
};

}  // namespace stereonav
