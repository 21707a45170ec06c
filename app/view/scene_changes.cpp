#include "app/view/scene_changes.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "app/options/option_value.h"
#include "app/scene/shown_as.h"
#include "app/view/live_settings.h"
#include "engine/base/error.h"
#include "engine/scene/capabilities.h"

namespace stereonav {
namespace {

constexpr std::string_view kScreenWidthKey = "screen-width", kViewingDistanceKey = "viewing-distance";

bool isOfScreen(std::string_view key) {
    return key == kScreenWidthKey || key == kViewingDistanceKey;
}

}  // namespace

SceneChanges::SceneChanges(std::optional<ViewSession>& session, SceneSettings& settings, Notices& notices,
                           ViewDisplay& display)
    : mSession(session),
      mSettings(settings),
      mNotices(notices),
      mDisplay(display),
      mBenches(settings.options().bench),
      mPreparation([] { Window::wake(); }) {}

void SceneChanges::begin() {
    const ViewOptions& options = mSettings.options();
    if (shownAs(options.scene).swept) mSweep = std::make_unique<ViewSweep>(options.sweep);
    checkSize(mDisplay.windowSize(), options.scene, kViewBytes);
    mWorker = std::make_unique<ViewWorker>(
        [options, size = mDisplay.windowSize(), sweep = mSweep.get()](Progress& progress) {
            return openScene(options, true, size, sweep, progress);
        },
        [] { Window::wake(); });
}

std::optional<std::string> SceneChanges::valueOf(const Option& option) const {
    if (option.key == kScreenWidthKey)
        return fmt::format("{:.6g}", mDisplay.sizes().of(mDisplay.told()).width_mm);
    if (option.key == kViewingDistanceKey)
        return fmt::format("{:.6g}", mDisplay.sizes().of(mDisplay.told()).distance_mm);
    return mSession ? valueNow(*mSession, option.key) : std::nullopt;
}

bool SceneChanges::live(const Option& option) const {
    return isOfScreen(option.key) || (mSession && isLive(*mSession, option.key));
}

// Sets the screen's size, which belongs to the user and not to the scene: it is kept for the monitor, and
// nothing is loaded. Returns false for other options.
bool SceneChanges::setScreen(const std::string& key, const std::optional<std::string>& text) {
    if (!isOfScreen(key)) return false;
    const Option& option = *viewOption(key);
    const std::optional<double> mm =
        text ? std::optional(readValue(option.name(), option.value, option.advice, *text).number())
             : std::nullopt;
    const std::string monitor = mDisplay.told().name;
    if (key == kScreenWidthKey)
        mDisplay.sizes().setWidth(monitor, mm);
    else
        mDisplay.sizes().setDistance(monitor, mm);
    // The command line's value is no longer in effect.
    mSettings.forgetScreen(
        key, key == kScreenWidthKey ? &ViewOptions::screenWidth_mm : &ViewOptions::viewingDistance_mm);
    return true;
}

void SceneChanges::load(const ViewOptions& options, SettingTexts given, bool another) {
    ViewOptions shown = options;
    const bool swept = shownAs(shown.scene).swept;
    shown.scene.skyTurns = !swept;
    shown.scene.detailLater = true;
    shown.scene.standInFirst = !mBenches;
    checkMethod(shown.scene, shown.method);
    checkSize(mDisplay.windowSize(), shown.scene, kViewBytes);
    mDisplay.follow(shown);
    if (swept && !mSweep) mSweep = std::make_unique<ViewSweep>(shown.sweep);
    mAnother = mAnother || another;
    mArrival.reset();
    mSettings.begin({shown, std::move(given), fileTextsOf(options.scene.given)});
    mWorker->scenes().reload([options = shown, size = mDisplay.windowSize(),
                              sweep = swept ? mSweep.get() : nullptr](Progress& progress) {
        return openScene(options, false, size, sweep, progress);
    });
}

// Loads the scene again with the same settings.
void SceneChanges::loadAgain() {
    mWorker->scenes().reload([options = mSettings.changed(), size = mDisplay.windowSize(),
                              sweep = mSweep.get()](Progress& progress) {
        return openScene(options, false, size, sweep, progress);
    });
}

bool SceneChanges::open(const std::string& scene) {
    mNotices.forgetFailure();
    mNotices.tryTo([&] {
        SettingTexts settings;
        if (scene != "terrain") settings["SCENE"] = {scene};
        // Settings of the user and of the screen are kept.
        const SettingTexts& given = mSettings.given();
        for (const char* key : {"shots", "size", "threads", "simd", "full-screen", "screen-width",
                                "viewing-distance", "late-warp", "target-ms"})
            if (const auto kept = given.find(key); kept != given.end()) settings.insert(*kept);
        ViewOptions options = viewOptionsOf(settings);
        if (mSession) mDisplay.setMode(mSession->shownMode());
        load(options, settingTextsOf(options.scene.given), true);
    });
    return mNotices.failure().empty();
}

void SceneChanges::goTo(std::shared_ptr<const OpenScene> scene, const SceneMade& next, const SceneMade& flown,
                        Arrival arrival) {
    mDisplay.setMode(mSession->shownMode());
    mAnother = true;
    mSettings.begin(next, flown);
    mArrival = std::move(arrival);
    mWorker->scenes().reload([next = std::move(scene)](Progress&) { return *next; });
}

void SceneChanges::cancelLoading() {
    if (!mSession) return mDisplay.close();
    mWorker->scenes().cancel();
    if (mWorker->scenes().newest() == mScene) keepBefore();  // otherwise it was there already
}

void SceneChanges::keepBefore() {
    mAnother = false;
    mSettings.keepBefore();
}

void SceneChanges::set(const std::string& key, const std::optional<std::string>& text) {
    if (!mSession) return;
    mNotices.tryTo([&] {
        if (setScreen(key, text)) return;
        if (isLive(*mSession, key, text)) {
            setLive(*mSession, key, text);
            if (!text) mSettings.forgetGiven(key);
            return;
        }
        SettingTexts settings = mSettings.now();
        if (text)
            setText(settings, key, *text);
        else
            settings.erase(key);
        change(settings);
    });
    mSettings.look();
}

// Changes the settings. Throws Error, and then changes nothing.
void SceneChanges::change(const SettingTexts& settings) {
    const SettingTexts now = mSettings.now();
    bool again = false;
    std::vector<std::pair<std::string, std::optional<std::string>>> changes;
    const auto note = [&](const std::string& key) {
        const auto a = now.find(key), b = settings.find(key);
        if (a != now.end() && b != settings.end() && a->second == b->second) return;
        const std::optional<std::string> text =
            b == settings.end() || b->second.empty() ? std::nullopt : std::optional(b->second.back());
        if (isOfScreen(key)) return;  // not undone, since it is no setting of the picture
        changes.emplace_back(key, text);
        again = again || !isLive(*mSession, key, text);
    };
    for (const auto& [key, texts] : now) note(key);
    for (const auto& [key, texts] : settings)
        if (!now.contains(key)) note(key);
    if (again) load(viewOptionsOf(settings), settings, false);
    for (const auto& [key, text] : changes) {
        if (!again && !text) mSettings.forgetGiven(key);
        if (isLive(*mSession, key, text)) setLive(*mSession, key, text);
    }
    if (again) mSession->surface().takeChange();  // the scene that is loaded has the change
    mSettings.look();
}

void SceneChanges::undo() {
    const auto settings = mSettings.history().undo();
    if (!settings) return mSession->notify("there is nothing to undo");
    mNotices.tryTo([&] { change(*settings); });
}

void SceneChanges::redo() {
    const auto settings = mSettings.history().redo();
    if (!settings) return mSession->notify("there is nothing to redo");
    mNotices.tryTo([&] { change(*settings); });
}

bool SceneChanges::takeScene() {
    auto scene = mWorker->scenes().newest();
    const bool busy = mWorker->scenes().loading().busy;  // after the scene: of that, or of a newer one
    if (busy && !mWasBusy) mLoadingWatch.lap_ms();
    mWasBusy = busy;
    if (!scene || scene == mScene) return false;
    mScene = std::move(scene);
    mSettings.lookAtScene();
    if (!busy) mSettings.arrived();
    return true;
}

std::optional<SceneMade> SceneChanges::interrupt() {
    if (mSession || !mSettings.begun()) return std::nullopt;
    SceneMade next = mSettings.made();
    keepBefore();
    return next;
}

void SceneChanges::resume(const std::optional<SceneMade>& next) {
    if (next) mSettings.begin(*next);
    mAnother = mSettings.begun();
}

void SceneChanges::follow() {
    if (const auto change = mSession->surface().takeChange()) {
        mSettings.change(*change);
        if (mScene->scene->offered<SurfaceChoices>() && !change->pieces)
            mWorker->scenes().change([options = mSettings.changed(), surface = change->surface](
                                         const OpenScene& now, Progress& progress) {
                return changedScene(now, surface, options, progress);
            });
        else
            loadAgain();
    }
    if (const std::string problem = mWorker->scenes().takeProblem(); !problem.empty()) {
        mSession->surface().forgetChange();
        mNotices.fail(problem);
        keepBefore();
    }
    followPreparation();
}

// Loads the scene again once the data that its stand-in lacked are there; not while another one is being
// loaded.
void SceneChanges::followPreparation() {
    try {
        mPreparation.follow(mScene);
        mPrepared = mPreparation.take() || mPrepared;
    } catch (const Cancelled&) {
        mSession->notify("the ground stays coarse until it is opened again");
    } catch (const std::exception& error) {
        mNotices.fail(error.what());
    }
    if (!mPrepared || mWorker->scenes().loading().busy) return;
    mPrepared = false;
    if (mScene->scene->offered<const StandIn>()) loadAgain();
}

}  // namespace stereonav
