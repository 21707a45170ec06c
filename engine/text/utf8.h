// Iterates over the letters of UTF-8 text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stereonav {

constexpr char32_t kNoLetter = 0xfffd;  // U+FFFD stands for invalid bytes

struct Letter {
    char32_t code = kNoLetter;
    std::size_t bytes = 0;  // length of the letter; 0 at the end of the text
};

// Returns the letter that starts at a byte of the text. A byte that starts none, an overlong form, a
// surrogate and values beyond U+10FFFF give kNoLetter, with one byte.
Letter letterAt(std::string_view text, std::size_t at);
// Returns whether the letter stands for an invalid byte: a real U+FFFD takes three bytes.
inline bool isNoLetter(const Letter& letter) {
    return letter.code == kNoLetter && letter.bytes < 3;
}
// Returns whether a byte continues a letter that began before it.
inline bool isInsideLetter(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// Returns the first `most` bytes of the text, cut between two letters.
std::string_view firstBytes(std::string_view text, std::size_t most);

// Returns the first `most` letters of the text, with an ellipsis in place of the rest.
std::string firstLetters(const std::string& text, std::size_t most);

}  // namespace stereonav
