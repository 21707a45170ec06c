// The options that a command was given by the command line, --set and the scene file.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/options/command.h"

namespace stereonav {

// Returns the type of the scene that options name; empty where the name stands for no scene, which is
// reported when the scene is loaded.
using SceneTypeOf = std::optional<SceneSet> (*)(const SceneOptions& options);

// The options of the chosen command, and the function that runs it. Not copied: the function refers to the
// values.
struct ParsedOptions {
    explicit ParsedOptions(SceneTypeOf by) : typeOf(by) {}
    ParsedOptions(const ParsedOptions&) = delete;

    SceneTypeOf typeOf;
    GivenOptions given;
    OptionTargets to;
    std::function<int()> run;  // empty until a command is chosen
};

// Makes the structure of a command and stores its options there from now on.
void chooseCommand(CommandSet which, ParsedOptions& parsed);

// Reads a value and stores it. place: its name in messages. Throws Error.
void takeOption(const Option& option, const std::string& text, const std::string& place,
                ParsedOptions& parsed);
// Reads "KEY=VALUE", the form of --set. Throws Error.
void takeSetOption(const std::string& text, ParsedOptions& parsed);

// Adds the options of the scene file and refuses options that do not apply. To be called when the whole
// command line is read. Throws Error.
void finishOptions(ParsedOptions& parsed);

// Returns the options for a scene that `compare` is given by name only: those of its scene file, if it is
// one, which may name another scene. Throws Error.
SceneOptions sceneOptionsOf(const std::string& scene, SceneTypeOf typeOf);

}  // namespace stereonav
