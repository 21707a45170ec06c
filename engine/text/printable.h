// Makes text that somebody else wrote (names of files, tags, comments) safe to show: it can not move the
// cursor, break lines, reverse the direction of writing or fill the screen.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stereonav {

inline constexpr std::size_t kLongestWords = 500, kLongestLine = 4000;  // bytes

// Returns whether a code point is drawn or is a blank. Not printable are control characters (C0, DEL, C1),
// marks and overrides of writing direction, line separators, invisible characters, and values that are no
// character.
bool isPrintable(char32_t letter);

// What happens to line feeds (\n) and tabs: Shown escapes them like other control characters, Kept leaves
// them.
enum class Breaks { Shown, Kept };

// Returns text that may be shown: each byte that is not printable or not UTF-8 becomes \xNN. Where the text
// has more than `most` bytes its middle is left out. Printable text stays as it is, so that a second call
// changes nothing.
std::string printable(std::string_view text, std::size_t most = kLongestWords, Breaks breaks = Breaks::Shown);
// Returns printable text of any length; line feeds and tabs stay.
std::string printableLines(std::string_view text);

}  // namespace stereonav
