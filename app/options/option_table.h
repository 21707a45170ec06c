// The program's options, each declared once: what it takes, what it is for, what it excludes. The command
// line, refusals, keys of scene files, completion, docs/options.md and the man page come from here.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/command/cache_command.h"
#include "app/command/colon_commands.h"
#include "app/command/commands.h"
#include "app/options/given_options.h"
#include "app/options/option_value.h"
#include "app/options/scene_types.h"

namespace stereonav {

namespace command {
constexpr CommandSet kInfo = 1, kRender = 2, kPlay = 4, kCompare = 8, kReport = 16, kMesh = 32,
                     kCentreline = 64, kBake = 128, kView = 256, kViewshed = 1 << 12, kMeasure = 1 << 13,
                     kProfile = 1 << 14, kSun = 1 << 15;
constexpr CommandSet kSurveying = kViewshed | kMeasure | kProfile | kSun;  // of the ground
// Instruments of colons: app/command/colon_commands.h.
constexpr CommandSet kCoverage = 1 << 16, kFindings = 1 << 17, kRegister = 1 << 18, kUnfold = 1 << 19;
constexpr CommandSet kColonInstruments = kCoverage | kFindings | kRegister | kUnfold;
constexpr CommandSet kCache = 1 << 20;                                       // what is kept between runs
constexpr CommandSet kShowing = kInfo | kRender | kPlay | kCompare | kView;  // any scene, as it looks
}  // namespace command

struct CommandFacts {
    CommandSet command;
    const char* name;
    const char* help;
    SceneSet scenes;  // that it takes; 0: its own
};
std::span<const CommandFacts> commandFacts();
const CommandFacts& factsOf(CommandSet command);

// Where the values of one command go; null: it has none.
struct OptionTargets {
    SceneOptions* scene = nullptr;
    SizeOption* size = nullptr;
    std::string *method = nullptr, *path = nullptr, *out = nullptr;
    OutputMode* mode = nullptr;
    bool *json = nullptr, *quiet = nullptr;
    RayOptions* rays = nullptr;
    InfoOptions* info = nullptr;
    RenderOptions* render = nullptr;
    PlayOptions* play = nullptr;
    CompareOptions* compare = nullptr;
    ReportOptions* report = nullptr;
    MeshOptions* mesh = nullptr;
    ViewshedOptions* viewshed = nullptr;
    MeasureOptions* measure = nullptr;
    ProfileOptions* profile = nullptr;
    SunOptions* sun = nullptr;
    BakeOptions* bake = nullptr;
    CoverageOptions* coverage = nullptr;
    FindingsOptions* findings = nullptr;
    RegisterOptions* registration = nullptr;
    UnfoldOptions* unfold = nullptr;
    CacheOptions* cache = nullptr;
    ViewOptions* view = nullptr;
};

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
    const char* key;  // of the other one
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
    CommandSet commands = 0;    // that have it
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

// The parts of the table.
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
std::vector<Option> meshAndLineOptions();
std::vector<Option> surveyOptions();
std::vector<Option> compareOptions();
std::vector<Option> reportOptions();
std::vector<Option> bakeOptions();
std::vector<Option> colonInstrumentOptions();
std::vector<Option> cacheOptions();

}  // namespace stereonav
