#include "app/view/setting_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "app/options/parsed_options.h"
#include "app/scene/shown_as.h"
#include "engine/text/printable.h"
#include "engine/text/utf8.h"

namespace stereonav {
namespace {

constexpr const char* kScene = "SCENE";

std::string lineOf(const std::vector<std::string>& words) {
    std::string line = "stereonav";
    for (const std::string& word : words) line += " " + shellWord(word);
    return line;
}

// Returns whether the option is for this run only, and no setting.
bool isOfTheRun(std::string_view key) {
    return key == "json" || key == "quiet" || key == "bench";
}

SettingTexts textsOf(const GivenOptions& given, bool ofFile) {
    SettingTexts settings;
    for (const Option& option : optionTable()) {
        if (!(option.commands & command::kView) || settings.contains(option.key)) continue;
        if (isOfTheRun(option.key)) continue;
        const GivenOptions::Given* const found = given.find(option.key);
        const auto typed = [&] {
            return found->place == option.name() || found->place.starts_with("--set ");
        };
        if (!found || (ofFile && typed())) continue;
        for (const OptionValue& value : found->values)
            settings[option.key].push_back(option.value.kind == ValueKind::Flag ? "" : value.text);
    }
    return settings;
}

// Returns the word in bash's own form, which is plain text for any name: pasted control characters would act
// on the terminal.
std::string escapedShellWord(std::string_view text) {
    std::string word = "$'";
    for (std::size_t at = 0; at < text.size();) {
        const std::string_view bytes = text.substr(at, letterAt(text, at).bytes);
        at += bytes.size();
        word += bytes == "'" || bytes == "\\" ? "\\" + std::string(bytes) : printable(bytes);
    }
    return word + "'";
}

}  // namespace

SettingTexts settingTextsOf(const GivenOptions& given) {
    return textsOf(given, false);
}

SettingTexts fileTextsOf(const GivenOptions& given) {
    return textsOf(given, true);
}

const Option* viewOption(const std::string& key) {
    return findOption(command::kView, key);
}

ViewOptions viewOptionsOf(const SettingTexts& settings) {
    ParsedOptions parsed(sceneTypeOf);
    chooseCommand(command::kView, parsed);
    for (const auto& [key, texts] : settings)
        if (const Option* const option = viewOption(key))
            for (const std::string& text : texts) takeOption(*option, text, option->name(), parsed);
    finishOptions(parsed);
    return parsed.to.of<ViewOptions>();
}

void setText(SettingTexts& settings, const std::string& key, const std::string& text) {
    const auto excludes = [](const std::string& one, const std::string& other) {
        const Option* const option = viewOption(one);
        return option && std::any_of(option->excludes.begin(), option->excludes.end(),
                                     [&](const Exclusion& exclusion) { return other == exclusion.key; });
    };
    std::erase_if(settings, [&](const auto& said) {
        return said.first != key && (excludes(key, said.first) || excludes(said.first, key));
    });
    settings[key] = {text};
}

std::string shellWord(const std::string& text) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) ||
               std::string_view("-_./:,+=@%").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
    if (printable(text, text.npos) != text) return escapedShellWord(text);
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

std::vector<std::string> commandWords(CommandSet command, const SettingTexts& settings) {
    std::vector<std::string> words{commandOf(command).name};
    if (const auto scene = settings.find(kScene); scene != settings.end() && !scene->second.empty())
        words.push_back(scene->second.back());
    for (const auto& [key, texts] : settings) {
        const Option* const option = findOption(command, key);
        if (!option || option->positional()) continue;
        // Some keys mean another thing with another command.
        const Option* const shown = viewOption(key);
        if (shown && shown != option && shown->scenes != option->scenes) continue;
        for (const std::string& text : texts) {
            // Written as one word, so that a value that begins with a dash is not taken for an option.
            words.push_back(option->value.kind == ValueKind::Flag ? option->name()
                                                                  : option->name() + "=" + text);
        }
    }
    return words;
}

std::string poseText(const Pose& pose) {
    const PoseAngles angles = anglesOf(pose);
    constexpr double kDegrees = 180 / std::numbers::pi;
    return fmt::format("{:.6g},{:.6g},{:.6g},{:.5g},{:.5g},{:.5g}", pose.position.x, pose.position.y,
                       pose.position.z, kDegrees * angles.heading, kDegrees * angles.pitch,
                       kDegrees * angles.roll);
}

SettingTexts withEyes(SettingTexts settings, const StereoSetting& eyes, bool one) {
    settings["separation"] = {fmt::format("{:.6g}", one ? 0.0 : eyes.separation)};
    if (one) settings["mode"] = {std::string(infoOf(OutputMode::Left).shortName)};
    settings["zero-parallax"] = {fmt::format("{:.6g}", eyes.zeroParallax)};
    return settings;
}

std::string commandLineOf(const SettingTexts& settings) {
    return lineOf(commandWords(command::kView, settings));
}

std::string renderLineOf(const SettingTexts& settings, const std::string& pose, const SizeOption& size) {
    SettingTexts shown = settings;
    shown["size"] = {fmt::format("{}x{}", size.width, size.height)};
    return lineOf(commandWords(command::kRender, shown)) + " --pose=" + pose + " --out view.png";
}

}  // namespace stereonav
