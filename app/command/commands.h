// The program's commands.
#pragma once

#include <vector>

#include "app/options/command.h"

namespace stereonav {

// In the order of help.
std::vector<Command> programCommands();

// No command given: flies the built-in terrain where there is a display, else plays it to out/ and compares.
int runDefault();

}  // namespace stereonav
