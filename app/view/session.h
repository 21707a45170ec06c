// What the viewer's user does and sees, without a window: flight, stereo settings, output mode, recording
// and playing, slices and what they ask for. The window's thread owns it and calls step() in turn.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/flight_recording.h"
#include "app/view/slices.h"
#include "app/view/stereo.h"
#include "app/view/worker.h"
#include "engine/image/stereo_compose.h"
#include "engine/nav/flight.h"
#include "engine/nav/flight_to.h"
#include "engine/nav/motion_ahead.h"

namespace stereonav {

enum class ViewCommand {
    Quit,  // first what is open over the picture, then the window
    // Of the interface, not the session.
    Help,
    HideInterface,
    Panels,
    LeftPanels,
    Unfolded,
    Controls,
    Search,
    OpenFile,
    SaveScene,
    StartPage,
    Undo,
    Redo,
    AddPlace,
    CopyPlace,
    MeasurePlace,
    ToggleCoverage,
    NextUnseen,
    PreviousUnseen,
    AddFinding,
    OpenPath,
    FullScreen,
    QuitAtOnce,
    // Of the session.
    Screenshot,
    Home,
    TurnRound,
    Reset,
    NextFlightMode,
    SetFlightMode,
    SpeedByDistance,
    ToggleStereo,
    SwapEyes,
    NextMode,
    PreviousMode,
    SetMode,
    NextMethod,
    ShowFullCast,  // these three: again ends it
    ShowDifference,
    ShowHoles,
    NextModel,
    LinearAnaglyph,
    LessSeparation,
    MoreSeparation,
    NearerZeroParallax,
    FartherZeroParallax,
    Record,
    Play,
    CaptureMouse,
    FollowClearance,
    KeepComfortable,
    LowerIsovalue,
    HigherIsovalue,
    ToggleTranslucent,
    NextTransfer,
    NextAmbient,
    PreviousAmbient,
    SmallerRadius,
    LargerRadius,
    NextModulation,
    LessSigma,
    MoreSigma,
    Slices,
    NextSlice,
    PreviousSlice,
    RemoveSeed,
    FindAgain,
    LowerSun,
    HigherSun,
    SunAnticlockwise,
    SunClockwise,

};

struct ViewAction {
    ViewCommand command;
    OutputMode mode = OutputMode::Left;  // of SetMode
    int number = 0;                      // of SetFlightMode
};

// Another scene that the user asks for: the same study, seen differently, or with its lumen found again of
// other pieces.
struct SceneChange {
    SurfaceChange surface;
    std::optional<PieceChoices> pieces;
};

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

    // The flight goes on in another scene, at the same place or where that one has room for it.
    void replaceScene(std::shared_ptr<const OpenScene> scene);
    // What was asked for since the last call.
    std::optional<SceneChange> takeSceneChange();
    // Of the last change, when it can not be done: what is shown counts again.
    void forgetSceneChange();

    void act(const ViewAction& action);
    // Settings by value, as panels have them; the scene takes them with the next frame, or by a SceneChange.
    void chooseMode(OutputMode mode) { act({ViewCommand::SetMode, mode}); }
    void chooseMethod(std::string_view method);  // one of the scene's
    void chooseModel(int model);                 // of LightModels::names()
    void placeSun(const SunPlace& place);
    void setEyes(const StereoSetting& eyes);         // slowly, and by hand from now on
    void setFov(std::optional<double> verticalFov);  // radians; none: the scene's
    void setSurface(const SurfaceChange& surface);
    void goTo(const Pose& pose);
    // Flies there by itself, until the person takes over (engine/nav/flight_to.h).
    void flyTo(const Pose& pose);
    void flyAlong(double along);  // metres along the way through; nothing where there is none
    bool flyingToGoal() const { return mGoal.has_value(); }
    std::string_view method() const { return mMethod; }
    int model() const { return mModel; }
    const SunPlace& sun() const { return mSun; }
    Lens lens() const;  // without a size
    SurfaceChange surface() const;
    const StereoSetting& eyesWanted() const { return mStereo.target(); }
    bool stereoOn() const { return mStereoOn; }
    bool swapped() const { return mSwapped; }
    const OpenScene& open() const { return *mScene; }
    const std::shared_ptr<const OpenScene>& openShared() const { return mScene; }
    const std::shared_ptr<const SliceStudy>& study() const { return mStudy; }
    // The study is read for panels, without the slice view.
    void wishStudy();
    void dropStudyWish() { mStudyWished = mSliceViewWished = false; }
    void keepStudy(std::shared_ptr<const SliceStudy> study) { mStudy = std::move(study); }
    bool wantsSliceView() const { return mSliceViewWished; }
    OutputMode firstMode() const { return mFirstMode; }
    double speed() const { return mSpeed * mPace * mFlight->speed(); }  // metres a second at full input
    // The speed follows the distance of what lies ahead (engine/nav/depth_speed.h); the wheel's is a factor.
    bool speedByDistance() const { return mSpeedByDistance; }
    const RecordedPath& path() const { return mPath; }
    // Puts another one in its place; what fails is told. The last ones can be had back.
    void editPath(const std::function<RecordedPath(const RecordedPath&)>& edit);
    void openPath(RecordedPath path);  // the same, with one that lies in a file
    void undoPath();
    void savePath();
    // Before the session ends: what is being recorded ends, and it or a path that was changed and not saved
    // goes into a file. What to tell of that; "" where there is neither.
    std::string keepWork();
    // In its place without a step back or a word: one that is being worked on.
    void setPath(RecordedPath path);
    long long pathVersion() const { return mPathVersion; }  // another one with every other path
    double playTime() const { return mPlayTime; }
    double recorded() const { return mRecorder->duration(); }  // seconds

    // Turns by radians: clockwise seen from above, upwards.
    void look(double yaw, double pitch);
    void turnWheel(double notches);  // each notch a fifth faster; in the slice view, a slice
    // In the slice view sets a seed; x, y: pixels of the last slice picture. What to tell, "" when nothing.
    std::string click(double x, double y);
    // dt seconds pass. The input's speed multiplier is applied on top of the session's own.
    void step(const FlightInput& input, double dt);
    // A frame has come: what it shows guides what follows the room.
    void observe(const ViewFrame& frame);
    // What was measured of one that rests.
    void observe(const FrameTruth& truth) { mMeasured = truth; }

    // The slice view. The study is read by the caller, whom takeStudyWish() tells once.
    bool slicesShown() const { return mSlices.has_value(); }
    bool takeStudyWish();
    void showSlices(std::shared_ptr<const SliceStudy> study);
    const Plane<PackedColor>& slicePicture(int width, int height);
    long long sliceVersion() const { return mSlices ? mSlices->version() : 0; }
    std::string sliceStatus() const { return mSlices ? mSlices->status() : ""; }

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
    bool takeScreenshotWish();
    const std::string& notice() const { return mNotice; }
    void notify(const std::string& text);

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
    Pose pose() const { return mPlaying ? mPlayed : mFlight->pose(); }
    const Flight& flight() const { return *mFlight; }
    bool playing() const { return mPlaying; }
    bool recording() const { return mRecorder->recording(); }

private:
    bool hasOtherShape(int width, int height) const;  // than the pictures that were asked for last
    bool actOnStereo(const ViewAction& action);
    bool actOnEyes(ViewCommand command);
    bool actOnVolume(ViewCommand command);
    bool actOnSun(ViewCommand command);
    void turnSun(double azimuth, double elevation);
    bool actOnSlices(ViewCommand command);
    void actOnFlight(const ViewAction& action);
    bool actOnAmbient(ViewCommand command);
    void moveIsovalue(double steps);
    void nextTransfer();
    void stepAmbient(int by);
    void scaleRadius(double factor);
    void nextModulation();
    void scaleSigma(double factor);
    double sigmaNow() const;
    std::string ambientText() const;
    std::string modulationText() const;
    std::string volumeText() const;
    void askForChange();
    void openSlices();
    void closeSlices();
    void fly(const FlightInput& input, double dt);
    void stepPace(double dt);
    void stepGoal(double dt);
    void startGoal(const std::function<FlightTo(const Flight&)>& goal);
    void turnRound();
    void stepMode(int by);
    void nextMethod();
    void showTruth(ViewCommand command);
    void nextModel();
    void reset();
    void takeSurface();
    void toggleRecording();
    void saveFlight();
    void writtenTo(const std::function<std::filesystem::path()>& write);
    enum class PathIs { InFile, Unsaved };
    void takePath(RecordedPath path, PathIs where);
    void putPath(const std::function<RecordedPath(const RecordedPath&)>& edit, PathIs where);
    void dropOldestPaths();
    void togglePlaying();
    void stepPlaying(double dt);
    void stopPlaying();

    const Scene& shown() const { return *mScene->scene; }
    template <typename C>
    C* offered() const {
        return shown().offered<C>();
    }

    std::shared_ptr<const OpenScene> mScene;
    std::unique_ptr<Flight> mFlight;
    int mFirstFlightMode = 0;
    std::optional<FlightTo> mGoal;
    std::unique_ptr<FlightRecording> mRecorder;
    RecordedPath mPath;               // what Play plays
    PathIs mPathIs = PathIs::InFile;  // the scene's own needs no file
    long long mPathVersion = 0;
    bool mPlaying = false;
    double mPlayTime = 0;  // seconds since the path's start
    Pose mPlayed;
    MotionAhead mAhead;
    bool mOwnPath = false;  // mPath is the scene's own
    struct PathBefore {
        RecordedPath path;
        bool own;  // the scene's: given back, it is that of the scene that is shown then
        PathIs where;
    };
    std::vector<PathBefore> mPathsBefore;
    ViewStereo mStereo;
    double mDepthAhead = 0;  // metres
    SunPlace mSun;
    std::optional<double> mIsovalue;
    bool mTranslucent = false;
    std::string mTransfer, mTriedTransfer;  // the second may not have gone
    std::optional<AmbientChoice> mAmbient;
    std::string mMethodUnlit;  // its method, before ambient light was turned on
    std::optional<SceneChange> mChange;
    std::optional<SliceView> mSlices;
    std::shared_ptr<const SliceStudy> mStudy;
    bool mStudyWished = false, mSliceViewWished = false;
    std::optional<PieceChoices> mPieceChoices;  // when the slice view was left
    int mSliceWidth = 1, mSliceHeight = 1;      // pixels of the last slice picture
    OutputMode mMode, mFirstMode;
    bool mQuadBuffer = false;  // whether the window has one
    std::string_view mMethod;
    int mModel = 0;
    TruthView mTruth = TruthView::None;
    std::shared_ptr<const EyePainter> mPaint;
    FrameTruth mMeasured;
    double mShape = 0;           // width to height of the eyes' pictures that were asked for last
    std::optional<double> mFov;  // radians; none: the scene's
    double mTime = 0;            // seconds, of what moves by itself
    bool mDriftsAtRest = true;
    bool mStereoOn = true, mSwapped = false, mLinear = false, mQuit = false, mCaptured = false;
    bool mMoving = false, mFlying = false, mScreenshot = false;
    bool mResting = false, mLooked = false, mFresh = true;
    double mSpeed = 1;  // by the wheel
    double mPace = 1;   // by the distance ahead
    bool mSpeedByDistance = false;
    std::string mNotice;
    double mNoticeLeft = 0;  // seconds
    FrameRequest mRequest;
};

}  // namespace stereonav
