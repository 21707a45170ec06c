#include "app/options/parsed_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/options/refusals.h"
#include "app/options/scene_file_options.h"
#include "app/options/usual_words.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

// Returns the value of a flag in a scene file or after --set: "true" or "false". Throws Error for other text.
bool isTrue(const std::string& text, const std::string& place) {
    if (text == "true" || text == "false") return text == "true";
    throw Error(place, "", "expected true or false, got " + shownText(text), "correct the value");
}

void takeAny(const Option& option, const std::string& text, const std::string& place, ParsedOptions& parsed) {
    if (option.value.kind != ValueKind::Flag || isTrue(text, place)) takeOption(option, text, place, parsed);
}

// Returns file names relative to the scene file's folder; words are returned unchanged.
std::string besideFile(const Option& option, const std::string& text, const std::filesystem::path& toml) {
    const std::vector<std::string>& words = option.value.words;
    if (!option.value.isFile() || std::find(words.begin(), words.end(), text) != words.end()) return text;
    const std::filesystem::path beside = toml.parent_path() / text;
    std::error_code code;
    return option.value.kind == ValueKind::File || std::filesystem::exists(beside, code) ? beside.string()
                                                                                         : text;
}

// Returns whether the command line gives or excludes this option; the scene file's value is then ignored.
bool isRuledOut(const Option& option, const GivenOptions& given) {
    if (given.has(option.key)) return true;
    const auto excludes = [&](const Option& one, const std::string& other) {
        return std::any_of(one.excludes.begin(), one.excludes.end(),
                           [&](const Exclusion& exclusion) { return other == exclusion.key; });
    };
    return std::any_of(optionTable().begin(), optionTable().end(), [&](const Option& other) {
        return (other.commands & given.command) && given.has(other.key) &&
               (excludes(option, other.key) || excludes(other, option.key));
    });
}

// Reads the options of a scene file, and the scene that it names.
void takeSceneFile(ParsedOptions& parsed) {
    const std::filesystem::path toml = parsed.to.scene->scene;
    std::error_code code;
    if (toml.extension() != ".toml" || !std::filesystem::is_regular_file(toml, code)) return;
    const SceneFileOptions read = readSceneFileOptions(toml);
    if (!read.scene.empty()) parsed.to.scene->scene = read.scene;
    const GivenOptions onCommandLine = parsed.given;
    for (const SceneFileOption& said : read.options) {
        const Option* option = findOption(parsed.given.command, said.key);
        // Options of other commands, and keys that mean another thing with this one, are skipped.
        if (!option || !option->inFile || isRuledOut(*option, onCommandLine)) continue;
        const std::string place = fmt::format("{}:{}: {}", toml.string(), said.line, said.key);
        if (said.texts.size() > 1 && !option->repeated)
            throw Error(place, "", "expected one value, got several", "leave the others out");
        for (const std::string& text : said.texts)
            takeAny(*option, besideFile(*option, text, toml), place, parsed);
    }
}

}  // namespace

void chooseCommand(CommandSet which, ParsedOptions& parsed) {
    parsed.to = {};
    parsed.given = {};
    parsed.given.command = which;
    parsed.run = commandOf(which).start(parsed.to);
}

void takeOption(const Option& option, const std::string& text, const std::string& place,
                ParsedOptions& parsed) {
    OptionValue value = readValue(place, option.value, option.advice, text);
    if (text.empty() && option.value.takesText())  // an empty text would mean "not given"
        throw Error(place, "", "expected a name, got \"\"",
                    option.positional() && *option.fallback
                        ? std::string("leave it out for ") + option.fallback
                        : "give one, or leave it out");
    option.take(parsed.to, value);
    parsed.given.add(option.key, std::move(value), place);
}

void takeSetOption(const std::string& text, ParsedOptions& parsed) {
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string key = text.substr(0, equals);
    const Option* option = findOption(parsed.given.command, key);
    if (equals == text.size() || !option || option->positional() || key == kSetKey)
        throw Error("--set", "", "expected KEY=VALUE with an option's key, got " + shownText(text),
                    std::string("as in --set fov=45; see stereonav ") + commandOf(parsed.given.command).name +
                        " --help");
    if (parsed.given.has(key) && !option->repeated)
        throw Error("--set " + key, "", "is given more than once", kLeaveOneOut);
    takeAny(*option, text.substr(equals + 1), "--set " + key, parsed);
}

void finishOptions(ParsedOptions& parsed) {
    SceneOptions* const scene = parsed.to.scene;
    if (!scene) return refuseWhatDoesNotApply(parsed.given, 0, "");
    takeSceneFile(parsed);
    scene->given = parsed.given;
    refuseWhatDoesNotApply(*scene, parsed.typeOf(*scene));
}

SceneOptions sceneOptionsOf(const std::string& scene, SceneTypeOf typeOf) {
    ParsedOptions parsed(typeOf);
    chooseCommand(command::kCompare, parsed);
    parsed.to.scene->scene = scene;
    finishOptions(parsed);
    return std::move(*parsed.to.scene);
}

}  // namespace stereonav
