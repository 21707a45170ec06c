// What a command will hold is held against what can be had before it is taken: one line with what would fit.
// STEREONAV_MEMORY says how much that is.
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

class Memory : public VolumeTest {
protected:
    void TearDown() override {
        unsetenv("STEREONAV_MEMORY");
        VolumeTest::TearDown();
    }
    static void allow(const char* bytes) { setenv("STEREONAV_MEMORY", bytes, 1); }
    void expectTooMuch(const std::vector<std::string>& scene, const std::vector<std::string>& words) const {
        std::vector<std::string> arguments{"render"};
        arguments.insert(arguments.end(), scene.begin(), scene.end());
        arguments.insert(arguments.end(), {"--size", "32x24", "--out", "out.png"});
        expectRefused(arguments, words);
    }
    // The first two numbers around " x " in the words before "would fit".
    static std::pair<int, int> fitting(const std::string& line) {
        const std::size_t end = line.find(" would fit"), times = line.rfind(" x ", end);
        std::size_t start = times;
        while (start > 0 && std::isdigit(static_cast<unsigned char>(line[start - 1]))) --start;
        return {std::atoi(line.c_str() + start), std::atoi(line.c_str() + times + 3)};
    }
};

TEST_F(Memory, OfAStudyIsCheckedByItsHeader) {
    const std::string study = nrrd("ct.nrrd", {160, 160, 160, 1, "short", ""},
                                   [](int i, int j, int k) { return (i * j + k) % 500; });
    allow("3e7");  // 160^3 voxels of 2 bytes, twice, are 16.4 MB; a surface takes 47 MB
    expectTooMuch({study, "--isosurface"},
                  {"ct.nrrd", "160 x 160 x 160 voxels need 47.1 MB of memory", "would fit"});
    allow("1.8e7");
    expectTooMuch({study}, {"ct.nrrd", "160 x 160 x 160 voxels need 16.4 MB", "would fit"});
    allow("2e9");
    EXPECT_EQ(run({"render", study, "--isosurface", "--size", "32x24", "--out", "out.png"}).status, 0);
}

TEST_F(Memory, OfCellsIsCheckedWhenTheyAreCounted) {
    const std::string study = nrrd("ct.nrrd", {96, 96, 96, 1, "short", ""},
                                   [](int i, int j, int k) { return (i + j + k) % 3 * 250; });  // all surface
    allow("6e7");  // 884,736 voxels: 10 MB before; then 912,673 cells of 64 bytes
    expectTooMuch({study, "--isosurface", "--isovalue", "300"}, {"a surface of ", "choose another isovalue"});
}

TEST_F(Memory, OfALumenIsCheckedByItsBox) {
    const std::string mask = nrrd("mask.nrrd", {200, 200, 200, 1, "uchar", ""}, [](int i, int j, int k) {
        return i > 2 && j > 2 && k > 2 && i < 197 && j < 197 && k < 197 ? 1 : 0;
    });
    allow("5e7");
    expectTooMuch({mask, "--no-cache"},
                  {"mask.nrrd", "a lumen of 200 x 200 x 200 voxels", "needs 80 MB", "--seed"});
}

TEST_F(Memory, OfGroundIsCheckedByItsHeader) {
    const std::string ground = grid("large.asc", 1500, 1500, 30.0, [](int i, int j) { return (i * j) % 7; });
    allow("6e7");  // with colours 105 MB
    const Outcome outcome = run({"render", ground, "--size", "32x24", "--out", "out.png"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("large.asc"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("1500 x 1500 samples need 1"), std::string::npos) << outcome.err;
    const auto [width, height] = fitting(outcome.err);
    EXPECT_GT(width, 300) << outcome.err;
    EXPECT_EQ(width, height);
    EXPECT_LT(width, 1400);
    // What is said to fit does.
    const std::string smaller =
        grid("small.asc", width - 20, height - 20, 30.0, [](int i, int j) { return (i * j) % 7; });
    const Outcome fits = run({"render", smaller, "--size", "32x24", "--out", "out.png"});
    EXPECT_EQ(fits.status, 0) << fits.err;
}

TEST_F(Memory, OfAMeshIsCheckedWhileItGrows) {
    const std::string ground = grid("rough.asc", 1000, 1000, 30.0,
                                    [](int i, int j) { return (i * 7919 + j * 104729 + i * j * 31) % 997; });
    allow("1.1e8");
    expectRefused({"mesh", ground, "--error", "0", "--out", "a.glb"}, {"a mesh of", "larger --error"});
}

TEST_F(Memory, ThatIsNoNumberIsRefused) {
    const std::string ground = hills();
    allow("much");
    expectRefused({"render", ground, "--size", "3200x2400", "--out", "a.png"}, {"STEREONAV_MEMORY", "much"});
}

}  // namespace
}  // namespace stereonav::test
