// The command line.
#pragma once

#include <string>
#include <vector>

#include "app/command/commands.h"

namespace stereonav {

// Parses and runs one command; returns the exit status. Throws what the command throws.
int runCommandLine(int argc, char** argv);

// Reads a command line as far as it can be checked without running it. Throws Error.
void checkCommandLine(const std::vector<std::string>& arguments);

// Every option of every command that takes a value.
struct OptionFacts {
    std::string command, name;  // "render", "--fov"; SCENE for what has no dashes
    bool takesNumbers = false;  // else words and files
};
std::vector<OptionFacts> optionsOfCommands();

// What these arguments of `render` ask for. Throws Error.
RenderOptions renderOptionsFrom(const std::vector<std::string>& arguments);

}  // namespace stereonav
