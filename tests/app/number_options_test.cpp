// Numbers at the door: every option of every command that takes numbers refuses what is none, or out of its
// range, in the same line, before anything else is done. The options are those that the program declares: a
// new one is tried here, or has to be named among the words.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "app/command/arguments.h"
#include "engine/base/error.h"
#include "tests/app/program.h"

namespace stereonav::test {
namespace {

// Files, names and words; some hold numbers beside a word, and are checked where they are read.
const std::set<std::string> kWords{"SCENE",
                                   "--late-warp",
                                   "--look",
                                   "--refine",
                                   "--truth-rays",
                                   "--simd",
                                   "--series",
                                   "--series-pictures",
                                   "--up",
                                   "--image",
                                   "--sky",
                                   "--light",
                                   "--transfer",
                                   "--shading",
                                   "--modulate",
                                   "--ambient-method",
                                   "--medium",
                                   "--model",
                                   "--phase",
                                   "--noise",
                                   "--method",
                                   "--mode",
                                   "--of",
                                   "--older",
                                   "--out",
                                   "--path",
                                   "--video",
                                   "--methods",
                                   "--json",
                                   "--label",
                                   "--csv",
                                   "--images",
                                   "--plot",
                                   "--scene",
                                   "--compare",
                                   "--stability",
                                   "--parts",
                                   "--data",
                                   "--probe",
                                   "--what",
                                   "--sweep",
                                   "--shots",
                                   "--set",
                                   "--full-screen",
                                   "--ground-detail",
                                   "--line",
                                   "--area",
                                   "--track",
                                   "--tracks",
                                   "--follow",
                                   "--paint",
                                   "--geojson",
                                   "--svg",
                                   "--at",
                                   "--picture",
                                   "--comment",
                                   "--file",
                                   "--page",
                                   "--panorama",
                                   "--memory",
                                   "--tiles",
                                   "--sr",
                                   "--with",
                                   "--fluid",
                                   "--distortion",
                                   "--findings",
                                   "--paint",
                                   "--late-warp"};
// Lists for which "1,5" is right.
const std::set<std::string> kPairs{"--sun",  "--light-from", "--mist", "--isovalues",
                                   "--from", "--to",         "--pick"};

const std::vector<std::string> kNoNumbers{
    "nan", "inf",   "-inf", "NaN", "infinity", "1e300", "-1e300", std::string(309, '7'),
    "",    "0x10",  "1,5",  "5 ",  " 5",       "5mm",   "1e",     "++1",
    "--1", "1.2.3", "1/0",  "1,,2"};

std::string refusalOf(const std::vector<std::string>& arguments) {
    try {
        checkCommandLine(arguments);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(NumberOptions, AreAllThatAreNotWordsOrFiles) {
    std::set<std::string> words;
    int numbers = 0;
    for (const OptionFacts& option : optionsOfCommands()) {
        numbers += option.takesNumbers;
        if (option.takesNumbers) continue;
        words.insert(option.name);
        EXPECT_TRUE(kWords.contains(option.name))
            << option.command << " " << option.name << ": declare its range, or name it among the words";
    }
    EXPECT_EQ(words, kWords);
    EXPECT_GT(numbers, 100);
}

TEST(NumberOptions, RefuseWhatIsNoNumberInOneLine) {
    for (const OptionFacts& option : optionsOfCommands()) {
        if (!option.takesNumbers) continue;
        for (const std::string& text : kNoNumbers) {
            if (text == "1,5" && kPairs.contains(option.name)) continue;
            const std::string line = refusalOf({option.command, option.name, text});
            const std::string shown = text.size() > 40 ? text.substr(0, 40) + "..." : text;
            EXPECT_TRUE(line.starts_with(option.name + ": expected ")) << option.command << ": " << line;
            EXPECT_NE(line.find("got \"" + shown + "\""), std::string::npos)
                << option.command << " " << option.name << " " << text << ": " << line;
            EXPECT_LT(line.size(), 260u) << line;
        }
    }
}

TEST(NumberOptions, TakeAPartByItsEnds) {
    for (const char* part : {"0..0", "3..8", "999999..1000000"})
        EXPECT_EQ(refusalOf({"play", "--frames", part}), "") << part;
    for (const char* part : {"8..3", "..3", "3..", "..", "1..2..3", "-1..2", "0..1000001", "1...2", "1.5..2"})
        EXPECT_NE(refusalOf({"play", "--frames", part}).find("FIRST..LAST"), std::string::npos) << part;
}

TEST(NumberOptions, SayRangeUnitAndAdvice) {
    EXPECT_EQ(refusalOf({"render", "--fov", "nan"}),
              "--fov: expected 1 to 170 degrees, got \"nan\"; 45 is common");
    EXPECT_EQ(refusalOf({"render", "--opacity", "0"}),
              "--opacity: expected more than 0 and at most 1, got \"0\"; "
              "0.95 is a wall that is nearly opaque within a millimetre");
    EXPECT_EQ(
        refusalOf({"play", "--frames", "2.5"}),
        "--frames: expected a whole number, 1 to 1e6 frames, or FIRST..LAST of those from 0 on, got \"2.5\"; "
        "leave it out for the whole path at --fps");
    EXPECT_EQ(refusalOf({"render", "--pose", "1,2"}),
              "--pose: expected x,y,z,heading,pitch,roll (-1e9 to 1e9 metres, then -360 to "
              "360 degrees), got \"1,2\"; the angles may be left out, as in 0,0,3000");
    EXPECT_EQ(refusalOf({"compare", "--relative-separation", "1/0"}),
              "--relative-separation: expected 0 to 10 or a fraction, got \"1/0\"; try 1/30");
}

struct Ends {
    const char *command, *option;
    std::vector<const char*> taken, refused;
};

TEST(NumberOptions, TakeTheirEndsAndNothingBeyond) {
    const Ends all[]{
        {"render", "--fov", {"1", "170", "+45", "4.5e1"}, {"0", "0.99", "170.1", "-1"}},
        {"render", "--separation", {"0", "1e9"}, {"-1e-9", "1.1e9"}},
        {"render", "--zero-parallax", {"1e-9", "1e9"}, {"0", "1e-10", "-1"}},
        {"render", "--vertical-scale", {"1e-6", "1e6"}, {"0", "1e-7", "1e7", "-1"}},
        {"render", "--threads", {"0", "256"}, {"-1", "257"}},
        {"render", "--tilt", {"-90", "90"}, {"-90.1", "90.1"}},
        {"render", "--cone", {"0", "171.8"}, {"172", "-1"}},
        {"render", "--exposure", {"1e-30", "1e6"}, {"0", "1.1e6"}},
        {"render", "--size", {"1x1", "32768x32768"}, {"0x1", "1x32769", "1x", "x1", "1x1x1", "1 x1"}},
        {"render", "--sun", {"0,90", "-360,-90"}, {"0,90.1", "361,0", "1", "1,2,3"}},
        {"render", "--lamp", {"head", "1,2,3"}, {"heads", "head,1", "1,2"}},
        {"render",
         "--point-light",
         {"centreline", "centreline,0.05", "1,2,3", "1,2,3,4"},
         {"centreline,", "centreline,0", "centreline0.05", "1,2,3,0", "1,2,3,4,5"}},
        {"bake", "--albedo", {"0", "1", "0.1,0.2,0.3"}, {"1.1", "0.1,0.2", "-0.1"}},
        {"report", "--minutes", {"0.01", "1440"}, {"0", "1441", "nan"}},
        {"report",
         "--seed",
         {"0", "9000000000000000000"},
         {"-1", "9000000000000000001e1", "18446744073709551616"}},
        {"bake", "--samples", {"1", "16777216"}, {"0", "16777217", "1.5"}},
        {"play", "--fps", {"0.001", "1000"}, {"0", "1001"}}};
    for (const Ends& ends : all) {
        for (const char* text : ends.taken) {
            const std::string line = refusalOf({ends.command, ends.option, text});
            EXPECT_FALSE(line.starts_with(ends.option)) << text << ": " << line;
        }
        for (const char* text : ends.refused) {
            const std::string line = refusalOf({ends.command, ends.option, text});
            EXPECT_TRUE(line.starts_with(ends.option)) << ends.option << " " << text << " is taken: " << line;
        }
    }
}

class NumbersAtTheDoor : public ProgramTest {};

TEST_F(NumbersAtTheDoor, AreRefusedByTheProgramItself) {
    for (const OptionFacts& option : optionsOfCommands())
        if (option.takesNumbers)
            expectRefused({option.command, option.name, "nan", "--out", "x"},
                          {"stereonav: " + option.name + ": expected ", "got \"nan\""});
    expectRefused({"report", "--minutes", "nan", "--out", "x"}, {"--minutes: expected more than 0"});
    expectRefused({"render", "--fov", "0", "--out", "x.png"},
                  {"--fov: expected 1 to 170 degrees, got \"0\""});
    expectRefused({"render", "--vertical-scale", "1e300", "--out", "x.png"},
                  {"--vertical-scale: expected 1e-6 to 1e6"});
    for (const char* g : {"nan", "inf", "1e300", "0x1", "1", "-0.9991", "1,5", ""})
        expectRefused({"render", "cloud", "--phase", std::string("hg ") + g, "--out", "x.png"},
                      {"--phase: expected"});
    expectRefused({"render", "cloud", "--phase", "magic", "--out", "x.png"},
                  {"--phase: expected", "\"magic\""});
}

// The ends themselves are accepted, as docs/formats.md says.
TEST_F(NumbersAtTheDoor, ThePhaseFunctionsEndsAreTaken) {
    for (const char* g : {"hg 0.999", "hg -0.999"}) {
        const Outcome outcome =
            run({"render", "cloud", "--phase", g, "--slices", "8", "--size", "16x12", "--out", "a.png"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    }
}

// What a scene file says has the ranges of the options.
TEST_F(NumbersAtTheDoor, ScenesAreHeldToTheSameRanges) {
    const auto refused = [&](const std::string& section, const std::string& key, const std::string& range) {
        const auto scene = input("scene.toml", "[terrain]\nbuiltin = true\n" + section);
        expectRefused({"info", scene}, {"scene.toml:", "\"" + key + "\"", range});
    };
    for (const char* fov : {"0", "0.5", "171", "nan", "inf", "1e300"})
        refused(std::string("[stereo]\nfov_deg = ") + fov + "\n", "fov_deg", "from 1 to 170 degrees");
    refused("[stereo]\nseparation_m = 1e300\n", "separation_m", "from 0 to 1e9 metres");
    refused("[stereo]\nzero_parallax_m = 0\n", "zero_parallax_m", "from 1e-9 to 1e9 metres");
    refused("vertical_scale = 1e300\n", "vertical_scale", "from 1e-6 to 1e6");
    refused("[start]\nposition_m = [0, 0, 1e300]\n", "position_m", "from -1e9 to 1e9 metres");
    refused("[look]\nfog_distance_m = 1e300\n", "fog_distance_m", "from 0 to 1e9 metres");
    refused("[flight]\nclearance_m = 1e300\n", "clearance_m", "from 1e-9 to 1e9 metres");
}

}  // namespace
}  // namespace stereonav::test
