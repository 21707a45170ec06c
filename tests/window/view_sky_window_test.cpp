// Baked light in a window: with transfer the sky turns as --turn does, with irradiance it stays.
#include <algorithm>
#include <cmath>

#include "tests/support/byte_study.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

class SkyWindow : public WindowTest {
protected:
    void SetUp() override {
        WindowTest::SetUp();
        if (IsSkipped()) return;
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
        // A ball of 24 voxels.
        test::writeByteStudy(mFolder / "ball.nrrd", glm::ivec3(24), glm::dvec3(-11.5),
                             [](int i, int j, int k) {
                                 return std::max(0.0, 250 - 20 * std::hypot(i - 11.5, j - 11.5, k - 11.5));
                             });
        // Bright in the east (a column of the panorama), dark elsewhere.
        std::ofstream probe(mFolder / "east.hdr", std::ios::binary);
        probe << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n";
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 16; ++x) {
                const int bright = x >= 11 && x <= 12 ? 200 : 10;
                for (const int byte : {bright, bright, bright, 129}) probe.put(static_cast<char>(byte));
            }
    }
    // Eyes that are given do not follow the room.
    std::string ball() const {
        return "'" + (mFolder / "ball.nrrd").string() + "' --isosurface --isovalue 100";
    }
    static constexpr const char* kEyes = " --separation 0.002 --zero-parallax 0.06";
    std::string sky() const { return " --sky '" + (mFolder / "east.hdr").string() + "'"; }
    int run(const std::string& arguments) const {
        return std::system(
            ("'" STEREONAV_PROGRAM "' " + arguments + " >'" + (mFolder / "run.txt").string() + "' 2>&1")
                .c_str());
    }
    std::string baked(const std::string& what) const {
        const std::string file = (mFolder / (what + ".bake")).string();
        EXPECT_EQ(run("bake " + ball() + " --what " + what + " --samples 64 --out '" + file + "'"), 0)
            << textOf("run.txt");
        return " --light '" + file + "'";
    }
    std::map<std::string, Picture> shots(const std::string& arguments) {
        EXPECT_EQ(drive("drive_sky.sh", arguments), 0) << textOf("problems.txt") << textOf("log.txt");
        EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
        std::map<std::string, Picture> shots;
        for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
        return shots;
    }
};

TEST_F(SkyWindow, TurnsOverTransfer) {
    const std::string scene = ball() + baked("transfer") + sky() + " --exposure 1" + kEyes;
    auto shot = shots(scene);
    ASSERT_EQ(shot.size(), 4u);
    EXPECT_GT(difference(shot["start"], shot["turned"]), 1.0);
    EXPECT_GT(difference(shot["turned"], shot["tilted"]), 0.2);
    EXPECT_LT(difference(shot["start"], shot["reset"]), 0.01);
    // The same from a file of options.
    const fs::path rendered = mFolder / "rendered.png";
    ASSERT_EQ(run("render " + scene + " --turn 30 --size 320x240 --mode sbsl --method linear --out '" +
                  rendered.string() + "'"),
              0)
        << textOf("run.txt");
    EXPECT_LT(difference(shot["turned"], readColorImage(rendered)), 0.2);
}

TEST_F(SkyWindow, StaysOverIrradiance) {
    auto shot = shots(ball() + baked("irradiance") + kEyes);
    ASSERT_EQ(shot.size(), 4u);
    EXPECT_EQ(difference(shot["start"], shot["turned"]), 0.0);
    EXPECT_EQ(difference(shot["start"], shot["tilted"]), 0.0);
}

}  // namespace
}  // namespace stereonav
