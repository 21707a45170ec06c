// The viewer's state and what each command does to it.
#include "app/view_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kStereoStep = 1.1;  // separation and zero parallax, a key press
constexpr double kSpeedStep = 1.2;   // a notch of the wheel
constexpr double kSlowest = 0.01, kFastest = 100.0;
constexpr double kStereoSeconds = 0.35;  // time constant: eyes follow a slow change, not a jump
constexpr double kSettled = 1e-3;        // relative difference at which a slow change ends
constexpr double kNoticeSeconds = 4.0;
constexpr double kCrossingSeconds = 45.0;    // to cross the scene at normal speed
constexpr double kStill = 1e-4;              // of the normal speed, and radians a second: at rest
constexpr double kFirstSeparation = 1e-3;    // of the zero-parallax distance: the step up from none
constexpr double kLargestSeparation = 0.25;  // of the zero-parallax distance

FlightSetting flightSettingOf(const ViewScene& scene) {
    FlightSetting setting;
    setting.clearance = scene.clearance;
    setting.followHeight = std::max(4 * scene.clearance, scene.extent / 150);
    setting.speed = scene.extent / kCrossingSeconds;
    setting.groundStep = scene.groundStep;
    return setting;
}

// Exponential approach in the logarithm, so that halving and doubling feel alike.
double approach(double now, double target, double dt) {
    if (!(now > 0) || !(target > 0) || std::abs(now - target) <= kSettled * target) return target;
    return target * std::pow(now / target, std::exp(-dt / kStereoSeconds));
}

// Whether so little moved within dt seconds that the flight counts as at rest.
bool atRest(const Pose& before, const Pose& after, double speed, double dt) {
    const double moved = glm::length(after.position - before.position);
    const glm::dquat turned = after.orientation - before.orientation;
    return moved <= kStill * speed * dt && glm::length(turned) <= kStill * dt;
}

bool samePose(const Pose& a, const Pose& b) {
    return a.position == b.position && a.orientation == b.orientation;
}

bool sameFrame(const FrameRequest& a, const FrameRequest& b) {
    return samePose(a.pose, b.pose) && a.lens.width == b.lens.width && a.lens.height == b.lens.height &&
           a.stereo.separation == b.stereo.separation && a.stereo.zeroParallax == b.stereo.zeroParallax &&
           a.warp.method == b.warp.method && a.twoEyes == b.twoEyes && a.mode == b.mode;
}

bool asksForMotion(const FlightInput& input) {
    for (const double v :
         {input.forward, input.right, input.up, input.yawRate, input.pitchRate, input.rollRate})
        if (v != 0) return true;
    return false;
}

std::string metres(double value) {
    if (value >= 1000) return fmt::format("{:.2f} km", value / 1000);
    return fmt::format("{:.{}f} m", value, value >= 100 ? 0 : value >= 10 ? 1 : 2);
}

}  // namespace

ViewSession::ViewSession(const ViewScene& scene, const Options& options)
    : mScene(scene),
      mFolder(options.folder),
      mNavigator(scene.ground, scene.start, flightSettingOf(scene)),
      mPath(options.path ? *options.path : scene.path),
      mStereo(scene.stereo),
      mTarget(scene.stereo),
      mMode(options.mode),
      mFirstMode(options.mode),
      mMethod(scene.method) {}

void ViewSession::act(const ViewAction& action) {
    mResting = false;
    if (actOnStereo(action)) return;
    switch (action.command) {
        case ViewCommand::Quit:
            mQuit = true;
            break;
        case ViewCommand::Help:
            mHelp = !mHelp;
            break;
        case ViewCommand::Screenshot:
            mScreenshot = true;
            break;
        case ViewCommand::CaptureMouse:
            mCaptured = !mCaptured;
            break;
        case ViewCommand::Record:
            toggleRecording();
            break;
        case ViewCommand::Play:
            togglePlaying();
            break;
        default:
            actOnFlight(action.command);
    }
}

bool ViewSession::actOnStereo(const ViewAction& action) {
    switch (action.command) {
        case ViewCommand::ToggleStereo:
            mStereoOn = !mStereoOn;
            notify(mStereoOn ? "stereo on" : "stereo off");
            return true;
        case ViewCommand::SwapEyes:
            mSwapped = !mSwapped;
            notify(mSwapped ? "eyes swapped" : "eyes as they are");
            return true;
        case ViewCommand::NextMode:
            stepMode(1);
            return true;
        case ViewCommand::PreviousMode:
            stepMode(-1);
            return true;
        case ViewCommand::SetMode:
            mMode = action.mode;
            stepMode(0);
            return true;
        case ViewCommand::NextMethod:
            nextMethod();
            return true;
        case ViewCommand::LinearAnaglyph:
            mLinear = !mLinear;
            notify(mLinear ? "anaglyph in linear light" : "anaglyph on encoded values");
            return true;
        case ViewCommand::LessSeparation:
            scaleSeparation(1 / kStereoStep);
            return true;
        case ViewCommand::MoreSeparation:
            scaleSeparation(kStereoStep);
            return true;
        case ViewCommand::NearerZeroParallax:
            scaleZeroParallax(1 / kStereoStep);
            return true;
        case ViewCommand::FartherZeroParallax:
            scaleZeroParallax(kStereoStep);
            return true;
        default:
            return false;
    }
}

void ViewSession::scaleSeparation(double factor) {
    const double least = kFirstSeparation * mTarget.zeroParallax;
    mTarget.separation =
        factor > 1 ? std::max(mTarget.separation * factor, least) : mTarget.separation * factor;
    if (mTarget.separation < least) mTarget.separation = 0;
    mTarget.separation = std::min(mTarget.separation, kLargestSeparation * mTarget.zeroParallax);
}

void ViewSession::scaleZeroParallax(double factor) {
    mTarget.zeroParallax = std::max(mTarget.zeroParallax * factor, mTarget.separation / kLargestSeparation);
}

void ViewSession::actOnFlight(ViewCommand command) {
    stopPlaying();
    if (command == ViewCommand::Home) {
        mNavigator.goHome();
    } else if (command == ViewCommand::Reset) {
        reset();
    } else if (command == ViewCommand::ToggleFollow) {
        const bool follows = mNavigator.flightMode() == FlightMode::FollowGround;
        mNavigator.setMode(follows ? FlightMode::Free : FlightMode::FollowGround);
        notify(follows ? "free flight" : "following the ground");
    }
}

void ViewSession::stepMode(int by) {
    const int count = static_cast<int>(outputModes().size());
    mMode = static_cast<OutputMode>((static_cast<int>(mMode) + by + count) % count);
    notify(fmt::format("{} ({})", infoOf(mMode).longName, infoOf(mMode).shortName));
}

void ViewSession::nextMethod() {
    const auto at = std::find_if(kRightEyeMethods.begin(), kRightEyeMethods.end(),
                                 [&](const NamedMethod& m) { return m.method == mMethod; });
    const std::size_t next =
        (static_cast<std::size_t>(at - kRightEyeMethods.begin()) + 1) % kRightEyeMethods.size();
    mMethod = kRightEyeMethods[next].method;
    notify(fmt::format("right eye: {}", kRightEyeMethods[next].name));
}

void ViewSession::reset() {
    mNavigator.setMode(FlightMode::Free);
    mNavigator.goHome();
    mTarget = mScene.stereo;
    mMode = mFirstMode;
    mMethod = mScene.method;
    mStereoOn = true;
    mSwapped = mLinear = false;
    mSpeed = 1;
    notify("reset");
}

void ViewSession::look(double yaw, double pitch) {
    if (mPlaying || (yaw == 0 && pitch == 0)) return;
    mNavigator.turnBy(yaw, pitch);
    mLooked = true;
}

void ViewSession::changeSpeed(double notches) {
    if (notches == 0) return;
    mSpeed = std::clamp(mSpeed * std::pow(kSpeedStep, notches), kSlowest, kFastest);
    notify(fmt::format("speed {}/s", metres(mSpeed * mNavigator.setting().speed)));
}

void ViewSession::toggleRecording() {
    if (mRecorder.recording()) return saveFlight();
    stopPlaying();
    mRecorder.start(mNavigator.pose());
    notify("recording; z ends it");
}

void ViewSession::saveFlight() {
    try {
        mPath = mRecorder.finish();
        std::filesystem::path file;
        int number = 1;
        do file = mFolder / fmt::format("flight_{:04}.gltf", number++);
        while (std::filesystem::exists(file));
        writePath(file, mPath);
        notify(fmt::format("flight of {:.1f} s recorded in {}; Z plays it", mPath.duration(), file.string()));
    } catch (const Error& error) {
        notify(error.what());
    }
}

void ViewSession::togglePlaying() {
    if (mPlaying) return stopPlaying();
    if (mRecorder.recording()) saveFlight();
    if (mPath.samples().size() < 2) return notify("there is no flight to play; z records one");
    mPlaying = true;
    mPlayTime = 0;
    mPlayed = mPath.at(mPath.startTime());
    notify(fmt::format("playing {:.1f} s", mPath.duration()));
}

void ViewSession::stopPlaying() {
    if (!mPlaying) return;
    mPlaying = false;
    mNavigator.setPose(mPlayed);
    notify(fmt::format("played {:.1f} s", mPlayTime));
}

void ViewSession::stepPlaying(double dt) {
    mPlayTime = std::min(mPlayTime + dt, mPath.duration());
    mPlayed = mPath.at(mPath.startTime() + mPlayTime);
    if (mPlayTime >= mPath.duration()) stopPlaying();
}

void ViewSession::stepStereo(double dt) {
    mStereo.separation = approach(mStereo.separation, mTarget.separation, dt);
    mStereo.zeroParallax = approach(mStereo.zeroParallax, mTarget.zeroParallax, dt);
}

void ViewSession::fly(const FlightInput& input, double dt) {
    FlightInput wish = input;
    wish.speedMultiplier *= mSpeed;
    const Pose before = mNavigator.pose();
    if (!mResting || asksForMotion(input)) mNavigator.step(wish, dt);
    if (dt > 0)
        mResting = !asksForMotion(input) &&
                   atRest(before, mNavigator.pose(), mNavigator.setting().speed * mSpeed, dt);
    mRecorder.step(dt, mNavigator.pose());
}

void ViewSession::step(const FlightInput& input, double dt) {
    const StereoSetting before = mStereo;
    stepStereo(dt);
    const Pose poseBefore = pose();
    const bool looked = std::exchange(mLooked, false);
    if (mPlaying) {
        stepPlaying(dt);
    } else {
        fly(input, dt);
    }
    if (mNoticeLeft > 0 && (mNoticeLeft -= dt) <= 0) mNotice.clear();
    const bool stereoMoves =
        before.separation != mStereo.separation || before.zeroParallax != mStereo.zeroParallax;
    mMoving = mPlaying || recording() || stereoMoves || asksForMotion(input) || looked ||
              !samePose(poseBefore, pose());
}

void ViewSession::notify(const std::string& text) {
    mNotice = text;
    mNoticeLeft = kNoticeSeconds;
}

bool ViewSession::takeScreenshotWish() {
    return std::exchange(mScreenshot, false);
}

const FrameRequest& ViewSession::requestFor(int width, int height) {
    const auto [eyeWidth, eyeHeight] = eyeSizeFor(compose().mode, width, height);
    FrameRequest wanted;
    wanted.pose = pose();
    wanted.lens = mScene.lens;
    wanted.lens.width = eyeWidth;
    wanted.lens.height = eyeHeight;
    wanted.stereo = mStereo;
    wanted.warp.method = mMethod;
    wanted.twoEyes = mStereoOn;
    wanted.mode = compose().mode;
    wanted.version = mRequest.version;
    if (wanted.version == 0 || !sameFrame(wanted, mRequest)) ++wanted.version;
    mRequest = wanted;
    return mRequest;
}

ComposeSetting ViewSession::compose() const {
    return {mStereoOn ? mMode : OutputMode::Left, mStereoOn && mSwapped, mLinear};
}

std::string ViewSession::statusLine(const ViewFrame& frame, double framesPerSecond) const {
    // Nothing is known of the rate before the first frames that followed each other.
    std::string line = framesPerSecond > 0 ? fmt::format("{:.1f} fps  ", framesPerSecond) : "";
    line += fmt::format("left {:.1f} ms", frame.left_ms);
    if (!frame.request.twoEyes) return line + "  one eye";
    const double pixels = static_cast<double>(frame.left.width()) * frame.left.height();
    line += fmt::format(
        "  warp {:.1f} ms  fill {:.1f} ms  holes {:.1f} %  {}  {}{}", frame.rightTimings.warp_ms,
        frame.rightTimings.fill_ms, 100 * static_cast<double>(frame.rightTimings.holePixels) / pixels,
        nameOf(frame.request.warp.method), infoOf(mMode).longName, mSwapped ? " swapped" : "");
    line += fmt::format("  separation {}  zero parallax {}  parallax {:+.1f} to {:+.1f} %",
                        metres(frame.request.stereo.separation), metres(frame.request.stereo.zeroParallax),
                        100 * frame.nearParallax, 100 * frame.farParallax);
    if (mPlaying) line += fmt::format("  playing {:.1f} of {:.1f} s", mPlayTime, mPath.duration());
    if (recording()) line += fmt::format("  recording {:.1f} s", mRecorder.duration());
    return line;
}

std::string ViewSession::warningLine(const ViewFrame& frame) const {
    if (!frame.request.twoEyes) return "";
    const double range = frame.farParallax - frame.nearParallax;
    if (range > kParallaxBudget)
        return fmt::format(
            "parallax spans {:.1f} % of the width, more than {:.0f} %: [ brings the eyes together",
            100 * range, 100 * kParallaxBudget);
    if (frame.nearParallax < kNearestParallax)
        return "the nearest things stand too far before the screen: ; brings the screen nearer";
    if (frame.farParallax > kFarthestParallax)
        return "the farthest things lie too far behind the screen: ' moves the screen away";
    return "";
}

}  // namespace stereonav
