// Refusals name the file or the option that they are about, in our words and in one line.
#include <gtest/gtest.h>

#include "app/options/command.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

class Messages : public VolumeTest {
protected:
    // A lumen of one voxel across: nothing flies through it.
    std::string thread() const {
        return nrrd("thread.nrrd", {24, 24, 40, 1, "uchar", ""},
                    [](int i, int j, int k) { return i == 12 && j == 12 && k > 2 && k < 38 ? 1 : 0; });
    }
};

TEST_F(Messages, OfAColonWithoutRoomNameTheStudy) {
    const std::string study = thread();
    for (const char* command : {"info", "centreline", "render"}) {
        std::vector<std::string> all{command, study, "--no-cache"};
        if (std::string(command) != "info")
            all.insert(all.end(), {"--out", command[0] == 'c' ? "a.txt" : "a.png"});
        if (command[0] != 'c') all.insert(all.end(), {"--mask-smoothing", "0"});  // which leaves some room
        expectRefused(all, {"stereonav: " + study + ": centreline: expected a stretch with room for the eyes",
                            "; render, play and view show any volume from outside with --isosurface"});
    }
}

TEST_F(Messages, OfMethodsNameTheOption) {
    expectRefused({"render", hills(), "--method", "magic", "--out", "a.png"},
                  {"stereonav: --method: there is no method"});
    expectRefused({"render", "cloud", "--method", "linear", "--out", "a.png"},
                  {"stereonav: --method: there is no method \"linear\" of making two eyes of a medium"});
    expectRefused({"compare", hills(), "--methods", "full,magic"},
                  {"stereonav: --methods: there is no method"});
    expectRefused({"compare", "cloud", "--methods", "linear"}, {"stereonav: --methods: there is no method"});
}

TEST_F(Messages, NameTheOptionThatWasGivenAndNoOther) {
    const std::string scene = ball();
    const std::string out = "a.png";
    expectRefused({"render", scene, "--exposure", "2", "--out", out}, {"stereonav: --exposure: needs light"});
    expectRefused({"render", scene, "--turn", "9", "--out", out}, {"stereonav: --turn: needs light"});
    expectRefused({"render", scene, "--bounces", "2", "--out", out},
                  {"stereonav: --bounces: needs --light traced"});
    expectRefused({"render", scene, "--ambient-lamp", "0.5", "--out", out},
                  {"stereonav: --ambient-lamp: needs"});
    expectRefused({"render", scene, "--modulate-sigma", "2", "--out", out},
                  {"stereonav: --modulate-sigma: needs"});
    expectRefused({"render", "cloud", "--target-ms", "9", "--out", out},
                  {"stereonav: --target-ms: does not go with"});
    expectRefused({"render", hills(), "--target-psnr", "40", "--method", "paper", "--out", out},
                  {"stereonav: --target-psnr: does not go with the method"});
}

TEST_F(Messages, OfTheCommandLineAreInOurWords) {
    expectRefused({"render", hills(), "--nonsense", "3", "--out", "a.png"},
                  {"stereonav: --nonsense: there is no such option here; see stereonav render --help"});
    expectRefused(
        {"render", hills(), "--siez", "3x3", "--out", "a.png"},
        {"stereonav: --siez: there is no such option here; did you mean --size? see stereonav render"});
    expectRefused({"mesh", "terrain", "terrain", "--out", "a.glb"},
                  {"stereonav: terrain: is one word too many; see stereonav mesh"});
    expectRefused({"fly"}, {"stereonav: fly: there is no such command; see stereonav --help"});
    for (const char* help : {"--help", "-h"}) {
        expectRefused({"fly", help}, {"stereonav: fly: there is no such command; see stereonav --help"});
        expectRefused({help, "fly"}, {"stereonav: fly: there is no such command; see stereonav --help"});
    }
    expectRefused({"help", "fly"}, {"stereonav: fly: there is no such command; see stereonav --help"});
    expectRefused({""}, {"stereonav: \"\": there is no such command"});
    expectRefused({"veiw"},
                  {"stereonav: veiw: there is no such command; did you mean view? see stereonav --help"});
    expectRefused({"veiw", "colon"}, {"stereonav: veiw: there is no such command; did you mean view?"});
    expectRefused({"rendr", "--help"}, {"stereonav: rendr: there is no such command; did you mean render?"});
    expectRefused({"colon"}, {"stereonav: colon: there is no such command; did you mean stereonav view"});
    expectRefused({"completion", "zsh"},
                  {"stereonav: completion: expected bash, got \"zsh\"; see stereonav completion --help"});
    expectRefused({"completion"}, {"stereonav: completion: expected bash, found nothing"});
    expectRefused({"completion", "bash", "zsh"}, {"stereonav: zsh: is one word too many"});
    expectRefused({"mesh", "terrain"}, {"stereonav: --out: is required; see stereonav mesh --help"});
    expectRefused({"render", "--out"}, {"stereonav: --out: expected a value, found none"});
    expectRefused({"render", "--fov", "40", "--fov", "50", "--out", "a.png"},
                  {"stereonav: --fov: is given more than once"});
    expectRefused({"render", "--out", "a.png", "--out", "b.png"},
                  {"stereonav: --out: is given more than once"});
}

TEST_F(Messages, HelpIsThatOfTheCommandThatIsNamed) {
    for (const Command& command : commands()) {
        const Outcome asked = run({"help", command.name}), usual = run({command.name, "--help"});
        ASSERT_EQ(asked.status, 0) << command.name;
        EXPECT_EQ(asked.out, usual.out) << command.name;
        EXPECT_NE(asked.out.find(command.help), std::string::npos) << command.name;
    }
    EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
}

// An empty word would be taken for none: another scene would open, or nothing be written.
TEST_F(Messages, EmptyNamesAreRefused) {
    expectRefused({"info", ""}, {"SCENE: expected a name, got \"\"; leave it out for the built-in terrain"});
    for (const char* option : {"--image", "--sky", "--light", "--tracks", "--set"})
        expectRefused({"render", "terrain", option, "", "--out", "a.png"},
                      {"stereonav: " + std::string(option) + ": expected "});
    expectRefused({"render", "terrain", "--out", ""}, {"stereonav: --out: expected a name, got \"\""});
    expectRefused({"render", "terrain", "--set", "image=", "--out", "a.png"},
                  {"stereonav: --set image: expected a name, got \"\""});
    expectRefused({"play", "terrain", "--video", ""}, {"stereonav: --video: expected a name, got \"\""});
    expectRefused({"compare", "terrain", "--csv", ""}, {"stereonav: --csv: expected a name, got \"\""});
    expectRefused({"register", "colon", "--with", ""}, {"stereonav: --with: expected a name, got \"\""});
}

TEST_F(Messages, SayWhatWasFound) {
    const std::string text = input("words.txt", "hello\n");
    expectRefused({"centreline", "cloud", "--out", "a.txt"}, {"cloud: expected a CT study, found a medium"});
    expectRefused({"centreline", text, "--out", "a.txt"},
                  {text + ": expected a CT study, found a terrain or another"});
    expectRefused({"mesh", "wax", "--out", "a.glb"}, {"wax: expected a terrain, found a medium"});
    expectRefused({"report", "--compare", text, "--out", "r"},
                  {text + ": expected a report as JSON, found what is none at byte 1"});
    expectRefused({"report", "--compare", input("a.json", "{}"), "--out", "r"},
                  {"a.json: expected a report, found JSON"});
    expectRefused({"report", "--stability", text, "--out", "r"},
                  {text + ":1: expected a row of the stability tests, found \"hello\""});
    expectRefused({"report", "--papers", "--data", "nowhere", "--out", "r"},
                  {"--data: expected a folder, got \"nowhere\""});
}

}  // namespace
}  // namespace stereonav::test
