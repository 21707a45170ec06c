// Lines and words of text files.
#pragma once

#include <algorithm>
#include <concepts>
#include <string>
#include <string_view>
#include <vector>

namespace stereonav {

inline constexpr std::string_view kBlanks = " \t\r\n\v\f";

// Returns the line up to its first '#', where a comment begins.
inline std::string_view withoutComment(std::string_view line) {
    return line.substr(0, line.find('#'));
}

// Takes the first word after any blanks; `rest` then begins behind it. Empty at the end.
inline std::string_view takeWord(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
    rest.remove_prefix(word.size());
    return word;
}

// Returns words that are parts of the text, which must outlive them.
inline std::vector<std::string_view> wordsOf(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::string_view word = takeWord(text); !word.empty(); word = takeWord(text)) words.push_back(word);
    return words;
}
template <std::same_as<std::string> Text>
std::vector<std::string_view> wordsOf(Text&& text) = delete;  // the words would refer to a destroyed text
// Returns copies of the words.
inline std::vector<std::string> ownWordsOf(std::string_view text) {
    const std::vector<std::string_view> words = wordsOf(text);
    return {words.begin(), words.end()};
}

// Takes the first line, without its end (\n); `rest` begins behind that.
inline std::string_view takeLine(std::string_view& rest) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    return line;
}

// Calls use(line) for each line, without its end.
template <typename Use>
void forEachLine(std::string_view text, Use use) {
    while (!text.empty()) use(takeLine(text));
}

}  // namespace stereonav
