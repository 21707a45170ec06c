#include "app/view/window/viewer.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "app/options/output_place.h"
#include "app/output/stereo_frame.h"
#include "app/view/raised_ground.h"
#include "engine/base/stop.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

constexpr double kActiveWait = 1.0 / 120;  // seconds between checks of the keys while something moves
constexpr double kShortestWait = 0.0005;   // seconds between warped pictures
constexpr double kIdleWait = 0.1;          // seconds; events and frames end the wait at once

std::string titleOf(const SceneOptions& scene) {
    return "stereonav - " + (scene.scene.empty() ? "built-in terrain" : scene.scene);
}

// Returns the mode that a window of a given size is opened for.
OutputMode firstMode(const ViewOptions& options) {
    return options.mode.value_or(ShownMode{ShownMode().mode, options.bench}.shown());
}

void wakeWindow() {
    Window::wake();
}

}  // namespace

Viewer::Viewer(const ViewOptions& options)
    : mNotices(options),
      mSettings(options, mSession),
      mFlight(options.path.empty() ? std::nullopt : std::optional(readPath(options.path))),
      mWindow(titleOf(options.scene),
              composedSize(firstMode(options), options.size.width, options.size.height).first,
              composedSize(firstMode(options), options.size.width, options.size.height).second, true,
              ViewDisplay::wantsQuadBuffer(options)),
      mDisplay(mWindow, options),
      mChanges(mSession, mSettings, mNotices, mDisplay),
      mStage(mWindow, mSession, mDisplay),
      mInput(mWindow),
      mScreenshots(options.shots),
      mPictures(mWindow, options.bench),
      mBench(options.bench, !options.path.empty()),
      mStudy(wakeWindow),
      mKept(mSession, mSettings, mNotices),
      mJobs(mSession, mSettings, mNotices),
      mInstruments(mSession, mStudy, wakeWindow),
      mSecond(mSession, mSettings, mNotices, mChanges, mDisplay),
      mLooks(wakeWindow),
      mClosing(mSession, mWindow, mJobs, mInstruments),
      mPointer(mSession, mWindow, mStage, mPictures),
      mMarks(mPictures, mPointer, mStage, mKept, mInstruments),
      mDrawing(mSession, mWindow, mDisplay, mStage, mPictures, mPointer, mMarks),
      mClipboard(mWindow, mSession) {
    mStage.panels().shown().start = options.scene.given.empty();
    mKeptWindow.restore(mWindow, mStage, mDisplay, mNotices,
                        options.bench || !options.fullScreen.empty() || mSettings.given().contains("size"));
    mChanges.begin();
}

Viewer::~Viewer() {
    mJobs.cancel();  // they end while other parts do
    mWindow.use();
    mChanges.end();
}

void Viewer::run() {
    const std::string& shots = mSettings.options().shots;
    if (!shots.empty()) makeOutputFolder(shots);
    while (!mClosing.ends([this] { mStage.layOutSoon(); })) turn();
    end();
}

void Viewer::turn() {
    mWindow.handleEvents(waitSeconds());
    throwIfStopped();
    const double dt = mClock.lap_ms() / 1000;
    const Stopwatch turn;
    mSettings.look();
    takeScene();
    takeDrops();
    takeInput(dt);
    if (mSession) {
        fly(dt);
        followInstruments();
        askFor();
        mChanges.follow();
        mStudy.follow(*mSession, mNotices);
        mSecond.follow();
        if (const auto light = mJobs.look()) mChanges.set("light", *light);
        takeFrame();
        report();
    }
    show(dt, turn);
    if (mSession &&
        mBench.step(*mSession, mChanges.worker(), mPictures.frame(), mAsked, mSettings.options().refine))
        mWindow.close();
}

void Viewer::end() {
    mBench.end(mNotices.result(), mStage.mode(), mStage.eyeSize());
    if (mSession) mNotices.tell(mSession->paths().keepWork());
    while (mScreenshots.waiting() && mPictures.frame()) {
        mWindow.handleEvents(kActiveWait);
        takeFrame();
        report();
    }
    const bool byDistance = mSession ? mSession->moves().speedByDistance() : mKeptWindow.speedByDistance();
    keepView();
    mKeptWindow.keep(mWindow, mStage, mDisplay, byDistance);
    mNotices.finish(mSettings.sceneName());
}

double Viewer::waitSeconds() const {
    if (mInput.panels().any()) return 0;
    if (mWindow.minimised() && !mStage.controls()) return kIdleWait;
    if (const auto turn = mDisplay.wait()) return *turn;
    if (mSession && mSession->flying())
        if (const auto late = mPictures.wait(mAsked, mSettings.options().lateWarp, mDisplay.refreshPeriod()))
            return std::clamp(*late, kShortestWait, kActiveWait);
    const bool flows = mSession && (mSession->moving() || mInput.active() || mScreenshots.waiting());
    return flows || mStage.panelled().active() || mStage.panels().shown().start ? kActiveWait : kIdleWait;
}

void Viewer::takeInput(double dt) {
    // Keys that come with the one that opens a box are meant for the box.
    for (const ViewAction& action : mInput.take(mStage.controls(), dt))
        if (!mStage.panels().holdsKeys() || action.command == ViewCommand::Quit) act(action);
}

void Viewer::takeDrops() {
    std::vector<std::string> drops = mWindow.takeDrops();
    if (ControlWindow* const controls = mStage.controls())
        for (std::string& drop : controls->window().takeDrops()) drops.push_back(std::move(drop));
    if (drops.size() > 1) mNotices.fail("one file or folder at a time: the first one is opened");
    if (!drops.empty() && mChanges.open(drops.front())) mStage.panels().shown().start = false;
}

void Viewer::act(const ViewAction& action) {
    mSettings.look();
    mStage.layOutSoon();
    if (actOnInterface(action.command) || actOnInstruments(action.command) || !mSession) return;
    mSession->act(action);
}

// Closes the topmost of what is open over the picture, then leaves full screen. Returns false where the
// session closes it.
bool Viewer::back() {
    if (mClosing.asks()) return mClosing.goOn(), true;
    if (mStage.panels().closeOne()) return true;
    if (mSession && mStudy.busy()) return mStudy.cancel(), true;
    if (mSession && mSession->slices().shown()) return false;
    if (mSession && mSession->mouseCaptured()) return mSession->act({ViewCommand::CaptureMouse}), true;
    if (mDisplay.fullScreen()) mDisplay.toggleFullScreen();
    return true;
}

bool Viewer::actOnInterface(ViewCommand command) {
    Panels& panels = mStage.panels();
    ShownPanels& shown = panels.shown();
    switch (command) {
        case ViewCommand::Back:
            return back();
        case ViewCommand::Quit:
            mClosing.leave();
            return true;
        case ViewCommand::FullScreen:
            mDisplay.toggleFullScreen();
            return true;
        case ViewCommand::OpenPath:
            if (mSession) panels.openFiles(FileBrowser::For::OpenPath);
            return true;
        case ViewCommand::Help:
            shown.help = !shown.help;
            return true;
        case ViewCommand::HideInterface:
            shown.hidden = !shown.hidden;
            return true;
        case ViewCommand::Panels:
            shown.toggleSide();
            return true;
        case ViewCommand::Controls:
            mNotices.tryTo([this] { mStage.toggleControls(); });
            return true;
        case ViewCommand::LeftPanels:
            shown.toggleLeft();
            return true;
        case ViewCommand::Unfolded:
            if (mSession) shown.toggleUnfolded();
            return true;
        case ViewCommand::GoToPlace:
            panels.openPlace();
            return true;
        case ViewCommand::Search:
            panels.openSearch();
            return true;
        case ViewCommand::OpenFile:
            panels.openFiles(FileBrowser::For::Open);
            return true;
        case ViewCommand::StartPage:
            shown.start = true;
            return true;
        case ViewCommand::SaveScene:
            if (mSession) panels.openFiles(FileBrowser::For::SaveScene);
            return true;
        default:
            return panels.open(command);
    }
}

bool Viewer::actOnInstruments(ViewCommand command) {
    const ViewFrame* const frame = mPictures.frame();
    switch (command) {
        case ViewCommand::AddPlace:
            mKept.add(frame ? &frame->left.color : nullptr);
            return true;
        case ViewCommand::CopyPlace:
            copyPlace();
            return true;
        case ViewCommand::MeasurePlace:
            mInstruments.measureAt(mPointer.world());
            return true;
        case ViewCommand::AddFinding:
            mInstruments.findAt(mPointer.world());
            return true;
        case ViewCommand::ToggleCoverage:
            mInstruments.toggleCoverage(frame, mAsked);
            return true;
        case ViewCommand::NextUnseen:
        case ViewCommand::PreviousUnseen:
            mInstruments.flyToUnseen(command == ViewCommand::NextUnseen ? 1 : -1);
            return true;
        case ViewCommand::RemoveSeed:
            if (!mKeyframes.edit().chosen() || !mSession || mSession->slices().shown()) return false;
            mKeyframes.edit().removeChosen();
            return true;
        case ViewCommand::Undo:
        case ViewCommand::Redo:
            step(command == ViewCommand::Redo);
            return true;
        default:
            return false;
    }
}

void Viewer::copyPlace() {
    const Facts facts = mPointer.facts();
    if (!facts.empty()) return mClipboard.copy(linesOf(facts));
    if (mSession) mSession->notify("nothing is under the pointer");
}

void Viewer::step(bool forward) {
    KeyframeEdit& keyframes = mKeyframes.edit();
    if (!mSession) return;
    if (forward && keyframes.canRedo()) return keyframes.redo();
    if (!forward && keyframes.canUndo()) return keyframes.undo();
    if (forward)
        mChanges.redo();
    else
        mChanges.undo();
}

// Begins the session with the first scene; others take its place, or begin a session of their own.
void Viewer::takeScene() {
    if (!mChanges.takeScene()) return;
    mFacts.forget();
    if (!mChanges.isAnother()) return replaceScene();
    const std::optional<SceneMade> next = mChanges.interrupt();
    beginSession();
    mChanges.resume(next);
}

void Viewer::beginSession() {
    const bool first = !mSession;
    const std::string kept = mSession ? mSession->paths().keepWork() : "";
    const bool byDistance = mSession ? mSession->moves().speedByDistance() : mKeptWindow.speedByDistance();
    mStudy.abandon();
    keepView();
    mView.emplace(mSettings.fullName().string());
    if (const auto mode = mView->mode()) mDisplay.restoreMode(*mode);
    mSession.emplace(mChanges.scene(),
                     ViewSession::Options{mDisplay.mode().mode, std::exchange(mFlight, std::nullopt),
                                          mSettings.options().shots, mWindow.quadBuffered(), byDistance,
                                          mDisplay.mode().stereo, mDisplay.firstStereo()});
    mAsked.begin(*mSession);
    mKeyframes.end();
    mPictures.forgetCosts();
    mWindow.setTitle(titleOf(mSettings.options().scene));
    mSettings.look();
    mSettings.history().start(mSettings.now());
    const bool left =
        !mSettings.options().bench && !mSettings.given().contains("pose") && mView->restore(*mSession);
    mKept.open();
    mInstruments.open(mChanges.scene()->scene, mKept.places()->file());
    mSecond.begin();
    greet(first, left);
    tell(kept);
}

// Keeps the view of the scene that is left. What a benchmark flies is nobody's view.
void Viewer::keepView() {
    if (!mSession || !mView || mSettings.options().bench) return;
    mDisplay.setMode(mSession->shownMode());
    mView->keep(*mSession, mDisplay.modeToKeep());
}

// Shows another scene in the same session.
void Viewer::replaceScene() {
    const std::shared_ptr<const OpenScene>& scene = mChanges.scene();
    const auto raised = RaisedGround::between(*mSession->open().scene, *scene->scene);
    mInstruments.replaceScene(scene->scene);
    mSession->replaceScene(scene);
    if (raised) mKeyframes.raise(*raised, *mSession);
}

// Guesses about the scene are reported before hints. left: it is seen as it was left.
void Viewer::greet(bool first, bool left) {
    const auto* const terrain = mChanges.scene()->scene->offered<const TerrainScene>();
    const std::vector<std::string> notes = terrain ? terrain->report.notes : std::vector<std::string>();
    for (const std::string& note : notes) mNotices.tell(note);
    if (!notes.empty())
        mSession->notify(notes.front());
    else if (left)
        mSession->notify("as it was left; Space goes to the start");
    else if (first)
        mSession->notify("F1 shows the keys, F2 and F3 the panels");
}

void Viewer::fly(double dt) {
    mWindow.setCaptured(mSession->mouseCaptured());
    mPointer.use(mInstruments, mNotices);
    mSession->step(mInput.flight(mStage.controls()), dt);
    mSettings.look();
    mSettings.history().observe(mSettings.now(), mStage.panelled().active(), dt);
    mKeyframes.follow(*mSession, mNotices);
}

void Viewer::followInstruments() {
    if (mInstruments.follow()) mStage.layOutSoon();
    if (mInstruments.followPaint([this](const std::string& problem) { mNotices.fail(problem); })) {
        mFacts.forget();  // the facts include paint
        mStage.layOutSoon();
    }
    const Instruments::Shows shows = mInstruments.takeShows();
    if (shows == Instruments::Shows::Nothing) return;
    mStage.layOutSoon();
    Panels& panels = mStage.panels();
    if (panels.shown().left.shown) return;
    if (shows == Instruments::Shows::Findings)
        panels.showFindings();
    else
        panels.shown().toggleLeft();
}

void Viewer::askFor() {
    const OutputModeInfo& mode = infoOf(mSession->compose().mode);
    const glm::ivec2 composed = composedAt(mode, mStage.placeOf(mode));
    if (mWindow.minimised()) return;
    const auto request = mAsked.next(*mSession, mScreenshots, mSettings.options(), composed,
                                     mDisplay.refreshPeriod(), Window::now());
    if (request) mChanges.worker().request(*request);
}

void Viewer::takeFrame() {
    if (auto frame = mChanges.worker().takeFrame()) {
        if (mAsked.ofSession(*frame))
            takeOwnFrame(std::move(frame));
        else  // frames of the scene before only serve screenshots: their eyes would become this one's
            mScreenshots.take(frame, mSession->compose());
    }
    mPictures.show(*mSession, mAsked, mSettings.options().lateWarp, mDisplay.refreshPeriod());
    if (const auto truth = mChanges.worker().takeTruth()) mSession->observe(*truth);
    if (mSession->slices().shown()) {
        mPictures.showSlices(*mSession, mStage.eyeSize(), mScreenshots);
    } else {
        mScreenshots.take(mPictures.shared(), mSession->compose());
        mPictures.leaveSlices();
    }
}

void Viewer::takeOwnFrame(std::shared_ptr<const ViewFrame> frame) {
    mAsked.came(*frame, Window::now());
    mSession->observe(*frame);
    mBench.cast(*frame);
    mInstruments.see(*frame, mAsked);
    mStudy.noteFrame();
    mKept.noteRecent(frame->left.color);
    mStage.noteFrame();
    mPictures.take(std::move(frame), mAsked, mSettings.options().lateWarp);
}

// Draws the window. Actions of panels wait until then: they may open or close the window, or the session.
void Viewer::show(double dt, const Stopwatch& turn) {
    const auto drawPanels = [this] { mStage.panels().draw(parts()); };
    mStage.drawControls(dt, mPictures.frame(), drawPanels);
    if (mWindow.minimised()) return;
    if (mDrawing.draw(turn, dt, mChanges.loading().busy, drawPanels))
        mBench.shown(mPictures.picture(), mAsked.present());
}

PanelParts Viewer::parts() {
    return {mSession ? &*mSession : nullptr,
            mInput.panels(),
            mClipboard,
            mClosing,
            mDisplay,
            mFacts,
            mInstruments,
            mJobs,
            mKept,
            mKeyframes,
            mLooks,
            mNotices,
            mPictures,
            mChanges,
            mSecond,
            mStudy,
            mStage.panelled(),
            mStage.controls() != nullptr,
            mStage.eyeSize(),
            mPointer.world(),
            mPointer.facts()};
}

void Viewer::tell(const std::string& notice) {
    if (!notice.empty()) mSession->notify(notice);
    mNotices.tell(notice);
}

void Viewer::report() {
    tell(mScreenshots.report());
    tell(mChanges.takeSweepNotice());
    const ViewFrame* const frame = mPictures.frame();
    if (frame && !frame->sweep.empty() && frame->sweep != mSwept) mNotices.tell(mSwept = frame->sweep);
    tell(mDisplay.takeNotice());
}

}  // namespace stereonav
