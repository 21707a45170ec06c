#include "app/options/option_table.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "app/options/command.h"

namespace stereonav {
namespace {

std::vector<Command>& allCommands() {
    static std::vector<Command> all;
    return all;
}

// Returns the option --set, which gives any other option by its key in scene files.
std::vector<Option> setOption() {
    using namespace command;
    return {
        {.key = kSetKey,
         .value = textValue(),
         .help =
             "KEY=VALUE: another option by the key that it has in a scene file; may be given several times",
         .commands = kWithScene,
         .repeated = true,
         .take = [](OptionTargets&, const OptionValue&) {}}};
}

struct Part {
    std::vector<Option> (*options)();
    bool inFile;  // whether scene files may contain them
};
constexpr std::array<Part, 11> kShownParts{{{sourceOptions, true},
                                            {studyOptions, true},
                                            {lookOptions, true},
                                            {paintOptions, true},
                                            {groundPaintOptions, true},
                                            {volumeLookOptions, true},
                                            {qualityOptions, true},
                                            {mediumOptions, true},
                                            {tracedOptions, true},
                                            {viewOptions, true},
                                            {pictureOptions, false}}};
constexpr std::array<Part, 2> kLastParts{{{setOption, false}, {tellingOptions, false}}};

// Returns the bits of the commands that a row names directly or by a trait.
CommandSet commandsWith(CommandSet asked) {
    CommandSet found = 0;
    for (const Command& command : commands())
        if (asked & (command.command | command.traits)) found |= command.command;
    return found;
}

void addPart(const Part& part, CommandSet owner, std::vector<Option>& all) {
    for (Option& option : part.options()) {
        option.inFile = part.inFile && !option.positional() && option.inFile;
        option.commands = option.commands ? commandsWith(option.commands) : owner;
        all.push_back(std::move(option));
    }
}

std::vector<Option> makeTable() {
    std::vector<const Command*> byChapter;
    for (const Command& command : commands())
        if (command.options) byChapter.push_back(&command);
    std::ranges::stable_sort(byChapter, {}, [](const Command* command) { return command->chapter; });
    std::vector<Option> all;
    for (const Part& part : kShownParts) addPart(part, 0, all);
    for (const Command* command : byChapter) addPart({command->options, false}, command->command, all);
    for (const Part& part : kLastParts) addPart(part, 0, all);
    return all;
}

}  // namespace

void setCommands(std::vector<Command> commands) {
    CommandSet own = CommandSet{1} << 32;  // first bit after those of named commands
    for (Command& command : commands)
        if (command.command == 0) command.command = std::exchange(own, own << 1);
    allCommands() = std::move(commands);
}

std::span<const Command> commands() {
    if (allCommands().empty()) throw std::logic_error("the table of options has no commands: setCommands()");
    return allCommands();
}

const Command& commandOf(CommandSet command) {
    return *std::ranges::find(commands(), command, &Command::command);
}

const std::vector<Option>& optionTable() {
    static const std::vector<Option> table = makeTable();
    return table;
}

std::string helpLine(const Option& option) {
    std::string line = option.help;
    if (const std::string expected = option.value.expected(); !expected.empty())
        line += " (" + expected + ")";
    if (*option.fallback) line += std::string("; left out: ") + option.fallback;
    return line;
}

const Option* findOption(CommandSet command, std::string_view key) {
    for (const Option& option : optionTable())
        if ((option.commands & command) && option.key == key) return &option;
    return nullptr;
}

}  // namespace stereonav
