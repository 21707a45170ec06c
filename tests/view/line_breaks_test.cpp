// Where wrapped text of the panels goes on: between words, never within a number.
#include "app/view/panel/line_breaks.h"

#include <gtest/gtest.h>

namespace stereonav {
namespace {

// Breaks text whose letters have one width.
std::string within(std::string_view text, float letters) {
    return withLineBreaks(text, letters,
                          [](std::string_view part) { return static_cast<float>(part.size()); });
}

TEST(LineBreaks, AreAtBlanks) {
    EXPECT_EQ(within("-0.33 to +0.14 degrees", 12), "-0.33 to\n+0.14\ndegrees");
    EXPECT_EQ(within("one two", 7), "one two") << "as wide as the line";
    EXPECT_EQ(within("one two", 6), "one\ntwo");
}

TEST(LineBreaks, WordsWiderThanALineHaveTheirOwn) {
    EXPECT_EQ(within("in /a/long/path.mp4 now", 8), "in\n/a/long/path.mp4\nnow");
    EXPECT_EQ(within("/a/long/path.mp4", 3), "/a/long/path.mp4");
    EXPECT_EQ(within("a b", 0), "a\nb");
}

TEST(LineBreaks, KeepThoseOfTheText) {
    EXPECT_EQ(within("one\ntwo three", 5), "one\ntwo\nthree");
    EXPECT_EQ(within("one two\n\nthree", 7), "one two\n\nthree");
    EXPECT_EQ(within("", 5), "");
    EXPECT_EQ(within("\n", 5), "\n");
    EXPECT_EQ(within(" a", 5), " a");
}

}  // namespace
}  // namespace stereonav
