// Words that somebody else wrote (names of files, tags, comments) as they are shown: text and nothing else.
// They move no cursor, break no line, turn no text around and do not fill the screen.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stereonav {

inline constexpr std::size_t kLongestWords = 500, kLongestLine = 4000;  // bytes

// Returns whether a letter is drawn, or is a blank. Control characters (C0, DEL, C1), marks and overrides of
// direction, separators of lines, and what is not seen at all or is no character are not printable.
bool isPrintable(char32_t letter);

// Ends of lines (\n) and tabs: shown as other control characters are, or left as they are.
enum class Breaks { Shown, Kept };

// Returns words as they may be shown: each byte of what is not printable or is no UTF-8 becomes \xNN; of more
// bytes than `most` the middle is left out. Printable text stays as it is, so that doing it twice changes
// nothing.
std::string printable(std::string_view text, std::size_t most = kLongestWords, Breaks breaks = Breaks::Shown);
// Returns the same at any length, with its ends of lines and tabs.
std::string printableLines(std::string_view text);

}  // namespace stereonav
