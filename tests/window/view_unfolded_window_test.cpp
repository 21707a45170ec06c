// The window with the wall laid flat below the flight: the picture makes room for it, and a click on the wall
// flies there.
#include "tests/support/byte_study.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

using UnfoldedWindow = WindowTest;

TEST_F(UnfoldedWindow, LiesBelowTheFlightAndLeadsIt) {
    const std::filesystem::path study = test::writeByteStudy(
        mFolder / "tube.nrrd", {40, 40, 48}, {-19.5, -19.5, -23.5}, [](int i, int j, int k) {
            const double z = k - 23.5;
            return std::hypot(i - 19.5, j - 19.5) < 8 + std::sin(z) && std::abs(z) < 21;
        });
    ASSERT_EQ(drive("drive_unfolded.sh", "'" + study.string() + "'"), 0)
        << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    std::map<std::string, Picture> shots;
    for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
    ASSERT_EQ(shots.size(), 4u);
    EXPECT_LT(shots["below"].height(), shots["start"].height()) << "the wall lies below the picture";
    EXPECT_EQ(shots["below"].width(), shots["start"].width());
    EXPECT_GT(difference(shots["below"], shots["flown"]), kDifferent);
    EXPECT_LT(shots["beside"].width(), shots["flown"].width());
}

}  // namespace
}  // namespace stereonav
