// The window: events and drawing on this thread, loading and rendering on the worker's threads. Each part has
// an owner; this class calls them in their order.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/options/view_options.h"
#include "app/view/asked_frames.h"
#include "app/view/bench_flight.h"
#include "app/view/clipboard.h"
#include "app/view/file_looks.h"
#include "app/view/flown_keyframes.h"
#include "app/view/frame_presenter.h"
#include "app/view/instruments.h"
#include "app/view/kept_places.h"
#include "app/view/kept_view.h"
#include "app/view/notices.h"
#include "app/view/panel/panel_parts.h"
#include "app/view/scene_changes.h"
#include "app/view/scene_facts.h"
#include "app/view/scene_settings.h"
#include "app/view/screenshots.h"
#include "app/view/second_side.h"
#include "app/view/session.h"
#include "app/view/study_reading.h"
#include "app/view/view_display.h"
#include "app/view/window/kept_window.h"
#include "app/view/window/panel_stage.h"
#include "app/view/window/picture_marks.h"
#include "app/view/window/picture_pointer.h"
#include "app/view/window/window_drawing.h"
#include "app/view/window/window_input.h"
#include "app/view/window_closing.h"
#include "app/view/window_jobs.h"
#include "engine/base/stopwatch.h"
#include "engine/display/window.h"

namespace stereonav {

class Viewer {
public:
    explicit Viewer(const ViewOptions& options);
    ~Viewer();

    void run();

private:
    void turn();
    void end();
    double waitSeconds() const;
    void takeInput(double dt);
    void takeDrops();
    void act(const ViewAction& action);
    bool actOnInterface(ViewCommand command);  // commands that need no scene
    bool actOnInstruments(ViewCommand command);
    bool back();
    void step(bool forward);  // undo or redo
    void takeScene();
    void beginSession();
    void replaceScene();
    void greet(bool first, bool left);
    void keepView();
    void fly(double dt);
    void followInstruments();
    void askFor();
    void takeFrame();
    void takeOwnFrame(std::shared_ptr<const ViewFrame> frame);
    void show(double dt, const Stopwatch& turn);
    void report();
    void tell(const std::string& notice);  // in the window, too
    PanelParts parts();
    void copyPlace();

    // Later members refer to earlier ones and are destroyed before them.
    Notices mNotices;
    SceneSettings mSettings;
    std::optional<RecordedPath> mFlight;
    Window mWindow;
    ViewDisplay mDisplay;
    SceneChanges mChanges;
    PanelStage mStage;
    WindowInput mInput;
    Screenshots mScreenshots;
    AskedFrames mAsked;
    FramePresenter mPictures;
    BenchFlight mBench;
    SceneFacts mFacts;
    StudyReading mStudy;
    FlownKeyframes mKeyframes;
    KeptPlaces mKept;
    KeptWindow mKeptWindow;
    std::optional<KeptView> mView;  // the view that the shown scene had when it was left
    WindowJobs mJobs;
    Instruments mInstruments;
    std::optional<ViewSession> mSession;
    SecondSide mSecond;
    FileLooks mLooks;
    WindowClosing mClosing;
    PicturePointer mPointer;
    PictureMarks mMarks;
    WindowDrawing mDrawing;
    Clipboard mClipboard;
    Stopwatch mClock;
    std::string mSwept = kCpuSweep;  // processor for media, as last reported
};

}  // namespace stereonav
