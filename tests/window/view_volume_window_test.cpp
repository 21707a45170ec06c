// A study in a window: it is flown through, its slices are shown, a click sets a seed and the colon is found
// again from it; a volume seen from outside moves its surface.
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

// Greenish pixels: crosses of seeds.
int crossPixels(const Picture& picture) {
    int count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width() / 2; ++x) {
            const PackedColor c = picture.at(x, y);
            count += byteOf(c, 1) > 200 && byteOf(c, 0) < 150 && byteOf(c, 2) < 150;
        }
    return count;
}

TEST_F(VolumeWindow, FliesThroughAColonAndTakesASeed) {
    // A tube with folds, 14 to 18 mm wide.
    const fs::path tube = study([](double x, double y, double z) {
        return std::hypot(x, y) < 8 + std::sin(z) && std::abs(z) < 21 ? 1 : 0;
    });
    auto shots = shotsOf("'" + tube.string() + "'");
    ASSERT_EQ(shots.size(), 10u);
    EXPECT_GT(difference(shots["start"], shots["flown"]), kDifferent);
    EXPECT_GT(difference(shots["surface"], shots["translucent"]), kDifferent);
    // Both eyes see the same slice; it is black, white and marks.
    EXPECT_LT(difference(shots["axial"], 0, 0, shots["axial"], 320, 0, 320, 240), 1e-9);
    EXPECT_GT(difference(shots["translucent"], shots["axial"]), kDifferent);
    EXPECT_EQ(crossPixels(shots["axial"]), 0);
    EXPECT_GT(crossPixels(shots["seeded"]), 20);
    EXPECT_LT(crossPixels(shots["paged"]), crossPixels(shots["seeded"])) << "dim in another slice";
    EXPECT_GT(difference(shots["axial"], shots["coronal"]), kDifferent);
    // The click was in the middle of the left eye's picture, 240 pixels for 48 mm.
    const std::string log = textOf("log.txt");
    const std::size_t at = log.find("--seed ");
    ASSERT_NE(at, std::string::npos) << log;
    double seed[3] = {};
    ASSERT_EQ(std::sscanf(log.c_str() + at, "--seed %lf,%lf,%lf", &seed[0], &seed[1], &seed[2]), 3) << log;
    EXPECT_NEAR(seed[0], 0, 0.5);
    EXPECT_NEAR(seed[1], 0, 0.5);
    EXPECT_LT(std::abs(seed[2]), 24);
    // Found again from the seed: the same lumen, so the flight goes on where it was.
    EXPECT_LT(difference(shots["surface"], shots["back"]), kDifferent);
}

TEST_F(VolumeWindow, MovesASurfaceSeenFromOutside) {
    const fs::path ball = study([](double x, double y, double z) {
        return std::clamp(static_cast<int>(250 - 10 * std::hypot(x, y, z)), 0, 250);
    });
    auto shots = shotsOf("'" + ball.string() + "' --isosurface --isovalue 100");
    ASSERT_EQ(shots.size(), 10u);
    EXPECT_GT(difference(shots["flown"], shots["surface"]), 0.3)
        << "eight steps of a hundredth: a smaller ball";
    EXPECT_LT(difference(shots["axial"], 0, 0, shots["axial"], 320, 0, 320, 240), 1e-9);
}

}  // namespace
}  // namespace stereonav
