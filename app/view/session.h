// The viewer without a window: flight, stereo settings, output mode, recording and playing, slices, and
// requests for frames. Owned by the window's thread, which calls step().
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
#include "app/view/session_orbit.h"
#include "app/view/session_path.h"
#include "app/view/session_slices.h"
#include "app/view/session_surface.h"
#include "app/view/shown_mode.h"
#include "app/view/stereo.h"
#include "app/view/view_action.h"
#include "app/view/view_frame.h"
#include "engine/image/stereo_compose.h"
#include "engine/nav/motion_ahead.h"

namespace stereonav {

class ViewSession {
public:
    struct Options {
        OutputMode mode = OutputMode::SideBySide;
        std::optional<RecordedPath> path;  // flight that Play plays before anything is recorded
        std::filesystem::path folder;      // folder for recorded flights
        bool quadBuffer = false;           // whether the window has a quad buffer
        bool speedByDistance = false;
        bool stereo = true, firstStereo = true;  // whether both eyes are shown, now and after a reset
    };
    ViewSession(std::shared_ptr<const OpenScene> scene, const Options& options);
    ViewSession(const ViewSession&) = delete;
    ViewSession& operator=(const ViewSession&) = delete;

    // Goes on in another scene, at the same place or where it has room.
    void replaceScene(std::shared_ptr<const OpenScene> scene);

    void act(const ViewAction& action);
    // Settings by value, for panels; they take effect with the next frame, or by a SceneChange.
    void chooseMode(OutputMode mode) { act({ViewCommand::SetMode, mode}); }
    void chooseMethod(std::string_view method);      // one of the scene's methods
    void setEyes(const StereoSetting& eyes);         // slowly; ends following
    void setFov(std::optional<double> verticalFov);  // radians; empty: the scene's
    void goTo(const Pose& pose);
    // Flies to a pose until the user takes over (engine/nav/flight_to.h).
    void flyTo(const Pose& pose);
    void flyAlong(double along);  // metres along the line through the scene; without one nothing happens
    std::string_view method() const { return mMethod; }
    Lens lens() const;  // lens without a size
    const StereoSetting& eyesWanted() const { return mStereo.target(); }
    // Returns whether both eyes are shown.
    bool stereoOn() const { return infoOf(mShown.shown()).layout != OutputLayout::OneEye; }
    const ShownMode& shownMode() const { return mShown; }
    void show(const ShownMode& mode);
    bool swapped() const { return mSwapped; }
    const OpenScene& open() const { return *mScene; }
    const std::shared_ptr<const OpenScene>& openShared() const { return mScene; }
    const ShownMode& firstMode() const { return mFirst; }
    const SessionFlight& moves() const { return mFlight; }
    SessionPath& paths() { return mPaths; }
    const SessionPath& paths() const { return mPaths; }
    SessionLight& light() { return mLight; }
    const SessionLight& light() const { return mLight; }
    SessionSurface& surface() { return mSurface; }
    const SessionSurface& surface() const { return mSurface; }
    SessionSlices& slices() { return mSlices; }
    const SessionSlices& slices() const { return mSlices; }

    // Turns by radians: clockwise seen from above, and upwards.
    void look(double yaw, double pitch);
    void turnWheel(double notches);  // each notch a fifth faster; in the slice view, one slice
    // What the mouse does: whether it turns, pans and zooms about a place, or looks around.
    bool orbits() const { return mOrbit.on(); }
    // Takes the surface under the pointer as the place that the coming drags and zooms are about; empty: the
    // middle of the object.
    void takeHold(const std::optional<glm::dvec3>& place);
    // Drags by the pointer's motion to the right and up, in units of the picture's plane at view depth 1, of
    // which the picture is `height` high.
    void drag(OrbitDrag drag, const glm::dvec2& by, double height);
    // Takes the wheel for zooming; false where it does something else.
    bool zoomsByWheel() const { return mOrbit.on() && !mSlices.shown() && !mPaths.playing(); }
    bool zooming() const { return mOrbit.zooming(); }
    void zoomBy(double notches);
    // Lets dt seconds pass. The input's speed multiplier is applied in addition to the session's.
    void step(const FlightInput& input, double dt);
    // Takes a frame, by which the eyes follow the room.
    void observe(const ViewFrame& frame);
    // Takes the measurement of a frame that rests.
    void observe(const FrameTruth& truth) { mMeasured = truth; }

    // Continues the versions of requests after those of another session.
    void continueVersions(long long last) {
        mRequest.version = last;
        mFresh = true;
    }
    // Returns the request for a composed picture of this size; its version grows with every difference.
    // ahead: seconds until the picture is there, while something moves: the eyes are where they will be then.
    // scale: share of the width and height. guard: shares of them that are cast beyond each side.
    const FrameRequest& requestFor(int width, int height, double ahead = 0, double scale = 1,
                                   const glm::dvec2& guard = glm::dvec2(0.0));
    // Returns the future pose: on a path as it continues, in flight by the present motion, but at most half
    // of the way to the surroundings.
    Pose poseAhead(double seconds) const;
    double time() const { return mTime; }  // time in seconds of moving parts of the scene
    // Sets whether moving parts of the scene move while nothing else does, or stop, so that the picture can
    // become the truth.
    void driftAtRest(bool drifts) { mDriftsAtRest = drifts; }
    ComposeSetting compose() const;

    bool moving() const { return mMoving; }  // things change without input: do not sleep
    // Returns whether the pose or the picture's content changes: eyes that only come together or apart do not
    // count, and follow whole pictures.
    bool flying() const { return mFlying; }
    bool mouseCaptured() const { return mCaptured; }
    // Returns true once after each Screenshot.
    bool takeScreenshotWish() { return std::exchange(mScreenshot, false); }
    const std::string& notice() const { return mNotice.text(); }
    void notify(const std::string& text) { mNotice.say(text); }

    StereoSetting stereo() const { return mStereo.now(); }
    const ViewStereo& eyes() const { return mStereo; }
    ViewStereo& eyes() { return mStereo; }  // for changes other than by keys
    void setTruth(TruthView truth) { mTruth = truth; }
    // Paints over the surfaces from the next frame on; null: nothing.
    void setPaint(const std::shared_ptr<const EyePainter>& paint) {
        if (paint == mPaint) return;
        mPaint = paint;
        mFresh = true;
    }
    const std::shared_ptr<const EyePainter>& paint() const { return mPaint; }
    TruthView truth() const { return mTruth; }
    // Returns the measurement of the picture that rests; "" where it is of another one.
    std::string measuredText(const ViewFrame& frame) const;
    const FrameTruth& measured() const { return mMeasured; }
    bool followsClearance() const { return mStereo.follows(); }
    OutputMode mode() const { return mShown.mode; }
    Pose pose() const { return mPaths.playing() ? mPaths.played() : flight().pose(); }
    const Flight& flight() const { return mFlight.flight(); }

private:
    bool hasOtherShape(int width, int height) const;  // compared with the last pictures that were asked for
    bool actOnStereo(const ViewAction& action);
    bool actOnEyes(ViewCommand command);
    void stepMode(int by);
    void toggleStereo();
    void nextMethod();
    void setOrbit(bool on);
    void stepZoom(double dt);
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
    SessionOrbit mOrbit;
    SessionPath mPaths;
    SessionLight mLight;
    SessionSurface mSurface;
    SessionSlices mSlices;
    MotionAhead mAhead;
    ViewStereo mStereo;
    double mDepthAhead = 0;  // in metres
    ShownMode mShown, mFirst;
    bool mQuadBuffer = false;  // whether the window has a quad buffer
    std::string_view mMethod;
    TruthView mTruth = TruthView::None;
    std::shared_ptr<const EyePainter> mPaint;
    FrameTruth mMeasured;
    double mShape = 0;           // width to height of the last pictures of an eye that were asked for
    std::optional<double> mFov;  // radians; empty: the scene's
    double mTime = 0;            // time in seconds of moving parts of the scene
    bool mDriftsAtRest = true;
    bool mSwapped = false, mLinear = false, mCaptured = false;
    bool mMoving = false, mFlying = false, mScreenshot = false;
    bool mFresh = true;
    FrameRequest mRequest;
};

}  // namespace stereonav
