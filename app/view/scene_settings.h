// Settings of the scene that is shown, as options and as texts: those that it was made of, and the present
// ones, which panels show, and which are saved and copied; and undo and redo. While another scene is being
// loaded it has that one's settings, and those before, to return to.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/options/view_options.h"
#include "app/view/offered_settings.h"
#include "app/view/session.h"
#include "app/view/setting_texts.h"
#include "app/view/settings_history.h"

namespace stereonav {

struct SceneMade {
    ViewOptions options;
    SettingTexts given, said;  // texts given to the window, and those in the scene file
};

class SceneSettings {
public:
    // session: its live values are included; none until the first scene is there. It must outlive this
    // object.
    SceneSettings(const ViewOptions& options, std::optional<ViewSession>& session);

    const SceneMade& made() const { return mMade; }
    const ViewOptions& options() const { return mMade.options; }
    // Returns the options with the session's changes.
    const ViewOptions& changed() const { return mChanged; }
    const SettingTexts& given() const { return mMade.given; }
    // Returns the scene file's name without its folder, or the built-in scene's.
    std::string sceneName() const;
    // Returns the full path, so that it is found from anywhere; built-in scenes by their names.
    std::filesystem::path fullName() const;

    // Returns given and live settings. Valid until something is set.
    const SettingTexts& now() const;
    // Notes that something may have been set.
    void look() { mNow.reset(); }
    // Returns whether the option applies to the scene, and would not be refused beside the present settings.
    bool applies(const Option& option) const;
    // Returns what of the option the scene takes.
    SettingRow row(const Option& option) const;
    // Forgets which options apply, since another scene is shown.
    void lookAtScene();

    // Begins with the settings of another scene that is being loaded.
    void begin(SceneMade next);
    // Begins with the settings of another scene that is being loaded, where those before differ from the ones
    // given.
    void begin(SceneMade next, SceneMade before);
    // Notes that the other scene is there.
    void arrived() { mBefore.reset(); }
    bool begun() const { return mBefore.has_value(); }
    // Returns to the settings before: the other scene is not wanted, or can not be loaded.
    void keepBefore();

    // Adds a change of the session to a scene that shows the same in another way.
    void change(const SceneChange& change);
    // Removes an option that is no longer given.
    void forgetGiven(const std::string& key) { mMade.given.erase(key); }
    // Forgets the screen's width or distance that was given.
    void forgetScreen(const std::string& key, std::optional<double> ViewOptions::*size);

    SettingsHistory& history() { return mHistory; }
    const SettingsHistory& history() const { return mHistory; }

    // Writes a scene file that shows the present scene (savedScene()), and returns its path. Throws Error,
    // also where another file is there.
    std::filesystem::path save(const std::filesystem::path& file) const;

private:
    const Scene* shownScene() const;  // null before the first

    std::optional<ViewSession>& mSession;
    SceneMade mMade;
    ViewOptions mChanged;
    std::optional<SceneMade> mBefore;  // set while another one is being loaded
    SettingsHistory mHistory;
    // Present settings, used by every control in every layout: made once per turn, or once per scene.
    mutable std::optional<SettingTexts> mNow;
    mutable std::map<const Option*, bool> mApplies;
};

}  // namespace stereonav
