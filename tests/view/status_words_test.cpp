// The line at the bottom: words, and figures where they are wanted.
#include "app/view/status_words.h"

#include <gmock/gmock.h>

#include "app/view/status.h"

namespace stereonav {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(StatusWords, LatePicturesInWordsAndFigures) {
    EXPECT_EQ(lateWords({0.02, 1}), "") << "nobody would notice";
    EXPECT_EQ(lateWords({0.669, 0.29}), "coarse while it moves");
    EXPECT_EQ(lateWords({0.669, 1}), "catching up");
    EXPECT_EQ(lateFigures({0.669, 0.29}), "669 ms old, 29 %");
    EXPECT_EQ(lateFigures({0.669, 1}), "669 ms old");
}

TEST(StatusWords, TheTruthInWords) {
    ViewFrame frame;
    FrameTruth truth;
    EXPECT_EQ(truthWords(frame, truth, ""), "");
    EXPECT_EQ(truthWords(frame, truth, truthText(truth)), "both eyes exact");
    truth.error.wrongShare = 0.3;
    truth.error.psnr_db = 10.4;
    EXPECT_EQ(truthWords(frame, truth, truthText(truth)), "right eye rough");
    truth.error.psnr_db = 45;
    EXPECT_EQ(truthWords(frame, truth, truthText(truth)), "both eyes alike");
    frame.rays = 16;
    frame.expected_db = 48;
    EXPECT_EQ(truthWords(frame, truth, "16 rays"), "getting finer");
    frame.expected_db = 61;
    EXPECT_EQ(truthWords(frame, truth, "64 rays"), "refined");
}

TEST(StatusWords, NoTimeOfAnEyeThatIsNotShown) {
    ViewFrame frame;
    frame.timings.left_ms = 8;
    frame.timings.right_ms = 4.5;
    EXPECT_THAT(costFigures(frame, OutputLayout::SideBySide), HasSubstr("right   4.5"));
    EXPECT_THAT(costFigures(frame, OutputLayout::OneEye), Not(HasSubstr("right")));
    frame.request.twoEyes = false;
    EXPECT_THAT(costFigures(frame, OutputLayout::SideBySide), Not(HasSubstr("right")));
}

}  // namespace
}  // namespace stereonav
