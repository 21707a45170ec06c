// Words as only an enemy chooses them, and what may come of them on a terminal.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "engine/text/printable.h"
#include "engine/text/utf8.h"

namespace stereonav::test {

// Clears the screen, sets the title, begins a line as the program does, C1 as a letter and as a byte, no
// UTF-8, turns the direction, separates lines.
inline const std::string kForeignWords =
    "\x1b[2J\x1b]0;t\x07\r\nstereonav: forged\n\t\x08\x7f\xc2\x9b[31m\x9b[31m\xff\u202e\u2066\u2028\u2029";
// The same where no more than UTF-8 gets into a file.
inline const std::string kForeignUtf8 =
    "\x1b[2J\x1b]0;t\x07\r\nstereonav: forged\n\t\x08\x7f\u009b[31m\u202e\u2066\u2028\u2029";

// Text, lines and tabs: in a file that keeps the ends of lines of its cells.
inline void expectPrintable(const std::string& printed) {
    for (std::size_t at = 0; at < printed.size();) {
        const Letter letter = letterAt(printed, at);
        const bool lays = letter.code == '\n' || letter.code == '\t';
        ASSERT_TRUE(lays || (isPrintable(letter.code) && !isNoLetter(letter)))
            << fmt::format("U+{:04X} at byte {} of: {}", static_cast<unsigned>(letter.code), at,
                           printable(printed, printed.npos));
        at += letter.bytes;
    }
}

// Expects printable text of which no line is a stranger's.
inline void expectTextAlone(const std::string& printed) {
    expectPrintable(printed);
    EXPECT_EQ(("\n" + printed).find("\nstereonav: forged"), std::string::npos) << printed;
}

}  // namespace stereonav::test
