// Settings of a scene as texts by the options' keys, in the form of the command line. The window sets,
// undoes, saves and copies them, and makes the scene from them by the table of options.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/options/option_table.h"
#include "app/options/view_options.h"
#include "engine/camera/stereo_rig.h"

namespace stereonav {

// Texts by key: all values of options that can be repeated; one "" for flags.
using SettingTexts = std::map<std::string, std::vector<std::string>>;

// Return the options of `view` that were given: all, or only those in a scene file.
SettingTexts settingTextsOf(const GivenOptions& given);
SettingTexts fileTextsOf(const GivenOptions& given);

// Returns the options of `view` for these settings. Throws Error, in the words of the command line.
ViewOptions viewOptionsOf(const SettingTexts& settings);

// Returns the option of `view`; null where it has none of this key.
const Option* viewOption(const std::string& key);

// Sets an option; others that conflict with it (Option::excludes) are removed.
void setText(SettingTexts& settings, const std::string& key, const std::string& text);

// Returns "stereonav view 'my dem.tif' --sun 250,15": words that a shell reads unchanged.
std::string commandLineOf(const SettingTexts& settings);
// Returns the command line that makes a picture of the scene from this pose, without options that `render`
// does not have.
std::string renderLineOf(const SettingTexts& settings, const std::string& pose, const SizeOption& size);
// Returns a pose in the form of --pose.
std::string poseText(const Pose& pose);
// Returns the settings with these eyes, for a picture, whose eyes then neither follow the room nor fit
// themselves to it. one: one eye is shown, in the middle of the head.
SettingTexts withEyes(SettingTexts settings, const StereoSetting& eyes, bool one = false);
// Returns the arguments of a command, with those settings that it shares with `view`.
std::vector<std::string> commandWords(CommandSet command, const SettingTexts& settings);
// Returns the text as one word of a POSIX shell; where it is not printable, in the form $'\x1b' of bash, ksh
// and zsh.
std::string shellWord(const std::string& text);

// Returns the text of a scene file (docs/formats.md) that shows these settings: `before`, "" for none, where
// keys under [options] that differ from `said` (fileTextsOf) are replaced or added, and everything else,
// comments included, is kept. scene: the scene to name; "" where it is named already, or is a terrain's own.
// Files are written with full paths. Throws Error where a value over several lines would have to change.
std::string savedScene(const std::string& before, const std::string& scene, const SettingTexts& said,
                       const SettingTexts& settings);

}  // namespace stereonav
