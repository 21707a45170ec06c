// The window: events and drawing on this thread, loading and rendering on the worker's.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "app/command/commands.h"
#include "app/output/output_place.h"
#include "app/output/stereo_frame.h"
#include "app/scene/shown_as.h"
#include "app/view/input.h"
#include "app/view/loading.h"
#include "app/view/screenshots.h"
#include "app/view/session.h"
#include "app/view/status.h"
#include "app/view/sweep.h"
#include "app/view/view_display.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/display/overlay.h"
#include "engine/display/stereo_presenter.h"
#include "engine/display/window.h"

namespace stereonav {
namespace {

constexpr double kActiveWait = 1.0 / 120;  // seconds between looks at the keys while something moves
constexpr double kIdleWait = 0.1;          // seconds; events and frames end the wait at once
constexpr double kFigureSeconds = 0.25;    // the figures change four times a second, to be readable
constexpr double kFrameWeight = 0.15;      // of the newest frame in the mean time between frames

// Frames a second while they flow; keeps its value while the picture stands still.
class FrameRate {
public:
    // flowing: the next frame is already asked for, so that the time until it counts.
    void count(bool flowing) {
        const double seconds = mWatch.lap_ms() / 1000;
        if (mFlowing) mMean = mMean > 0 ? mMean + kFrameWeight * (seconds - mMean) : seconds;
        mFlowing = flowing;
    }
    double value() const { return mMean > 0 ? 1 / mMean : 0; }

private:
    Stopwatch mWatch;
    double mMean = 0;  // seconds
    bool mFlowing = false;
};

// Where text goes: once in each eye's part of the window.
std::vector<OverlayArea> areasOf(OutputLayout layout) {
    if (layout == OutputLayout::SideBySide) return {{0, 0, 0.5f, 1}, {0.5f, 0, 0.5f, 1}};
    if (layout == OutputLayout::TopBottom) return {{0, 0, 1, 0.5f}, {0, 0.5f, 1, 0.5f}};
    if (layout == OutputLayout::FramePacked)
        return {{0, 0, 1, kPackedEye}, {0, 1 - kPackedEye, 1, kPackedEye}};
    return {{0, 0, 1, 1}};
}

class Viewer {
public:
    explicit Viewer(const ViewOptions& options)
        : mOptions(options),
          mFlight(options.path.empty() ? std::nullopt : std::optional(readPath(options.path))),
          mWindow(titleOf(options), composedSize(options.mode, options.size.width, options.size.height).first,
                  composedSize(options.mode, options.size.width, options.size.height).second, true,
                  ViewDisplay::wantsQuadBuffer(options)),
          mDisplay(mWindow, options),
          mMode(mDisplay.mode()),
          mSweep(shownAs(options.scene).swept ? std::make_unique<ViewSweep>(options.sweep) : nullptr),
          mOverlay(mWindow),
          mScreenshots(options.shots),
          mWorker([options, size = checkedSize(), sweep = mSweep.get()](
                      Progress& progress) { return openScene(options, true, size, sweep, progress); },
                  [] { Window::wake(); }) {}

    void run() {
        if (!mOptions.shots.empty()) makeOutputFolder(mOptions.shots);
        while (!mWindow.shouldClose() && !mQuitWhileLoading && !(mSession && mSession->quit())) {
            mWindow.handleEvents(waitSeconds());
            const double dt = mClock.lap_ms() / 1000;
            takeScene();
            if (mSession)
                update(dt);
            else
                quitOnEscape();
            if (!mWindow.minimised()) draw();
        }
        while (mScreenshots.waiting() && mFrame) finishScreenshots();
    }

private:
    static std::string titleOf(const ViewOptions& options) {
        return "stereonav - " + (options.scene.scene.empty() ? "built-in terrain" : options.scene.scene);
    }

    // Which may be smaller than what was asked for; no mode has larger eyes.
    SizeOption windowSize() const {
        const glm::ivec2 size = mWindow.framebufferSize();
        return {std::max(size.x, 1), std::max(size.y, 1)};
    }
    // Throws Error where there is no memory for its pictures.
    SizeOption checkedSize() const {
        checkSize(windowSize(), mOptions.scene, kViewBytes);
        return windowSize();
    }

    double waitSeconds() const {
        if (const auto turn = mDisplay.wait(); turn && !mWindow.minimised()) return *turn;
        if (!mSession || mWindow.minimised()) return kIdleWait;
        return mSession->moving() || mWindow.gamepad().present || mScreenshots.waiting() ? kActiveWait
                                                                                         : kIdleWait;
    }

    // The first scene starts the session, others take its place in it.
    void takeScene() {
        auto scene = mWorker.scene();
        if (!scene || scene == mScene) return;
        mScene = std::move(scene);
        if (mSession) {
            mSession->replaceScene(mScene);
        } else {
            mSession.emplace(mScene,
                             ViewSession::Options{mMode, mFlight, mOptions.shots, mWindow.quadBuffered()});
            mSession->notify("F1 shows the keys");
        }
    }

    void quitOnEscape() {
        for (const KeyPress& press : mWindow.takeKeys())
            if (const auto action = actionOf(press); action && action->command == ViewCommand::Quit) {
                mQuitWhileLoading = true;
            }
    }

    void update(double dt) {
        const Gamepad pad = mWindow.gamepad();
        for (const KeyPress& press : mWindow.takeKeys())
            if (const auto action = actionOf(press))
                action->command == ViewCommand::FullScreen ? mDisplay.toggleFullScreen()
                                                           : mSession->act(*action);
        for (const ViewAction& action : mInput.actionsOf(pad, dt)) mSession->act(action);
        mWindow.setCaptured(mSession->mouseCaptured());
        const glm::ivec2 size = mWindow.framebufferSize();
        usePointer(size);
        mSession->step(mInput.flightOf(mWindow, pad), dt);
        if (size.x > 0 && size.y > 0) askFor(size);
        followWishes();
        takeFrame();
    }

    void usePointer(const glm::ivec2& size) {
        const glm::dvec2 drag = mWindow.takeDrag();
        const std::vector<glm::dvec2> clicks = mWindow.takeClicks();
        mSession->turnWheel(mWindow.takeWheel());
        if (size.x < 1 || size.y < 1) return;
        const double radiansPerUnit = mScene->scene->lens.verticalFov / size.y;
        mSession->look(drag.x * radiansPerUnit, -drag.y * radiansPerUnit);
        const OutputMode mode = mSession->compose().mode;
        const auto [width, height] = eyeSizeFor(mode, size.x, size.y);
        for (const glm::dvec2& click : clicks) {
            const glm::dvec2 place = placeInEye(infoOf(mode).layout, click) * glm::dvec2(width, height);
            tell(mSession->click(place.x, place.y));
        }
    }

    // What stays useful after the window is closed.
    static void tell(const std::string& text) {
        if (text.empty()) return;
        std::printf("%s\n", text.c_str());
        std::fflush(stdout);
    }

    // What the session wants that takes longer than a frame.
    void followWishes() {
        if (const auto change = mSession->takeSceneChange()) {
            applyChange(*change, mOptions.scene, mChanged.scene);
            if (mScene->scene->offered<SurfaceChoices>() && !change->seeds)
                mWorker.change([options = mChanged, surface = change->surface](const OpenScene& now,
                                                                               Progress& progress) {
                    return changedScene(now, surface, options, progress);
                });
            else
                mWorker.reload(
                    [options = mChanged, size = windowSize(), sweep = mSweep.get()](Progress& progress) {
                        return openScene(options, false, size, sweep, progress);
                    });
        }
        if (const std::string problem = mWorker.takeReloadProblem(); !problem.empty()) {
            mSession->forgetSceneChange();
            mSession->notify(problem);
        }
        if (mSession->takeStudyWish()) mSlices.start(mScene, [] { Window::wake(); });
        try {
            if (auto study = mSlices.take()) mSession->showSlices(std::move(study));
        } catch (const std::exception& error) {
            mSession->notify(error.what());
        }
    }

    void askFor(const glm::ivec2& size) {
        const FrameRequest& request = mSession->requestFor(size.x, size.y);
        if (request.version != mAsked) mWorker.request(request);
        mAsked = request.version;
        if (mSession->takeScreenshotWish()) mScreenshots.wish(mAsked);
    }

    void takeFrame() {
        if (auto frame = mWorker.takeFrame()) {
            mFrame = std::move(frame);
            mSession->observe(*mFrame);
            if (!mSession->slicesShown()) mPresenter.upload(mFrame->left.color, mFrame->right.color);
            mRate.count(mFrame->request.version < mAsked);
            mNewFrame = true;
        }
        if (mSession->slicesShown())
            takeSlice();
        else
            mScreenshots.take(mFrame, mSession->compose());
        if (!mSession->slicesShown() && mSliceVersion != 0) endSlices();
        reportScreenshots();
        reportSweep();
        reportDisplay();
    }

    void takeSlice() {
        const glm::ivec2 size = mWindow.framebufferSize();
        if (size.x < 1 || size.y < 1) return;
        const auto [width, height] = eyeSizeFor(mSession->compose().mode, size.x, size.y);
        const Plane<PackedColor>& picture = mSession->slicePicture(width, height);
        mScreenshots.take(picture, mSession->compose());
        if (mSession->sliceVersion() == mSliceVersion) return;
        mSliceVersion = mSession->sliceVersion();
        mPresenter.upload(picture, {});
        mNewFrame = true;
    }

    void endSlices() {
        mSliceVersion = 0;
        if (mFrame) mPresenter.upload(mFrame->left.color, mFrame->right.color);
        mNewFrame = true;
    }

    void reportSweep() {
        const std::string notice = mSweep ? mSweep->takeNotice() : "";
        if (!notice.empty()) mSession->notify(notice);
        tell(notice);
        if (!mFrame || mFrame->sweep == mSwept) return;
        mSwept = mFrame->sweep;
        tell(mSwept);
    }

    void reportDisplay() {
        const std::string notice = mDisplay.takeNotice();
        if (!notice.empty()) mSession->notify(notice);
        tell(notice);
    }

    void reportScreenshots() {
        if (const std::string text = mScreenshots.report(); !text.empty()) {
            mSession->notify(text);
            tell(text);
        }
    }

    void finishScreenshots() {
        mWindow.handleEvents(kActiveWait);
        takeFrame();
    }

    OverlayContent content() {
        OverlayContent content;
        if (!mSession) {
            const ViewWorker::Loading loading = mWorker.loading();
            content.progress = loading.fraction;
            content.progressText = loading.what.empty() ? "loading" : loading.what;
            return content;
        }
        if (!mFrame) {
            content.progress = 1.0;
            content.progressText = "casting the first picture";
        }
        content.notice = mSession->notice();
        if (mSession->helpShown()) content.help = viewHelp();
        if (mFrame && (mFigureWatch.elapsed_ms() > 1000 * kFigureSeconds || mStatus.empty())) {
            mFigureWatch.lap_ms();
            mStatus = mSession->statusLine(*mFrame, mRate.value());
            if (const std::string onScreen = mDisplay.parallaxText(*mFrame); !onScreen.empty())
                mStatus += "  " + onScreen;
            mWarning = mDisplay.warning(*mFrame);
            if (mWarning.empty()) mWarning = warningLine(*mFrame);
        }
        content.status = mSession->slicesShown() ? mSession->sliceStatus() : mStatus;
        content.warning = mSession->slicesShown() ? "" : mWarning;
        addLoading(content);
        return content;
    }

    // Of a scene that is to take the present one's place.
    void addLoading(OverlayContent& content) const {
        const ViewWorker::Loading loading = mWorker.loading();
        if (loading.busy)
            content.status += fmt::format("\n{:.0f} % {}", 100 * loading.fraction,
                                          loading.what.empty() ? "loading" : loading.what);
        if (mSlices.busy()) content.status += "\nreading the slices";
    }

    // The mode of the session; but until a picture made for it is there, that of the one shown.
    ComposeSetting shownSetting() const {
        ComposeSetting setting = mSession ? mSession->compose() : ComposeSetting{mMode, false, false};
        const glm::ivec2 size = mWindow.framebufferSize();
        if (mSession && mSession->slicesShown()) return setting;
        if (mFrame &&
            eyeSizeFor(setting.mode, size.x, size.y) != eyeSizeFor(mFrame->request.mode, size.x, size.y))
            setting.mode = mFrame->request.mode;
        return setting;
    }

    // Draws only when there is something new: the processor is the ray caster's.
    void draw() {
        OverlayContent now = content();
        const ComposeSetting setting = shownSetting();
        const bool sameSetting = setting == mDrawn;
        if (!mWindow.redrawNeeded() && !mNewFrame && sameSetting && now == mContent &&
            !ViewDisplay::alternates(setting))
            return;
        mNewFrame = false;
        mContent = std::move(now);
        mDrawn = setting;
        const glm::ivec2 size = mWindow.framebufferSize(), origin = mWindow.framebufferOrigin();
        mDisplay.draw(setting, [&](const ComposeSetting& one) {
            glViewport(0, 0, size.x, size.y);
            glClearColor(0, 0, 0, 1);
            glClear(GL_COLOR_BUFFER_BIT);
            mPresenter.draw(one, {0, 0, size.x, size.y}, origin.x, origin.y);
            mOverlay.draw(mContent, areasOf(infoOf(one.mode).layout));
        });
    }

    ViewOptions mOptions, mChanged = mOptions;  // as given, and with what was changed since
    std::optional<RecordedPath> mFlight;
    Window mWindow;
    ViewDisplay mDisplay;
    OutputMode mMode;
    std::unique_ptr<ViewSweep> mSweep;  // of a medium; before the scenes, which use it to their end
    StereoPresenter mPresenter;
    Overlay mOverlay;
    Screenshots mScreenshots;
    ViewInput mInput;
    Stopwatch mClock, mFigureWatch;
    FrameRate mRate;
    std::shared_ptr<const ViewFrame> mFrame;
    OverlayContent mContent;
    ComposeSetting mDrawn;
    std::string mStatus, mWarning, mSwept = kCpuSweep;
    long long mAsked = 0, mSliceVersion = 0;
    std::shared_ptr<const OpenScene> mScene;
    SliceReading mSlices;
    bool mNewFrame = false, mQuitWhileLoading = false;
    ViewWorker mWorker;  // after the window, whose wake() it calls until it has ended
    std::optional<ViewSession> mSession;
};

}  // namespace

int runView(const ViewOptions& options) {
    checkSize(options.size, options.scene, kNoPicture);
    checkMethod(options.scene, options.method);
    if (!options.shots.empty()) checkOutputFolder("--shots", options.shots);
    ViewOptions shown = options;
    shown.scene.skyTurns = !shownAs(options.scene).swept;  // a medium's keys turn its own light
    Viewer(shown).run();
    return 0;
}

}  // namespace stereonav
