// A medium in a window: its model, its light and the way to two eyes are changed by keys, and it is flown
// into.
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

class MediumWindow : public WindowTest {};

TEST_F(MediumWindow, KeysChangeModelAndLight) {
    ASSERT_EQ(drive("drive_medium.sh", "wax --slices 32 --light-size 32"), 0)
        << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    std::map<std::string, Picture> shots;
    for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
    ASSERT_EQ(shots.size(), 6u);
    EXPECT_GT(difference(shots["start"], shots["emission"]), kDifferent);
    EXPECT_LT(difference(shots["start"], shots["again"]), kSame) << "after the last model comes the first";
    EXPECT_GT(difference(shots["again"], shots["turned"]), kDifferent) << "the light has turned";
    EXPECT_LT(difference(shots["turned"], shots["two_sweeps"]), kSame) << "each eye's own sweep is the same";
    EXPECT_GT(difference(shots["two_sweeps"], shots["flown"]), kDifferent);
    // Two eyes: the same block from two places.
    const double apart = difference(shots["start"], 0, 0, shots["start"], 320, 0, 320, 240);
    EXPECT_GT(apart, 0.05);
}

}  // namespace
}  // namespace stereonav
