// Volumes under baked light and under the lighting models that it is compared with, through the real program.
#include <nlohmann/json.hpp>

#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {
namespace fs = std::filesystem;

class VolumeLight : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    std::string baked(const std::string& scene, const std::string& what) const {
        const std::string file = (mFolder / (what + ".bake")).string();
        const Outcome done = run({"bake", scene, "--what", what, "--samples", "16", "--out", file});
        EXPECT_EQ(done.status, 0) << done.err;
        return file;
    }
    // The picture's bytes.
    std::string picture(const std::string& scene, std::vector<std::string> options) const {
        const std::string file = (mFolder / "picture.png").string();
        options.insert(options.begin(), {"render", scene, "--size", "64x48", "--out", file});
        const Outcome done = run(options);
        EXPECT_EQ(done.status, 0) << done.err;
        return contentOf(file);
    }
};

TEST_F(VolumeLight, BakedLightOfEveryKindIsSeen) {
    const std::string scene = ball();
    const std::string lamp = picture(scene, {});
    const std::string irradiance = baked(scene, "irradiance"), transfer = baked(scene, "transfer");
    const std::string still = picture(scene, {"--light", irradiance});
    EXPECT_TRUE(still != lamp);
    EXPECT_TRUE(picture(scene, {"--light", irradiance, "--exposure", "2"}) != still);
    EXPECT_TRUE(picture(scene, {"--light", transfer}) != lamp);
    // A ball is open everywhere: nothing is taken from the lamp.
    EXPECT_TRUE(picture(scene, {"--light", baked(scene, "openness")}) == lamp);
}

TEST_F(VolumeLight, IsWorkedOutWhileOneLooks) {
    const std::string scene = ball();
    const std::string lazy = picture(scene, {"--light", "lazy"});
    EXPECT_TRUE(lazy != picture(scene, {}));
    EXPECT_TRUE(lazy == picture(scene, {"--light", "lazy", "--threads", "1"}));
    expectRefused({"compare", scene, "--light", "lazy", "--size", "32x24"}, {"lazy", "view"});
    expectRefused({"render", scene, "--light", "lazy", "--turn", "3", "--out", "a.png"}, {"lazy", "--turn"});
    // Transfer of as many samples shows the same as a bake of it, also under a turned sky; nothing is mean
    // here, so that the exposures are given.
    const std::string file = (mFolder / "lazy.bake").string();
    const Outcome done =
        run({"bake", scene, "--what", "transfer", "--samples", "64", "--bounces", "1", "--out", file});
    EXPECT_EQ(done.status, 0) << done.err;
    for (const std::string turn : {"0", "70"})
        EXPECT_TRUE(picture(scene, {"--light", "lazy-transfer", "--turn", turn, "--exposure", "1"}) ==
                    picture(scene, {"--light", file, "--turn", turn, "--exposure", "1"}))
            << turn;
    expectRefused({"info", scene, "--light", "lazy-transfer"}, {"lazy-transfer", "view"});
}

TEST_F(VolumeLight, EachModelLooksDifferent) {
    const std::string scene = ball();
    std::vector<std::string> pictures;
    for (const std::string name : {"lamp", "lambert", "phong", "varying", "fog"}) {
        pictures.push_back(picture(scene, {"--shading", name}));
        for (std::size_t n = 0; n + 1 < pictures.size(); ++n)
            EXPECT_TRUE(pictures[n] != pictures.back()) << name;
    }
    // A convex thing casts no shadow on what the lamp lights.
    EXPECT_TRUE(picture(scene, {"--shading", "lambert-shadows"}) == pictures[1]);
}

// A ball is open all around; where two touch it is not, and in a larger box to another degree.
TEST_F(VolumeLight, AmbientOcclusionIsSeen) {
    const std::string round = ball();
    EXPECT_TRUE(picture(round, {"--ambient", "6"}) == picture(round, {}));
    const std::string scene = nrrd("two.nrrd", {}, [](int i, int j, int k) {
        return std::max({0.0, 1000 - 100 * std::hypot(i - 7.5, j - 11.5, k - 11.5),
                         1000 - 100 * std::hypot(i - 15.5, j - 11.5, k - 11.5)});
    });
    const std::string lamp = picture(scene, {});
    const std::string near = picture(scene, {"--ambient", "3"});
    EXPECT_TRUE(near != lamp);
    EXPECT_TRUE(picture(scene, {"--ambient", "20"}) != near);
    expectRefused({"render", scene, "--ambient", "0", "--out", "a.png"}, {"--ambient", "above 0"});
    expectRefused({"render", scene, "--ambient", "3", "--light", "b", "--out", "a.png"},
                  {"--ambient", "--light"});
}

// Inside two translucent balls all is alike; their walls are not.
TEST_F(VolumeLight, OpacityIsModulated) {
    const std::string scene = ball();
    const auto shown = [&](const std::string& by) {
        return picture(scene, {"--isosurface", "--opacity", "0.3", "--modulate", by});
    };
    const std::string none = shown("none"), variance = shown("variance");
    EXPECT_TRUE(picture(scene, {"--isosurface", "--opacity", "0.3"}) == none);
    EXPECT_TRUE(variance != none);
    EXPECT_TRUE(shown("gradient") != variance);
    expectRefused({"render", scene, "--modulate", "much", "--opacity", "0.3", "--out", "a.png"},
                  {"--modulate", "much", "variance, gradient, none"});
    expectRefused({"render", scene, "--modulate", "variance", "--out", "a.png"},
                  {"--modulate", "translucent", "--transfer"});
    expectRefused({"render", "cloud", "--modulate", "variance", "--out", "a.png"}, {"--modulate", "medium"});
}

TEST_F(VolumeLight, RefusesWhatDoesNotFit) {
    const std::string scene = ball();
    const std::string light = baked(scene, "irradiance");
    expectRefused({"render", scene, "--shading", "dark", "--out", "a.png"}, {"--shading", "dark", "lambert"});
    expectRefused({"render", scene, "--turn", "30", "--out", "a.png"}, {"--turn", "--light"});
    expectRefused({"render", scene, "--light", light, "--exposure", "-1", "--out", "a.png"},
                  {"--exposure", "above 0"});
    expectRefused({"render", scene, "--light", light, "--turn", "30", "--out", "a.png"},
                  {"transfer", "stands still"});
    expectRefused({"render", scene, "--light", "none.bake", "--out", "a.png"}, {"none.bake", "bake"});
    expectRefused({"render", "terrain", "--shading", "phong", "--out", "a.png"}, {"--shading", "terrain"});
}

}  // namespace
}  // namespace stereonav::test
