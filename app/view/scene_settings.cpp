#include "app/view/scene_settings.h"

#include <system_error>
#include <utility>

#include "app/scene/scene_type_table.h"
#include "app/view/live_settings.h"
#include "app/view/loading.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {

SceneSettings::SceneSettings(const ViewOptions& options, std::optional<ViewSession>& session)
    : mSession(session),
      mMade{options, settingTextsOf(options.scene.given), fileTextsOf(options.scene.given)},
      mChanged(options) {}

std::string SceneSettings::sceneName() const {
    const std::string& scene = options().scene.scene;
    if (scene.empty()) return "terrain";
    const std::string name = std::filesystem::path(scene).filename().string();
    return name.empty() ? scene : name;
}

// A folder with the name of a built-in scene is not that scene.
std::filesystem::path SceneSettings::fullName() const {
    const std::string& scene = options().scene.scene;
    if (scene.empty()) return "terrain";
    std::error_code code;
    if (isBuiltIn(scene) || !std::filesystem::exists(scene, code)) return scene;
    return std::filesystem::absolute(scene, code).lexically_normal();
}

const SettingTexts& SceneSettings::now() const {
    if (!mNow) mNow = mSession ? withLive(*mSession, mMade.given) : mMade.given;
    return *mNow;
}

bool SceneSettings::applies(const Option& option) const {
    const auto [known, fresh] = mApplies.try_emplace(&option, false);
    if (fresh) known->second = isOffered(shownScene(), mChanged, option);
    return known->second;
}

const Scene* SceneSettings::shownScene() const {
    return mSession ? mSession->open().scene.get() : nullptr;
}

SettingRow SceneSettings::row(const Option& option) const {
    return rowOf(shownScene(), mChanged, option);
}

void SceneSettings::lookAtScene() {
    mNow.reset();
    mApplies.clear();
}

void SceneSettings::begin(SceneMade next) {
    begin(std::move(next), mBefore ? *std::exchange(mBefore, std::nullopt) : mMade);
}

void SceneSettings::begin(SceneMade next, SceneMade before) {
    mBefore = std::move(before);
    mMade = std::move(next);
    mChanged = mMade.options;
    lookAtScene();
}

void SceneSettings::keepBefore() {
    if (!mBefore) return;
    mMade = *std::exchange(mBefore, std::nullopt);
    mChanged = mMade.options;
    lookAtScene();
    if (mSession) mHistory.backTo(now());
}

void SceneSettings::change(const SceneChange& change) {
    applyChange(change, options().scene, mChanged.scene);
    mApplies.clear();
}

void SceneSettings::forgetScreen(const std::string& key, std::optional<double> ViewOptions::*size) {
    for (ViewOptions* options : {&mMade.options, &mChanged}) {
        (options->*size).reset();
        options->scene.given.forget(key);
    }
    mMade.given.erase(key);
}

std::filesystem::path SceneSettings::save(const std::filesystem::path& file) const {
    std::filesystem::path place = file;
    if (place.extension() != ".toml") place += ".toml";
    SettingTexts settings = now();
    const auto scene = settings.find("SCENE");
    const std::string name = scene == settings.end() ? "" : scene->second.back();
    std::error_code code;
    const bool isToml = std::filesystem::path(name).extension() == ".toml";
    const bool there = std::filesystem::exists(place, code);
    const bool same = isToml && there && std::filesystem::equivalent(name, place, code);
    if (there && !same)
        throw Error(place.string(), "", "there is a file already", "choose another name, or delete it");
    // A copy of a scene file has to lie beside it: the files that it names are relative to it.
    if (isToml && !same &&
        std::filesystem::absolute(name).parent_path() != std::filesystem::absolute(place).parent_path())
        throw Error(place.string(), "", "a copy of a scene file must lie beside it",
                    "choose a name in " + std::filesystem::absolute(name).parent_path().string());
    const std::string before = isToml ? readTextFile(name) : "";
    std::string named = isToml ? "" : name.empty() ? "terrain" : name;
    if (!named.empty() && std::filesystem::exists(named, code))
        named = std::filesystem::absolute(named).lexically_normal().string();
    settings.erase("SCENE");
    const std::string text = savedScene(before, named, isToml ? mMade.said : SettingTexts(), settings);
    // The scene file has been read and may be overwritten; other files that were read may not.
    writeTextFile(place, text, Flush::ToDisk, same ? Over::Anything : Over::NothingRead);
    return place;
}

}  // namespace stereonav
