// The program's commands, as the layer above hands them over: each with its options and what runs it.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "app/options/option_table.h"

namespace stereonav {

// Where in the pages, which list options by what they are about, a command's own stand.
enum class Chapter { Shapes, Ground, Measuring, Light, Colon, Kept };

struct Command {
    const char* name;
    const char* help;
    SceneSet scenes = 0;                         // types that it takes; 0: its own
    CommandSet command = 0;                      // its bit; 0: setCommands() gives it one
    CommandSet traits = 0;                       // by which rows of the table are for it
    Chapter chapter{};                           // where its own options stand
    std::vector<Option> (*options)() = nullptr;  // its own; null: none
    // Makes its structure, lets values go there, and returns what runs the command with it.
    std::function<int()> (*start)(OptionTargets& to) = nullptr;
};

// Command::start of a command that is one function of one structure.
template <typename Options, int (*run)(const Options&)>
std::function<int()> startOf(OptionTargets& to) {
    const auto options = std::make_shared<Options>();
    to.bind(*options);
    return [options] { return run(*options); };
}

// Hands over the commands in the order of help, before anything of the table is asked.
void setCommands(std::vector<Command> commands);

std::span<const Command> commands();
const Command& commandOf(CommandSet command);

}  // namespace stereonav
