// The command line.
#pragma once

#include <string>
#include <vector>

#include "app/command/render_command.h"

namespace stereonav {

// Name in help of values that are numbers; all other values are words and files.
constexpr const char* kNumberValue = "NUMBER";
constexpr const char* kNumbersValue = "NUMBERS";

// Parses and runs one command; returns the exit status. Throws the command's exceptions.
int runCommandLine(int argc, char** argv);

// Reads a command line, each option on its own. Throws Error.
void checkCommandLine(const std::vector<std::string>& arguments);
// Reads the scene file as well, and checks that all options go together. Throws Error.
void checkWholeCommandLine(const std::vector<std::string>& arguments);

// An option of a command that takes a value.
struct OptionFacts {
    std::string command, name;  // "render", "--fov"; SCENE for an argument without dashes
    bool takesNumbers = false;  // otherwise words and files
};
std::vector<OptionFacts> optionsOfCommands();

// Returns the options of `render` for these arguments. Throws Error.
RenderOptions renderOptionsFrom(const std::vector<std::string>& arguments);

}  // namespace stereonav
