// The viewer's part that changes what is shown: other files, other settings, back and forth.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "app/options/option_value.h"
#include "app/options/scene_types.h"
#include "app/scene/shown_as.h"
#include "app/view/live_settings.h"
#include "app/view/raised_ground.h"
#include "app/view/viewer.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/scene/capabilities.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

namespace {

constexpr std::string_view kScreenWidthKey = "screen-width", kViewingDistanceKey = "viewing-distance";

bool isOfScreen(std::string_view key) {
    return key == kScreenWidthKey || key == kViewingDistanceKey;
}

}  // namespace

std::optional<std::string> Viewer::valueOf(const Option& option) const {
    if (option.key == kScreenWidthKey)
        return fmt::format("{:.6g}", mDisplay.sizes().of(mDisplay.told()).width_mm);
    if (option.key == kViewingDistanceKey)
        return fmt::format("{:.6g}", mDisplay.sizes().of(mDisplay.told()).distance_mm);
    return mSession ? valueNow(*mSession, option.key) : std::nullopt;
}

// The screen's size is the person's, not the scene's: it is kept for the monitor, and nothing is loaded for
// it. False: the option is another.
bool Viewer::setScreen(const std::string& key, const std::optional<std::string>& text) {
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
    // What the command line said counts no longer.
    mSettings.forgetScreen(
        key, key == kScreenWidthKey ? &ViewOptions::screenWidth_mm : &ViewOptions::viewingDistance_mm);
    return true;
}

bool Viewer::live(const Option& option) const {
    return isOfScreen(option.key) || (mSession && isLive(*mSession, option.key));
}

void Viewer::load(const ViewOptions& options, SettingTexts given, bool another) {
    ViewOptions shown = options;
    const bool swept = shownAs(shown.scene).swept;
    shown.scene.skyTurns = !swept;
    shown.scene.detailLater = true;
    shown.scene.standInFirst = !mBench.on();
    checkMethod(shown.scene, shown.method);
    checkSize(windowSize(), shown.scene, kViewBytes);
    mDisplay.follow(shown);
    if (swept && !mSweep) mSweep = std::make_unique<ViewSweep>(shown.sweep);
    mAnother = mAnother || another;
    mSwapTo.reset();
    mSettings.begin({shown, std::move(given), fileTextsOf(options.scene.given)});
    mWorker->reload([options = shown, size = windowSize(), sweep = swept ? mSweep.get() : nullptr](
                        Progress& progress) { return openScene(options, false, size, sweep, progress); });
}

// In the same session.
void Viewer::replaceScene() {
    const auto raised = RaisedGround::between(*mSession->open().scene, *mScene->scene);
    mMeasured.replaceScene(mScene->scene);
    mCoverage.replaceScene(mScene->scene);
    mFindings.replaceScene(mScene->scene);
    mSession->replaceScene(mScene);
    if (!raised || !mKeyframes.any()) return;
    mKeyframes.start(raised->moved(mKeyframes.keys()));
    mKeyframesPath = mSession->pathVersion();
}

void Viewer::open(const std::string& scene) {
    mNotices.forgetFailure();
    mNotices.tryTo([&] {
        SettingTexts settings;
        if (scene != "terrain") settings["SCENE"] = {scene};
        // What is of the person and the screen stays.
        for (const char* key : {"shots", "size", "threads", "simd", "full-screen", "screen-width",
                                "viewing-distance", "late-warp", "target-ms"})
            if (const auto kept = mSettings.given().find(key); kept != mSettings.given().end())
                settings.insert(*kept);
        ViewOptions options = viewOptionsOf(settings);
        mMode = mSession ? mSession->mode() : mMode;
        options.mode = mMode;
        load(options, settingTextsOf(options.scene.given), true);
        mPanels.showStart(false);
    });
}

void Viewer::cancelLoading() {
    if (!mSession) return mWindow.close();
    mWorker->cancelLoading();
    if (mWorker->scene() == mScene) keepBefore();  // else it was there already
}

// What is shown stays what it was.
void Viewer::keepBefore() {
    mAnother = false;
    mSettings.keepBefore();
}

void Viewer::set(const std::string& key, const std::optional<std::string>& text) {
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
        goTo(settings);
    });
    mSettings.look();
}

// Throws Error, and nothing is changed then.
void Viewer::goTo(const SettingTexts& settings) {
    const SettingTexts now = mSettings.now();
    bool again = false;
    std::vector<std::pair<std::string, std::optional<std::string>>> changes;
    const auto note = [&](const std::string& key) {
        const auto a = now.find(key), b = settings.find(key);
        if (a != now.end() && b != settings.end() && a->second == b->second) return;
        const std::optional<std::string> text =
            b == settings.end() || b->second.empty() ? std::nullopt : std::optional(b->second.back());
        if (isOfScreen(key)) return;  // not undone: it is no setting of the picture
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
    if (again) mSession->takeSceneChange();  // the scene that is loaded has it
    mSettings.look();
}

// What was guessed of the scene comes before what helps to begin.
void Viewer::greet(bool first) {
    const auto* const terrain = mScene->scene->offered<const TerrainScene>();
    const std::vector<std::string> notes = terrain ? terrain->report.notes : std::vector<std::string>();
    for (const std::string& note : notes) mNotices.tell(note);
    if (!notes.empty())
        mSession->notify(notes.front());
    else if (first)
        mSession->notify("F1 shows the keys, F2 and F3 the panels");
}

void Viewer::undo() {
    if (!mSession) return;
    if (mKeyframes.canUndo()) return mKeyframes.undo();
    const auto settings = mSettings.undo();
    if (!settings) return mSession->notify("there is nothing to undo");
    mNotices.tryTo([&] { goTo(*settings); });
}

void Viewer::redo() {
    if (!mSession) return;
    if (mKeyframes.canRedo()) return mKeyframes.redo();
    const auto settings = mSettings.redo();
    if (!settings) return mSession->notify("there is nothing to redo");
    mNotices.tryTo([&] { goTo(*settings); });
}

void Viewer::copy(const std::string& text) {
    mWindow.setClipboard(text);
    if (mSession) mSession->notify("copied");
}

void Viewer::saveScene(const std::filesystem::path& file) {
    mNotices.tryTo([&] {
        const std::filesystem::path place = mSettings.save(file);
        mSession->notify("saved " + place.string());
    });
}

// The same settings.
void Viewer::loadAgain() {
    mWorker->reload([options = mSettings.changed(), size = windowSize(), sweep = mSweep.get()](
                        Progress& progress) { return openScene(options, false, size, sweep, progress); });
}

// A coarser scene stands in until what it lacks is there; not while another one is being loaded.
void Viewer::followPreparation() {
    try {
        mPreparation.follow(mScene);
        mPrepared = mPreparation.take() || mPrepared;
    } catch (const Cancelled&) {
        mSession->notify("the ground stays coarse until it is opened again");
    } catch (const std::exception& error) {
        mNotices.fail(error.what());
    }
    if (!mPrepared || mWorker->loading().busy) return;
    mPrepared = false;
    if (mScene->scene->offered<const StandIn>()) loadAgain();
}

// What the session wants that takes longer than a frame.
void Viewer::followWishes() {
    if (const auto change = mSession->takeSceneChange()) {
        mSettings.change(*change);
        if (mScene->scene->offered<SurfaceChoices>() && !change->pieces)
            mWorker->change([options = mSettings.changed(), surface = change->surface](const OpenScene& now,
                                                                                       Progress& progress) {
                return changedScene(now, surface, options, progress);
            });
        else
            loadAgain();
    }
    if (const std::string problem = mWorker->takeReloadProblem(); !problem.empty()) {
        mSession->forgetSceneChange();
        mNotices.fail(problem);
        keepBefore();
    }
    followPreparation();
    takeStudy();
}

void Viewer::takeStudy() {
    // A panel asks with each layout, and not again for what failed; the key V does.
    if (!mSlices.busy() && mSession->takeStudyWish() && (!mStudyFailed || mSession->wantsSliceView())) {
        mStudyFailed = false;
        mSlices.start(mScene, [] { Window::wake(); });
    }
    try {
        auto study = mSlices.take();
        if (!study) return;
        mSession->takeStudyWish();  // asked for again meanwhile
        if (mSession->wantsSliceView())
            mSession->showSlices(std::move(study));
        else
            mSession->keepStudy(std::move(study));
    } catch (const Cancelled&) {
        mStudyFailed = true;
        mSession->dropStudyWish();
        mSession->notify("the slices were not read; V reads them again");
    } catch (const std::exception& error) {
        mStudyFailed = true;
        mSession->dropStudyWish();
        mNotices.fail(error.what());
    }
}

std::shared_ptr<const SliceStudy> Viewer::study() {
    if (!mSession) return nullptr;
    // Not before the first picture, which is what is waited for.
    if (!mSession->study() && !mSlices.busy() && mPictures.frame()) mSession->wishStudy();
    return mSession->study();
}

}  // namespace stereonav
