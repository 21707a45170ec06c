// The program's commands.
#pragma once

#include <vector>

#include "app/options/command.h"

namespace stereonav {

// Returns the commands in the order of help.
std::vector<Command> programCommands();

// Runs the program without a command: flies over the built-in terrain where there is a display, otherwise
// plays it to out/ and compares.
int runDefault();

}  // namespace stereonav
