// The table of options: every option is refused in one line where it does not apply, all that are refused are
// told together, and what stands in the table is what help lists.
#include <gtest/gtest.h>

#include <set>

#include "app/command/arguments.h"
#include "app/options/bake_options.h"
#include "app/options/command.h"
#include "app/options/option_take.h"
#include "engine/base/error.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Words = std::vector<std::string>;

Words operator+(Words a, const Words& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::string lineAgainst(const Words& arguments) {
    try {
        checkWholeCommandLine(arguments);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

// Returns a value that the option takes.
std::string sampleOf(const Option& option) {
    const ValueType& type = option.value;
    if (type.kind == ValueKind::Word) return type.words.front();
    if (option.key == std::string_view("mode")) return "sbsl";
    if (option.key == std::string_view("memory")) return "2G";
    if (!type.takesNumbers()) return option.key == std::string_view("at") ? "2026-06-21" : "some";
    for (const char* text : {"1", "0.5", "1,2", "1,2,3", "1,2,3,4,5,6", "8", "64x48"}) {
        try {
            readValue("", type, "", text);
            return text;
        } catch (const Error&) {
            continue;
        }
    }
    ADD_FAILURE() << "no sample for " << option.key;
    return "";
}

Words given(const Option& option) {
    if (option.positional()) return {};
    if (option.value.kind == ValueKind::Flag) return {option.name()};
    return {option.name(), sampleOf(option)};
}

// Returns the words that a command needs beside.
Words neededBy(const Command& command) {
    Words words;
    for (const Option& option : optionTable())
        if ((option.commands & command.command) && option.required) words = words + given(option);
    return words;
}

class OptionTable : public VolumeTest {
protected:
    // A scene of each type, as arguments.
    std::vector<std::pair<SceneSet, Words>> scenes() const {
        using namespace scene_type;
        const std::string study = ball();
        return {{kTerrain, {"terrain"}},    {kTerrainMedium, {"terrain", "--medium", "ground"}},
                {kStudy, {study}},          {kStudyMedium, {study, "--medium", "tissue"}},
                {kColon, {"colon"}},        {kColonMedium, {"colon", "--medium", "tissue"}},
                {kBuiltInMedium, {"cloud"}}};
    }

    static bool takesMedium(const Command& command) {
        return findOption(command.command, "medium") != nullptr;
    }
};

TEST_F(OptionTable, DeclaresEachOptionOnceForACommand) {
    for (const Command& command : commands()) {
        std::set<std::string> keys;
        for (const Option& option : optionTable()) {
            if (!(option.commands & command.command)) continue;
            SCOPED_TRACE(std::string(command.name) + " " + option.name());
            EXPECT_TRUE(keys.insert(option.key).second);
            EXPECT_NE(option.take, nullptr);
            EXPECT_EQ(option.help.find('\n'), std::string::npos);
            EXPECT_FALSE(option.help.empty());
            EXPECT_NE(option.scenes, 0u);
            for (const Exclusion& other : option.excludes)
                EXPECT_TRUE(std::any_of(optionTable().begin(), optionTable().end(), [&](const Option& all) {
                    return all.key == std::string(other.key);
                })) << other.key;
        }
    }
}

TEST_F(OptionTable, GivesEachCommandABitOfItsOwn) {
    CommandSet all = 0;
    for (const Command& command : commands()) {
        EXPECT_EQ(command.command & (command.command - 1), 0u) << command.name;
        EXPECT_EQ(command.command & all, 0u) << command.name;
        EXPECT_EQ(&commandOf(command.command), &command);
        all |= command.command;
    }
    for (const Option& option : optionTable()) {
        EXPECT_NE(option.commands, 0u) << option.name();
        EXPECT_EQ(option.commands & ~all, 0u) << option.name() << ": traits stand for commands";
    }
}

TEST_F(OptionTable, LetsValuesGoToTheStructureOfTheirCommandAlone) {
    struct Own {
        SceneOptions scene;
        Telling telling;
        std::optional<double> error;
        bool full = false;
    } own;
    struct Other {
        bool full = false;
    };
    OptionTargets to;
    to.bind(own);
    EXPECT_EQ(to.scene, &own.scene);
    EXPECT_EQ(to.telling, &own.telling);
    EXPECT_EQ(to.rays, nullptr);
    OptionValue value;
    value.numbers = {0.25};
    into<&Own::error>(to, value);
    into<&Own::full>(to, value);
    into<&SceneOptions::volume, &VolumeOptions::opacity>(to, value);
    EXPECT_EQ(own.error, 0.25);
    EXPECT_TRUE(own.full);
    EXPECT_EQ(own.scene.volume.opacity, 0.25);
    EXPECT_THROW(into<&Other::full>(to, value), std::logic_error);
}

TEST_F(OptionTable, RefusesWhatAnotherTypeOfSceneHasInOneLine) {
    int refused = 0, taken = 0;
    for (const Command& command : commands())
        for (const auto& [type, scene] : scenes()) {
            if (!(command.scenes & type) || (scene.size() > 1 && !takesMedium(command))) continue;
            const Words line = Words{command.name} + scene + neededBy(command);
            ASSERT_EQ(lineAgainst(line), "") << command.name << " " << scene.front();
            for (const Option& option : optionTable()) {
                const std::string key = option.key;
                if (!(option.commands & command.command) || option.positional() || option.required) continue;
                if (key == "medium" || key == kSetKey) continue;  // says itself what type the scene is of
                SCOPED_TRACE(command.name + (" " + scene.front()) + " " + scene.back() + " " + option.name());
                const std::string said = lineAgainst(line + given(option));
                if (!(option.scenes & type)) {
                    EXPECT_TRUE(said.starts_with(option.name() + ": ")) << said;
                    EXPECT_NE(said.find("; "), std::string::npos) << said;
                    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
                    EXPECT_EQ(said.find('{'), std::string::npos) << said;
                    ++refused;
                } else if (option.rules.empty() && option.excludes.empty()) {
                    EXPECT_EQ(said, "");
                    ++taken;
                }
            }
        }
    EXPECT_GT(refused, 500);
    EXPECT_GT(taken, 500);
    std::printf("%d options refused, %d taken\n", refused, taken);
}

TEST_F(OptionTable, TellsAllThatDoesNotApplyTogether) {
    EXPECT_EQ(
        lineAgainst({"render", "terrain", "--isovalue", "3", "--slices", "9", "--opacity", "0.5", "--samples",
                     "2", "--out", "a.png"}),
        "--isovalue, --opacity: only for CT studies and the built-in colon, the scene is a terrain; leave it "
        "out. --slices: needs a medium; add --medium, or show cloud or wax. --samples: needs --light "
        "traced; leave it out");
    expectRefused(
        {"render", "colon", "--sun", "90,30", "--mist", "900,2", "--opacity", "0.5", "--transfer", "wall_95",
         "--out", "a.png"},
        {"--sun: only for terrains", ". --opacity: does not go with --transfer", ". --mist: needs a medium"});
}

// Words stand in the order of what they name.
TEST_F(OptionTable, TurnsWordsIntoWhatTheyName) {
    const auto asked = [](Words words) {
        return renderOptionsFrom(std::move(words) + Words{"--out", "a.png"});
    };
    for (const NamedSimdTarget& set : kSimdTargets)
        EXPECT_EQ(asked({"terrain", "--simd", std::string(set.name)}).scene.simd, set.target);
    for (const MediumModel model :
         {MediumModel::Emission, MediumModel::Surface, MediumModel::Direct, MediumModel::Indirect})
        EXPECT_EQ(asked({"cloud", "--model", std::string(nameOf(model))}).scene.medium.model, model);
    for (const char* up : {"x", "-x", "y", "-y", "z", "-z"})
        EXPECT_EQ(nameOf(*asked({"colon", "--isosurface", "--up", up}).scene.volume.up), up);
    EXPECT_EQ(asked({"colon", "--shading", "phong"}).scene.volume.shading, Shading::Phong);
    EXPECT_EQ(asked({"colon", "--opacity", "0.5", "--modulate", "gradient"}).scene.volume.modulate,
              Modulation::Gradient);
    EXPECT_EQ(asked({"terrain", "--mode", "abl"}).mode, OutputMode::TopBottom);
    for (const char* mode : {"al", "ar", "quad"}) {
        for (const Words& words :
             {Words{"render", "terrain", "--out", "a.png"}, {"play", "terrain", "--video", "a.mp4"}})
            EXPECT_TRUE(
                lineAgainst(words + Words{"--mode", mode})
                    .starts_with("--mode: " + std::string(mode) +
                                 " shows one eye after the other, which view alone can; the modes are ml, "))
                << words.front();
        EXPECT_EQ(lineAgainst({"view", "terrain", "--mode", mode}), "");
    }
    EXPECT_EQ(lineAgainst({"view", "terrain", "--full-screen", ""}),
              "--full-screen: expected a monitor, got \"\"; try auto");
    const ValueType& kinds = findOption(command::kBake, "what")->value;
    for (const BakeKind kind : {BakeKind::Irradiance, BakeKind::Transfer, BakeKind::Openness})
        EXPECT_EQ(kinds.words[static_cast<std::size_t>(kind)], nameOf(kind));
    EXPECT_EQ(findOption(command::kView, "sweep")->value.words, (Words{"auto", "cpu", "gpu"}));
    for (const char* text : {"", "GPU", "fast"})
        EXPECT_EQ(lineAgainst({"view", "cloud", "--sweep", text}),
                  "--sweep: expected auto, cpu or gpu, got \"" + std::string(text) +
                      "\"; auto takes the faster one");
}

// Words of --light that are of some scenes or commands alone.
TEST_F(OptionTable, RefusesLightOfOtherScenes) {
    for (const char* light : {"lazy", "lazy-transfer", "traced"})
        expectRefused({"render", "terrain", "--light", light, "--out", "a.png"},
                      {std::string("--light: ") + light + " expects the surface of a CT study"});
    expectRefused({"render", "colon", "--light", "auto", "--out", "a.png"},
                  {"--light: auto expects a terrain", "name the bake's file"});
    expectRefused({"play", "colon", "--light", "lazy", "--hash"}, {"--light: lazy is for view and render"});
    expectRefused({"view", "colon", "--light", "traced"}, {"--light: traced is for render"});
    for (const char* light : {"auto", "lazy", "traced", "some.bake"})
        expectRefused({"render", "cloud", "--light", light, "--out", "a.png"}, {"stereonav: --light: "});
}

TEST_F(OptionTable, IsWhatHelpLists) {
    for (const Command& command : commands()) {
        const std::string help = run({command.name, "--help"}).out;
        for (const Option& option : optionTable())
            if (option.commands & command.command) {
                EXPECT_NE(help.find(option.name() + " "), std::string::npos)
                    << command.name << " " << option.name();
            }
    }
}

// What a command does not read it does not take.
TEST_F(OptionTable, HasForACommandWhatItReads) {
    const auto keysOf = [](const char* name) {
        std::set<std::string> keys;
        for (const Command& command : commands())
            if (name == std::string(command.name))
                for (const Option& option : optionTable())
                    if (option.commands & command.command) keys.insert(option.key);
        return keys;
    };
    EXPECT_EQ(keysOf("mesh"),
              (std::set<std::string>{"SCENE", "vertical-scale", "open-holes", "tiles", "memory", "threads",
                                     "image", "shade-image", "sun", "out", "error", "set", "json", "quiet"}));
    EXPECT_EQ(
        keysOf("centreline"),
        (std::set<std::string>{"SCENE", "threads", "memory", "series", "label", "seed", "include", "exclude",
                               "fluid", "resample", "backwards", "no-cache", "out", "set", "json", "quiet"}));
    EXPECT_FALSE(keysOf("bake").contains("simd"));
    EXPECT_FALSE(keysOf("bake").contains("fov"));
}

}  // namespace
}  // namespace stereonav::test
