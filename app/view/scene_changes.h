// Changes which scene is shown: another file, other settings, steps back and forth. What the session takes at
// once it is given; else the scene is loaded anew beside the frames, and is there when the worker has it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/view/loading.h"
#include "app/view/notices.h"
#include "app/view/panel_stage.h"
#include "app/view/scene_preparation.h"
#include "app/view/scene_settings.h"
#include "app/view/sweep.h"
#include "app/view/view_display.h"
#include "app/view/worker.h"
#include "engine/base/stopwatch.h"

namespace stereonav {

// Where the flight goes on in a scene, with a study of it that is there already; null: none.
struct Arrival {
    Pose pose;
    std::shared_ptr<const SliceStudy> study;
};

class SceneChanges {
public:
    // All of them are there from begin() to end().
    SceneChanges(std::optional<ViewSession>& session, SceneSettings& settings, Notices& notices,
                 ViewDisplay& display, PanelStage& stage);
    // Loads what the settings say. Throws Error.
    void begin();
    // Ends loading and frames, and waits for it.
    void end() { mWorker.reset(); }

    ViewWorker& worker() { return *mWorker; }
    const ViewWorker& worker() const { return *mWorker; }
    const std::shared_ptr<const OpenScene>& scene() const { return mScene; }  // null before the first

    const SceneSettings& settings() const { return mSettings; }

    // What fails of these is told.
    void open(const std::string& scene);  // a file, a folder, or a built-in scene's name
    void set(const std::string& key, const std::optional<std::string>& text);  // none: as it begins
    void undo();
    void redo();
    // A scene that is there already, made of `next`; `flown` is what the one is made of that is shown.
    void goTo(std::shared_ptr<const OpenScene> scene, const SceneMade& next, const SceneMade& flown,
              Arrival arrival);
    // The value in use; none where it is not known, or "" where the option is not given and has no default.
    std::optional<std::string> valueOf(const Option& option) const;
    bool live(const Option& option) const;  // taken at once, while it is dragged

    ViewWorker::Loading loading() const { return mWorker->loading(); }
    double loadingSeconds() const { return mLoadingWatch.elapsed_ms() / 1000; }  // since it began
    // Ends it; the first scene's ends the window with it.
    void cancelLoading();
    // What a coarser scene is shown for (StandIn), while it is prepared.
    std::optional<PaintWork> preparing() const { return mPreparation.work(); }
    void cancelPreparing() { mPreparation.cancel(); }

    // Each turn. True: scene() is another one than before.
    bool takeScene();
    // Whether that is another file, whose session begins; else it takes the place of the one before.
    bool isAnother() const { return !mSession || mAnother; }
    // Another one was chosen while the first was loaded: the first is shown until then. Settings of what is
    // loaded give way to its own, until resume().
    std::optional<SceneMade> interrupt();
    void resume(const std::optional<SceneMade>& next);
    std::optional<Arrival> takeArrival() { return std::exchange(mArrival, std::nullopt); }
    // Each turn with a session: begins what the session wants that takes longer than a frame.
    void follow();
    // Why media are swept on the processor, told once; "": nothing to tell.
    std::string takeSweepNotice() { return mSweep ? mSweep->takeNotice() : ""; }

private:
    void load(const ViewOptions& options, SettingTexts given, bool another);
    void loadAgain();
    void change(const SettingTexts& settings);
    bool setScreen(const std::string& key, const std::optional<std::string>& text);
    void keepBefore();
    void followPreparation();

    std::optional<ViewSession>& mSession;
    SceneSettings& mSettings;
    Notices& mNotices;
    ViewDisplay& mDisplay;
    PanelStage& mStage;
    bool mBenches;
    std::unique_ptr<ViewSweep> mSweep;  // of media; before the scenes, which use it to their end
    std::shared_ptr<const OpenScene> mScene;
    std::optional<Arrival> mArrival;  // in the scene that is loaded
    Stopwatch mLoadingWatch;
    bool mAnother = false, mWasBusy = false;
    ScenePreparation mPreparation;
    bool mPrepared = false;  // what is shown is to be loaded again
    std::unique_ptr<ViewWorker> mWorker;
};

}  // namespace stereonav
