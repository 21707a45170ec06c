// A window with unfinished work closes by the second of two wishes within a short time, and no sooner.
#include "app/view/closing_question.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::vector<std::string> kMovie{"the movie a.mp4, which is lost"};

TEST(ClosingQuestion, IsNotAskedWhereNothingIsAtWork) {
    ClosingQuestion question;
    EXPECT_TRUE(question.wish({}, 100));
    EXPECT_EQ(question.text({}, 100), "");
}

TEST(ClosingQuestion, NamesAllThatIsAtWork) {
    ClosingQuestion question;
    const std::vector<std::string> both{"a recording of 3 s, which is kept", kMovie[0]};
    EXPECT_EQ(question.text(both, 100), "") << "nobody wants to close it";
    EXPECT_FALSE(question.wish(both, 100));
    EXPECT_THAT(question.text(both, 100), AllOf(HasSubstr(both[0]), HasSubstr(both[1]),
                                                HasSubstr("Ctrl+Q again quits"), HasSubstr("Esc goes on")));
    EXPECT_TRUE(question.wish(both, 100 + ClosingQuestion::kAsked_s));
}

TEST(ClosingQuestion, IsAskedAgainWhereTheAnswerIsLate) {
    ClosingQuestion question;
    EXPECT_FALSE(question.wish(kMovie, 100));
    const double late = 100.001 + ClosingQuestion::kAsked_s;
    EXPECT_EQ(question.text(kMovie, late), "");
    EXPECT_FALSE(question.wish(kMovie, late));
    EXPECT_NE(question.text(kMovie, late), "");
    EXPECT_TRUE(question.wish(kMovie, late + 1));
}

TEST(ClosingQuestion, GoesWithItsAnswerOrWithTheWork) {
    ClosingQuestion question;
    EXPECT_FALSE(question.wish(kMovie, 100));
    question.goOn();
    EXPECT_EQ(question.text(kMovie, 100), "");
    EXPECT_FALSE(question.wish(kMovie, 101)) << "it was answered: another wish is another question";
    EXPECT_EQ(question.text({}, 101), "") << "the movie is made";
    EXPECT_TRUE(question.wish({}, 101));
}

}  // namespace
}  // namespace stereonav
