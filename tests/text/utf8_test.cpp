// Letters of UTF-8: every code comes back, and bytes that are none are one letter each.
#include "engine/text/utf8.h"

#include <gtest/gtest.h>

#include <vector>

namespace stereonav {
namespace {

std::string encoded(char32_t code) {
    const auto byte = [](char32_t bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
    if (code < 0x80) return {byte(code)};
    if (code < 0x800) return {byte(0xc0 | code >> 6), byte(0x80 | (code & 63))};
    if (code < 0x10000)
        return {byte(0xe0 | code >> 12), byte(0x80 | (code >> 6 & 63)), byte(0x80 | (code & 63))};
    return {byte(0xf0 | code >> 18), byte(0x80 | (code >> 12 & 63)), byte(0x80 | (code >> 6 & 63)),
            byte(0x80 | (code & 63))};
}

TEST(Utf8, GivesEveryCode) {
    for (char32_t code = 0; code <= 0x10ffff; ++code) {
        if (code == 0xd800) code = 0xe000;  // surrogates are no letters
        const std::string text = "x" + encoded(code) + "y";
        const Letter letter = letterAt(text, 1);
        ASSERT_TRUE(letter.code == code) << static_cast<unsigned>(code);
        ASSERT_EQ(letter.bytes, text.size() - 2);
    }
}

TEST(Utf8, TakesWhatIsNoneByteByByte) {
    const std::vector<std::string> none{"\x80",
                                        "\xc3",
                                        "\xc3(",
                                        "\xe4\xb8",
                                        "\xe4\xb8z",
                                        "\xff",
                                        "\xfe",
                                        "\xc0\x80",
                                        "\xe0\x80\x80",
                                        "\xf0\x80\x80\x80",
                                        "\xed\xa0\x80" /* a surrogate */,
                                        "\xf4\x90\x80\x80",
                                        "\xf8\x88\x80\x80\x80"};
    for (const std::string& text : none) {
        EXPECT_TRUE(letterAt(text, 0).code == kNoLetter);
        EXPECT_EQ(letterAt(text, 0).bytes, 1u);
    }
    EXPECT_EQ(letterAt("", 0).bytes, 0u);
    EXPECT_EQ(letterAt("a", 1).bytes, 0u);
}

TEST(Utf8, CutsBetweenLetters) {
    EXPECT_EQ(firstLetters("", 3), "");
    EXPECT_EQ(firstLetters("abc", 3), "abc");
    EXPECT_EQ(firstLetters("abcd", 3), "abc\u2026");
    EXPECT_EQ(firstLetters("\u00e9\u4e2dx", 2), "\u00e9\u4e2d\u2026");
    EXPECT_EQ(firstLetters(std::string(500, '\x80'), 4), "\x80\x80\x80\x80\u2026");
    EXPECT_EQ(firstLetters("a", 0), "\u2026");
}

}  // namespace
}  // namespace stereonav
