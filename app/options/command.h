// The program's commands: each with its options and the function that runs it.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "app/options/option_table.h"

namespace stereonav {

// Chapters of the pages that list options by topic; a command's own options stand in one of them.
enum class Chapter { Pictures, Series, Shapes, Ground, Measuring, Light, Colon, Kept };

struct Command {
    const char* name;
    const char* help;
    SceneSet scenes = 0;                         // scenes that it takes; 0: checks its own
    CommandSet command = 0;                      // bit of this command; 0: setCommands() assigns one
    CommandSet traits = 0;                       // traits, by which rows of the table apply to it
    Chapter chapter{};                           // chapter of its own options
    std::vector<Option> (*options)() = nullptr;  // its own options; null: it has none
    // Makes the command's structure, points `to` at it, and returns the function that runs the command.
    std::function<int()> (*start)(OptionTargets& to) = nullptr;
};

// Command::start of a command that consists of one function and one structure.
template <typename Options, int (*run)(const Options&)>
std::function<int()> startOf(OptionTargets& to) {
    const auto options = std::make_shared<Options>();
    to.bind(*options);
    return [options] { return run(*options); };
}

// Hands over the commands in the order of help. Has to be called before the table of options is used.
void setCommands(std::vector<Command> commands);

std::span<const Command> commands();
const Command& commandOf(CommandSet command);

}  // namespace stereonav
