// A study in a window: it is flown through, its slices are shown, a click takes a piece and the colon is
// found again from it; a volume seen from outside moves its surface.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "tests/support/byte_study.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

class VolumeWindow : public WindowTest {
protected:
    // 48 voxels of 1 mm along each axis, the middle at 0, as a NRRD file of bytes.
    fs::path study(const std::function<int(double x, double y, double z)>& value) const {
        return test::writeByteStudy(mFolder / "study.nrrd", glm::ivec3(48), glm::dvec3(-23.5),
                                    [&](int i, int j, int k) { return value(i - 23.5, j - 23.5, k - 23.5); });
    }

    // Eyes that are given do not follow the room, which takes long to come to rest.
    std::map<std::string, Picture> shotsOf(const std::string& arguments) {
        EXPECT_EQ(drive("drive_volume.sh", arguments + " --separation 0.001 --zero-parallax 0.03"), 0)
            << textOf("problems.txt") << textOf("log.txt");
        EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
        std::map<std::string, Picture> shots;
        for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
        return shots;
    }
};

// Greenish pixels: crosses of pieces that are taken.
int crossPixels(const Picture& picture) {
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width() / 2; ++x) {
            const PackedColor c = picture.at(x, y);
            count += byteOf(c, 1) > 200 && byteOf(c, 0) < 150 && byteOf(c, 2) < 150;
        }
    return count;
}

TEST_F(VolumeWindow, FliesThroughAColonAndTakesAPiece) {
    // A tube with folds, 14 to 18 mm wide; beside it a rod of 0.4 ml, which is left out as a speck.
    const fs::path tube = study([](double x, double y, double z) {
        if (std::abs(z) >= 21) return 0;
        return std::hypot(x, y) < 8 + std::sin(z) || std::hypot(x - 17, y) < 1.5 ? 1 : 0;
    });
    auto shots = shotsOf("'" + tube.string() + "'");
    ASSERT_EQ(shots.size(), 10u);
    EXPECT_GT(difference(shots["start"], shots["flown"]), kDifferent);
    EXPECT_GT(difference(shots["surface"], shots["translucent"]), kDifferent);
    // Both eyes see the same slice; it is black, white and marks.
    EXPECT_LT(difference(shots["axial"], 0, 0, shots["axial"], 320, 0, 320, 240), 1e-9);
    EXPECT_GT(difference(shots["translucent"], shots["axial"]), kDifferent);
    EXPECT_EQ(crossPixels(shots["axial"]), 0);
    EXPECT_GT(crossPixels(shots["chosen"]), 20);
    EXPECT_LT(crossPixels(shots["paged"]), crossPixels(shots["chosen"])) << "dim in another slice";
    EXPECT_GT(difference(shots["axial"], shots["coronal"]), kDifferent);
    // The click was 85 pixels right of the middle of the left eye's picture, 240 pixels for 48 mm.
    const std::string log = textOf("log.txt");
    const std::size_t at = log.find("--include ");
    ASSERT_NE(at, std::string::npos) << log;
    double place[3] = {};
    ASSERT_EQ(std::sscanf(log.c_str() + at, "--include %lf,%lf,%lf", &place[0], &place[1], &place[2]), 3)
        << log;
    EXPECT_NEAR(place[0], 17, 0.5);
    EXPECT_NEAR(place[1], 0, 0.5);
    EXPECT_LT(std::abs(place[2]), 24);
    // Found again with the rod: where the flight is nothing changed, so it goes on.
    EXPECT_LT(difference(shots["surface"], shots["back"]), kDifferent);
}

TEST_F(VolumeWindow, MovesASurfaceSeenFromOutside) {
    const fs::path ball = study([](double x, double y, double z) {
        return std::clamp(static_cast<int>(250 - 10 * std::hypot(x, y, z)), 0, 250);
    });
    auto shots = shotsOf("'" + ball.string() + "' --isosurface --isovalue 100");
    ASSERT_EQ(shots.size(), 9u);
    EXPECT_GT(difference(shots["flown"], shots["surface"]), 0.3)
        << "eight steps of a hundredth: a smaller ball";
    EXPECT_LT(difference(shots["axial"], 0, 0, shots["axial"], 320, 0, 320, 240), 1e-9);
}

}  // namespace
}  // namespace stereonav
