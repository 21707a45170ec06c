// The command line.
#pragma once

#include <string>
#include <vector>

#include "app/commands.h"

namespace stereonav {

// Parses and runs one command; returns the exit status. Throws what the command throws.
int runCommandLine(int argc, char** argv);

// What these arguments of `render` ask for. Throws Error.
RenderOptions renderOptionsFrom(const std::vector<std::string>& arguments);

}  // namespace stereonav
