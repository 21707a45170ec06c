// The viewer's eyes: how far apart they are and what distance lies in the screen, by hand or following the
// room around them; never in jumps once the first picture was seen.
#pragma once

#include <optional>

#include "app/view/worker.h"

namespace stereonav {

class ViewStereo {
public:
    // The follower, where the scene has one, is at work from the start.
    explicit ViewStereo(const Scene& scene);

    // As at the start: the scene's own setting, or what fitted its first picture; follows as at the start.
    void reset(const Scene& scene);
    // What reset() goes to.
    const StereoSetting& begun(const Scene& scene) const { return mStart ? *mStart : scene.stereo; }
    // Another scene: the eyes stay as they are and go on from there.
    void replaceScene(const Scene& scene);

    // By hand: each ends following.
    void scaleSeparation(double factor);
    void scaleZeroParallax(double factor);
    // Metres, brought within what is possible; what is no number, or a screen that is not ahead, changes
    // nothing.
    void setSeparation(double metres);
    void setZeroParallax(double metres);
    bool follows() const { return static_cast<bool>(mFollower); }
    void follow();

    // Eyes that nobody asked for (Scene::eyesGiven) are made comfortable with the first picture: until that
    // one is there, requests say so (FrameRequest::fitEyes).
    bool fits() const { return mFits; }
    // They are as they were fitted then, and that was not what the scene has.
    bool fitted() const { return mFitted; }
    // Where they are set by hand: brings them together, slowly, while a picture's parallax is too much, and
    // back again after it. Off at first.
    void setClamp(bool on) { mClamp = on; }
    bool clamp() const { return mClamp; }
    bool clamping() const;  // they are nearer to each other than was asked for

    // Pictures have another shape from now on: eyes that were fitted, and not touched since, are fitted to
    // them anew.
    void refit(const Scene& scene);

    // A frame has come: the parallax that it shows limits what is followed.
    // fitsNow: its shape is that of the pictures that are asked for; eyes that fitted another one are not
    // taken.
    void observe(const ViewFrame& frame, bool fitsNow = true);
    // free: distance around the head; depth: in the middle of the last picture; metres.
    void step(double free, double depth, double dt);

    const StereoSetting& now() const { return mNow; }
    // By hand: where they go, without the clamp.
    const StereoSetting& target() const { return follows() ? mNow : mTarget; }
    bool moving() const { return mMoving; }  // since the last step
    // For the line of figures: "eyes follow", "comfort", "comfort clamp"; "" where there is nothing to say.
    const char* word() const;

private:
    void look(const Scene& scene);
    void takeOver();
    void setTarget(const StereoSetting& target);
    void adopt(const StereoSetting& fitting);
    void stepByHand(double dt);
    void arrive(double free, double depth, double dt);

    // As shown; where it slowly goes, by hand; and how far that is, before the clamp.
    StereoSetting mNow, mTarget, mByHand;
    double mLargest;                    // metres
    const RoomAround* mRoom = nullptr;  // the scene's, which outlives this or is replaced first
    StereoFollower mFollower;
    ComfortLimit mComfort;
    bool mGiven = false;  // by the user or the scene's file
    bool mFits = false, mFitted = false, mClamp = false;
    std::optional<StereoSetting> mStart;  // that fitted the first picture
    bool mMoving = false;
    bool mArrives = false, mSeen = false;  // at once, with the first picture; one was seen
};

}  // namespace stereonav
