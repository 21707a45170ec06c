#include "app/options/option_table.h"

#include <algorithm>
#include <array>
#include <bit>
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
    return {{.key = kSetKey,
             .value = textValue(),
             .help = "KEY=VALUE: another option, by its key in a scene file; may be given several times",
             .commands = kWithScene,
             .repeated = true,
             .inFile = false,
             .take = [](OptionTargets&, const OptionValue&) {}}};
}

constexpr std::array kSharedParts{sourceOptions, studyOptions,       isosurfaceOptions, lookOptions,
                                  paintOptions,  groundPaintOptions, volumeLookOptions, qualityOptions,
                                  mediumOptions, pictureOptions,     setOption,         tellingOptions};

// Returns the bits of the commands that a row names directly or by a trait.
CommandSet commandsWith(CommandSet asked) {
    CommandSet found = 0;
    for (const Command& command : commands())
        if (asked & (command.command | command.traits)) found |= command.command;
    return found;
}

// Returns the row that several commands have.
std::vector<Option>::iterator sharedRow(std::vector<Option>& all, const std::string_view key) {
    const auto row = std::ranges::find_if(all, [&](const Option& option) {
        return option.key == key && !std::has_single_bit(option.commands);
    });
    if (row == all.end()) throw std::logic_error("an option is to stand behind one that is not shared");
    return row;
}

void addOwnOptions(const Command& command, std::vector<Option>& all) {
    auto at = sharedRow(all, kSetKey);
    bool inFile = false;
    for (Option& option : command.options()) {
        if (*option.behind) {
            at = sharedRow(all, option.behind);
            inFile = at->inFile;
            ++at;
        }
        option.inFile = option.inFile && inFile;
        option.commands = option.commands ? commandsWith(option.commands) : command.command;
        at = std::next(all.insert(at, std::move(option)));
    }
}

std::vector<Option> makeTable() {
    std::vector<Option> all;
    for (const auto& part : kSharedParts)
        for (Option& option : part()) {
            option.commands = commandsWith(option.commands);
            all.push_back(std::move(option));
        }
    std::vector<const Command*> byChapter;
    for (const Command& command : commands())
        if (command.options) byChapter.push_back(&command);
    std::ranges::stable_sort(byChapter, {}, [](const Command* command) { return command->chapter; });
    for (const Command* command : byChapter) addOwnOptions(*command, all);
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
