#include "app/view/viewer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>

#include "app/output/output_place.h"
#include "app/output/stereo_frame.h"
#include "app/scene/shown_as.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/stop.h"

namespace stereonav {
namespace {

constexpr double kActiveWait = 1.0 / 120;  // seconds between looks at the keys while something moves
constexpr double kShortestWait = 0.0005;   // seconds, between pictures that are warped
constexpr double kIdleWait = 0.1;          // seconds; events and frames end the wait at once
constexpr double kFiguresWait = 0.1;       // seconds that figures and notices may be old in flight
constexpr double kMostFiguresWait = 0.3;   // where no new picture comes

std::string titleOf(const SceneOptions& scene) {
    return "stereonav - " + (scene.scene.empty() ? "built-in terrain" : scene.scene);
}

}  // namespace

Viewer::Viewer(const ViewOptions& options)
    : mNotices(options),
      mSettings(options, mSession),
      mFlight(options.path.empty() ? std::nullopt : std::optional(readPath(options.path))),
      mWindow(titleOf(options.scene),
              composedSize(options.mode, options.size.width, options.size.height).first,
              composedSize(options.mode, options.size.width, options.size.height).second, true,
              ViewDisplay::wantsQuadBuffer(options)),
      mDisplay(mWindow, options),
      mMode(mDisplay.mode()),
      mInterface(mWindow),
      mScreenshots(options.shots),
      mPictures(mWindow, options.bench),
      mBench(options.bench, !options.path.empty()) {
    if (shownAs(options.scene).swept) mSweep = std::make_unique<ViewSweep>(options.sweep);
    checkSize(windowSize(), options.scene, kViewBytes);
    mPanels.showStart(options.startPage);
    readConfig();
    mWorker = std::make_unique<ViewWorker>(
        [options, size = windowSize(), sweep = mSweep.get()](Progress& progress) {
            return openScene(options, true, size, sweep, progress);
        },
        [] { Window::wake(); });
}

// What is left is deleted in the first window's context.
Viewer::~Viewer() {
    mJobs.cancel();  // ends while the rest does
    mControls.reset();
    mWindow.use();
    mPanels.forget();
}

void Viewer::run() {
    if (!mSettings.options().shots.empty()) makeOutputFolder(mSettings.options().shots);
    while (!ends()) {
        mWindow.handleEvents(waitSeconds());
        throwIfStopped();
        const double dt = mClock.lap_ms() / 1000;
        const Stopwatch turn;
        mSettings.look();
        takeScene();
        takeDrops();
        takeKeys(dt);
        if (mSession) update(dt);
        drawControls(dt);
        if (!mWindow.minimised()) draw(dt, turn);
        if (mSession &&
            mBench.step(*mSession, *mWorker, mPictures.frame(), mAsked, mSettings.options().refine))
            mWindow.close();
    }
    mBench.end(mNotices.result(), shownMode(), pictureSize());
    endSession();
    while (mScreenshots.waiting() && mPictures.frame()) finishScreenshots();
    keepConfig();
    mNotices.finish(mSettings.sceneName());
}

double Viewer::waitSeconds() const {
    if (!mActsOfPanels.empty()) return 0;
    if (mWindow.minimised() && !mControls) return kIdleWait;
    if (const auto turn = mDisplay.wait()) return *turn;
    const auto late = mPictures.wait(mAsked, mSettings.options().lateWarp, mDisplay.refreshPeriod());
    if (mSession && late && mSession->flying()) return std::clamp(*late, kShortestWait, kActiveWait);
    const bool flows = mSession && (mSession->moving() || mWindow.gamepad().present ||
                                    mSpaceMouse.state().moved() || mScreenshots.waiting());
    return flows || panelled().active() || mPanels.startShown() ? kActiveWait : kIdleWait;
}

// The first scene starts the session, others take its place in it, or a session of their own.
void Viewer::takeScene() {
    auto scene = mWorker->scene();
    const ViewWorker::Loading loading =
        mWorker->loading();  // after the scene: it is of that, or of a newer one
    if (loading.busy && !mWasBusy) mLoadingWatch.lap_ms();
    mWasBusy = loading.busy;
    if (!scene || scene == mScene) return;
    mScene = std::move(scene);
    mFacts.forget();
    mSettings.lookAtScene();
    if (!loading.busy) mSettings.arrived();
    if (mSession && !mAnother) return replaceScene();
    if (!mSession && mSettings.begun()) {
        // Another one was chosen while the first was loaded: this is the first, and is shown until then.
        const SceneMade next = mSettings.made();
        keepBefore();
        beginSession();
        mSettings.begin(next);
    } else {
        beginSession();
    }
    mAnother = mSettings.begun();
}

void Viewer::beginSession() {
    const bool first = !mSession;
    const std::string kept = mSession ? mSession->keepWork() : "";
    mSlices.abandon();
    mSession.emplace(
        mScene, ViewSession::Options{mMode, std::exchange(mFlight, std::nullopt), mSettings.options().shots,
                                     mWindow.quadBuffered(),
                                     mSession ? mSession->speedByDistance() : mConfig.speedByDistance});
    mAsked.begin(*mSession);
    mKeyframes.start({});
    mStudyFailed = false;
    mPictures.forgetCosts();
    mWindow.setTitle(titleOf(mSettings.options().scene));
    mSettings.look();
    mSettings.startSteps();
    mPlaces.emplace(mSettings.fullName().string());
    openInstruments();
    mRecentDue = true;
    reportKept();
    beginSecond();
    greet(first);
    mNotices.tell(kept);
    if (!kept.empty()) mSession->notify(kept);
}

void Viewer::takeKeys(double dt) {
    for (const ViewAction& action : std::exchange(mActsOfPanels, {})) act(action);
    const Gamepad pad = mWindow.gamepad();
    const auto press = [&](const KeyPress& key) {
        if (const auto action = actionOf(key)) act(*action);
    };
    for (const KeyPress& key : mWindow.takeKeys()) press(key);
    if (mControls)
        for (const KeyPress& key : mControls->window().takeKeys()) press(key);
    for (const ViewAction& action : mInput.actionsOf(pad, dt)) act(action);
    mSpaceMouse.look();
    for (const ViewAction& action : actionsOfSpaceMouse(mSpaceMouse.takePresses())) act(action);
}

// What needs no scene.
bool Viewer::actOnInterface(const ViewAction& action) {
    switch (action.command) {
        case ViewCommand::Quit:
            if (mPanels.closeOne()) return true;
            if (mSession && (mSession->slicesShown() || mSlices.busy())) return false;
            leave();
            return true;
        case ViewCommand::QuitAtOnce:
            leave();
            return true;
        case ViewCommand::FullScreen:
            mDisplay.toggleFullScreen();
            return true;
        case ViewCommand::AddPlace:
            addPlace();
            return true;
        case ViewCommand::CopyPlace:
            copyPlace();
            return true;
        case ViewCommand::MeasurePlace:
            measureHere();
            return true;
        case ViewCommand::AddFinding:
            findHere();
            return true;
        case ViewCommand::OpenPath:
            if (mSession) mPanels.openPaths();
            return true;
        case ViewCommand::RemoveSeed:
            if (!mKeyframes.chosen() || !mSession || mSession->slicesShown()) return false;
            mKeyframes.removeChosen();
            return true;
        case ViewCommand::Help:
            mPanels.toggleHelp();
            return true;
        case ViewCommand::HideInterface:
            mPanels.toggleAll();
            return true;
        case ViewCommand::Panels:
            mPanels.toggleSide();
            return true;
        case ViewCommand::Controls:
            toggleControls();
            return true;
        case ViewCommand::LeftPanels:
            mPanels.toggleLeft();
            return true;
        case ViewCommand::Unfolded:
            if (mSession) mPanels.toggleUnfolded();
            return true;
        case ViewCommand::Search:
            mPanels.openSearch();
            return true;
        case ViewCommand::OpenFile:
            mPanels.openFiles();
            return true;
        case ViewCommand::StartPage:
            mPanels.showStart(true);
            return true;
        case ViewCommand::SaveScene:
            if (mSession) mPanels.openSave();
            return true;
        case ViewCommand::Undo:
            undo();
            return true;
        case ViewCommand::Redo:
            redo();
            return true;
        default:
            return actOnCoverage(action.command);
    }
}

// An action may open or close the window, or the session, that is being drawn: those of panels wait.
void Viewer::drawPanels(const std::function<void()>& drawn) {
    mInPanels = true;
    drawn();
    mInPanels = false;
}

void Viewer::act(const ViewAction& action) {
    if (mInPanels) return mActsOfPanels.push_back(action);
    mSettings.look();
    mLayoutDue = true;
    if (actOnInterface(action) || !mSession) return;
    if (action.command == ViewCommand::Quit && mSlices.busy()) {
        mSlices.cancel();
        return;
    }
    mSession->act(action);
}

void Viewer::update(double dt) {
    mWindow.setCaptured(mSession->mouseCaptured());
    usePointer();
    if (mControls) useControls();
    const Window* const controls = mControls ? &mControls->window() : nullptr;
    mSession->step(withSpaceMouse(mInput.flightOf(mWindow, controls, mWindow.gamepad()), mSpaceMouse.state()),
                   dt);
    mSettings.look();
    mSettings.observe(panelled().active(), dt);
    followKeyframes();
    followInstruments();
    followPaint();
    askFor();
    followWishes();
    followSecond();
    if (const auto light = mJobs.look()) set("light", *light);
    takeFrame();
}

void Viewer::takeDrops() {
    std::vector<std::string> drops = mWindow.takeDrops();
    if (mControls)
        for (std::string& drop : mControls->window().takeDrops()) drops.push_back(std::move(drop));
    if (drops.size() > 1) mNotices.fail("one file or folder at a time: the first one is opened");
    if (!drops.empty()) open(drops.front());
}

void Viewer::askFor() {
    const glm::ivec2 composed =
        composedAt(infoOf(mSession->compose().mode), placeFor(infoOf(mSession->compose().mode)));
    if (mWindow.minimised()) return;
    const auto request = mAsked.next(*mSession, mScreenshots, mSettings.options(), composed,
                                     mDisplay.refreshPeriod(), Window::now());
    if (request) mWorker->request(*request);
}

void Viewer::takeFrame() {
    if (auto frame = mWorker->takeFrame()) {
        if (mAsked.ofSession(*frame))
            takeOwnFrame(std::move(frame));
        else  // of the scene before: its eyes would become this one's. It is saved where that was asked for
            mScreenshots.take(frame, mSession->compose());
    }
    mPictures.show(*mSession, mAsked, mSettings.options().lateWarp, mDisplay.refreshPeriod());
    if (const auto truth = mWorker->takeTruth()) mSession->observe(*truth);
    if (mSession->slicesShown()) {
        const OutputModeInfo& mode = infoOf(mSession->compose().mode);
        mPictures.showSlices(*mSession, eyeSizeAt(mode, placeFor(mode)), mScreenshots);
    } else {
        mScreenshots.take(mPictures.shared(), mSession->compose());
        mPictures.leaveSlices();
    }
    reportScreenshots();
    reportSweep();
    reportDisplay();
}

void Viewer::takeOwnFrame(std::shared_ptr<const ViewFrame> frame) {
    mAsked.came(*frame, Window::now());
    mSession->observe(*frame);
    mBench.cast(*frame);
    mPictures.take(std::move(frame), mAsked, mSettings.options().lateWarp);
    showToCoverage();
    noteRecent();
    mNewPreview = true;
}

void Viewer::reportSweep() {
    const std::string notice = mSweep ? mSweep->takeNotice() : "";
    if (!notice.empty()) mSession->notify(notice);
    mNotices.tell(notice);
    if (!mPictures.frame() || mPictures.frame()->sweep.empty() || mPictures.frame()->sweep == mSwept) return;
    mSwept = mPictures.frame()->sweep;
    mNotices.tell(mSwept);
}

void Viewer::reportDisplay() {
    const std::string notice = mDisplay.takeNotice();
    if (!notice.empty()) mSession->notify(notice);
    mNotices.tell(notice);
}

ScreenWords Viewer::onScreen(const ViewFrame& frame) const {
    return {mDisplay.parallaxText(frame), mDisplay.warning(frame)};
}

ScreenAnswer Viewer::screen() const {
    const ScreenTold told = mDisplay.told();
    const ScreenSize size = mDisplay.sizes().of(told);
    return {screenText(size), size.width_mm, mDisplay.sizes().asks(told)};
}

void Viewer::leaveScreenUnknown() {
    mDisplay.sizes().noteAsked(mDisplay.told().name);
}

void Viewer::reportScreenshots() {
    if (const std::string text = mScreenshots.report(); !text.empty()) {
        mSession->notify(text);
        mNotices.tell(text);
    }
}

void Viewer::finishScreenshots() {
    mWindow.handleEvents(kActiveWait);
    takeFrame();
}

SizeOption Viewer::windowSize() const {
    const glm::ivec2 size = glm::max(mWindow.framebufferSize(), glm::ivec2(1));
    return {size.x, size.y};
}

SizeOption Viewer::pictureSize() const {
    const OutputModeInfo& mode = infoOf(shownMode());
    return eyeSizeAt(mode, placeFor(mode));
}

PicturePlace Viewer::placeFor(const OutputModeInfo& mode) const {
    const SizeOption window = windowSize();
    const glm::ivec2 size(window.width, window.height);
    const glm::vec2 units = glm::vec2(size) * interfacePlaces(mode).size;
    return picturePlace(mode, size, mControls ? Panels::Rest{{0, 0}, units} : mPanels.rest(units), units);
}

OutputMode Viewer::shownMode() const {
    return mSession ? mSession->compose().mode : mMode;
}

// The mode of the session; but until a picture made for it is there, that of the one shown.
ComposeSetting Viewer::shownSetting() const {
    ComposeSetting setting = mSession ? mSession->compose() : ComposeSetting{mMode, false, false};
    if (!mSession || mSession->slicesShown() || !mPictures.picture().left) return setting;
    const OutputModeInfo &now = infoOf(setting.mode), &then = infoOf(mPictures.picture().of.mode);
    const SizeOption wanted = eyeSizeAt(now, placeFor(now)), made = eyeSizeAt(then, placeFor(then));
    if (wanted.width != made.width || wanted.height != made.height)
        setting.mode = mPictures.picture().of.mode;
    return setting;
}

// In flight each picture has other figures, which nobody reads as fast: the interface is laid out for what
// the user does, and else ten times a second, together with a new picture: a window that is drawn for its
// figures alone would make the next picture late.
bool Viewer::layOut(const InterfacePlaces& places, double dt) {
    mSinceLayout += dt;
    const bool flying = mSession && mSession->moving() && mWorker->loading().busy == mLaidOutBusy;
    const bool due = mPictures.fresh() ? mSinceLayout >= kFiguresWait : mSinceLayout >= kMostFiguresWait;
    if (flying && !mLayoutDue && !due && !mInterface.waits(places)) return false;
    mLaidOutBusy = mWorker->loading().busy;
    mLayoutDue = false;
    return mInterface.layOut(places, std::exchange(mSinceLayout, 0), [this] {
        if (!mControls) drawPanels([this] { mPanels.draw(*this); });
    });
}

// Draws only when there is something new: the processor is the ray caster's.
void Viewer::draw(double dt, const Stopwatch& turn) {
    const ComposeSetting setting = shownSetting();
    const OutputModeInfo& mode = infoOf(setting.mode);
    InterfaceLook look = mInterface.look();
    look.grey = mode.layout == OutputLayout::Anaglyph;
    mInterface.setLook(look);
    const double before = turn.elapsed_ms();
    mInterface.setPointerOfPicture(drawsPointer(mode));
    const bool laidOut = layOut(interfacePlaces(mode), dt);
    const double layout = turn.elapsed_ms() - before;
    const PicturePlace place = placeFor(mode);
    const bool marked = drawOverlay(mode);
    const bool same = setting == mDrawn && place == mDrawnPlace && !mPictures.fresh() && !laidOut && !marked;
    if (!mWindow.redrawNeeded() && same && !ViewDisplay::alternates(setting))
        return mTimes.add(layout, 0, turn.elapsed_ms(), false);
    mPictures.takeFresh();
    mDrawn = setting;
    mDrawnPlace = place;
    show(setting);
    if (mTimes.on()) glFinish();
    mBench.shown(mPictures.picture(), mAsked.present());
    const double all = turn.elapsed_ms();
    mPictures.drew(all / 1000);
    mTimes.add(layout, all - layout - before, all, true);
}

void Viewer::show(const ComposeSetting& setting) {
    const SizeOption size = windowSize();
    const glm::ivec2 origin = mWindow.framebufferOrigin();
    const PicturePlace& place = mDrawnPlace;
    const PartInset inset{place.corner.x, place.corner.y, place.part.x - place.corner.x - place.size.x,
                          place.part.y - place.corner.y - place.size.y};
    mDisplay.draw(setting, [&](const ComposeSetting& one) {
        glDisable(GL_SCISSOR_TEST);
        glViewport(0, 0, size.width, size.height);
        // Pictures and panels cover both parts; where these do not cover the window, it is black.
        if (!mPictures.eyes().hasPicture() || !partsCover(one.mode, size)) {
            glClearColor(0, 0, 0, 1);
            glClear(GL_COLOR_BUFFER_BIT);
        }
        mPictures.eyes().draw(one, {0, 0, size.width, size.height}, origin.x, origin.y, inset);
        mInterface.render(InterfaceOpening{place.corner, place.size});
    });
}

}  // namespace stereonav
