// What the viewer's user does and sees, without a window: flight, stereo settings, output mode, recording
// and playing, slices and what they ask for. The window's thread owns it and calls step() in turn.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/passing_notice.h"
#include "app/view/session_flight.h"
#include "app/view/session_light.h"
#include "app/view/session_path.h"
#include "app/view/session_slices.h"
#include "app/view/session_surface.h"
#include "app/view/stereo.h"
#include "app/view/view_action.h"
#include "app/view/worker.h"
#include "engine/image/stereo_compose.h"
#include "engine/nav/motion_ahead.h"

namespace stereonav {

class ViewSession {
public:
    struct Options {
        OutputMode mode = OutputMode::SideBySide;
        std::optional<RecordedPath> path;  // what Play plays before anything is recorded
        std::filesystem::path folder;      // for recorded flights
        bool quadBuffer = false;           // whether the window has one
        bool speedByDistance = false;
    };
    ViewSession(std::shared_ptr<const OpenScene> scene, const Options& options);
    ViewSession(const ViewSession&) = delete;
    ViewSession& operator=(const ViewSession&) = delete;

    // The flight goes on in another scene, at the same place or where that one has room for it.
    void replaceScene(std::shared_ptr<const OpenScene> scene);

    void act(const ViewAction& action);
    // Settings by value, as panels have them; the scene takes them with the next frame, or by a SceneChange.
    void chooseMode(OutputMode mode) { act({ViewCommand::SetMode, mode}); }
    void chooseMethod(std::string_view method);      // one of the scene's
    void setEyes(const StereoSetting& eyes);         // slowly, and by hand from now on
    void setFov(std::optional<double> verticalFov);  // radians; none: the scene's
    void goTo(const Pose& pose);
    // Flies there by itself, until the person takes over (engine/nav/flight_to.h).
    void flyTo(const Pose& pose);
    void flyAlong(double along);  // metres along the way through; nothing where there is none
    std::string_view method() const { return mMethod; }
    Lens lens() const;  // without a size
    const StereoSetting& eyesWanted() const { return mStereo.target(); }
    bool stereoOn() const { return mStereoOn; }
    bool swapped() const { return mSwapped; }
    const OpenScene& open() const { return *mScene; }
    const std::shared_ptr<const OpenScene>& openShared() const { return mScene; }
    OutputMode firstMode() const { return mFirstMode; }
    const SessionFlight& moves() const { return mFlight; }
    SessionPath& paths() { return mPaths; }
    const SessionPath& paths() const { return mPaths; }
    SessionLight& light() { return mLight; }
    const SessionLight& light() const { return mLight; }
    SessionSurface& surface() { return mSurface; }
    const SessionSurface& surface() const { return mSurface; }
    SessionSlices& slices() { return mSlices; }
    const SessionSlices& slices() const { return mSlices; }

    // Turns by radians: clockwise seen from above, upwards.
    void look(double yaw, double pitch);
    void turnWheel(double notches);  // each notch a fifth faster; in the slice view, a slice
    // dt seconds pass. The input's speed multiplier is applied on top of the session's own.
    void step(const FlightInput& input, double dt);
    // A frame has come: what it shows guides what follows the room.
    void observe(const ViewFrame& frame);
    // What was measured of one that rests.
    void observe(const FrameTruth& truth) { mMeasured = truth; }

    // Of requests, from here on: where another session made some before.
    void continueVersions(long long last) {
        mRequest.version = last;
        mFresh = true;
    }
    // What to render for a composed picture of this size; the version grows with every difference. ahead:
    // seconds until the picture is there, while something moves: it is of where the eyes will be then. scale:
    // the frame has only so much of the width and height. guard: shares of them that are cast beyond each
    // side.
    const FrameRequest& requestFor(int width, int height, double ahead = 0, double scale = 1,
                                   const glm::dvec2& guard = glm::dvec2(0.0));
    // Where the eyes will be: on a path as it goes, in flight as they move now. Not nearer to what is around
    // than half of the way there.
    Pose poseAhead(double seconds) const;
    double time() const { return mTime; }  // seconds, of what moves by itself
    // Whether what moves by itself does so too while nothing else moves, or stands still then, so that the
    // picture can become the truth.
    void driftAtRest(bool drifts) { mDriftsAtRest = drifts; }
    ComposeSetting compose() const;

    bool quit() const { return mQuit; }
    bool moving() const { return mMoving; }  // things change by themselves: do not sleep
    // Where one is or looks to changes, or what is seen: eyes that only draw together or apart are no flight,
    // and follow what whole pictures show.
    bool flying() const { return mFlying; }
    bool mouseCaptured() const { return mCaptured; }
    // True once after each Screenshot.
    bool takeScreenshotWish() { return std::exchange(mScreenshot, false); }
    const std::string& notice() const { return mNotice.text(); }
    void notify(const std::string& text) { mNotice.say(text); }

    // "24.0 fps  left 3.1 ms  warp ...";
    std::string statusLine(const ViewFrame& frame, double framesPerSecond) const;

    const StereoSetting& stereo() const { return mStereo.now(); }
    const ViewStereo& eyes() const { return mStereo; }
    ViewStereo& eyes() { return mStereo; }  // to be set by what is not a key
    void setTruth(TruthView truth) { mTruth = truth; }
    // Over the surfaces from the next frame on; null: nothing.
    void setPaint(const std::shared_ptr<const EyePainter>& paint) {
        if (paint == mPaint) return;
        mPaint = paint;
        mFresh = true;
    }
    const std::shared_ptr<const EyePainter>& paint() const { return mPaint; }
    TruthView truth() const { return mTruth; }
    // What was measured of the picture that rests; "" where it is of another one.
    std::string measuredText(const ViewFrame& frame) const;
    bool followsClearance() const { return mStereo.follows(); }
    OutputMode mode() const { return mMode; }
    Pose pose() const { return mPaths.playing() ? mPaths.played() : flight().pose(); }
    const Flight& flight() const { return mFlight.flight(); }

private:
    bool hasOtherShape(int width, int height) const;  // than the pictures that were asked for last
    bool actOnStereo(const ViewAction& action);
    bool actOnEyes(ViewCommand command);
    void stepMode(int by);
    void nextMethod();
    void showTruth(ViewCommand command);
    void reset();

    const Scene& shown() const { return *mScene->scene; }
    template <typename C>
    C* offered() const {
        return shown().offered<C>();
    }

    std::shared_ptr<const OpenScene> mScene;
    PassingNotice mNotice;
    SessionFlight mFlight;
    SessionPath mPaths;
    SessionLight mLight;
    SessionSurface mSurface;
    SessionSlices mSlices;
    MotionAhead mAhead;
    ViewStereo mStereo;
    double mDepthAhead = 0;  // metres
    OutputMode mMode, mFirstMode;
    bool mQuadBuffer = false;  // whether the window has one
    std::string_view mMethod;
    TruthView mTruth = TruthView::None;
    std::shared_ptr<const EyePainter> mPaint;
    FrameTruth mMeasured;
    double mShape = 0;           // width to height of the eyes' pictures that were asked for last
    std::optional<double> mFov;  // radians; none: the scene's
    double mTime = 0;            // seconds, of what moves by itself
    bool mDriftsAtRest = true;
    bool mStereoOn = true, mSwapped = false, mLinear = false, mQuit = false, mCaptured = false;
    bool mMoving = false, mFlying = false, mScreenshot = false;
    bool mFresh = true;
    FrameRequest mRequest;
};

}  // namespace stereonav
