// Which eye is drawn into which buffer, for every mode; and that exchanging the eyes exchanges them there.
#include "engine/display/eye_passes.h"

#include <gtest/gtest.h>

namespace stereonav {
namespace {

// Returns the eye that is seen in a mode of one eye: 0 left, 1 right.
int seenEye(const ComposeSetting& setting) {
    EXPECT_EQ(infoOf(setting.mode).layout, OutputLayout::OneEye);
    return infoOf(setting.mode).rightFirst != setting.swapEyes;
}

TEST(EyePasses, ModesOfPicturesAreOnePass) {
    for (const OutputModeInfo& info : outputModes())
        for (const bool swapped : {false, true})
            for (const bool quadBuffered : {false, true}) {
                if (!fitsInPicture(info.mode)) continue;
                const ComposeSetting setting{info.mode, swapped, true};
                EXPECT_EQ(eyePasses(setting, 1, quadBuffered),
                          (std::vector<EyePass>{{setting, BackBuffer::Both}}))
                    << info.longName;
            }
}

TEST(EyePasses, AlternatingModesShowTheEyeWhoseTurnItIs) {
    for (const bool swapped : {false, true})
        for (const int turn : {0, 1, 2, 3}) {
            const auto left = eyePasses({OutputMode::Alternating, swapped, false}, turn, false);
            const auto right = eyePasses({OutputMode::AlternatingRightFirst, swapped, false}, turn, true);
            ASSERT_EQ(left.size(), 1u);
            ASSERT_EQ(right.size(), 1u);
            EXPECT_EQ(seenEye(left[0].setting), (turn + swapped) % 2);
            EXPECT_EQ(seenEye(right[0].setting), (turn + swapped + 1) % 2);
            EXPECT_EQ(left[0].buffer, BackBuffer::Both);
        }
}

TEST(EyePasses, QuadBufferHasAnEyeInEachBuffer) {
    for (const bool swapped : {false, true}) {
        const ComposeSetting setting{OutputMode::QuadBuffer, swapped, false};
        const auto passes = eyePasses(setting, 0, true);
        ASSERT_EQ(passes.size(), 2u);
        EXPECT_EQ(passes[0].buffer, BackBuffer::Left);
        EXPECT_EQ(passes[1].buffer, BackBuffer::Right);
        EXPECT_EQ(seenEye(passes[0].setting), swapped ? 1 : 0);
        EXPECT_EQ(seenEye(passes[1].setting), swapped ? 0 : 1);
        const auto refused = eyePasses(setting, 0, false);
        ASSERT_EQ(refused.size(), 1u);
        EXPECT_EQ(refused[0].buffer, BackBuffer::Both) << "buffers that are not there are not drawn into";
        EXPECT_EQ(seenEye(refused[0].setting), swapped ? 1 : 0);
    }
}

}  // namespace
}  // namespace stereonav
