// Words of strangers as they are shown. Sequences are those of ECMA-48 and Unicode (UAX 9, chapter 23).
#include "engine/text/printable.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "engine/text/printed.h"
#include "engine/text/utf8.h"

namespace stereonav {
namespace {

std::string utf8Of(char32_t code) {
    std::string text;
    if (code < 0x80) return {static_cast<char>(code)};
    const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    constexpr unsigned kFirst[] = {0, 0xc0, 0xe0, 0xf0};
    text += static_cast<char>(kFirst[more] | code >> (6 * more));
    for (int n = more - 1; n >= 0; --n) text += static_cast<char>(0x80 | (code >> (6 * n) & 0x3f));
    return text;
}

std::string escaped(const std::string& bytes) {
    std::string text;
    for (const char c : bytes) {
        char one[8];
        std::snprintf(one, sizeof one, "\\x%02x", static_cast<unsigned char>(c));
        text += one;
    }
    return text;
}

// Returns what a printing function of the program lets through.
std::string printed(void (*print)(std::FILE*, std::string_view), const std::string& text) {
    char* bytes = nullptr;
    std::size_t size = 0;
    std::FILE* const to = open_memstream(&bytes, &size);
    print(to, text);
    std::fclose(to);
    const std::string all(bytes, size);
    std::free(bytes);
    return all;
}

TEST(Printable, TextStaysAsItIs) {
    for (const std::string text :
         {"", "Höhe 12 m", "WGS 84 / UTM zone 11N", "山 \xf0\x9f\x8f\x94", "a\\b\"c'd", "\u00a0\u00ff\ufffd",
          "\u0645\u06cc\u200c\u062e\u0648\u0627\u0647\u0645", "e\u0301"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, WhatMovesATerminalIsShown) {
    EXPECT_EQ(printable("a\x1b[2Jb"), "a\\x1b[2Jb");
    EXPECT_EQ(printable("\x1b]0;title\x07"), "\\x1b]0;title\\x07");
    EXPECT_EQ(printable(std::string("\0\r\n\t\x7f", 5)), "\\x00\\x0d\\x0a\\x09\\x7f");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "\\xc2\\x9b31m")
        << "CSI as one letter";
    EXPECT_EQ(printable("\x9b"
                        "31m"),
              "\\x9b31m")
        << "and as one byte";
    EXPECT_EQ(printable("txt.\u202egpj.exe"), "txt.\\xe2\\x80\\xaegpj.exe");
    EXPECT_EQ(printable("a\u2028b\u2029"), "a\\xe2\\x80\\xa8b\\xe2\\x80\\xa9");
    EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3") << "no UTF-8, and a letter that is cut off";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
}

TEST(Printable, EveryControlAndDirection) {
    for (char32_t code = 0; code <= 0x2100; ++code) {
        const bool control = code < 0x20 || (code >= 0x7f && code <= 0x9f);
        const bool direction = code == 0x61c || code == 0x200e || code == 0x200f ||
                               (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
        const bool unseen = code == 0x180e || code == 0x200b || (code >= 0x2060 && code <= 0x206f);
        const bool hidden = control || direction || unseen;
        ASSERT_EQ(isPrintable(code), !hidden) << std::hex << static_cast<unsigned>(code);
        const std::string letter = utf8Of(code);
        ASSERT_EQ(printable(letter), hidden ? escaped(letter) : letter)
            << std::hex << static_cast<unsigned>(code);
    }
    for (const char32_t code : {0xfeffu, 0xfff9u, 0xfdd0u, 0xffffu, 0x1fffeu, 0xe0001u, 0xe0061u, 0x10ffffu})
        EXPECT_FALSE(isPrintable(code)) << std::hex << static_cast<unsigned>(code);
    for (int byte = 0x80; byte < 0x100; ++byte) {
        const std::string one(1, static_cast<char>(byte));
        ASSERT_EQ(printable(one), escaped(one));
    }
}

TEST(Printable, LinesKeepTheirEndsAndTabsAlone) {
    EXPECT_EQ(printableLines("a\n\tb\r\n\x1b"), "a\n\tb\\x0d\n\\x1b");
    EXPECT_EQ(printableLines(std::string(100'000, 'x')).size(), 100'000u);
}

TEST(Printable, AMegabyteDoesNotFillTheScreen) {
    for (const std::string letter : {"x", "\u00e9", "\xf0\x9f\x8f\x94", "\x1b", "\xff"}) {
        std::string text = "begin ";
        while (text.size() < 1'000'000) text += letter;
        text += " end";
        const std::string shown = printable(text);
        EXPECT_LE(shown.size(), kLongestWords);
        EXPECT_GT(shown.size(), kLongestWords - 20);
        EXPECT_TRUE(shown.starts_with("begin "));
        EXPECT_TRUE(shown.ends_with(" end"));
        EXPECT_NE(shown.find(" ... "), std::string::npos);
        EXPECT_EQ(printable(shown), shown) << "cut between letters";
    }
    const std::string fits(kLongestWords, 'x');
    EXPECT_EQ(printable(fits), fits);
    EXPECT_EQ(printable("abcdef", 5), " ... ");
    EXPECT_EQ(printable("abcdef", 0), " ... ");
}

TEST(Printable, TwiceIsOnce) {
    const std::string odd = "a\x1b\xff\u202e\n\\x1b";
    EXPECT_EQ(printable(printable(odd)), printable(odd));
}

TEST(Printed, OneLineIsOneLine) {
    EXPECT_EQ(printed(printLine, "a\nstereonav: b\r\x1b[2J"), "a\\x0astereonav: b\\x0d\\x1b[2J\n");
    EXPECT_EQ(printed(printLine, ""), "\n");
    const std::string many = printed(printLine, std::string(1'000'000, 'x') + "; do this");
    EXPECT_LE(many.size(), kLongestLine + 1);
    EXPECT_TRUE(many.ends_with("; do this\n")) << "what to do is still read";
}

TEST(Printed, LinesAreThoseThatWereLaidOut) {
    EXPECT_EQ(printed(printLines, "a\n\tb\x07\u009b\n"), "a\n\tb\\x07\\xc2\\x9b\n");
}

TEST(Utf8, TextIsCutBetweenLetters) {
    EXPECT_EQ(firstBytes("abc", 3), "abc");
    EXPECT_EQ(firstBytes("abc", 2), "ab");
    EXPECT_EQ(firstBytes("a\u00e9", 2), "a");
    EXPECT_EQ(firstBytes("\xf0\x9f\x8f\x94", 3), "");
    EXPECT_EQ(firstBytes(std::string(9, '\x80'), 6).size(), 3u) << "no further back than a letter is long";
    EXPECT_EQ(firstBytes("", 4), "");
}

}  // namespace
}  // namespace stereonav
