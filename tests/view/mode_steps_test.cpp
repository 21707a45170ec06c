// Stepping through the modes, and modes for saved pictures in place of those that fit in none.
#include "app/view/mode_steps.h"

#include <gtest/gtest.h>

namespace stereonav {
namespace {

TEST(ModeSteps, GoRoundBothWaysThroughWhatFitsInAPicture) {
    for (const OutputModeInfo& first : outputModes()) {
        OutputMode forth = OutputMode::Left, back = OutputMode::Left;
        int count = 0;
        do {
            forth = steppedMode(forth, 1, first.mode);
            EXPECT_TRUE(fitsInPicture(forth) || forth == first.mode);
            EXPECT_EQ(steppedMode(steppedMode(forth, 1, first.mode), -1, first.mode), forth);
            ASSERT_LE(++count, static_cast<int>(outputModes().size()));
        } while (forth != OutputMode::Left);
        EXPECT_EQ(count, fitsInPicture(first.mode) ? 31 : 32) << first.longName;
        back = steppedMode(back, -1, first.mode);
        EXPECT_EQ(steppedMode(back, 1, first.mode), OutputMode::Left);
    }
    EXPECT_EQ(steppedMode(OutputMode::Alternating, 0, OutputMode::Left), OutputMode::Alternating);
    EXPECT_EQ(steppedMode(OutputMode::Alternating, 1, OutputMode::Left), OutputMode::Left);
}

TEST(ModeSteps, PicturesKeepBothEyes) {
    for (const OutputModeInfo& info : outputModes())
        for (const bool swapped : {false, true}) {
            const ComposeSetting setting{info.mode, swapped, true};
            const ComposeSetting saved = pictureSetting(setting);
            EXPECT_EQ(saved.mode, fitsInPicture(info.mode) ? info.mode : OutputMode::SideBySide);
            EXPECT_EQ(saved.swapEyes, swapped);
            EXPECT_TRUE(saved.linearAnaglyph);
        }
}

}  // namespace
}  // namespace stereonav
