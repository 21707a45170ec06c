// What a command was given, from wherever: the command line, --set, and the scene file.
#pragma once

#include <functional>
#include <string>

#include "app/command/commands.h"
#include "app/options/option_table.h"

namespace stereonav {

// The options of each command, which of them was chosen, and what runs it. Not copied: what runs refers to
// it.
struct ParsedOptions {
    ParsedOptions() = default;
    ParsedOptions(const ParsedOptions&) = delete;

    InfoOptions info;
    RenderOptions render;
    PlayOptions play;
    CompareOptions compare;
    ReportOptions report;
    MeshOptions mesh;
    ViewshedOptions viewshed;
    MeasureOptions measure;
    ProfileOptions profile;
    SunOptions sun;
    CentrelineOptions centreline;
    BakeOptions bake;
    CoverageOptions coverage;
    FindingsOptions findings;
    RegisterOptions registration;
    UnfoldOptions unfold;
    CacheOptions cache;
    ViewOptions view;
    GivenOptions given;
    OptionTargets to;
    std::function<int()> run = runDefault;
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
SceneOptions sceneOptionsOf(const std::string& scene);

}  // namespace stereonav
