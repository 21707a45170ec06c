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

// "true" or "false" of a flag that stands in a file or behind --set.
bool isTrue(const std::string& text, const std::string& place) {
    if (text == "true" || text == "false") return text == "true";
    throw Error(place, "", "expected true or false, got " + shownText(text), "correct the value");
}

void takeAny(const Option& option, const std::string& text, const std::string& place, ParsedOptions& parsed) {
    if (option.value.kind != ValueKind::Flag || isTrue(text, place)) takeOption(option, text, place, parsed);
}

// Files are relative to the scene file's folder; words are none.
std::string besideFile(const Option& option, const std::string& text, const std::filesystem::path& toml) {
    const std::vector<std::string>& words = option.value.words;
    if (!option.value.isFile() || std::find(words.begin(), words.end(), text) != words.end()) return text;
    const std::filesystem::path beside = toml.parent_path() / text;
    std::error_code code;
    return option.value.kind == ValueKind::File || std::filesystem::exists(beside, code) ? beside.string()
                                                                                         : text;
}

// What the command line says, or rules out, the file does not.
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

// The options of a scene file, and the scene that it names.
void takeSceneFile(ParsedOptions& parsed) {
    const std::filesystem::path toml = parsed.to.scene->scene;
    std::error_code code;
    if (toml.extension() != ".toml" || !std::filesystem::is_regular_file(toml, code)) return;
    const SceneFileOptions read = readSceneFileOptions(toml);
    if (!read.scene.empty()) parsed.to.scene->scene = read.scene;
    const GivenOptions onCommandLine = parsed.given;
    for (const SceneFileOption& said : read.options) {
        const Option* option = findOption(parsed.given.command, said.key);
        // of other commands, or another thing with this one
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
    OptionTargets& to = parsed.to;
    const auto tells = [&to](Telling& telling) {
        to.json = &telling.json;
        to.quiet = &telling.quiet;
    };
    const auto shows = [&](auto& options) {
        to.scene = &options.scene;
        to.size = &options.size;
    };
    to = {};
    parsed.given = {};
    parsed.given.command = which;
    switch (which) {
        case command::kInfo:
            shows(parsed.info);
            to.info = &parsed.info;
            tells(parsed.info.telling);
            parsed.run = [&parsed] { return runInfo(parsed.info); };
            break;
        case command::kRender:
            shows(parsed.render);
            parsed.render.scene.traced.emplace();
            to.render = &parsed.render;
            tells(parsed.render.telling);
            to.method = &parsed.render.method, to.rays = &parsed.render.rays, to.mode = &parsed.render.mode,
            to.out = &parsed.render.out;
            parsed.run = [&parsed] { return runRender(parsed.render); };
            break;
        case command::kPlay:
            shows(parsed.play);
            to.play = &parsed.play;
            tells(parsed.play.telling);
            to.method = &parsed.play.method, to.rays = &parsed.play.rays, to.mode = &parsed.play.mode,
            to.out = &parsed.play.out;
            to.path = &parsed.play.path;
            parsed.run = [&parsed] { return runPlay(parsed.play); };
            break;
        case command::kCompare:
            shows(parsed.compare);
            to.compare = &parsed.compare;
            to.quiet = &parsed.compare.quiet;
            to.path = &parsed.compare.path;
            parsed.run = [&parsed] { return runCompare(parsed.compare); };
            break;
        case command::kReport:
            to.report = &parsed.report;
            tells(parsed.report.telling);
            parsed.run = [&parsed] { return runReport(parsed.report); };
            break;
        case command::kMesh:
            to.scene = &parsed.mesh.scene, to.mesh = &parsed.mesh, to.out = &parsed.mesh.out;
            tells(parsed.mesh.telling);
            parsed.run = [&parsed] { return runMesh(parsed.mesh); };
            break;
        case command::kViewshed:
            to.scene = &parsed.viewshed.scene, to.viewshed = &parsed.viewshed, to.out = &parsed.viewshed.out;
            tells(parsed.viewshed.telling);
            parsed.run = [&parsed] { return runViewshed(parsed.viewshed); };
            break;
        case command::kMeasure:
            to.scene = &parsed.measure.scene, to.measure = &parsed.measure;
            tells(parsed.measure.telling);
            parsed.run = [&parsed] { return runMeasure(parsed.measure); };
            break;
        case command::kProfile:
            to.scene = &parsed.profile.scene, to.profile = &parsed.profile,
            to.path = &parsed.profile.line.path;
            tells(parsed.profile.telling);
            parsed.run = [&parsed] { return runProfile(parsed.profile); };
            break;
        case command::kSun:
            to.scene = &parsed.sun.scene, to.sun = &parsed.sun, to.out = &parsed.sun.out;
            tells(parsed.sun.telling);
            parsed.run = [&parsed] { return runSun(parsed.sun); };
            break;
        case command::kCentreline:
            to.scene = &parsed.centreline.scene, to.out = &parsed.centreline.out;
            tells(parsed.centreline.telling);
            parsed.run = [&parsed] { return runCentreline(parsed.centreline); };
            break;
        case command::kCoverage:
            shows(parsed.coverage);
            to.coverage = &parsed.coverage;
            to.path = &parsed.coverage.path, to.out = &parsed.coverage.out;
            tells(parsed.coverage.telling);
            parsed.run = [&parsed] { return runCoverage(parsed.coverage); };
            break;
        case command::kFindings:
            to.scene = &parsed.findings.scene, to.findings = &parsed.findings;
            tells(parsed.findings.telling);
            parsed.run = [&parsed] { return runFindings(parsed.findings); };
            break;
        case command::kRegister:
            to.scene = &parsed.registration.scene, to.registration = &parsed.registration;
            to.out = &parsed.registration.out;
            tells(parsed.registration.telling);
            parsed.run = [&parsed] { return runRegister(parsed.registration); };
            break;
        case command::kUnfold:
            to.scene = &parsed.unfold.scene, to.unfold = &parsed.unfold, to.out = &parsed.unfold.out;
            tells(parsed.unfold.telling);
            parsed.run = [&parsed] { return runUnfold(parsed.unfold); };
            break;
        case command::kCache:
            to.cache = &parsed.cache;
            tells(parsed.cache.telling);
            parsed.run = [&parsed] { return runCache(parsed.cache); };
            break;
        case command::kBake:
            to.scene = &parsed.bake.scene, to.bake = &parsed.bake;
            tells(parsed.bake.telling);
            parsed.run = [&parsed] { return runBake(parsed.bake); };
            break;
        default:
            shows(parsed.view);
            to.view = &parsed.view;
            tells(parsed.view.telling);
            to.method = &parsed.view.method, to.mode = &parsed.view.mode, to.path = &parsed.view.path;
            parsed.run = [&parsed] { return runView(parsed.view); };
    }
}

void takeOption(const Option& option, const std::string& text, const std::string& place,
                ParsedOptions& parsed) {
    OptionValue value = readValue(place, option.value, option.advice, text);
    if (text.empty() && option.value.takesText())  // which would be taken for none
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
                    std::string("as in --set fov=45; see stereonav ") + factsOf(parsed.given.command).name +
                        " --help");
    if (parsed.given.has(key) && !option->repeated)
        throw Error("--set " + key, "", "is given more than once", kLeaveOneOut);
    takeAny(*option, text.substr(equals + 1), "--set " + key, parsed);
}

void finishOptions(ParsedOptions& parsed) {
    if (parsed.to.report || parsed.to.cache) refuseWhatDoesNotApply(parsed.given, 0, "");
    if (!parsed.to.scene) return;
    // `view` alone is what a desktop's menu starts, with a file or with none.
    parsed.view.startPage = parsed.to.view && parsed.given.empty();
    takeSceneFile(parsed);
    parsed.to.scene->given = parsed.given;
    refuseWhatDoesNotApply(*parsed.to.scene);
}

SceneOptions sceneOptionsOf(const std::string& scene) {
    ParsedOptions parsed;
    chooseCommand(command::kCompare, parsed);
    parsed.compare.scene.scene = scene;
    finishOptions(parsed);
    return std::move(parsed.compare.scene);
}

}  // namespace stereonav
