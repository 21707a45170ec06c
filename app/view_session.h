// What the viewer's user does and sees, without a window: flight, stereo settings, output mode,
// recording and playing, the line of figures. The window's thread owns it and calls step() in turn.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/view_worker.h"
#include "engine/image/stereo_compose.h"
#include "engine/nav/navigator.h"
#include "engine/nav/path_recorder.h"

namespace stereonav {

enum class ViewCommand {
    Quit,
    Help,
    Screenshot,
    Home,
    Reset,
    ToggleFollow,
    ToggleStereo,
    SwapEyes,
    NextMode,
    PreviousMode,
    SetMode,
    NextMethod,
    LinearAnaglyph,
    LessSeparation,
    MoreSeparation,
    NearerZeroParallax,
    FartherZeroParallax,
    Record,
    Play,
    CaptureMouse,
};

struct ViewAction {
    ViewCommand command;
    OutputMode mode = OutputMode::Left;  // of SetMode
};

// Parallax that is comfortable, as shares of the picture's width: the whole range, and the short
// excursions that broadcasters allow before and behind the screen.
constexpr double kParallaxBudget = 0.03, kNearestParallax = -0.025, kFarthestParallax = 0.04;

class ViewSession {
public:
    struct Options {
        OutputMode mode = OutputMode::SideBySide;
        std::optional<RecordedPath> path;  // what Play plays before anything is recorded
        std::filesystem::path folder;      // for recorded flights
    };
    // scene must outlive the session.
    ViewSession(const ViewScene& scene, const Options& options);

    void act(const ViewAction& action);
    // Turns by radians: clockwise seen from above, upwards.
    void look(double yaw, double pitch);
    void changeSpeed(double notches);  // each notch a fifth faster
    // dt seconds pass. The input's speed multiplier is applied on top of the session's own.
    void step(const FlightInput& input, double dt);

    // What to render for a framebuffer of this size; the version grows with every difference.
    const FrameRequest& requestFor(int width, int height);
    ComposeSetting compose() const;

    bool quit() const { return mQuit; }
    bool moving() const { return mMoving; }  // things change by themselves: do not sleep
    bool helpShown() const { return mHelp; }
    bool mouseCaptured() const { return mCaptured; }
    // True once after each Screenshot.
    bool takeScreenshotWish();
    const std::string& notice() const { return mNotice; }
    void notify(const std::string& text);

    // "24.0 fps  left 3.1 ms  warp ..."; ASCII, which is all that the overlay's font is asked for.
    std::string statusLine(const ViewFrame& frame, double framesPerSecond) const;
    // "" while the parallax of the frame is comfortable.
    std::string warningLine(const ViewFrame& frame) const;

    const StereoSetting& stereo() const { return mStereo; }
    OutputMode mode() const { return mMode; }
    Pose pose() const { return mPlaying ? mPlayed : mNavigator.pose(); }
    bool playing() const { return mPlaying; }
    bool recording() const { return mRecorder.recording(); }

private:
    bool actOnStereo(const ViewAction& action);
    void actOnFlight(ViewCommand command);
    void scaleSeparation(double factor);
    void scaleZeroParallax(double factor);
    void fly(const FlightInput& input, double dt);
    void stepMode(int by);
    void nextMethod();
    void reset();
    void toggleRecording();
    void saveFlight();
    void togglePlaying();
    void stepPlaying(double dt);
    void stopPlaying();
    void stepStereo(double dt);

    const ViewScene& mScene;
    std::filesystem::path mFolder;
    Navigator mNavigator;
    PathRecorder mRecorder;
    RecordedPath mPath;  // what Play plays
    bool mPlaying = false;
    double mPlayTime = 0;  // seconds since the path's start
    Pose mPlayed;
    StereoSetting mStereo, mTarget;  // now, and where it slowly goes
    OutputMode mMode, mFirstMode;
    RightEyeMethod mMethod;
    bool mStereoOn = true, mSwapped = false, mLinear = false, mHelp = false, mQuit = false, mCaptured = false;
    bool mMoving = false, mScreenshot = false;
    bool mResting = false, mLooked = false;
    double mSpeed = 1;
    std::string mNotice;
    double mNoticeLeft = 0;  // seconds
    FrameRequest mRequest;
};

}  // namespace stereonav
