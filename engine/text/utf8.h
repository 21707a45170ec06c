// Letters of UTF-8 text, one after the other.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stereonav {

constexpr char32_t kNoLetter = 0xfffd;  // U+FFFD stands for what is none

struct Letter {
    char32_t code = kNoLetter;
    std::size_t bytes = 0;  // how many it takes; 0 at the end of the text
};

// Returns the letter that starts at a byte of the text. A byte that starts none, a form longer than need be,
// a surrogate and what lies beyond U+10FFFF are kNoLetter, of one byte.
Letter letterAt(std::string_view text, std::size_t at);
// Returns whether the letter stands for a byte that starts no letter: U+FFFD itself takes three.
inline bool isNoLetter(const Letter& letter) {
    return letter.code == kNoLetter && letter.bytes < 3;
}
// Returns whether a byte goes on with a letter that began before it.
inline bool isInsideLetter(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// Returns the first `most` bytes of the text, cut between two letters.
std::string_view firstBytes(std::string_view text, std::size_t most);

// Returns the first `most` letters of the text, with an ellipsis in the place of those that were cut off.
std::string firstLetters(const std::string& text, std::size_t most);

}  // namespace stereonav
