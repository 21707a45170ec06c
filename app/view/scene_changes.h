// Changes of the scene that is shown: another file, other settings, undo and redo. The session takes some
// settings at once; for others the scene is loaded again beside the frames, and is shown when the worker has
// it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/view/loading.h"
#include "app/view/notices.h"
#include "app/view/scene_preparation.h"
#include "app/view/scene_settings.h"
#include "app/view/session.h"
#include "app/view/sweep.h"
#include "app/view/view_display.h"
#include "app/view/worker.h"
#include "engine/base/stopwatch.h"

namespace stereonav {

// Pose in a scene that is to be shown, with a study of it that has been read; null: none.
struct Arrival {
    Pose pose;
    std::shared_ptr<const SliceStudy> study;
};

class SceneChanges {
public:
    // The arguments must exist from begin() to end().
    SceneChanges(std::optional<ViewSession>& session, SceneSettings& settings, Notices& notices,
                 ViewDisplay& display);
    // Loads the scene of the settings. Throws Error.
    void begin();
    // Ends loading and frames, and waits for their end.
    void end() { mWorker.reset(); }

    ViewWorker& worker() { return *mWorker; }
    const ViewWorker& worker() const { return *mWorker; }
    const std::shared_ptr<const OpenScene>& scene() const { return mScene; }  // null before the first

    const SceneSettings& settings() const { return mSettings; }

    // Changes of the scene; failures become notices.
    // Opens a file, a folder, or a built-in scene by its name. Returns whether it is being loaded.
    bool open(const std::string& scene);
    void set(const std::string& key, const std::optional<std::string>& text);  // empty: as it begins
    void undo();
    void redo();
    // Shows a scene that has been loaded, made of `next`; `flown` is what the present one is made of.
    void goTo(std::shared_ptr<const OpenScene> scene, const SceneMade& next, const SceneMade& flown,
              Arrival arrival);
    // Returns the value in use; empty where it is not known, "" where the option is not given and has no
    // default.
    std::optional<std::string> valueOf(const Option& option) const;
    bool live(const Option& option) const;  // whether it takes effect at once, even while dragging

    SceneLoader::Loading loading() const { return mWorker->scenes().loading(); }
    double loadingSeconds() const { return mLoadingWatch.elapsed_ms() / 1000; }  // time since it began
    // Cancels loading; for the first scene it ends the window.
    void cancelLoading();
    // Returns the progress of preparing the scene that a stand-in is shown for (StandIn).
    std::optional<PaintWork> preparing() const { return mPreparation.work(); }
    void cancelPreparing() { mPreparation.cancel(); }

    // Takes a loaded scene; to be called each turn. Returns true where scene() has changed.
    bool takeScene();
    // Returns whether that is another file, whose session begins; otherwise it takes the place of the one
    // before.
    bool isAnother() const { return !mSession || mAnother; }
    // Interrupts loading another scene while the first is being loaded: the first is shown until then. The
    // settings being loaded are replaced by its own, until resume().
    std::optional<SceneMade> interrupt();
    void resume(const std::optional<SceneMade>& next);
    std::optional<Arrival> takeArrival() { return std::exchange(mArrival, std::nullopt); }
    // Begins work that the session wants and that takes longer than a frame; to be called each turn with a
    // session.
    void follow();
    // Returns once why media are swept on the CPU; "": no reason.
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
    bool mBenches;
    std::unique_ptr<ViewSweep> mSweep;  // for media; before the scenes, which use it to their end
    std::shared_ptr<const OpenScene> mScene;
    std::optional<Arrival> mArrival;  // in the scene that is being loaded
    Stopwatch mLoadingWatch;
    bool mAnother = false, mWasBusy = false;
    ScenePreparation mPreparation;
    bool mPrepared = false;  // whether the scene is to be loaded again
    std::unique_ptr<ViewWorker> mWorker;
};

}  // namespace stereonav
