// The command line.
#pragma once

#include <string>
#include <vector>

#include "app/options/picture_options.h"

namespace stereonav {

// What help names the values of options that take numbers: all others are words and files.
constexpr const char* kNumberValue = "NUMBER";
constexpr const char* kNumbersValue = "NUMBERS";

// Parses and runs one command; returns the exit status. Throws what the command throws.
int runCommandLine(int argc, char** argv);

// Reads a command line, each option by itself. Throws Error.
void checkCommandLine(const std::vector<std::string>& arguments);
// Also what its scene file says, and whether all that is given goes together. Throws Error.
void checkWholeCommandLine(const std::vector<std::string>& arguments);

// Every option of every command that takes a value.
struct OptionFacts {
    std::string command, name;  // "render", "--fov"; SCENE for what has no dashes
    bool takesNumbers = false;  // else words and files
};
std::vector<OptionFacts> optionsOfCommands();

// What these arguments of `render` ask for. Throws Error.
RenderOptions renderOptionsFrom(const std::vector<std::string>& arguments);

}  // namespace stereonav
