// What a command will hold is held against what can be had before it is taken: one line with what would fit.
// STEREONAV_MEMORY says how much that is.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "tests/app/asked_memory.h"
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
    // Bytes that no file backs, at most while a command ran, and what it had and asked for at most; the most
    // but for that.
    struct Taken {
        double most = 0, asked = 0, askedElse = 0;
    };
    Taken taking(const std::vector<std::string>& arguments) const {
        const std::string file = (mFolder / "asked").string();
        std::filesystem::remove(file);
        std::optional<AskedMemory> noted(file);
        const pid_t child = start(arguments);
        noted.reset();
        Taken taken;
        siginfo_t ended{};
        while (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
               ended.si_pid == 0) {
            std::ifstream status("/proc/" + std::to_string(child) + "/status");
            for (std::string line; std::getline(status, line);)
                if (line.rfind("RssAnon:", 0) == 0)
                    taken.most = std::max(taken.most, 1024 * std::atof(line.c_str() + 8));
            usleep(1000);
        }
        const Outcome outcome = await(child);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        std::ifstream lines(file);
        for (double had = 0, bytes = 0; lines >> had >> bytes;) {
            taken.askedElse = std::max(taken.askedElse, std::min(taken.asked, had + bytes));
            taken.asked = std::max(taken.asked, had + bytes);
        }
        return taken;
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
    allow("3e7");  // 160^3 voxels of 2 bytes are 8.2 MB; a surface takes 43 MB
    expectTooMuch({study, "--isosurface"},
                  {"ct.nrrd", "160 x 160 x 160 voxels need 43 MB of memory", "would fit"});
    allow("8e6");
    expectTooMuch({study}, {"ct.nrrd", "160 x 160 x 160 voxels need 8.19 MB", "would fit"});
    allow("2e9");
    EXPECT_EQ(run({"render", study, "--isosurface", "--size", "32x24", "--out", "out.png"}).status, 0);
}

TEST_F(Memory, OfCellsIsCheckedWhenTheyAreCounted) {
    const std::string study = nrrd("ct.nrrd", {96, 96, 96, 1, "short", ""},
                                   [](int i, int j, int k) { return (i + j + k) % 3 * 250; });  // all surface
    // Bricks of 16^3 cells have a number for each of 17^3 corners; those at the border, which stand half
    // empty, are more than the volume's size tells.
    const Taken taken = taking({"render", study, "--look", "plain", "--isosurface", "--isovalue", "300",
                                "--size", "32x24", "--out", "a.png"});
    ASSERT_GT(taken.asked, taken.askedElse + 4e5);
    std::filesystem::remove(place() / "a.png");
    allow(std::to_string((taken.asked + taken.askedElse) / 2).c_str());
    expectTooMuch({study, "--look", "plain", "--isosurface", "--isovalue", "300"},
                  {"a surface of ", "choose another isovalue"});
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
    const Outcome tiled = run({"render", ground, "--size", "32x24", "--out", "out.png"});
    EXPECT_EQ(tiled.status, 0) << "goes into tiles; " << tiled.err;
    const Outcome outcome = run({"render", ground, "--tiles", "off", "--size", "32x24", "--out", "out.png"});
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
    const Outcome fits = run({"render", smaller, "--tiles", "off", "--size", "32x24", "--out", "out.png"});
    EXPECT_EQ(fits.status, 0) << fits.err;
}

TEST_F(Memory, OfAMeshIsCheckedWhileItGrows) {
    const std::string ground = grid("rough.asc", 1000, 1000, 30.0,
                                    [](int i, int j) { return (i * 7919 + j * 104729 + i * j * 31) % 997; });
    allow("1.1e8");
    expectRefused({"mesh", ground, "--error", "0", "--out", "a.glb"}, {"a mesh of", "larger --error"});
}

TEST_F(Memory, OfPicturesIsCheckedBesideTheScene) {
    const std::string ground = grid("large.asc", 1500, 1500, 30.0, [](int i, int j) { return (i * j) % 7; });
    const auto render = [&](const char* size) {
        return run({"render", ground, "--look", "plain", "--size", size, "--out", "out.png"});
    };
    allow("1.5e8");  // the ground takes 141 MB while it is read, then 60 MB
    const Outcome small = render("32x24");
    EXPECT_EQ(small.status, 0) << small.err;
    const Outcome both = render("1400x1400");  // 118 MB
    EXPECT_EQ(both.status, 1);
    EXPECT_NE(both.err.find("--size: 1400x1400 needs 118 MB"), std::string::npos) << both.err;
    allow("2.4e8");
    const Outcome fits = render("1400x1400");
    EXPECT_EQ(fits.status, 0) << fits.err;
}

// --memory is the limit that is told, before anything of the scene is read.
TEST_F(Memory, ThatWasGivenAsAnOptionIsWhatIsTold) {
    for (const char* size : {"3000x3000", "32768x32768"})
        expectRefused({"render", "--memory", "300M", "--size", size, "--out", "a.png"},
                      {std::string("--size: ") + size + " needs ", " of memory, and ", " MB is available",
                       " would fit"});
    expectRefused({"render", "--memory", "300M", "--size", "3000x3000", "--out", "a.png"},
                  {"needs 540 MB of memory"});
    expectRefused({"render", "--memory", "300M", "--size", "3000x3000", "--out", "a.webp"},
                  {"needs 972 MB of memory"});
}

// What is asked for is what is taken: 60 bytes a pixel where rays are cast, and of no kind of file so much
// more that what fits would be refused.
TEST_F(Memory, OfPicturesIsWhatTheirFileTakes) {
    for (const char* file : {"a.png", "a.jpg", "a.tif", "a.bmp", "a.webp", "a.jp2", "a.jps", "a.mpo"}) {
        const Taken taken = taking({"render", ball(), "--isosurface", "--size", "1500x1200", "--out", file});
        SCOPED_TRACE(fmt::format("{}: {:.0f} MB taken, {:.0f} MB asked for", file, taken.most / 1e6,
                                 taken.asked / 1e6));
        EXPECT_LE(taken.most, taken.asked + 2e7);
        const bool whole = std::string(file) == "a.webp" || std::string(file) == "a.jp2";
        EXPECT_NEAR(taken.asked, 1500 * 1200 * (whole ? 108.0 : 60.0), 20e6);
        std::filesystem::remove(place() / file);
    }
}

TEST_F(Memory, OfPicturesIsNotAskedForWhereNoneAreMade) {
    const std::string ground = hills();
    allow("6e7");  // less than 1280x720 pixels take
    expectRefused({"render", ground, "--out", "a.png"}, {"--size", "1280x720"});
    const Outcome mesh = run({"mesh", ground, "--out", "a.glb"});
    EXPECT_EQ(mesh.status, 0) << mesh.err;
    const Outcome bake = run({"bake", ground, "--what", "openness", "--out", "a.light"});
    EXPECT_EQ(bake.status, 0) << bake.err;
}

TEST_F(Memory, OfAMeshsFileIsChecked) {
    const std::string ground = grid("flat.asc", 1500, 1500, 30.0, [](int i, int) { return i; });
    allow("1.5e8");  // two triangles; the picture of the ground is larger
    expectRefused({"mesh", ground, "--out", "a.glb"}, {"a.glb", "needs", "of memory"});
}

TEST_F(Memory, OfAMediumsLightIsChecked) {
    allow("4e8");
    expectRefused({"render", "wax", "--size", "32x24", "--light-size", "4096", "--out", "a.png"},
                  {"light in a medium", "4096 x ", "--light-size"});
}

TEST_F(Memory, OfAKeptColonIsChecked) {
    const std::string mask = nrrd("mask.nrrd", {200, 200, 200, 1, "uchar", ""}, [](int i, int j, int k) {
        return i > 2 && j > 2 && k > 2 && i < 197 && j < 197 && k < 197 ? 1 : 0;
    });
    const std::vector<std::string> render{"render", mask, "--size", "32x24", "--out", "out.png"};
    const Outcome first = run(render);
    ASSERT_EQ(first.status, 0) << first.err;
    std::filesystem::remove(place() / "out.png");
    allow("5e7");
    expectRefused(render, {"a colon of 200 x 200 x 200 voxels", "of memory"});
}

// A surface in a volume this large is found in blocks. 20 MB are the program's own.
TEST_F(Memory, OfALargeSurfaceIsNoMoreThanWasAskedFor) {
    const std::string study = nrrd("ct.nrrd", {330, 330, 320, 1, "short", ""}, [](int i, int j, int k) {
        return 1000 - 7 * std::max({std::abs(i - 165), std::abs(j - 165), std::abs(k - 160)});
    });
    const Taken taken =
        taking({"render", study, "--isosurface", "--isovalue", "100", "--size", "64x64", "--out", "a.png"});
    const double samples = 2.0 * 330 * 330 * 320;
    EXPECT_GT(taken.most, samples);
    EXPECT_LT(taken.most, taken.asked + 2e7);
}

// A bake's paths leap over fields of blocks, one for each isovalue that is lit: most of what a whole bake of
// a large volume takes. 20 MB are the program's own.
TEST_F(Memory, OfABakeIsNoMoreThanWasAskedFor) {
    const std::string study = nrrd("ct.nrrd", {160, 160, 160, 1, "short", ""}, [](int i, int j, int k) {
        return std::max(0.0, 1000 - 12 * std::hypot(i - 79.5, j - 79.5, k - 79.5));
    });
    for (const bool full : {true, false}) {
        SCOPED_TRACE(full);
        std::vector<std::string> bake{"bake", study, "--isosurface", "--resolution", "0.25"};
        bake.insert(bake.end(), {"--samples", "1", "--out", full ? "full.light" : "a.light"});
        if (full) bake.emplace_back("--full");
        const Taken taken = taking(bake);
        EXPECT_GT(taken.most, 3e7);
        EXPECT_LT(taken.most, taken.asked + 2e7);
    }
}

// A video's codec holds frames that it looks ahead at, and room for the largest one that could come out.
TEST_F(Memory, OfVideosIsNoMoreThanWasAskedFor) {
    for (const char* file : {"a.mp4", "a.mkv"}) {
        SCOPED_TRACE(file);
        const Taken taken = taking({"play", "--size", "640x360", "--frames", "20", "--video", file});
        EXPECT_GT(taken.most, 3e7);
        EXPECT_LT(taken.most, taken.asked);
    }
}

// What the program asks for is what it takes: the most it had asked for, with what it held then.
TEST_F(Memory, AskedForIsNoted) {
    const std::string ground = hills(), asked = (mFolder / "asked").string();
    const Outcome outcome = [&] {
        const AskedMemory noted(asked);
        return run({"render", ground, "--size", "500x400", "--out", "a.png"});
    }();
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    std::ifstream lines(asked);
    double taken = 0, bytes = 0, most = 0;
    while (lines >> taken >> bytes) {
        EXPECT_GT(taken, 1e5);
        most = std::max(most, bytes);
    }
    EXPECT_GE(most, 60.0 * 500 * 400);
}

// The variable names a file that is open to be added to, and nothing else: neither a path, nor what is
// written or read otherwise, gets a line.
TEST_F(Memory, AskedForGoesIntoNoOtherFile) {
    const std::string ground = hills(), victim = input("victim", "as it was");
    const auto runWith = [&](const std::string& value) {
        setenv("STEREONAV_MEMORY_ASKED", value.c_str(), 1);
        const Outcome outcome = run({"render", ground, "--size", "500x400", "--out", "a.png"});
        unsetenv("STEREONAV_MEMORY_ASKED");
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    };
    runWith(victim);
    runWith((mFolder / "new").string());
    for (const int how : {O_WRONLY, O_RDWR, O_RDWR | O_APPEND}) {
        const int file = open(victim.c_str(), how);
        runWith(std::to_string(file));
        close(file);
    }
    for (const char* none : {"1", "2", "-1", "", "9x", "1000"}) runWith(none);
    EXPECT_EQ(contentOf(victim), "as it was");
    EXPECT_FALSE(std::filesystem::exists(mFolder / "new"));
}

TEST_F(Memory, ThatIsNoNumberIsRefused) {
    const std::string ground = hills();
    allow("much");
    expectRefused({"render", ground, "--size", "3200x2400", "--out", "a.png"}, {"STEREONAV_MEMORY", "much"});
}

}  // namespace
}  // namespace stereonav::test
