// The settings of a shown scene as texts by the options' keys, as the command line has them: what the window
// sets, undoes, saves and tells is this, and what it shows is made from it by the table of options.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/options/option_table.h"
#include "app/options/picture_options.h"
#include "engine/camera/stereo_rig.h"

namespace stereonav {

// By key. Of options that may be given several times all values; of flags one "".
using SettingTexts = std::map<std::string, std::vector<std::string>>;

// Those of `view` that were given: all, or those alone that a scene file says.
SettingTexts settingTextsOf(const GivenOptions& given);
SettingTexts fileTextsOf(const GivenOptions& given);

// What `view` shows with these. Throws Error, in the words of the command line.
ViewOptions viewOptionsOf(const SettingTexts& settings);

// The option of `view`, null where it has none of this key.
const Option* viewOption(const std::string& key);

// What does not go with it (Option::excludes) gives way.
void setText(SettingTexts& settings, const std::string& key, const std::string& text);

// "stereonav view 'my dem.tif' --sun 250,15": words that a shell reads as they were meant.
std::string commandLineOf(const SettingTexts& settings);
// The command line that writes what is shown, seen from there, into a picture: without options that `render`
// has not.
std::string renderLineOf(const SettingTexts& settings, const std::string& pose, const SizeOption& size);
// Where one is and looks, as --pose takes it.
std::string poseText(const Pose& pose);
// With eyes as they are, for a picture: its eyes neither follow a room nor fit themselves to what they see.
SettingTexts withEyes(SettingTexts settings, const StereoSetting& eyes);
// The words of a command, after the program's name, with the settings that are the same options there as of
// `view`.
std::vector<std::string> commandWords(CommandSet command, const SettingTexts& settings);
// The text as one word of a POSIX shell; where it is not printable, in the form $'\x1b' of bash, ksh and zsh.
std::string shellWord(const std::string& text);

// The text of a scene file (docs/formats.md) that shows these settings: `before`, "" for none, with the keys
// under [options] that are not as it says (`said`, fileTextsOf) exchanged or added, and all else, comments
// too, as it was. scene: what the file is to name; "" where it does already, or is a terrain's own. Files are
// named in full. Throws Error where a value that spans lines is to change.
std::string savedScene(const std::string& before, const std::string& scene, const SettingTexts& said,
                       const SettingTexts& settings);

}  // namespace stereonav
