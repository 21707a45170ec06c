#include "app/options/option_table.h"

#include <algorithm>
#include <array>
#include <utility>

namespace stereonav {
namespace {

constexpr std::array<CommandFacts, 18> kCommands{{
    {command::kInfo, "info", "print what was read and the frame plan", scene_type::kAll},
    {command::kRender, "render", "one pose into a picture", scene_type::kAll},
    {command::kPlay, "play", "a flight into pictures, a video, or a hash", scene_type::kAll},
    {command::kCompare, "compare", "measure the ways of making the right eye", scene_type::kAll},
    {command::kReport, "report",
     "a page of error against time for every shortcut the program takes; up to 10 minutes", 0},
    {command::kMesh, "mesh", "the ground with its colour as a glTF mesh", scene_type::kTerrains},
    {command::kViewshed, "viewshed",
     "what of the ground is seen from a place, and whether two places see each other", scene_type::kTerrains},
    {command::kMeasure, "measure", "lengths, areas and volumes on the ground, each with its error",
     scene_type::kTerrains},
    {command::kProfile, "profile", "the ground along a line, a track or a flight", scene_type::kTerrains},
    {command::kSun, "sun", "where the sun stands at a time, and how long it shines on the ground",
     scene_type::kTerrains},
    {command::kCentreline, "centreline", "the way through a colon, with its radii, as a file",
     scene_type::kVolumes},
    {command::kBake, "bake",
     "light worked out before, with bounces and soft shadows; Ctrl-C keeps what is done",
     scene_type::kTerrains | scene_type::kVolumes},
    {command::kCoverage, "coverage", "what of a colon's wall a flight shows, and what it misses",
     scene_type::kVolumes},
    {command::kFindings, "findings", "polyps measured at places of a colon, as a list, a file and a page",
     scene_type::kVolumes},
    {command::kRegister, "register", "places of a colon in another study of it", scene_type::kVolumes},
    {command::kUnfold, "unfold", "a colon's wall laid flat, as a picture", scene_type::kVolumes},
    {command::kCache, "cache", "what is kept between runs to save time: its files, and clearing it", 0},
    {command::kView, "view", "fly through the scene in a window", scene_type::kAll},
}};

// Any option by its key, in the words of a scene file.
std::vector<Option> setOption() {
    using namespace command;
    return {
        {.key = kSetKey,
         .value = textValue(),
         .help =
             "KEY=VALUE: another option by the key that it has in a scene file; may be given several times",
         .commands = kShowing | kMesh | kSurveying | kColonInstruments | kCentreline | kBake,
         .repeated = true,
         .take = [](OptionTargets&, const OptionValue&) {}}};
}

struct Part {
    std::vector<Option> (*options)();
    bool inFile;  // whether scene files may say them
};
constexpr std::array<Part, 20> kParts{{{sourceOptions, true},
                                       {studyOptions, true},
                                       {lookOptions, true},
                                       {paintOptions, true},
                                       {groundPaintOptions, true},
                                       {volumeLookOptions, true},
                                       {qualityOptions, true},
                                       {mediumOptions, true},
                                       {tracedOptions, true},
                                       {viewOptions, true},
                                       {pictureOptions, false},
                                       {meshAndLineOptions, false},
                                       {surveyOptions, false},
                                       {compareOptions, false},
                                       {reportOptions, false},
                                       {bakeOptions, false},
                                       {colonInstrumentOptions, false},
                                       {cacheOptions, false},
                                       {setOption, false},
                                       {tellingOptions, false}}};

std::vector<Option> makeTable() {
    std::vector<Option> all;
    for (const Part& part : kParts)
        for (Option& option : part.options()) {
            option.inFile = part.inFile && !option.positional() && option.inFile;
            all.push_back(std::move(option));
        }
    return all;
}

}  // namespace

std::span<const CommandFacts> commandFacts() {
    return kCommands;
}

const CommandFacts& factsOf(CommandSet command) {
    return *std::find_if(kCommands.begin(), kCommands.end(),
                         [&](const CommandFacts& facts) { return facts.command == command; });
}

const std::vector<Option>& optionTable() {
    static const std::vector<Option> table = makeTable();
    return table;
}

std::string helpLine(const Option& option) {
    std::string line = option.help;
    if (const std::string expected = option.value.expected(); !expected.empty())
        line += " (" + expected + ")";
    if (*option.fallback) line += std::string("; left out: ") + option.fallback;
    return line;
}

const Option* findOption(CommandSet command, std::string_view key) {
    for (const Option& option : optionTable())
        if ((option.commands & command) && option.key == key) return &option;
    return nullptr;
}

}  // namespace stereonav
