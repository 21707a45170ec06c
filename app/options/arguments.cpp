// The command line, through CLI11: one subcommand for each function of commands.h, its options those of the
// table.
#include "app/options/arguments.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <utility>

#include "app/command/commands.h"
#include "app/options/built_without.h"
#include "app/options/option_table.h"
#include "app/options/refusals.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

// What the subcommands fill, and which of them runs.
struct Parsed {
    InfoOptions info;
    RenderOptions render;
    PlayOptions play;
    CompareOptions compare;
    ReportOptions report;
    MeshOptions mesh;
    CentrelineOptions centreline;
    BakeOptions bake;
    ViewOptions view;
    GivenOptions given;
    OptionTargets to;
    std::function<int()> run = runDefault;
};

// Makes the command's structure the one that its options go to.
void choose(CommandSet which, Parsed& parsed) {
    OptionTargets& to = parsed.to;
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
            parsed.run = [&parsed] { return runInfo(parsed.info); };
            break;
        case command::kRender:
            shows(parsed.render);
            parsed.render.scene.traced.emplace();
            to.render = &parsed.render;
            to.method = &parsed.render.method, to.mode = &parsed.render.mode, to.out = &parsed.render.out;
            parsed.run = [&parsed] { return runRender(parsed.render); };
            break;
        case command::kPlay:
            shows(parsed.play);
            to.play = &parsed.play;
            to.method = &parsed.play.method, to.mode = &parsed.play.mode, to.out = &parsed.play.out;
            to.path = &parsed.play.path;
            parsed.run = [&parsed] { return runPlay(parsed.play); };
            break;
        case command::kCompare:
            shows(parsed.compare);
            to.compare = &parsed.compare;
            to.path = &parsed.compare.path;
            parsed.run = [&parsed] { return runCompare(parsed.compare); };
            break;
        case command::kReport:
            to.report = &parsed.report;
            parsed.run = [&parsed] { return runReport(parsed.report); };
            break;
        case command::kMesh:
            to.scene = &parsed.mesh.scene, to.mesh = &parsed.mesh, to.out = &parsed.mesh.out;
            parsed.run = [&parsed] { return runMesh(parsed.mesh); };
            break;
        case command::kCentreline:
            to.scene = &parsed.centreline.scene, to.out = &parsed.centreline.out;
            parsed.run = [&parsed] { return runCentreline(parsed.centreline); };
            break;
        case command::kBake:
            to.scene = &parsed.bake.scene, to.bake = &parsed.bake;
            parsed.run = [&parsed] { return runBake(parsed.bake); };
            break;
        default:
            shows(parsed.view);
            to.view = &parsed.view;
            to.method = &parsed.view.method, to.mode = &parsed.view.mode, to.path = &parsed.view.path;
            parsed.run = [&parsed] { return runView(parsed.view); };
    }
}

void take(const Option& option, const std::string& text, Parsed& parsed) {
    OptionValue value = readValue(option.name(), option.value, option.advice, text);
    option.take(parsed.to, value);
    parsed.given.add(option.key, std::move(value), option.name());
}

// What help says behind the option's words.
std::string helpOf(const Option& option) {
    const ValueKind kind = option.value.kind;
    if (!option.value.takesNumbers()) return option.help;
    const std::string expected = kind == ValueKind::Size       ? "each " + rangeText(option.value.range)
                                 : kind == ValueKind::Fraction ? rangeText(option.value.range)
                                                               : option.value.expected();
    return option.help + " (" + expected + ")";
}

const char* nameOfValue(const Option& option) {
    if (!option.value.takesNumbers()) return "TEXT";
    const ValueKind kind = option.value.kind;
    return kind == ValueKind::Numbers || kind == ValueKind::Size ? kNumbersValue : kNumberValue;
}

void addOption(CLI::App& subcommand, const Option& option, CommandSet which, Parsed& parsed) {
    // Options are read after the subcommand is known.
    const auto chosen = [&parsed, which] {
        if (parsed.given.command != which) choose(which, parsed);
    };
    CLI::Option* added = nullptr;
    if (option.value.kind == ValueKind::Flag) {
        added = subcommand.add_flag_callback(
            option.name(), [&option, &parsed, chosen] { chosen(), take(option, "", parsed); }, option.help);
    } else {
        const auto takeAll = [&option, &parsed, chosen](const CLI::results_t& texts) {
            chosen();
            for (const std::string& text : texts) take(option, text, parsed);
            return true;
        };
        added = subcommand.add_option(option.name(), takeAll, helpOf(option))->type_name(nameOfValue(option));
        // the word behind it is the scene's, not another value
        if (option.repeated)
            added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->allow_extra_args(false);
        added->required(option.required);
    }
    if (*option.group) added->group(option.group);
}

void addCommand(CLI::App& app, const CommandFacts& facts, Parsed& parsed) {
    CLI::App& subcommand = *app.add_subcommand(facts.name, facts.help);
    for (const Option& option : optionTable())
        if (option.commands & facts.command) addOption(subcommand, option, facts.command, parsed);
    subcommand.callback([&parsed, which = facts.command] {
        if (parsed.given.command != which) choose(which, parsed);
    });
}

// The name of the subcommand that was being parsed, with a blank before it; "" when none.
std::string commandIn(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? "" : " " + chosen.front()->get_name();
}

// CLI11's refusals in our words: which option or word, what is wrong with it, what to do.
Error refusalOf(const CLI::App& app, const CLI::ParseError& error) {
    const std::string help = "see stereonav" + commandIn(app) + " --help";
    const std::string said = error.what();
    const std::string option = said.substr(0, said.find(':'));
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> left = app.remaining(true);
        const std::string word = left.empty() ? said : left.front();
        const bool dashes = word.starts_with("-");
        return {word, "",
                dashes                   ? "there is no such option here"
                : commandIn(app).empty() ? "there is no such command"
                                         : "is one word too many",
                help};
    }
    if (dynamic_cast<const CLI::RequiredError*>(&error))
        return {said.substr(0, said.find(' ')), "", "is required", help};
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && said.starts_with("--"))
        return {option, "",
                said.find("At Most") != std::string::npos ? "is given more than once"
                                                          : "expected a value, found none",
                help};
    return {"", "", said, help};
}

void addCommands(CLI::App& app, Parsed& parsed) {
    for (const CommandFacts& facts : commandFacts()) addCommand(app, facts, parsed);
}

// Lets what was given go with its options, and refuses what does not apply.
void finish(Parsed& parsed) {
    if (parsed.to.report) refuseWhatDoesNotApply(parsed.given, 0, "");
    if (!parsed.to.scene) return;
    parsed.to.scene->given = parsed.given;
    refuseWhatDoesNotApply(*parsed.to.scene);
}

void parse(CLI::App& app, std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    try {
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        throw refusalOf(app, error);
    }
}

}  // namespace

int runCommandLine(int argc, char** argv) {
    CLI::App app{"Stereo flight through terrain and the colon, with the second eye warped and measured",
                 "stereonav"};
    app.set_version_flag("--version", versionText());
    app.require_subcommand(0, 1);
    app.footer(
        "Without a command: flies the built-in terrain, or, where there is no display, plays it to out/.");
    Parsed parsed;
    addCommands(app, parsed);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        throw refusalOf(app, error);
    }
    finish(parsed);
    return parsed.run();
}

void checkCommandLine(const std::vector<std::string>& arguments) {
    CLI::App app;
    Parsed parsed;
    addCommands(app, parsed);
    parse(app, arguments);
    finish(parsed);
}

std::vector<OptionFacts> optionsOfCommands() {
    std::vector<OptionFacts> facts;
    for (const CommandFacts& command : commandFacts())
        for (const Option& option : optionTable())
            if ((option.commands & command.command) && option.value.kind != ValueKind::Flag)
                facts.push_back({command.name, option.name(), option.value.takesNumbers()});
    return facts;
}

RenderOptions renderOptionsFrom(const std::vector<std::string>& arguments) {
    CLI::App app;
    Parsed parsed;
    addCommands(app, parsed);
    std::vector<std::string> words{"render"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    parse(app, std::move(words));
    finish(parsed);
    return parsed.render;
}

}  // namespace stereonav
