// State of the viewer, and the effect of each command on it.
#include "app/view/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/live_settings.h"
#include "app/view/mode_steps.h"
#include "app/view/raised_ground.h"
#include "app/view/status.h"

namespace stereonav {
namespace {

constexpr double kStereoStep = 1.1;   // factor on separation and zero parallax per key press
constexpr double kOtherShape = 0.02;  // share of width to height: smaller differences are rounding

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

}  // namespace

ViewSession::ViewSession(std::shared_ptr<const OpenScene> scene, const Options& options)
    : mScene(std::move(scene)),
      mFlight(shown(), options.speedByDistance, mNotice),
      mOrbit(shown()),
      mPaths(mScene, mFlight.shared(), mNotice, options.path, options.folder),
      mLight(mScene, mNotice),
      mSurface(mScene, mNotice),
      mSlices(mScene, mNotice, [this] { return pose().position; }),
      mStereo(shown()),
      mShown{options.mode, options.stereo},
      mFirst{options.mode, options.firstStereo},
      mQuadBuffer(options.quadBuffer),
      mMethod(mScene->way.method) {
    if (!shown().warning.empty()) notify(shown().warning);
}

void ViewSession::act(const ViewAction& action) {
    // A screenshot of a resting picture shows just that: it does not resume remaining motion.
    if (action.command != ViewCommand::Screenshot) mFlight.stir();
    if (mSlices.act(action.command, mSurface) || mSurface.act(action.command) || mLight.act(action.command) ||
        actOnEyes(action.command) || actOnStereo(action))
        return;
    switch (action.command) {
        case ViewCommand::Back:
            break;
        case ViewCommand::Screenshot:
            mScreenshot = true;
            break;
        case ViewCommand::CaptureMouse:
            mCaptured = !mCaptured;
            break;
        case ViewCommand::Record:
            mPaths.toggleRecording();
            break;
        case ViewCommand::Play:
            mPaths.togglePlaying();
            if (mPaths.playing()) mFlight.endGoal();
            break;
        case ViewCommand::SpeedByDistance:
            mFlight.toggleSpeedByDistance();
            break;
        case ViewCommand::ToggleOrbit:
            setOrbit(!mOrbit.on());
            break;
        case ViewCommand::NextFlightMode:
            if (mOrbit.startsOn()) return setOrbit(!mOrbit.on());
            [[fallthrough]];
        default:
            mPaths.stop();
            mOrbit.endZoom();
            if (action.command == ViewCommand::SetFlightMode) mOrbit.set(false);
            if (action.command == ViewCommand::Home) mStereo.endZoom();
            mFlight.act(action);
            if (action.command == ViewCommand::Reset) reset();
    }
}

// Goes on in another scene at the same place, or where it has room.
void ViewSession::replaceScene(std::shared_ptr<const OpenScene> scene) {
    if (!scene->changed) mPaths.stop();
    mFlight.endGoal();
    const auto raised = RaisedGround::between(shown(), *scene->scene);
    if (raised && mPaths.recording()) mPaths.endRecording();  // the recording is over the ground before
    const Pose here = mFlight.flight().pose();
    mFlight.replaceScene(*scene->scene, raised ? raised->moved(here) : here);
    mOrbit.replaceScene(*scene->scene);
    // Light that was turned stays turned over the same study.
    const auto *const before = offered<TurningLight>(), *const after = scene->scene->offered<TurningLight>();
    const bool lightStays = before && after && before->isSky() == after->isSky();
    const bool methodStays = scene->changed && scene->way.method == mScene->way.method;
    mSlices.replaceScene(*scene->scene);
    mStereo.replaceScene(*scene->scene);
    keepPaint(shown(), *scene->scene);
    mScene = std::move(scene);
    mPaths.replaceScene(raised);
    mLight.replaceScene(lightStays);
    if (!methodStays) mMethod = mScene->way.method;
    // More changes may be asked for than a scene made meanwhile shows.
    if (!mScene->changed) mSurface.forgetChange();
    if (!shown().warning.empty()) notify(shown().warning);
    ++mRequest.version;
}

bool ViewSession::actOnStereo(const ViewAction& action) {
    switch (action.command) {
        case ViewCommand::ToggleStereo:
            toggleStereo();
            return true;
        case ViewCommand::SwapEyes:
            mSwapped = !mSwapped;
            notify(mSwapped ? "eyes swapped" : "eyes not swapped");
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
            mShown = {action.mode, true};
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
            notify(mStereo.clamp() ? "the eyes come together where parallax is too large"
                                   : "the eyes stay as far apart as they are set");
            return true;
        default:
            return false;
    }
}

// --- modes

// From one eye the first step goes to the mode that both eyes were shown in last.
void ViewSession::stepMode(int by) {
    const bool returns = !mShown.stereo && by > 0 && infoOf(mShown.mode).layout != OutputLayout::OneEye;
    mShown = {steppedMode(mShown.mode, returns ? 0 : by, mFirst.mode), true};
    notify(fmt::format("{} ({})", infoOf(mShown.mode).longName, infoOf(mShown.mode).shortName));
}

void ViewSession::toggleStereo() {
    const bool on = !stereoOn();
    if (on && infoOf(mShown.mode).layout == OutputLayout::OneEye) mShown.mode = ShownMode().mode;
    mShown.stereo = on;
    notify(on ? "stereo on" : "stereo off");
}

void ViewSession::show(const ShownMode& mode) {
    if (mode.mode != OutputMode::QuadBuffer || mQuadBuffer) mShown = mode;
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
    mFlight.reset();
    mOrbit.set(mOrbit.startsOn());
    mLight.reset();
    mStereo.reset(shown());
    mShown = mFirst;
    mMethod = mScene->way.method;
    mFov.reset();
    mSwapped = mLinear = false;
    notify("reset");
}

void ViewSession::look(double yaw, double pitch) {
    if (mPaths.playing() || mSlices.shown() || (yaw == 0 && pitch == 0)) return;
    mFlight.turnBy(yaw, pitch);
}

void ViewSession::turnWheel(double notches) {
    if (notches == 0) return;
    if (mSlices.shown()) return mSlices.turnPages(notches > 0 ? -1 : 1);
    mFlight.turnWheel(notches);
}

void ViewSession::setOrbit(bool on) {
    mOrbit.set(on);
    notify(on ? "orbit: drag turns, Shift or the middle button pans, the wheel zooms"
              : "fly: drag looks around, the wheel sets the speed");
}

void ViewSession::takeHold(const std::optional<glm::dvec3>& place) {
    mOrbit.takeHold(place, pose(),
                    std::isfinite(mDepthAhead) && mDepthAhead > 0 ? mDepthAhead : mStereo.now().zeroParallax);
}

void ViewSession::drag(OrbitDrag drag, const glm::dvec2& by, double height) {
    if (mPaths.playing() || mSlices.shown() || by == glm::dvec2(0.0)) return;
    mFlight.moveTo(mOrbit.dragged(mFlight.flight().pose(), drag, by, height));
}

void ViewSession::zoomBy(double notches) {
    mFlight.endGoal();
    mOrbit.zoomBy(notches);
}

// Brings the eyes nearer together as they come nearer, and apart again: what is looked at keeps its parallax.
void ViewSession::stepZoom(double dt) {
    if (!mOrbit.zooming()) return;
    const auto away = [this] { return glm::distance(mFlight.flight().pose().position, mOrbit.pivot()); };
    const double before = away();
    const Pose wanted = mOrbit.zoomed(mFlight.flight().pose(), dt);
    mFlight.moveTo(wanted);
    const double after = away(), asked = glm::distance(wanted.position, mOrbit.pivot());
    if (std::abs(after - asked) > 0.5 * std::abs(before - asked))
        mOrbit.endZoom();  // something is in the way
    if (before > 0 && after > 0) mStereo.zoom(after / before);
}

void ViewSession::step(const FlightInput& input, double dt) {
    const bool animated = offered<Animation>() != nullptr, drifts = animated && mDriftsAtRest;
    mStereo.step(flight().clearanceNow(), mDepthAhead, dt);
    mFlight.stepPace(mDepthAhead, dt);
    const Pose poseBefore = pose();
    const bool looked = mFlight.takeLook();
    if (mPaths.playing()) {
        mPaths.step(dt);
    } else {
        if (asksForMotion(input)) mOrbit.endZoom();
        stepZoom(dt);
        mFlight.step(input, dt, !mSurface.hasIsovalue());  // keys for rolling move the surface
        mPaths.record(dt, flight().pose());
    }
    if (animated && mPaths.playing() && dt > 0)
        mTime = mPaths.time();
    else if (animated && (drifts || mFlying))
        mTime += std::max(dt, 0.0);
    mNotice.step(dt);
    if (const std::string problem = mPaths.takeProblem(); !problem.empty()) notify(problem);
    mFlying = mPaths.playing() || mFlight.toGoal() || drifts || asksForMotion(input) || looked ||
              !samePose(poseBefore, pose());
    mMoving = mFlying || mPaths.recording() || mStereo.moving();
    mAhead.step(poseBefore, pose(), dt);
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

void ViewSession::setEyes(const StereoSetting& eyes) {
    mFlight.stir();
    mStereo.setZeroParallax(eyes.zeroParallax);
    mStereo.setSeparation(eyes.separation);
}

void ViewSession::setFov(std::optional<double> verticalFov) {
    mFov = verticalFov;
    mFlight.noteLook();
}

void ViewSession::goTo(const Pose& pose) {
    mPaths.stop();
    mOrbit.endZoom();
    mStereo.endZoom();
    mFlight.goTo(pose);
}

void ViewSession::flyTo(const Pose& pose) {
    mPaths.stop();
    mOrbit.endZoom();
    mStereo.endZoom();
    mFlight.flyTo(pose);
}

void ViewSession::flyAlong(double along) {
    mPaths.stop();
    mOrbit.endZoom();
    mStereo.endZoom();
    mFlight.flyAlong(along);
}

void ViewSession::observe(const ViewFrame& frame) {
    mDepthAhead = frame.depthAhead;
    mStereo.observe(frame, !hasOtherShape(frame.request.lens.width, frame.request.lens.height));
}

// Returns whether the shape differs: parallax is relative to the width, of which a picture of another shape
// has more or less.
bool ViewSession::hasOtherShape(int width, int height) const {
    if (!(mShape > 0) || width < 1 || height < 1) return false;
    return std::abs(static_cast<double>(width) / height - mShape) > kOtherShape * mShape;
}

Pose ViewSession::poseAhead(double seconds) const {
    if (!(seconds > 0) || !mFlying) return pose();
    if (mPaths.playing()) return mPaths.ahead(seconds);
    // Nothing of what is turned lies nearer than the place that it is turned about.
    double free = flight().clearanceNow();
    if (mOrbit.on()) free = std::min(free, glm::distance(pose().position, mOrbit.pivot()));
    return mAhead.from(pose(), seconds, free);
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
    wanted.model = mLight.model();
    wanted.time = offered<Animation>() ? mTime + ahead : mTime;
    wanted.sun = mLight.sun();
    wanted.paint = paintVersion(shown());
    wanted.twoEyes = mShown.stereo;
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
    if (!mShown.stereo) return {OutputMode::Left, false, mLinear};
    // A difference is shown to both eyes where a display mixes them; they have the same size there.
    if (mTruth == TruthView::Difference && mixesEyes(infoOf(mShown.mode).layout))
        return {OutputMode::Right, false, mLinear};
    return {mShown.mode, mSwapped, mLinear};
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

}  // namespace stereonav
