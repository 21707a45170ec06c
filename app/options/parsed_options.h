// What a command was given, from wherever: the command line, --set, and the scene file.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/options/command.h"

namespace stereonav {

// The type of scene that options name; none where the name stands for no scene, which is said when it is
// loaded.
using SceneTypeOf = std::optional<SceneSet> (*)(const SceneOptions& options);

// What was given to the command that was chosen, and what runs it. Not copied: values go into what runs.
struct ParsedOptions {
    explicit ParsedOptions(SceneTypeOf by) : typeOf(by) {}
    ParsedOptions(const ParsedOptions&) = delete;

    SceneTypeOf typeOf;
    GivenOptions given;
    OptionTargets to;
    std::function<int()> run;  // empty until a command is chosen
};

// Makes the command's structure the one that its options go to.
void chooseCommand(CommandSet which, ParsedOptions& parsed);

// Reads a value and lets it go to its place. place: what messages call it. Throws Error.
void takeOption(const Option& option, const std::string& text, const std::string& place,
                ParsedOptions& parsed);
// "KEY=VALUE", as --set has it. Throws Error.
void takeSetOption(const std::string& text, ParsedOptions& parsed);

// When all of the command line is read: takes what the scene file says beside it, and refuses what does not
// apply. Throws Error.
void finishOptions(ParsedOptions& parsed);

// How `compare` shows a scene of which the name alone is given: as its file says, if it is a scene file,
// which may name another scene. Throws Error.
SceneOptions sceneOptionsOf(const std::string& scene, SceneTypeOf typeOf);

}  // namespace stereonav
