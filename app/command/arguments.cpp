// The command line, read with CLI11: a subcommand for each command, with the options of the table.
#include "app/command/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "app/command/commands.h"
#include "app/options/built_without.h"
#include "app/options/number_text.h"
#include "app/options/pages.h"
#include "app/options/parsed_options.h"
#include "app/scene/scene_type_table.h"
#include "app/scene/shown_as.h"
#include "engine/base/error.h"
#include "engine/text/printed.h"
#include "engine/text/similar.h"

namespace stereonav {
namespace {

const char* nameOfValue(const Option& option) {
    if (!option.value.takesNumbers()) return "TEXT";
    const ValueKind kind = option.value.kind;
    return kind == ValueKind::Numbers || kind == ValueKind::Size ? kNumbersValue : kNumberValue;
}

void addOption(CLI::App& subcommand, const Option& option, CommandSet which, ParsedOptions& parsed) {
    // Options are read once the subcommand is known.
    const auto chosen = [&parsed, which] {
        if (parsed.given.command != which) chooseCommand(which, parsed);
    };
    CLI::Option* added = nullptr;
    if (option.value.kind == ValueKind::Flag) {
        added = subcommand.add_flag_callback(
            option.name(),
            [&option, &parsed, chosen] { chosen(), takeOption(option, "", option.name(), parsed); },
            option.help);
    } else {
        const auto takeAll = [&option, &parsed, chosen](const CLI::results_t& texts) {
            chosen();
            for (const std::string& text : texts)
                option.key == std::string_view(kSetKey) ? takeSetOption(text, parsed)
                                                        : takeOption(option, text, option.name(), parsed);
            return true;
        };
        added =
            subcommand.add_option(option.name(), takeAll, helpLine(option))->type_name(nameOfValue(option));
        // The word after the value is the scene, not another value.
        if (option.repeated)
            added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->allow_extra_args(false);
        added->required(option.required);
    }
    if (*option.group) added->group(option.group);
}

void addCommand(CLI::App& app, const Command& facts, ParsedOptions& parsed) {
    CLI::App& subcommand = *app.add_subcommand(facts.name, facts.help);
    for (const Option& option : optionTable())
        if (option.commands & facts.command) addOption(subcommand, option, facts.command, parsed);
    subcommand.callback([&parsed, which = facts.command] {
        if (parsed.given.command != which) chooseCommand(which, parsed);
    });
}

// Returns the name of the subcommand that was being parsed, with a blank before it; "" where there is none.
std::string commandIn(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? "" : " " + chosen.front()->get_name();
}

// Returns the page that was asked for without the word that has to follow it; null: none.
const PageFacts* pageIn(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    if (chosen.empty() || !chosen.front()->get_subcommands().empty()) return nullptr;
    for (const PageFacts& page : pageFacts())
        if (*page.of && chosen.front()->get_name() == page.name) return &page;
    return nullptr;
}

// Returns the option that a misspelled word may mean; "" where none is similar.
std::string similarOption(const CLI::App& app, const std::string& word) {
    const auto chosen = app.get_subcommands();
    if (chosen.empty() || !word.starts_with("--")) return "";
    const std::string name = word.substr(0, word.find('='));
    std::vector<std::string> names;
    for (const CLI::Option* option : chosen.front()->get_options())
        if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
    const std::string nearest = nearestWord(name, names);
    // More edits would make it a guess.
    const int mostEdits = std::min(static_cast<int>(name.size() - 2) / 3, 2);
    return editDistance(name, nearest) <= mostEdits ? nearest : "";
}

// Returns advice for a word that is no command: the command that it may mean, or the one that opens it.
std::string adviceForCommand(const CLI::App& app, const std::string& word) {
    const std::string help = "see stereonav --help";
    std::error_code code;
    if (!word.empty() && (isBuiltIn(word) || std::filesystem::exists(word, code)))
        return "did you mean stereonav view " + shownText(word) + "? " + help;
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    const std::string nearest = nearestWord(word, names);
    const int mostEdits = std::min(static_cast<int>(word.size()) / 3, 2);  // more would make it a guess
    return editDistance(word, nearest) <= mostEdits ? "did you mean " + nearest + "? " + help : help;
}

// Turns CLI11's refusal into our form: which option or word, what is wrong with it, what to do.
Error refusalOf(const CLI::App& app, const CLI::ParseError& error) {
    const std::string help = "see stereonav" + commandIn(app) + " --help";
    const std::string said = error.what();
    const std::string option = said.substr(0, said.find(':'));
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> left = app.remaining(true);
        const std::string word = left.empty() ? said : left.front();
        const bool dashes = word.starts_with("-");
        const std::string meant = dashes ? similarOption(app, word) : "";
        if (!dashes && commandIn(app).empty())
            return {word, "", "there is no such command", adviceForCommand(app, word)};
        return {word, "", dashes ? "there is no such option here" : "is one word too many",
                meant.empty() ? help : "did you mean " + meant + "? " + help};
    }
    if (const PageFacts* page = pageIn(app)) {
        const std::vector<std::string> left = app.remaining(true);
        return {page->name, "",
                fmt::format("expected {}, {}", page->of,
                            left.empty() ? "found nothing" : "got " + shownText(left.front())),
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

int print(const std::string& text) {
    printLines(stdout, text);
    return 0;
}

// Adds the commands that print pages about the others.
void addPages(CLI::App& app, ParsedOptions& parsed) {
    for (const PageFacts& page : pageFacts()) {
        CLI::App* subcommand = app.add_subcommand(page.name, page.help);
        if (*page.of) {
            subcommand->require_subcommand(1);
            subcommand = subcommand->add_subcommand(page.of, std::string("of ") + page.of);
        }
        subcommand->callback([&parsed, &page] { parsed.run = [&page] { return print(page.text()); }; });
    }
}

void addCommands(CLI::App& app, ParsedOptions& parsed) {
    for (const Command& facts : commands()) addCommand(app, facts, parsed);
    addPages(app, parsed);
}

// Turns `view --json` into `--json=-`. For the window alone a file name may follow, which is any word that is
// neither a scene nor an option; with --bench any word that is no option.
void nameJsonFile(std::vector<std::string>& words) {
    if (words.empty() || words.front() != "view") return;
    const bool bench = std::find(words.begin(), words.end(), "--bench") != words.end();
    const auto isFile = [&](const std::string& word) {
        if (word == "-" || word.ends_with(".json")) return true;
        if (word.empty() || word.starts_with("-")) return false;
        std::error_code code;
        return bench || !(isBuiltIn(word) || std::filesystem::exists(word, code));
    };
    for (std::size_t n = 1; n < words.size(); ++n) {
        if (words[n] != "--json") continue;
        const bool named = n + 1 < words.size() && isFile(words[n + 1]);
        words[n] += "=" + (named ? words[n + 1] : "-");
        if (named) words.erase(words.begin() + static_cast<std::ptrdiff_t>(n) + 1);
    }
}

// Turns `help COMMAND` into `COMMAND --help`.
void turnHelp(std::vector<std::string>& words) {
    if (words.empty() || words.front() != "help") return;
    words.erase(words.begin());
    words.emplace_back("--help");
}

// Throws Error for an unknown command before --help, which would otherwise print the help of the whole
// program.
void checkIsCommand(const CLI::App& app, const std::vector<std::string>& words) {
    const auto word =
        std::find_if(words.begin(), words.end(), [](const auto& w) { return !w.starts_with("-"); });
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    const auto isNamed = [&](const CLI::App* command) { return command->get_name() == *word; };
    if (word == words.end() || std::any_of(commands.begin(), commands.end(), isNamed)) return;
    throw Error(word->empty() ? "\"\"" : *word, "", "there is no such command", adviceForCommand(app, *word));
}

void parse(CLI::App& app, std::vector<std::string> words) {
    nameJsonFile(words);
    std::reverse(words.begin(), words.end());  // the order that CLI11 expects
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
        "stereonav help COMMAND explains one of them. Without a command: a flight over the built-in terrain, "
        "in a window or, without a display, into out/.");
    ParsedOptions parsed(sceneTypeOf);
    addCommands(app, parsed);
    try {
        std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
        turnHelp(words);
        checkIsCommand(app, words);
        nameJsonFile(words);
        std::reverse(words.begin(), words.end());  // the order that CLI11 expects
        app.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // for --help and --version
        throw refusalOf(app, error);
    }
    finishOptions(parsed);
    return parsed.run ? parsed.run() : runDefault();
}

void checkCommandLine(const std::vector<std::string>& arguments) {
    CLI::App app;
    ParsedOptions parsed(sceneTypeOf);
    addCommands(app, parsed);
    parse(app, arguments);
}

void checkWholeCommandLine(const std::vector<std::string>& arguments) {
    CLI::App app;
    ParsedOptions parsed(sceneTypeOf);
    addCommands(app, parsed);
    parse(app, arguments);
    finishOptions(parsed);
}

std::vector<OptionFacts> optionsOfCommands() {
    std::vector<OptionFacts> facts;
    for (const Command& command : commands())
        for (const Option& option : optionTable())
            if ((option.commands & command.command) && option.value.kind != ValueKind::Flag)
                facts.push_back({command.name, option.name(), option.value.takesNumbers()});
    return facts;
}

RenderOptions renderOptionsFrom(const std::vector<std::string>& arguments) {
    CLI::App app;
    ParsedOptions parsed(sceneTypeOf);
    addCommands(app, parsed);
    std::vector<std::string> words{"render"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    parse(app, std::move(words));
    finishOptions(parsed);
    return parsed.to.of<RenderOptions>();
}

}  // namespace stereonav
