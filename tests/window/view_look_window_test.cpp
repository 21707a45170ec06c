// A volume in a window whose look is changed by keys: its file is gone meanwhile, so that nothing can be read
// again; what is gone back to looks as it did.
#include <algorithm>
#include <cmath>

#include "tests/support/byte_study.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

class LookWindowNightly : public WindowTest {
protected:
    // Two balls that touch, 48 voxels of 1 mm along each axis.
    fs::path study() const {
        return test::writeByteStudy(
            mFolder / "study.nrrd", glm::ivec3(48), glm::dvec3(-23.5), [](int i, int j, int k) {
                const double away = std::min(std::hypot(i - 14.5, j - 23.5, k - 23.5),
                                             std::hypot(i - 32.5, j - 23.5, k - 23.5));
                return std::clamp(static_cast<int>(340 - 24 * away), 0, 200);
            });
    }
    std::map<std::string, Picture> shotsOf(const std::string& options) {
        const std::string moved = (mFolder / "moved.nrrd").string();
        const std::string eyes = " --isosurface --isovalue 120 --separation 0.004 --zero-parallax 0.15 ";
        EXPECT_EQ(drive("drive_look.sh", "'" + study().string() + "' '" + moved + "'" + eyes + options), 0)
            << textOf("problems.txt") << textOf("log.txt");
        EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
        std::map<std::string, Picture> shots;
        for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
        return shots;
    }
};

TEST_F(LookWindowNightly, ChangesWithoutReadingAgain) {
    auto shots = shotsOf("--opacity 0.1");
    ASSERT_EQ(shots.size(), 14u);
    EXPECT_GT(difference(shots["start"], shots["surface"]), 0.3);
    EXPECT_LT(difference(shots["start"], shots["back"]), 1e-9);
    EXPECT_GT(difference(shots["back"], shots["ambient"]), kDifferent);
    EXPECT_GT(difference(shots["ambient"], shots["method"]), 0.03);
    EXPECT_GT(difference(shots["method"], shots["radius"]), 0.03);
    EXPECT_LT(difference(shots["lamp"], shots["start"]), 1e-9);
    EXPECT_GT(difference(shots["lamp"], shots["translucent"]), 0.3);
    EXPECT_GT(difference(shots["translucent"], shots["variance"]), 0.1);
    EXPECT_GT(difference(shots["variance"], shots["sigma"]), 0.1) << "less stays whole";
    EXPECT_GT(difference(shots["sigma"], shots["gradient"]), 0.1);
    EXPECT_LT(difference(shots["whole"], shots["translucent"]), 1e-9);
    EXPECT_LT(difference(shots["opaque"], shots["start"]), 1e-9);
}

// Light that was worked out stays where it is when the surface moves away and comes back.
TEST_F(LookWindowNightly, LazyLightStaysAndGoesOn) {
    auto shots = shotsOf("--light lazy");
    ASSERT_EQ(shots.size(), 14u);
    EXPECT_GT(difference(shots["start"], shots["surface"]), 0.3);
    EXPECT_LT(difference(shots["start"], shots["back"]), kSame);
    EXPECT_LT(difference(shots["back"], shots["ambient"]), kSame) << "baked light takes its place";
    EXPECT_LT(difference(shots["back"], shots["opaque"]), kSame) << "it is of an opaque surface";
}

}  // namespace
}  // namespace stereonav
