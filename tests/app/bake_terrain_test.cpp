// `stereonav bake` of terrains through the real program, and what is shown under its light.
#include "tests/app/program.h"

namespace stereonav::test {
namespace {
namespace fs = std::filesystem;

class BakeTerrain : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    Outcome render(const std::string& scene, std::vector<std::string> options) const {
        options.insert(options.begin(), {"render", scene, "--size", "96x64", "--out", "p.png"});
        return run(options);
    }
    static bool has(const std::string& text, const std::string& words) {
        return text.find(words) != std::string::npos;
    }
};

TEST_F(BakeTerrain, KeepsItInTheCacheAndShowsIt) {
    const std::string scene = hills();
    expectRefused({"render", scene, "--light", "auto", "--out", "p.png"}, {"light", "stereonav bake"});
    const Outcome first = run({"bake", scene});
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_TRUE(has(first.out, "32x24 samples")) << first.out;
    const Outcome again = run({"bake", scene});
    EXPECT_TRUE(has(again.out, "baked before")) << again.out;
    ASSERT_EQ(render(scene, {}).status, 0);
    const std::string plain = contentOf(place() / "p.png");
    ASSERT_EQ(render(scene, {"--light", "auto"}).status, 0);
    const std::string lit = contentOf(place() / "p.png");
    ASSERT_EQ(render(scene, {"--light", "auto", "--sun", "90,10"}).status, 0);
    const std::string moved = contentOf(place() / "p.png");
    EXPECT_FALSE(plain.empty());
    EXPECT_NE(lit, plain);
    EXPECT_NE(moved, lit);
    const Outcome info = run({"info", scene, "--light", "auto", "--size", "96x64"});
    EXPECT_TRUE(has(info.out, "32x24, transfer")) << info.out;
}

TEST_F(BakeTerrain, SameBytesOnAnyThreadCount) {
    const std::string scene = hills();
    for (const std::string what : {"transfer", "openness"}) {
        for (const std::string threads : {"1", "3"})
            ASSERT_EQ(run({"bake", scene, "--what", what, "--threads", threads, "--out", threads + ".light"})
                          .status,
                      0);
        EXPECT_EQ(contentOf(place() / "1.light"), contentOf(place() / "3.light")) << what;
        fs::remove(place() / "1.light");
        fs::remove(place() / "3.light");
    }
}

TEST_F(BakeTerrain, TakesCoarseGridsAndRays) {
    const Outcome outcome = run({"bake", hills(), "--resolution", "0.25", "--samples", "20", "--order", "2",
                                 "--bounces", "0", "--albedo", "1", "--out", "c.light"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "9x7 samples")) << outcome.out;
    EXPECT_EQ(render(hills(), {"--light", "c.light"}).status, 0);
}

TEST_F(BakeTerrain, RefusesWhatMakesNoSense) {
    const std::string scene = hills();
    expectRefused({"bake", scene, "--what", "irradiance"}, {"--what", "transfer or openness"});
    expectRefused({"bake", scene, "--error", "0.1"}, {"--error", "terrain"});
    expectRefused({"bake", scene, "--isovalues", "1,2"}, {"--isovalues", "terrain"});
    expectRefused({"bake", scene, "--resolution", "3"}, {"--resolution", "0.001 to 1, or 2, 4 or 8"});
    expectRefused({"bake", scene, "--resolution", "16"}, {"--resolution", "0.001 to 8"});
    for (const std::string tiles : {"on", "off"})
        expectRefused({"bake", scene, "--resolution", "2", "--tiles", tiles}, {"--resolution", "in memory"});
    expectRefused({"bake", scene, "--bounces", "9"}, {"--bounces", "0 to 8"});
    expectRefused({"bake", scene, "--bounces", "5"}, {"--bounces", "0 to 4"});
    expectRefused({"bake", scene, "--albedo", "1.5"}, {"--albedo"});
    expectRefused({"bake", scene, "--samples", "0"}, {"--samples"});
    expectRefused({"render", scene, "--sun", "east", "--out", "p.png"}, {"--sun", "azimuth,elevation"});
    expectRefused({"render", scene, "--sun", "0,91", "--out", "p.png"}, {"--sun"});
    expectRefused({"render", scene, "--light", "none.light", "--out", "p.png"},
                  {"none.light", "can not be read"});
}

TEST_F(BakeTerrain, KnowsItsGroundAndForeignFiles) {
    const std::string scene = hills(), light = (mFolder / "hills.light").string();
    ASSERT_EQ(run({"bake", scene, "--out", light}).status, 0);
    expectRefused({"render", scene, "--vertical-scale", "2", "--light", light, "--out", "p.png"},
                  {light, "other ground"});
    const std::string notes = input("notes.txt", "not to be lost");
    expectRefused({"bake", scene, "--out", notes}, {notes, "something other than a terrain's light"});
    EXPECT_EQ(contentOf(notes), "not to be lost");
    const std::string whole = contentOf(light);
    std::ofstream(light, std::ios::binary) << whole.substr(0, whole.size() / 2);
    expectRefused({"render", scene, "--light", light, "--out", "p.png"}, {light, "cut off"});
    const Outcome anew = run({"bake", scene, "--out", light});
    EXPECT_EQ(anew.status, 0);
    EXPECT_TRUE(has(anew.err, "computed again")) << anew.err;
    EXPECT_EQ(contentOf(light), whole);
}

}  // namespace
}  // namespace stereonav::test
