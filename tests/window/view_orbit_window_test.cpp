// What is seen from outside is turned, zoomed and panned by mouse, in a window.
#include <algorithm>
#include <cmath>

#include "tests/support/byte_study.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

class OrbitWindow : public WindowTest {
protected:
    // Three balls of different size along the axes, 48 voxels of 1 mm, as a NRRD file.
    std::filesystem::path balls() const {
        return test::writeByteStudy(
            mFolder / "balls.nrrd", glm::ivec3(48), glm::dvec3(-23.5), [](int i, int j, int k) {
                const double x = i - 23.5, y = j - 23.5, z = k - 23.5;
                const double away = std::min({std::hypot(x, y, z) - 9, std::hypot(x - 15, y, z) - 5,
                                              std::hypot(x, y - 14, z - 10) - 3});
                return std::clamp(static_cast<int>(125 - 25 * away), 0, 250);
            });
    }
};

TEST_F(OrbitWindow, TheMouseTurnsZoomsAndPans) {
    EXPECT_EQ(drive("drive_orbit.sh",
                    "'" + balls().string() + "' --isosurface --separation 0.001 --zero-parallax 0.1"),
              0)
        << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    std::map<std::string, Picture> shots;
    for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
    ASSERT_EQ(shots.size(), 9u);
    for (const auto& [before, after] : {std::pair{"start", "turned"},
                                        {"turned", "zoomed"},
                                        {"zoomed", "panned"},
                                        {"panned", "back"},
                                        {"back", "away"},
                                        {"home", "looked"}})
        EXPECT_GT(difference(shots[before], shots[after]), kDifferent) << before << ", " << after;
    EXPECT_LT(difference(shots["zoomed"], shots["back"]), kDifferent) << "panned there and back";
    EXPECT_LT(difference(shots["turned"], shots["away"]), kDifferent) << "zoomed there and back, eyes too";
    EXPECT_LT(difference(shots["start"], shots["home"]), kSame) << "home, with the eyes of the start";
    EXPECT_LT(difference(shots["looked"], shots["same"]), kSame) << "in flight the wheel sets the speed";
}

}  // namespace
}  // namespace stereonav
