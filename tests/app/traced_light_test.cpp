// Pictures whose every pixel is path traced, through the real program.
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

class TracedLight : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    std::string picture(const std::string& scene, std::vector<std::string> options) {
        const std::string file = (mFolder / "picture.png").string();
        options.insert(options.begin(),
                       {"render", scene, "--look", "plain", "--size", "64x48", "--out", file});
        mLast = run(options);
        EXPECT_EQ(mLast.status, 0) << mLast.err;
        return contentOf(file);
    }
    // Two balls that shade each other.
    std::string twins() const {
        return nrrd("two.nrrd", {}, [](int i, int j, int k) {
            return std::max({0.0, 1000 - 100 * std::hypot(i - 7.5, j - 11.5, k - 11.5),
                             1000 - 100 * std::hypot(i - 15.5, j - 11.5, k - 11.5)});
        });
    }
    Outcome mLast;
};

// A ball alone sees all of a white sky: every path brings the same, and so does every baked texel.
TEST_F(TracedLight, OfABallUnderAWhiteSkyIsThatOfTheBake) {
    const std::string scene = ball(), file = (mFolder / "ball.bake").string();
    ASSERT_EQ(run({"bake", scene, "--samples", "16", "--out", file}).status, 0);
    const std::string traced = picture(scene, {"--light", "traced", "--samples", "4", "--exposure", "1"});
    EXPECT_NE(mLast.out.find("4 paths a pixel"), std::string::npos) << mLast.out;
    EXPECT_NE(mLast.out.find("error at most about 0 %"), std::string::npos) << mLast.out;
    EXPECT_TRUE(traced ==
                picture(scene, {"--light", file, "--exposure", "1", "--method", "full", "--edges", "0"}));
    EXPECT_TRUE(traced != picture(scene, {}));
}

TEST_F(TracedLight, EachOptionIsSeenAndThreadsAreNot) {
    const std::string scene = twins();
    const std::vector<std::string> plain{"--light", "traced", "--samples", "8", "--exposure", "0.8"};
    const std::string usual = picture(scene, plain);
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), plain.begin(), plain.end());
        return picture(scene, more);
    };
    EXPECT_TRUE(with({"--threads", "1"}) == usual);
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--bounces", "0"},
                                                 {"--albedo", "0.2"},
                                                 {"--sky", "0.3,0.4,0.6"},
                                                 {"--point-light", "0.1,0,0.1"},
                                                 {"--reach", "3"}})
        EXPECT_TRUE(with(more) != usual) << more[0];
    EXPECT_TRUE(picture(scene, {"--light", "traced", "--samples", "9", "--exposure", "0.8"}) != usual);
    EXPECT_TRUE(picture(scene, {"--light", "traced", "--samples", "8", "--exposure", "0.4"}) != usual);
}

TEST_F(TracedLight, RefusesWhatDoesNotFit) {
    const std::string scene = ball();
    const auto refused = [&](std::vector<std::string> more, const std::vector<std::string>& words) {
        more.insert(more.begin(), {"render", scene, "--out", "a.png"});
        expectRefused(more, words);
    };
    refused({"--light", "traced", "--samples", "0"}, {"--samples", "got \"0\""});
    refused({"--light", "traced", "--method", "linear"}, {"--method", "linear", "traced"});
    refused({"--light", "traced", "--quality", "0.5"}, {"--quality", "traced"});
    refused({"--light", "traced", "--point-light", "1,2"}, {"--point-light", "x,y,z", "1,2"});
    refused({"--light", "traced", "--point-light", "centreline"}, {"--point-light", "centreline"});
    refused({"--light", "traced", "--turn", "5"}, {"--light", "--turn"});
    refused({"--light", "traced", "--opacity", "0.5"}, {"opaque", "--opacity"});
    refused({"--light", "traced", "--sky", "none.hdr"}, {"none.hdr"});
    refused({"--samples", "4"}, {"--samples", "--light traced"});
    expectRefused({"play", scene, "--light", "traced", "--out", "a"}, {"traced", "render"});
    expectRefused({"render", "terrain", "--light", "traced", "--out", "a.png"}, {"traced", "colon"});
    expectRefused({"render", "cloud", "--light", "traced", "--out", "a.png"}, {"traced", "CT study"});
    expectRefused({"render", maskedTube(), "--light", "traced", "--sky", "1", "--out", "a.png", "--no-cache"},
                  {"--sky", "closed", "--point-light"});
}

}  // namespace
}  // namespace stereonav::test
