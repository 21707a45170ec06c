// The viewer's state and what each command does to it.
#include "app/view/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/output/length_text.h"
#include "app/view/mode_steps.h"
#include "app/view/status.h"
#include "engine/base/error.h"
#include "engine/nav/depth_speed.h"

namespace stereonav {
namespace {

constexpr double kStereoStep = 1.1;  // separation and zero parallax, a key press
constexpr double kSpeedStep = 1.2;   // a notch of the wheel
constexpr double kSlowest = 0.01, kFastest = 100.0;
constexpr double kNoticeSeconds = 4.0;
constexpr double kOtherShape = 0.02;  // of width to height: less is rounding to pixels
constexpr double kEvenPace = 1e-3;    // relative difference at which the pace is the wanted one
constexpr double kStill = 1e-4;       // of the normal speed, and radians a second: at rest

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
    return samePose(a.pose, b.pose) && a.lens == b.lens && a.stereo == b.stereo &&
           a.way.method == b.way.method && a.model == b.model && a.time == b.time && a.paint == b.paint &&
           a.twoEyes == b.twoEyes && a.mode == b.mode && a.sun == b.sun && a.fitEyes == b.fitEyes &&
           a.truth == b.truth && a.guard == b.guard;
}

bool mixesEyes(OutputLayout layout) {
    switch (layout) {
        case OutputLayout::SideBySide:
        case OutputLayout::TopBottom:
        case OutputLayout::FramePacked:
            return false;
        default:
            return true;
    }
}

bool asksForMotion(const FlightInput& input) {
    for (const double v :
         {input.forward, input.right, input.up, input.yawRate, input.pitchRate, input.rollRate})
        if (v != 0) return true;
    return false;
}

}  // namespace

ViewSession::ViewSession(std::shared_ptr<const OpenScene> scene, const Options& options)
    : mScene(std::move(scene)),
      mFlight(shown().makeFlight()),
      mFirstFlightMode(mFlight->mode()),
      mRecorder(std::make_unique<FlightRecording>(options.folder)),
      mPath(options.path ? *options.path : shown().path),
      mOwnPath(!options.path),
      mStereo(shown()),
      mSun(mScene->sun),
      mMode(options.mode),
      mFirstMode(options.mode),
      mQuadBuffer(options.quadBuffer),
      mMethod(mScene->way.method),
      mModel(mScene->model),
      mSpeedByDistance(options.speedByDistance) {
    takeSurface();
    if (const auto* const surface = offered<SurfaceChoices>()) mTriedTransfer = surface->transfer;
}

void ViewSession::act(const ViewAction& action) {
    // A picture of what rests is of just that: it does not set going what is left of the motion.
    if (action.command != ViewCommand::Screenshot) mResting = false;
    if (actOnSlices(action.command) || actOnVolume(action.command) || actOnSun(action.command) ||
        actOnEyes(action.command) || actOnStereo(action))
        return;
    switch (action.command) {
        case ViewCommand::Quit:
            mQuit = true;
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
        case ViewCommand::SpeedByDistance:
            mSpeedByDistance = !mSpeedByDistance;
            notify(mSpeedByDistance ? "the speed follows the distance ahead" : "the same speed everywhere");
            break;
        default:
            actOnFlight(action);
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
            if (action.mode == OutputMode::QuadBuffer && !mQuadBuffer)
                return notify("this window has no buffer for each eye: start with --mode quad"), true;
            mMode = action.mode;
            stepMode(0);
            return true;
        case ViewCommand::ShowFullCast:
        case ViewCommand::ShowDifference:
        case ViewCommand::ShowHoles:
            showTruth(action.command);
            return true;
        case ViewCommand::NextMethod:
            nextMethod();
            return true;
        case ViewCommand::NextModel:
            nextModel();
            return true;
        case ViewCommand::LinearAnaglyph:
            mLinear = !mLinear;
            notify(mLinear ? "anaglyph in linear light" : "anaglyph on encoded values");
            return true;
        default:
            return false;
    }
}

bool ViewSession::actOnEyes(ViewCommand command) {
    switch (command) {
        case ViewCommand::LessSeparation:
            mStereo.scaleSeparation(1 / kStereoStep);
            return true;
        case ViewCommand::MoreSeparation:
            mStereo.scaleSeparation(kStereoStep);
            return true;
        case ViewCommand::NearerZeroParallax:
            mStereo.scaleZeroParallax(1 / kStereoStep);
            return true;
        case ViewCommand::FartherZeroParallax:
            mStereo.scaleZeroParallax(kStereoStep);
            return true;
        case ViewCommand::FollowClearance:
            mStereo.follow();
            notify(mStereo.follows() ? "the eyes' separation follows the room around them"
                                     : "the eyes' separation is set by hand here: [ ]");
            return true;
        case ViewCommand::KeepComfortable:
            mStereo.setClamp(!mStereo.clamp());
            notify(mStereo.clamp() ? "the eyes come together where the picture is too much for them"
                                   : "the eyes stay as far apart as they are set");
            return true;
        default:
            return false;
    }
}

void ViewSession::actOnFlight(const ViewAction& action) {
    stopPlaying();
    mGoal.reset();
    if (action.command == ViewCommand::TurnRound) return turnRound();
    if (action.command == ViewCommand::Home) {
        mFlight->goHome();
    } else if (action.command == ViewCommand::Reset) {
        reset();
    } else if ((action.command == ViewCommand::NextFlightMode ||
                action.command == ViewCommand::SetFlightMode) &&
               mFlight->modeCount() > 0) {
        const int wanted =
            action.command == ViewCommand::NextFlightMode ? mFlight->mode() + 1 : action.number;
        mFlight->setMode(wanted % mFlight->modeCount());
        notify(fmt::format("flight: {}", mFlight->modeName(mFlight->mode())));
    }
}

// --- modes

void ViewSession::stepMode(int by) {
    mMode = steppedMode(mMode, by, mFirstMode);
    notify(fmt::format("{} ({})", infoOf(mMode).longName, infoOf(mMode).shortName));
}

void ViewSession::nextModel() {
    const auto* const models = offered<LightModels>();
    if (!models || models->names().empty()) return notify("lighting models are of media");
    mModel = (mModel + 1) % static_cast<int>(models->names().size());
    notify("light: " + models->names()[static_cast<std::size_t>(mModel)]);
}

void ViewSession::showTruth(ViewCommand command) {
    const TruthView wanted = command == ViewCommand::ShowFullCast     ? TruthView::FullCast
                             : command == ViewCommand::ShowDifference ? TruthView::Difference
                                                                      : TruthView::Holes;
    mTruth = mTruth == wanted ? TruthView::None : wanted;
    notify(mTruth == TruthView::None         ? "the right eye as it is made"
           : mTruth == TruthView::FullCast   ? "the right eye cast in full"
           : mTruth == TruthView::Difference ? "five times the right eye's difference from a full cast"
                                             : "the right eye with its holes in red");
}

void ViewSession::nextMethod() {
    const std::span<const std::string_view> methods = shown().frames().methods();
    const auto at = std::find(methods.begin(), methods.end(), mMethod);
    mMethod = methods[(static_cast<std::size_t>(at - methods.begin()) + 1) % methods.size()];
    notify(fmt::format("{}: {}", shown().frames().whatMethodsMake(), mMethod));
}

void ViewSession::reset() {
    mFlight->setMode(mFirstFlightMode);
    mFlight->goHome();
    mStereo.reset(shown());
    mMode = mFirstMode;
    mMethod = mScene->way.method;
    mModel = mScene->model;
    mSun = mScene->sun;
    mFov.reset();
    mStereoOn = true;
    mSwapped = mLinear = false;
    mSpeed = 1;
    notify("reset");
}

void ViewSession::look(double yaw, double pitch) {
    if (mPlaying || mSlices || (yaw == 0 && pitch == 0)) return;
    mGoal.reset();
    mFlight->turnBy(yaw, pitch);
    mLooked = true;
}

void ViewSession::turnWheel(double notches) {
    if (notches == 0) return;
    if (mSlices) return mSlices->turnPages(notches > 0 ? -1 : 1);
    mSpeed = std::clamp(mSpeed * std::pow(kSpeedStep, notches), kSlowest, kFastest);
    notify(fmt::format("speed {}/s", lengthText(speed())));
}

// Smoothly both ways, also where it is switched on or off.
void ViewSession::stepPace(double dt) {
    const bool known = mSpeedByDistance && mDepthAhead > 0;  // 0: no frame has told yet
    const double base = mFlight->speed(), wanted = known ? speedFor(mDepthAhead, base) / base : 1;
    mPace = dampedSpeed(mPace, wanted, dt);
    if (std::abs(mPace - wanted) <= kEvenPace * wanted) mPace = wanted;
}

void ViewSession::fly(const FlightInput& input, double dt) {
    FlightInput wish = input;
    wish.speedMultiplier *= mSpeed * mPace;
    if (mIsovalue) wish.rollRate = 0;  // the same keys move the surface
    const Pose before = mFlight->pose();
    if (asksForMotion(input)) mGoal.reset();
    if (mGoal) {
        stepGoal(dt);
        mRecorder->step(dt, mFlight->pose());
        return;
    }
    if (!mResting || asksForMotion(input)) mFlight->step(wish, dt);
    if (dt > 0)
        mResting = !asksForMotion(input) && atRest(before, mFlight->pose(), mFlight->speed() * mSpeed, dt);
    mRecorder->step(dt, mFlight->pose());
}

void ViewSession::step(const FlightInput& input, double dt) {
    const bool animated = offered<Animation>() != nullptr, drifts = animated && mDriftsAtRest;
    mStereo.step(mFlight->clearanceNow(), mDepthAhead, dt);
    stepPace(dt);
    const Pose poseBefore = pose();
    const bool looked = std::exchange(mLooked, false);
    if (mPlaying) {
        stepPlaying(dt);
    } else {
        fly(input, dt);
    }
    if (animated && mPlaying && dt > 0)
        mTime = mPlayTime;
    else if (animated && (drifts || mFlying))
        mTime += std::max(dt, 0.0);
    if (mNoticeLeft > 0 && (mNoticeLeft -= dt) <= 0) mNotice.clear();
    if (const std::string problem = mRecorder->takeProblem(); !problem.empty()) notify(problem);
    mFlying = mPlaying || mGoal || drifts || asksForMotion(input) || looked || !samePose(poseBefore, pose());
    mMoving = mFlying || recording() || mStereo.moving();
    mAhead.step(poseBefore, pose(), dt);
}

void ViewSession::notify(const std::string& text) {
    mNotice = text;
    mNoticeLeft = kNoticeSeconds;
}

Lens ViewSession::lens() const {
    Lens lens = shown().lens;
    if (mFov) lens.verticalFov = *mFov;
    return lens;
}

void ViewSession::chooseMethod(std::string_view method) {
    const std::span<const std::string_view> methods = shown().frames().methods();
    const auto at = std::find(methods.begin(), methods.end(), method);
    if (at != methods.end()) mMethod = *at;
}

void ViewSession::chooseModel(int model) {
    const auto* const models = offered<LightModels>();
    if (models && model >= 0 && model < static_cast<int>(models->names().size())) mModel = model;
}

void ViewSession::placeSun(const SunPlace& place) {
    if (offered<TurningLight>()) mSun = place;
}

void ViewSession::setEyes(const StereoSetting& eyes) {
    mResting = false;
    mStereo.setZeroParallax(eyes.zeroParallax);
    mStereo.setSeparation(eyes.separation);
}

void ViewSession::setFov(std::optional<double> verticalFov) {
    mFov = verticalFov;
    mLooked = true;
}

void ViewSession::goTo(const Pose& pose) {
    stopPlaying();
    mGoal.reset();
    mFlight->setPose(pose);
    mResting = false;
    mLooked = true;
}

bool ViewSession::takeScreenshotWish() {
    return std::exchange(mScreenshot, false);
}

void ViewSession::observe(const ViewFrame& frame) {
    mDepthAhead = frame.depthAhead;
    mStereo.observe(frame, !hasOtherShape(frame.request.lens.width, frame.request.lens.height));
}

// Parallax counts by the width, of which a picture of another shape has more or less.
bool ViewSession::hasOtherShape(int width, int height) const {
    if (!(mShape > 0) || width < 1 || height < 1) return false;
    return std::abs(static_cast<double>(width) / height - mShape) > kOtherShape * mShape;
}

Pose ViewSession::poseAhead(double seconds) const {
    if (!(seconds > 0) || !mFlying) return pose();
    if (mPlaying) return mPath.at(mPath.startTime() + std::min(mPlayTime + seconds, mPath.duration()));
    return mAhead.from(pose(), seconds, mFlight->clearanceNow());
}

const FrameRequest& ViewSession::requestFor(int width, int height, double ahead, double scale,
                                            const glm::dvec2& guard) {
    const auto [eyeWidth, eyeHeight] = eyeSizeFor(compose().mode, width, height);
    const bool otherShape = hasOtherShape(eyeWidth, eyeHeight);
    if (otherShape) mStereo.refit(shown());
    if (otherShape || !(mShape > 0)) mShape = static_cast<double>(eyeWidth) / eyeHeight;
    FrameRequest wanted;
    wanted.pose = poseAhead(ahead);
    wanted.lens = lens();
    const auto scaled = [&](int pixels) {
        return std::max(1, static_cast<int>(std::lround(scale * pixels)));
    };
    wanted.lens.width = scaled(eyeWidth);
    wanted.lens.height = scaled(eyeHeight);
    wanted.whole = {eyeWidth, eyeHeight};
    wanted.scale = scale;
    wanted.guard = glm::ivec2(glm::round(guard * glm::dvec2(wanted.lens.width, wanted.lens.height)));
    wanted.stereo = mStereo.now();
    wanted.way = {mMethod, mScene->way.warp, mScene->way.edges};
    wanted.model = mModel;
    wanted.time = offered<Animation>() ? mTime + ahead : mTime;
    wanted.sun = mSun;
    wanted.paint = paintVersion(shown());
    wanted.twoEyes = mStereoOn;
    wanted.mode = compose().mode;
    wanted.fitEyes = mStereo.fits();
    wanted.truth = mTruth;
    wanted.paintOver = mPaint;
    wanted.version = mRequest.version + (mFresh || !sameFrame(wanted, mRequest) ? 1 : 0);
    mFresh = false;
    mRequest = wanted;
    return mRequest;
}

ComposeSetting ViewSession::compose() const {
    if (!mStereoOn) return {OutputMode::Left, false, mLinear};
    // A difference is looked at by itself where a display mixes both eyes; they are of the same size there.
    if (mTruth == TruthView::Difference && mixesEyes(infoOf(mMode).layout))
        return {OutputMode::Right, false, mLinear};
    return {mMode, mSwapped, mLinear};
}

std::string ViewSession::measuredText(const ViewFrame& frame) const {
    if (frame.effort > 1)
        return fmt::format("{:.0f} times the slices, {} ray{} a pixel, {:.0f} dB expected", frame.effort,
                           frame.rays, frame.rays > 1 ? "s" : "", frame.expected_db);
    if (frame.rays > 1)
        return fmt::format("{} rays a pixel, {:.0f} dB or more expected against very many", frame.rays,
                           frame.expected_db);
    const bool known =
        mMeasured.version == frame.request.version && mMeasured.version > 0 && mMeasured.note.empty();
    return known ? truthText(mMeasured) : "";
}

std::string ViewSession::statusLine(const ViewFrame& frame, double framesPerSecond) const {
    std::string line = frameText(frame, framesPerSecond);
    if (frame.request.twoEyes)
        line += fmt::format("  {}{}{}{}", infoOf(mMode).longName, mSwapped ? " swapped" : "",
                            *mStereo.word() ? "  " : "", mStereo.word());
    if (const std::string measured = measuredText(frame); !measured.empty()) line += "  " + measured;
    const auto* const models = offered<LightModels>();
    if (models && !models->names().empty())
        line += "  " + models->names()[static_cast<std::size_t>(frame.request.model)];
    if (!frame.sweep.empty()) line += "  " + frame.sweep;
    const double clearance = mFlight->clearanceNow();
    if (std::isfinite(clearance)) line += "  clearance " + lengthText(clearance);
    if (const auto* const through = offered<LineThrough>()) {
        const PlaceOnLine place = through->placeOnLine(pose().position);
        line += fmt::format("  at {:.0f} of {:.0f} mm", 1000 * place.along, 1000 * place.length);
    }
    line += volumeText();
    if (mPlaying) line += fmt::format("  playing {:.1f} of {:.1f} s", mPlayTime, mPath.duration());
    if (recording()) line += fmt::format("  recording {:.1f} s", mRecorder->duration());
    return line;
}

}  // namespace stereonav
