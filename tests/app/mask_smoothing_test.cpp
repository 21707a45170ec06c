// Masks that are shown smooth: what is said of it, what stays as it was, and light that was baked for the one
// or the other wall.
#include <nlohmann/json.hpp>

#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class ShownMask : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    // Returns what is printed; the program has to succeed.
    std::string runWell(Words arguments, const Words& more) const {
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.out;
    }
    Json facts(const std::string& mask, const Words& more) const {
        return Json::parse(runWell({"info", mask, "--size", "48x36", "--json"}, more)).at("volume");
    }
    std::string frames(const std::string& mask, const Words& more) const {
        const std::string out = runWell({"play", mask, "--size", "48x36", "--frames", "2", "--hash"}, more);
        const std::size_t at = out.find("hash ");
        EXPECT_NE(at, std::string::npos) << out;
        return at == std::string::npos ? "" : out.substr(at + 5, 16);
    }
};

TEST_F(ShownMask, InfoSaysHowItIsSmoothed) {
    const std::string mask = maskedTube();
    EXPECT_EQ(facts(mask, {}).at("mask_smoothing_mm"), 4) << "two voxels";
    EXPECT_EQ(facts(mask, {"--look", "plain"}).at("mask_smoothing_mm"), 0);
    EXPECT_EQ(facts(mask, {"--mask-smoothing", "3"}).at("mask_smoothing_mm"), 3);
    EXPECT_EQ(facts(mask, {"--isosurface"}).at("mask_smoothing_mm"), 4);
    EXPECT_FALSE(facts(ball(), {}).contains("mask_smoothing_mm"));
    EXPECT_EQ(facts(mask, {}).at("volume_ml"), facts(mask, {"--look", "plain"}).at("volume_ml"));
    EXPECT_EQ(facts(mask, {}).at("centreline_mm"), facts(mask, {"--look", "plain"}).at("centreline_mm"));
}

// One after the other, so that each could find in the cache what another one left.
TEST_F(ShownMask, PlainIsAsItWasWhateverIsKept) {
    const std::string mask = maskedTube();
    for (const Words& side : {Words{}, {"--isosurface"}}) {
        Words plain{"--look", "plain"}, smooth{"--look", "plain", "--mask-smoothing", "4"};
        plain.insert(plain.end(), side.begin(), side.end());
        smooth.insert(smooth.end(), side.begin(), side.end());
        Words none = plain, fresh = plain;
        none.insert(none.end(), {"--mask-smoothing", "0"});
        fresh.push_back("--no-cache");
        const std::string before = frames(mask, plain), smoothed = frames(mask, smooth);
        EXPECT_NE(smoothed, before);
        EXPECT_EQ(frames(mask, plain), before);
        EXPECT_EQ(frames(mask, none), before);
        EXPECT_EQ(frames(mask, fresh), before);
        EXPECT_EQ(frames(mask, smooth), smoothed);
        smooth.insert(smooth.end(), {"--no-cache", "--threads", "1"});
        EXPECT_EQ(frames(mask, smooth), smoothed);
    }
}

TEST_F(ShownMask, LightIsOfTheWallThatItWasBakedFor) {
    const std::string mask = maskedTube();
    const auto bake = [&](const char* name, const Words& more) {
        const std::string file = (mFolder / name).string();
        runWell({"bake", mask, "--what", "openness", "--samples", "1", "--resolution", "0.5", "--out", file},
                more);
        return file;
    };
    const std::string plain = bake("plain.bake", {}), smooth = bake("smooth.bake", {"--mask-smoothing", "4"});
    const Words render{"render", mask, "--size", "48x36", "--out", (mFolder / "a.png").string()};
    runWell(render, {"--light", plain});
    runWell(render, {"--light", smooth, "--mask-smoothing", "4"});
    for (const Words& wrong : {Words{"--light", smooth}, {"--light", plain, "--mask-smoothing", "4"}}) {
        Words arguments = render;
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        expectRefused(arguments, {"another volume", "--mask-smoothing"});
    }
    const Json notes = facts(mask, {"--light", plain}).at("notes");
    EXPECT_NE(notes.dump().find("not smoothed"), std::string::npos) << notes;
}

}  // namespace
}  // namespace stereonav::test
