#include "engine/text/words.h"

#include <gmock/gmock.h>

namespace stereonav {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(TextWords, BlanksOfAllKindsPart) {
    EXPECT_THAT(wordsOf(" a\tbc \r"), ElementsAre("a", "bc"));
    EXPECT_THAT(wordsOf("a\nb\vc\fd"), ElementsAre("a", "b", "c", "d"));
    EXPECT_THAT(wordsOf(""), IsEmpty());
    EXPECT_THAT(wordsOf(" \t"), IsEmpty());
    EXPECT_THAT(ownWordsOf("one two"), ElementsAre("one", "two"));
    EXPECT_THAT(wordsOf(withoutComment("1 2# 3")), ElementsAre("1", "2"));
}

TEST(TextWords, LinesWithAndWithoutAnEnd) {
    std::vector<std::string_view> lines;
    const auto keep = [&](std::string_view line) { lines.push_back(line); };
    forEachLine("a\n\nb\n", keep);
    EXPECT_THAT(lines, ElementsAre("a", "", "b"));
    lines.clear();
    forEachLine("a\nb", keep);
    EXPECT_THAT(lines, ElementsAre("a", "b"));
    lines.clear();
    forEachLine("", keep);
    EXPECT_THAT(lines, IsEmpty());
}

TEST(TextWords, TakenOneAtATime) {
    std::string_view rest = "  x  y";
    EXPECT_EQ(takeWord(rest), "x");
    EXPECT_EQ(rest, "  y");
    EXPECT_EQ(takeWord(rest), "y");
    EXPECT_EQ(takeWord(rest), "");
    EXPECT_TRUE(rest.empty());
}

}  // namespace
}  // namespace stereonav
