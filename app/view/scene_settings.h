// What the scene that is shown was made of, as options and as texts, and what is set now: the values that
// panels show, that are saved and copied, and the steps back and forth. While another scene is loaded it has
// that one's settings, and those of before, to return to.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/options/picture_options.h"
#include "app/view/session.h"
#include "app/view/setting_texts.h"
#include "app/view/settings_history.h"

namespace stereonav {

struct SceneMade {
    ViewOptions options;
    SettingTexts given, said;  // given to the window, and what the scene file says
};

class SceneSettings {
public:
    // session: whose live values count; none until the first scene is there. Outlives this.
    SceneSettings(const ViewOptions& options, std::optional<ViewSession>& session);

    const SceneMade& made() const { return mMade; }
    const ViewOptions& options() const { return mMade.options; }
    // Those with what the session changed in place since.
    const ViewOptions& changed() const { return mChanged; }
    const SettingTexts& given() const { return mMade.given; }
    // The scene file's name without its folder, or the built-in scene's.
    std::string sceneName() const;
    // In full, so that it is found from anywhere; built-in scenes by their names.
    std::filesystem::path fullName() const;

    // Given and live. Valid until something is set.
    const SettingTexts& now() const;
    // Something may have been set since.
    void look() { mNow.reset(); }
    // Whether the option goes with what is shown, and would not be refused beside what is set.
    bool applies(const Option& option) const;
    // Another scene is shown: what was found out of the last one holds no longer.
    void lookAtScene();

    // Another scene is being loaded: its settings count from now on.
    void begin(SceneMade next);
    // The same, where those of before are not as they were given.
    void begin(SceneMade next, SceneMade before);
    // It is there.
    void arrived() { mBefore.reset(); }
    bool begun() const { return mBefore.has_value(); }
    // It is not wanted, or can not be had: what is shown stays what it was.
    void keepBefore();

    // The session asks for a scene that shows the same otherwise.
    void change(const SceneChange& change);
    // It is no longer given.
    void forgetGiven(const std::string& key) { mMade.given.erase(key); }
    // The screen's width or distance is no longer as it was given.
    void forgetScreen(const std::string& key, std::optional<double> ViewOptions::*size);

    // Steps back and forth begin with what is set now.
    void startSteps() { mHistory.start(now()); }
    // Each turn. changing: a control is held; dt: seconds.
    void observe(bool changing, double dt) { mHistory.observe(now(), changing, dt); }
    bool canUndo() const { return mHistory.canUndo(); }
    bool canRedo() const { return mHistory.canRedo(); }
    // What is to be set; none: there is no step.
    std::optional<SettingTexts> undo() { return mHistory.undo(); }
    std::optional<SettingTexts> redo() { return mHistory.redo(); }

    // Writes a scene file that shows this (savedScene()), and returns its place. Throws Error, also where
    // another file is there.
    std::filesystem::path save(const std::filesystem::path& file) const;

private:
    bool wouldApply(const Option& option) const;

    std::optional<ViewSession>& mSession;
    SceneMade mMade;
    ViewOptions mChanged;
    std::optional<SceneMade> mBefore;  // while another one is loaded
    SettingsHistory mHistory;
    // Asked for by every control of every layout: made once a turn, or once a scene.
    mutable std::optional<SettingTexts> mNow;
    mutable std::map<const Option*, bool> mApplies;
};

}  // namespace stereonav
