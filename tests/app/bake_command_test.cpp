// `stereonav bake` of volumes through the real program: what it keeps, how it goes on, what it refuses.
#include <csignal>
#include <cstring>
#include <regex>

#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {
namespace fs = std::filesystem;

class BakeCommand : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    Outcome bake(const std::string& scene, std::vector<std::string> options) const {
        options.insert(options.begin(), {"bake", scene});
        return run(options);
    }
    void expectBakeRefused(const std::string& scene, const std::vector<std::string>& options,
                           const std::vector<std::string>& words) const {
        std::vector<std::string> arguments{"bake", scene};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expectRefused(arguments, words);
    }
    fs::path outFile() const { return mFolder / "out.bake"; }
    static bool has(const std::string& text, const std::string& words) {
        return text.find(words) != std::string::npos;
    }
};

TEST_F(BakeCommand, KeepsItInTheCacheAndFindsItAgain) {
    const std::string scene = ball();
    const Outcome first = bake(scene, {"--samples", "16"});
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_TRUE(has(first.out, "irradiance of ")) << first.out;
    EXPECT_TRUE(has(first.out, "16 samples each, error "));
    EXPECT_TRUE(has(first.out, "lit by a white sky"));
    int files = 0;
    for (const auto& entry : fs::directory_iterator(mFolder / "cache" / "stereonav"))
        files += entry.path().extension() == ".bake";
    EXPECT_EQ(files, 1);
    const Outcome again = bake(scene, {"--samples", "16"});
    EXPECT_TRUE(has(again.out, "nothing was to be done")) << again.out;
    const Outcome more = bake(scene, {"--samples", "32"});
    EXPECT_TRUE(has(more.out, "32 samples each")) << more.out;
    const Outcome other = bake(scene, {"--samples", "16", "--sky", "0.2,0.3,0.5"});
    EXPECT_TRUE(has(other.out, "16 samples each")) << "another light is another bake";
}

// Parts, threads and places make no difference.
TEST_F(BakeCommand, SameBytesInOneRunOrSeveralOnAnyThreadCount) {
    const std::string scene = ball();
    for (const std::string what : {"irradiance", "transfer", "openness"}) {
        std::vector<std::string> contents;
        for (const std::string threads : {"1", "3"}) {
            const std::string file = (mFolder / (what + threads + ".bake")).string();
            const std::vector<std::string> same{"--what", what, "--threads", threads,
                                                "--out",  file, "--samples"};
            const auto with = [&](const std::string& samples) {
                std::vector<std::string> options = same;
                options.push_back(samples);
                return options;
            };
            ASSERT_EQ(bake(scene, with(threads == "1" ? "128" : "200")).status, 0);
            ASSERT_EQ(bake(scene, with("200")).status, 0);
            // The estimate for transfer depends on the parts: only its sums are compared.
            contents.push_back(contentOf(file));
        }
        ASSERT_EQ(contents[0].size(), contents[1].size());
        ASSERT_GT(contents[0].size(), 232u);
        std::uint64_t bricks = 0;
        std::memcpy(&bricks, contents[0].data() + 184, 8);
        const std::size_t sums = 232 + 88 * bricks;
        ASSERT_LT(sums, contents[0].size());
        EXPECT_EQ(contents[0].substr(sums), contents[1].substr(sums)) << what;
    }
}

TEST_F(BakeCommand, InterruptedItKeepsWhatIsDoneAndGoesOn) {
    const std::string scene = ball();
    setenv("STEREONAV_PROGRESS_SECONDS", "0.1", 1);
    const pid_t child = start({"bake", scene, "--minutes", "1000", "--resolution", "2", "--out", outFile()});
    unsetenv("STEREONAV_PROGRESS_SECONDS");
    const std::regex some("[1-9][0-9]* samples a texel");
    EXPECT_TRUE(
        waitFor([&] { return std::regex_search(contentOf(mFolder / "stderr"), some) || hasEnded(child); }));
    kill(child, SIGINT);
    const Outcome stopped = awaitStopped(child);
    EXPECT_EQ(stopped.status, 1);
    EXPECT_TRUE(has(stopped.err, "stopped; what is done is kept")) << stopped.err;
    ASSERT_TRUE(fs::exists(outFile()));
    const Outcome next = bake(scene, {"--samples", "8", "--resolution", "2", "--out", outFile()});
    EXPECT_EQ(next.status, 0) << next.err;
    EXPECT_FALSE(has(next.err, "baked again")) << next.err;
}

TEST_F(BakeCommand, DamagedAndForeignBakesAreNamedAndMadeAnew) {
    const std::string scene = ball();
    ASSERT_EQ(bake(scene, {"--samples", "16", "--out", outFile()}).status, 0);
    const std::string whole = contentOf(outFile());
    std::string damaged = whole;
    damaged[damaged.size() - 9] ^= 1;
    for (const std::string& bytes : {damaged, whole.substr(0, whole.size() / 2), std::string("SNLIGHT\nx")}) {
        std::ofstream(outFile(), std::ios::binary) << bytes;
        const Outcome outcome = bake(scene, {"--samples", "16", "--out", outFile()});
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(linesIn(outcome.err), 1) << outcome.err;
        EXPECT_TRUE(has(outcome.err, "out.bake: is ")) << outcome.err;
        EXPECT_TRUE(has(outcome.err, "baked again"));
        EXPECT_EQ(contentOf(outFile()), whole);
    }
    const Outcome other = bake(scene, {"--samples", "16", "--bounces", "1", "--out", outFile()});
    EXPECT_TRUE(has(other.err, "the bake of something else")) << other.err;
    EXPECT_EQ(other.status, 0);
}

TEST_F(BakeCommand, WhatIsNoBakeIsNotWrittenOver) {
    const std::string photo = input("photo.jpg", "a photograph");
    expectBakeRefused(ball(), {"--out", photo}, {"--out", "photo.jpg", "no bake"});
    EXPECT_EQ(contentOf(photo), "a photograph");
    expectBakeRefused(ball(), {"--out", mFolder.string()}, {"--out", "folder"});
    expectBakeRefused(ball(), {"--out", photo + "/x.bake"}, {"--out"});
}

TEST_F(BakeCommand, StopsAtTheErrorAskedFor) {
    const Outcome outcome = bake(ball(), {"--error", "0.05", "--light", "0.2,0,0.1"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::size_t at = outcome.out.find("error ");
    ASSERT_NE(at, std::string::npos) << outcome.out;
    EXPECT_LE(std::stod(outcome.out.substr(at + 6)), 5.0);
}

TEST_F(BakeCommand, OfAColonOnlyTheWallLitAlongTheCentreline) {
    const Outcome outcome =
        bake(maskedTube(), {"--samples", "8", "--bounces", "1", "--light", "centreline,0.01"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "irradiance of ")) << outcome.out;
    const int texels = std::stoi(outcome.out.substr(outcome.out.find(" of ") + 4));
    EXPECT_GT(texels, 100);
    EXPECT_LT(texels, 24 * 24 * 24 / 2);
    expectBakeRefused(maskedTube(), {"--what", "transfer"}, {"--what", "transfer", "closed"});
    expectBakeRefused(maskedTube(), {"--reach", "0"}, {"--reach", "more than 0 and at most 1e12 mm"});
    const Outcome open = bake(maskedTube(), {"--what", "openness", "--samples", "8"});
    EXPECT_EQ(open.status, 0) << open.err;
    EXPECT_TRUE(has(open.out, "no wall within ")) << open.out;
    expectBakeRefused(maskedTube(), {"--sky", "1"}, {"--sky", "closed"});
    expectBakeRefused(maskedTube(), {"--full"}, {"--full", "colon"});
    expectBakeRefused(maskedTube(), {"--isovalues", "1,2"}, {"--isovalues", "colon"});
    expectBakeRefused(maskedTube(), {"--light", "centreline,5"}, {"--light", "smaller distance"});
}

TEST_F(BakeCommand, MoreSurfacesWantMoreTexels) {
    const auto texels = [&](std::vector<std::string> options) {
        options.insert(options.end(), {"--samples", "1"});
        const Outcome outcome = bake(ball(), options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        const std::size_t at = outcome.out.find(" of ");
        return at == std::string::npos ? 0 : std::stoi(outcome.out.substr(at + 4));
    };
    const int one = texels({"--isovalue", "500"}), some = texels({"--isovalues", "400,600"}),
              all = texels({"--full"});
    EXPECT_GT(one, 100);
    EXPECT_GT(some, one);
    EXPECT_GT(all, some);
    // Volumes seen from outside get a border of a voxel.
    EXPECT_EQ(all, 26 * 26 * 26);
    EXPECT_EQ(texels({"--full", "--resolution", "2"}), 51 * 51 * 51);
    EXPECT_EQ(texels({"--full", "--resolution", "0.5"}), 14 * 14 * 14);
}

TEST_F(BakeCommand, RefusesLimitsThatCanNotBe) {
    const std::string scene = ball();
    for (const std::string bad : {"-1", "0", "1e9", "many"})
        expectBakeRefused(scene, {"--samples", bad}, {"--samples"});
    for (const std::string bad : {"-1", "0", "1", "nan", "x"})
        expectBakeRefused(scene, {"--error", bad}, {"--error"});
    for (const std::string bad : {"-1", "0", "inf", "x"})
        expectBakeRefused(scene, {"--minutes", bad}, {"--minutes"});
    expectBakeRefused(scene, {"--samples", "9", "--error", "0.1"}, {"--samples, --error and --minutes"});
    expectBakeRefused(scene, {"--samples", "9", "--minutes", "1"}, {"--samples, --error and --minutes"});
    expectBakeRefused(scene, {"--error", "0.1", "--minutes", "1"}, {"--samples, --error and --minutes"});
}

TEST_F(BakeCommand, RefusesLightsThatCanNotBe) {
    const std::string scene = ball();
    expectBakeRefused(scene, {"--what", "radiosity"},
                      {"--what", "radiosity", "irradiance, transfer or openness"});
    expectBakeRefused(scene, {"--probe", "nowhere.hdr"}, {"nowhere.hdr"});
    expectBakeRefused(scene, {"--probe", input("letter.hdr", "Dear reader")}, {"letter.hdr"});
    for (const std::string bad : {"-1", "1,2", "x", "1,2,nan", "1,2,3,"})
        expectBakeRefused(scene, {"--sky", bad}, {"--sky"});
    for (const std::string bad : {"1,2", "1,2,3,-4", "1,2,3,0", "x,y,z", "1,2,3,4,5"})
        expectBakeRefused(scene, {"--light", bad}, {"--light"});
    expectBakeRefused(scene, {"--light", "centreline"}, {"--light", "expected a colon"});
    expectBakeRefused(scene, {"--light", "centreline,0"}, {"--light", "distance"});
    for (const std::string bad : {"-0.1", "1.1", "x", "0.5,0.5"})
        expectBakeRefused(scene, {"--albedo", bad}, {"--albedo"});
    for (const std::string bad : {"-1", "9", "x"})
        expectBakeRefused(scene, {"--bounces", bad}, {"--bounces"});
    expectBakeRefused(scene, {"--what", "transfer", "--sky", "1"}, {"--sky", "transfer"});
    expectBakeRefused(scene, {"--what", "openness", "--bounces", "1"}, {"--bounces", "openness"});
    expectBakeRefused(scene, {"--order", "5"}, {"--order", "transfer"});
    for (const std::string bad : {"0", "7"})
        expectBakeRefused(scene, {"--what", "transfer", "--order", bad}, {"--order", "1 to 6"});
}

TEST_F(BakeCommand, RefusesSurfacesThatCanNotBe) {
    const std::string scene = ball();
    for (const std::string bad : {"0", "-1", "9", "nan"})
        expectBakeRefused(scene, {"--resolution", bad}, {"--resolution"});
    for (const std::string bad : {"1", "2,1", "x,y", "1,2,3"})
        expectBakeRefused(scene, {"--isovalues", bad}, {"--isovalues"});
    expectBakeRefused(scene, {"--isovalues", "5000,6000"}, {"--isovalues", "no surface"});
    expectBakeRefused(scene, {"--isovalues", "1,2", "--isovalue", "100"}, {"--isovalues"});
    expectBakeRefused(scene, {"--isovalues", "1,2", "--full"}, {"--full"});
    expectBakeRefused(scene, {"--no-cache"}, {"--no-cache", "--out"});
    expectBakeRefused("nowhere.nrrd", {}, {"nowhere.nrrd"});
}

}  // namespace
}  // namespace stereonav::test
