// The window: events and drawing on this thread, loading and rendering on the worker's.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "app/commands.h"
#include "app/scene_loading.h"
#include "app/view_input.h"
#include "app/view_session.h"
#include "app/view_worker.h"
#include "engine/base/stopwatch.h"
#include "engine/display/overlay.h"
#include "engine/display/stereo_presenter.h"
#include "engine/display/window.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace {

constexpr double kActiveWait = 1.0 / 120;  // seconds between looks at the keys while something moves
constexpr double kIdleWait = 0.1;          // seconds; events and frames end the wait at once
constexpr double kFigureSeconds = 0.25;    // the figures change four times a second, to be readable
constexpr double kFrameWeight = 0.15;      // of the newest frame in the mean time between frames

// A loaded scene with the figures that the viewer chooses speeds and the right eye's method from.
ViewScene viewSceneOf(const ViewOptions& options, Progress& progress) {
    auto loaded = std::make_shared<LoadedScene>(loadScene(options.scene, options.size, progress));
    const TerrainScene& terrain = *loaded->terrain;
    ViewScene scene;
    scene.owner = loaded;
    scene.renderer = loaded->renderer.get();
    scene.ground = [&ground = terrain.ground](const glm::dvec2& place) { return ground.heightAt(place); };
    scene.start = terrain.startPose;
    scene.path = terrain.path;
    scene.lens = loaded->lens;
    scene.stereo = loaded->stereo;
    scene.clearance = terrain.clearance;
    const glm::dvec2 spacing = terrain.ground.spacing();
    scene.extent =
        std::max(spacing.x * (terrain.ground.width() - 1), spacing.y * (terrain.ground.height() - 1));
    scene.groundStep = 0.5 * std::min(spacing.x, spacing.y);
    if (options.method == "auto") {
        progress.report(1.0, "measuring how to make the right eye");
        scene.method = planScene(*loaded).method;
    } else {
        scene.method = methodFromText(options.method);
    }
    return scene;
}

// Saves pictures beside the window's thread; each waits for the frame that shows what was asked for.
class Screenshots {
public:
    explicit Screenshots(std::filesystem::path folder) : mFolder(std::move(folder)) {}

    void wish(long long version) { mVersions.push_back(version); }
    bool waiting() const { return !mVersions.empty() || !mSaving.empty(); }

    void take(const std::shared_ptr<const ViewFrame>& frame, const ComposeSetting& setting) {
        std::erase_if(mVersions, [&](long long version) {
            if (!frame || frame->request.version < version) return false;
            save(frame, setting);
            return true;
        });
    }

    // What happened since, "" when nothing; throws what saving threw.
    std::string report() {
        std::string text;
        std::erase_if(mSaving, [&](std::future<std::string>& saving) {
            if (saving.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
            text = saving.get();
            return true;
        });
        return text;
    }

private:
    void save(const std::shared_ptr<const ViewFrame>& frame, const ComposeSetting& setting) {
        std::filesystem::path file;
        do file = mFolder / fmt::format("stereonav_{:04}_{}.png", ++mNumber, infoOf(setting.mode).shortName);
        while (std::filesystem::exists(file));
        mSaving.push_back(std::async(std::launch::async, [frame, setting, file]() -> std::string {
            try {
                const bool oneEye = frame->right.color.empty();
                writeColorImage(
                    file, composeStereo(frame->left.color, oneEye ? frame->left.color : frame->right.color,
                                        setting));
                return "saved " + file.string();
            } catch (const std::exception& error) {
                return error.what();
            }
        }));
    }

    std::filesystem::path mFolder;
    int mNumber = 0;
    std::vector<long long> mVersions;
    std::vector<std::future<std::string>> mSaving;
};

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
    return {{0, 0, 1, 1}};
}

class Viewer {
public:
    explicit Viewer(const ViewOptions& options)
        : mOptions(options),
          mMode(modeFromText(options.mode)),
          mFlight(options.path.empty() ? std::nullopt : std::optional(readPath(options.path))),
          mWindow(titleOf(options), composedSize(mMode, options.size.width, options.size.height).first,
                  composedSize(mMode, options.size.width, options.size.height).second),
          mOverlay(mWindow),
          mScreenshots(options.shots),
          mWorker([options](Progress& progress) { return viewSceneOf(options, progress); },
                  [] { Window::wake(); }) {}

    void run() {
        while (!mWindow.shouldClose() && !mQuitWhileLoading && !(mSession && mSession->quit())) {
            mWindow.handleEvents(waitSeconds());
            const double dt = mClock.lap_ms() / 1000;
            if (!mSession && mWorker.scene()) startSession();
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

    double waitSeconds() const {
        if (!mSession || mWindow.minimised()) return kIdleWait;
        return mSession->moving() || mWindow.gamepad().present || mScreenshots.waiting() ? kActiveWait
                                                                                         : kIdleWait;
    }

    void startSession() {
        mSession.emplace(*mWorker.scene(), ViewSession::Options{mMode, mFlight, mOptions.shots});
        mSession->notify("F1 shows the keys");
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
            if (const auto action = actionOf(press)) mSession->act(*action);
        for (const ViewAction& action : mInput.actionsOf(pad)) mSession->act(action);
        mWindow.setCaptured(mSession->mouseCaptured());
        const glm::ivec2 size = mWindow.framebufferSize();
        const glm::dvec2 drag = mWindow.takeDrag();
        if (size.y > 0) {
            const double radiansPerUnit = mWorker.scene()->lens.verticalFov / size.y;
            mSession->look(drag.x * radiansPerUnit, -drag.y * radiansPerUnit);
        }
        mSession->changeSpeed(mWindow.takeWheel());
        mSession->step(mInput.flightOf(mWindow, pad), dt);
        if (size.x > 0 && size.y > 0) askFor(size);
        takeFrame();
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
            mPresenter.upload(mFrame->left.color, mFrame->right.color);
            mRate.count(mFrame->request.version < mAsked);
            mNewFrame = true;
        }
        mScreenshots.take(mFrame, mSession->compose());
        reportScreenshots();
    }

    void reportScreenshots() {
        if (const std::string text = mScreenshots.report(); !text.empty()) {
            mSession->notify(text);
            std::printf("%s\n", text.c_str());
            std::fflush(stdout);
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
            mWarning = mSession->warningLine(*mFrame);
        }
        content.status = mStatus;
        content.warning = mWarning;
        return content;
    }

    // The mode of the session; but until a picture made for it is there, that of the one shown.
    ComposeSetting shownSetting() const {
        ComposeSetting setting = mSession ? mSession->compose() : ComposeSetting{mMode, false, false};
        const glm::ivec2 size = mWindow.framebufferSize();
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
        if (!mWindow.redrawNeeded() && !mNewFrame && sameSetting && now == mContent) return;
        mNewFrame = false;
        mContent = std::move(now);
        mDrawn = setting;
        const glm::ivec2 size = mWindow.framebufferSize(), origin = mWindow.framebufferOrigin();
        glViewport(0, 0, size.x, size.y);
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        mPresenter.draw(setting, {0, 0, size.x, size.y}, origin.x, origin.y);
        mOverlay.draw(mContent, areasOf(infoOf(setting.mode).layout));
        mWindow.swapBuffers();
    }

    ViewOptions mOptions;
    OutputMode mMode;
    std::optional<RecordedPath> mFlight;
    Window mWindow;
    StereoPresenter mPresenter;
    Overlay mOverlay;
    Screenshots mScreenshots;
    ViewInput mInput;
    Stopwatch mClock, mFigureWatch;
    FrameRate mRate;
    std::shared_ptr<const ViewFrame> mFrame;
    OverlayContent mContent;
    ComposeSetting mDrawn;
    std::string mStatus, mWarning;
    long long mAsked = 0;
    bool mNewFrame = false, mQuitWhileLoading = false;
    ViewWorker mWorker;  // after the window, whose wake() it calls until it has ended
    std::optional<ViewSession> mSession;
};

}  // namespace

int runView(const ViewOptions& options) {
    checkSize(options.size);
    if (options.method != "auto") methodFromText(options.method);
    Viewer(options).run();
    return 0;
}

}  // namespace stereonav
