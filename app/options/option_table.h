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
// Bits of the commands that other code names: rows of other commands, or the window. setCommands() assigns
// bits to all others.
constexpr CommandSet kInfo = 1 << 0, kRender = 1 << 1, kPlay = 1 << 2, kCompare = 1 << 3, kReport = 1 << 4,
                     kMesh = 1 << 5, kBake = 1 << 6, kView = 1 << 7, kMeasure = 1 << 8, kProfile = 1 << 9;
// Traits of commands; a row with a trait applies to all commands that have it.
constexpr CommandSet kShowing = 1 << 16;                       // shows any scene as it looks
constexpr CommandSet kOfGround = 1 << 17, kOfColon = 1 << 18;  // takes ground only, a colon only
constexpr CommandSet kTelling = 1 << 19;                       // can report its result as a document
constexpr CommandSet kWithScene = kShowing | kOfGround | kOfColon | kBake;
constexpr CommandSet kAll = ~CommandSet{0};
}  // namespace command

// The facts that a rule of an option looks at.
struct Asked {
    const GivenOptions& given;
    SceneSet type;  // type of the scene, one bit; 0 for commands without a scene

    bool has(const char* key) const { return given.has(key); }
    bool is(const char* key, const char* word) const { return given.is(key, word); }
    bool shows(SceneSet types) const { return (type & types) != 0; }
    bool runs(CommandSet commands) const { return (given.command & commands) != 0; }
};

// A reason to refuse an option. "{model}" in its texts stands for the value of --model.
struct OptionRule {
    bool (*broken)(const Asked&);
    std::string problem, advice;
};

struct Exclusion {
    const char* key;  // key of the other option
    std::string advice = "leave one of them out";
};

// Heading in the window; None: the option is no setting of a scene that is shown.
enum class OptionPanel { None, View, Light, Material, Medium, Quality, Study };

struct Option {
    const char* key = "";  // "vertical-scale"; "SCENE" stands without dashes
    ValueType value;
    std::string help;           // one line
    const char* also = "";      // other words that people look for it by, separated by blanks
    const char* advice = "";    // what to write instead of a refused value
    const char* group = "";     // heading in help
    const char* fallback = "";  // value in effect where the option is left out
    // Key of the shared option behind which a command's own option, and those that follow it in the command's
    // list, stand in help and pages; "": in the command's own chapter. A scene file may set them where it may
    // set that shared option.
    const char* behind = "";
    CommandSet commands = 0;  // commands that have it; empty for options of single commands
    SceneSet scenes = scene_type::kAll;
    OptionRule elsewhere{};  // message where the scene has another type; empty: a general one
    std::vector<Exclusion> excludes{};
    std::vector<OptionRule> rules{};  // the first broken rule is reported
    bool required = false, repeated = false;
    bool inFile = true;  // whether a scene file may say it
    OptionPanel panel = OptionPanel::None;
    void (*take)(OptionTargets& to, const OptionValue& value) = nullptr;

    bool positional() const { return key == std::string_view("SCENE"); }
    // Returns the name on the command line: "--fov".
    std::string name() const { return positional() ? key : std::string("--") + key; }
};

// Returns all options in the order of help. Some keys mean different things with different commands.
const std::vector<Option>& optionTable();
// Returns the line of help: what the option is, what it takes, and its default.
std::string helpLine(const Option& option);
// Returns the command's option of this key; null where it has none.
const Option* findOption(CommandSet command, std::string_view key);

constexpr const char* kSetKey = "set";  // gives any other option: --set fov=45

// Parts of the table that commands share.
std::vector<Option> sourceOptions();
std::vector<Option> studyOptions();
std::vector<Option> isosurfaceOptions();
std::vector<Option> lookOptions();
std::vector<Option> paintOptions();
std::vector<Option> groundPaintOptions();
std::vector<Option> volumeLookOptions();
std::vector<Option> qualityOptions();
std::vector<Option> mediumOptions();
std::vector<Option> pictureOptions();
std::vector<Option> tellingOptions();

}  // namespace stereonav
