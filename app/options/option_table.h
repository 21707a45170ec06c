// The program's options, each declared once: what it takes, what it is for, what it excludes. The command
// line, refusals, keys of scene files, completion, docs/options.md and the man page come from here.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/given_options.h"
#include "app/options/option_targets.h"
#include "app/options/option_value.h"
#include "app/options/scene_types.h"

namespace stereonav {

namespace command {
// Commands that rows of others, or the window, name. All others get a bit of their own from setCommands().
constexpr CommandSet kInfo = 1 << 0, kRender = 1 << 1, kPlay = 1 << 2, kCompare = 1 << 3, kReport = 1 << 4,
                     kMesh = 1 << 5, kBake = 1 << 6, kView = 1 << 7, kMeasure = 1 << 8, kProfile = 1 << 9;
// Traits of commands: rows are for all that have one.
constexpr CommandSet kShowing = 1 << 16;                       // shows any scene as it looks
constexpr CommandSet kOfGround = 1 << 17, kOfColon = 1 << 18;  // takes ground alone, a colon alone
constexpr CommandSet kTelling = 1 << 19;                       // tells what was done as a document, if asked
constexpr CommandSet kWithScene = kShowing | kOfGround | kOfColon | kBake;
constexpr CommandSet kAll = ~CommandSet{0};
}  // namespace command

// What a rule looks at.
struct Asked {
    const GivenOptions& given;
    SceneSet type;  // one bit, or 0 of commands without a scene

    bool has(const char* key) const { return given.has(key); }
    bool is(const char* key, const char* word) const { return given.is(key, word); }
    bool shows(SceneSet types) const { return (type & types) != 0; }
    bool runs(CommandSet commands) const { return (given.command & commands) != 0; }
};

// "{model}" in texts stands for what was given as --model.
struct OptionRule {
    bool (*broken)(const Asked&);
    std::string problem, advice;
};

struct Exclusion {
    const char* key;  // the other one's
    std::string advice = "leave one of them out";
};

// Under which heading the window lists it; None: it is no setting of a scene that is shown.
enum class OptionPanel { None, View, Light, Material, Medium, Quality, Study };

struct Option {
    const char* key = "";  // "vertical-scale"; "SCENE" stands without dashes
    ValueType value;
    std::string help;           // one line
    const char* advice = "";    // what to write instead of what is refused
    const char* group = "";     // under which help lists it
    const char* fallback = "";  // what holds where it is left out
    CommandSet commands = 0;    // which have it; left out by a command's own options
    SceneSet scenes = scene_type::kAll;
    OptionRule elsewhere{};  // what is said with another scene, where it is not said by the types
    std::vector<Exclusion> excludes{};
    std::vector<OptionRule> rules{};  // the first that is broken is told
    bool required = false, repeated = false;
    bool inFile = true;  // whether a scene file may say it
    OptionPanel panel = OptionPanel::None;
    void (*take)(OptionTargets& to, const OptionValue& value) = nullptr;

    bool positional() const { return key == std::string_view("SCENE"); }
    // "--fov"
    std::string name() const { return positional() ? key : std::string("--") + key; }
};

// All, in the order in which help lists them. Some keys stand for different things with different commands.
const std::vector<Option>& optionTable();
// What help says of it: what it is, what it takes, and what holds where it is left out.
std::string helpLine(const Option& option);
// Null where the command has none of this key.
const Option* findOption(CommandSet command, std::string_view key);

constexpr const char* kSetKey = "set";  // gives any other option: --set fov=45

// The parts of the table that commands share.
std::vector<Option> sourceOptions();
std::vector<Option> studyOptions();
std::vector<Option> lookOptions();
std::vector<Option> paintOptions();
std::vector<Option> groundPaintOptions();
std::vector<Option> volumeLookOptions();
std::vector<Option> qualityOptions();
std::vector<Option> mediumOptions();
std::vector<Option> tracedOptions();
std::vector<Option> viewOptions();
std::vector<Option> pictureOptions();
std::vector<Option> tellingOptions();

}  // namespace stereonav
