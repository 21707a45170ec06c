// The window: events and drawing on this thread, loading and rendering on the worker's.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/command/commands.h"
#include "app/output/place_labels.h"
#include "app/view/asked_frames.h"
#include "app/view/bench_flight.h"
#include "app/view/closing_question.h"
#include "app/view/control_window.h"
#include "app/view/frame_presenter.h"
#include "app/view/input.h"
#include "app/view/keyframe_edit.h"
#include "app/view/live_coverage.h"
#include "app/view/loading.h"
#include "app/view/notices.h"
#include "app/view/panel/panel_host.h"
#include "app/view/panel/panels.h"
#include "app/view/picture_place.h"
#include "app/view/scene_facts.h"
#include "app/view/scene_preparation.h"
#include "app/view/scene_settings.h"
#include "app/view/screenshots.h"
#include "app/view/second_study.h"
#include "app/view/session.h"
#include "app/view/sweep.h"
#include "app/view/view_display.h"
#include "app/view/window_config.h"
#include "app/view/window_jobs.h"
#include "app/view/window_times.h"
#include "engine/base/stopwatch.h"
#include "engine/display/eye_overlay.h"
#include "engine/display/interface.h"
#include "engine/display/window.h"

namespace stereonav {

class Viewer final : public PanelHost {
public:
    explicit Viewer(const ViewOptions& options);
    ~Viewer() override;

    void run();

    // PanelHost
    ViewSession* session() override { return mSession ? &*mSession : nullptr; }
    const ViewFrame* frame() const override { return mPictures.frame(); }
    FramePresenter& pictures() override { return mPictures; }
    Facts pointedFacts() const override;
    SceneSettings& settings() override { return mSettings; }
    WindowJobs& jobs() override { return mJobs; }
    Notices& notices() override { return mNotices; }
    SettingTexts settingsToOpen() const override;
    std::optional<std::string> valueOf(const Option& option) const override;
    bool live(const Option& option) const override;
    SizeOption pictureSize() const override;
    ViewWorker::Loading loading() const override { return mWorker->loading(); }
    double loadingSeconds() const override { return mLoadingWatch.elapsed_ms() / 1000; }
    void cancelLoading() override;
    std::optional<double> readingSlices() const override {
        return mSlices.busy() ? std::optional(mSlices.fraction()) : std::nullopt;
    }
    void cancelSlices() override { mSlices.cancel(); }
    void act(const ViewAction& action) override;
    void set(const std::string& key, const std::optional<std::string>& text) override;
    void open(const std::string& scene) override;
    void quit() override { leave(); }
    std::string closingQuestion() const override;
    void answerClosing(bool close) override;
    const std::vector<RecentFile>& recentFiles() const override { return mRecent.list(); }
    void forgetRecent(const std::filesystem::path& file) override { mRecent.remove(file); }
    FileLook lookAt(const std::filesystem::path& file) override { return mLooks.look(file); }
    Bookmarks* places() override { return mPlaces ? &*mPlaces : nullptr; }
    void addPlace() override;
    void goToPlace(const Bookmark& place) override;
    bool placeLabels() const override { return mLabels; }
    void showPlaceLabels(bool shown) override { mLabels = shown; }
    KeyframeEdit& keyframes() override { return mKeyframes; }
    void openPath(const std::filesystem::path& file) override;
    std::shared_ptr<const SliceStudy> study() override;
    void saveScene(const std::filesystem::path& file) override;
    void copy(const std::string& text) override;
    MeasuredLine* measured() override { return mSession ? &mMeasured : nullptr; }
    bool measuring() const override { return mMeasuring; }
    void measure(bool on) override;
    LiveCoverage* coverage() override { return mSession && mCoverage.can() ? &mCoverage : nullptr; }
    FindingList* findings() override { return mSession && mFindings.maker() ? &mFindings : nullptr; }
    void addFinding(const glm::dvec3& place) override;
    void writeFindingsPage(const std::filesystem::path& file) override;
    void writeFindingsReport(const std::filesystem::path& file) override;
    void markWorld(const std::optional<glm::dvec3>& place) override { mMarked = place; }
    std::optional<glm::dvec3> pointedWorld() const override;
    std::vector<FlatMark> flatMarks() const override;
    SecondStudy* secondStudy() override { return &mSecond; }
    void openOther(const std::string& study) override;
    void swapStudies() override;
    std::optional<double> seesFromClicks() const override { return mSeesFrom; }
    void seeFromClicks(const std::optional<double>& height) override { mSeesFrom = height; }
    std::optional<PaintWork> painting() const override;
    std::optional<PaintWork> preparing() const override { return mPreparation.work(); }
    void cancelPreparing() override { mPreparation.cancel(); }
    bool canUndo() const override { return mSession && (mKeyframes.canUndo() || mSettings.canUndo()); }
    bool canRedo() const override { return mSession && (mKeyframes.canRedo() || mSettings.canRedo()); }
    void undo() override;
    void redo() override;
    const InterfaceLook& look() const override { return panelled().look(); }
    void setLook(const InterfaceLook& look) override { panelled().setLook(look); }
    const Facts* facts() override { return mScene ? mFacts.of(*mWorker) : nullptr; }
    ScreenWords onScreen(const ViewFrame& frame) const override;
    ScreenAnswer screen() const override;
    void leaveScreenUnknown() override;
    bool fullScreen() const override { return mWindow.fullScreen(); }
    bool controlsApart() const override { return mControls != nullptr; }

private:
    double waitSeconds() const;
    void takeScene();
    void beginSession();
    void greet(bool first);
    void beginSecond();
    void followSecond();
    void replaceScene();
    void update(double dt);
    // The interface that has the panels.
    Interface& panelled() { return mControls ? mControls->interface() : mInterface; }
    const Interface& panelled() const { return mControls ? mControls->interface() : mInterface; }
    void toggleControls();
    void drawControls(double dt);
    void useControls();
    void takeKeys(double dt);
    bool actOnInterface(const ViewAction& action);
    void drawPanels(const std::function<void()>& drawn);
    void usePointer();
    void followWishes();
    void followPreparation();
    void loadAgain();
    void followKeyframes();
    void takeStudy();
    void readConfig();
    void keepConfig();
    void noteRecent();
    void keepBefore();
    // What would end with the window, and what becomes of it.
    std::vector<std::string> workAtHand() const;
    void leave();  // closes the window, unless there is something to ask first
    bool ends();
    void endSession();
    void reportKept();
    void takeDrops();
    void load(const ViewOptions& options, SettingTexts given, bool another);
    void goTo(const SettingTexts& settings);
    bool setScreen(const std::string& key, const std::optional<std::string>& text);
    void askFor();
    void takeFrame();
    void takeOwnFrame(std::shared_ptr<const ViewFrame> frame);
    void reportSweep();
    void reportDisplay();
    void reportScreenshots();
    void finishScreenshots();
    OutputMode shownMode() const;
    ComposeSetting shownSetting() const;
    PicturePlace placeFor(const OutputModeInfo& mode) const;
    SizeOption windowSize() const;
    bool layOut(const InterfacePlaces& places, double dt);
    void draw(double dt, const Stopwatch& turn);
    void show(const ComposeSetting& setting);
    bool drawsPointer(const OutputModeInfo& mode) const;
    std::vector<OverlayMark> marks(const OutputModeInfo& mode) const;
    // Where the pointer is over the picture: shares of an eye's size.
    std::optional<glm::dvec2> pointedShare(const OutputModeInfo& mode) const;
    void copyPlace();
    void openInstruments();
    void followInstruments();
    void measureHere();
    void followCoverage();
    void showToCoverage();
    bool actOnCoverage(ViewCommand command);
    void toggleCoverage();
    void flyToUnseen(int step);
    void findHere();
    void seeFromHere();
    void followPaint();
    const std::vector<LabelledPlace>& namedPlaces() const;
    void addLineMarks(std::vector<OverlayMark>& marks) const;
    bool drawOverlay(const OutputModeInfo& mode);

    Notices mNotices;
    SceneSettings mSettings;
    std::optional<RecordedPath> mFlight;
    Window mWindow;
    ViewDisplay mDisplay;
    OutputMode mMode;
    std::unique_ptr<ViewSweep> mSweep;  // of media; before the scenes, which use it to their end
    Interface mInterface;
    EyeOverlay mOverlay;
    Panels mPanels;
    std::unique_ptr<ControlWindow> mControls;  // while the panels are in a window of their own
    bool mInPanels = false;
    std::vector<ViewAction> mActsOfPanels;  // asked for while they were drawn
    Screenshots mScreenshots;
    AskedFrames mAsked;
    FramePresenter mPictures;
    BenchFlight mBench;
    ViewInput mInput;
    SpaceMouse mSpaceMouse;
    Stopwatch mClock, mLoadingWatch;
    double mSinceLayout = 0;  // seconds
    WindowTimes mTimes;
    WindowConfig mConfig;  // as it was read, and is kept at the end
    RecentFiles mRecent;
    std::optional<Bookmarks> mPlaces;
    WindowJobs mJobs{mSession, mSettings, mNotices};
    ClosingQuestion mClosing;
    bool mEnds = false;       // the window closes, whatever is at work
    bool mRecentDue = false;  // the file that is shown goes among them with its first picture
    ComposeSetting mDrawn;
    PicturePlace mDrawnPlace;
    std::string mSwept = kCpuSweep;
    std::shared_ptr<const OpenScene> mScene;
    SceneFacts mFacts;
    SliceReading mSlices;
    bool mLabels = true;  // of places, over the picture
    mutable struct {
        std::weak_ptr<const OpenScene> of;
        int places = -1;  // versions
        long long paint = 0;
        std::vector<LabelledPlace> list;
    } mNames;  // of those places
    bool mNewPreview = false, mLayoutDue = true, mLaidOutBusy = false, mAnother = false, mWasBusy = false,
         mStudyFailed = false;
    bool mMeasuring = false;
    std::optional<glm::dvec3> mMarked;  // world
    std::optional<double> mSeesFrom;    // metres above the ground
    long long mPaintSeen = 0;           // versions: of what is painted
    Stopwatch mPaintWatch;              // of what is worked out
    MeasuredLine mMeasured{[] { Window::wake(); }};
    LiveCoverage mCoverage{[] { Window::wake(); }};
    FindingList mFindings{[] { Window::wake(); }};
    KeyframeEdit mKeyframes;
    long long mKeyframesSeen = 0, mKeyframesPath = 0;  // versions: of them, and of the path beside them
    bool mKeyframesFlown = false;                      // that path is theirs
    std::optional<ViewSession> mSession;
    ScenePreparation mPreparation{[] { Window::wake(); }};
    bool mPrepared = false;                                        // what is shown is to be loaded again
    SecondStudy mSecond{[] { Window::wake(); }};                   // after the window, as the worker
    SceneMade mSecondMade;                                         // what it is, or is being, made of
    std::optional<Pose> mSwapTo;                                   // where the flight goes on in it
    std::shared_ptr<const SliceStudy> mSecondSlices, mSwapSlices;  // its own, once read; those to go on with
    FileLooks mLooks{[] { Window::wake(); }};                      // after the window, as the worker
    std::unique_ptr<ViewWorker> mWorker;  // after the window, whose wake() it calls until it has ended
};

}  // namespace stereonav
