#include "engine/text/utf8.h"

#include <algorithm>

namespace stereonav {
namespace {

// Bytes that a first byte announces, with its own bits of the code.
struct FirstByte {
    std::size_t bytes;
    char32_t bits, least;  // least: a smaller code has a shorter form
};
FirstByte firstByte(unsigned char byte) {
    if (byte < 0x80) return {1, byte, 0};
    if (byte < 0xc0) return {0, 0, 0};
    if (byte < 0xe0) return {2, byte & 0x1fu, 0x80};
    if (byte < 0xf0) return {3, byte & 0x0fu, 0x800};
    if (byte < 0xf8) return {4, byte & 0x07u, 0x10000};
    return {0, 0, 0};
}

}  // namespace

Letter letterAt(std::string_view text, std::size_t at) {
    if (at >= text.size()) return {kNoLetter, 0};
    const FirstByte first = firstByte(static_cast<unsigned char>(text[at]));
    if (first.bytes == 0 || first.bytes > text.size() - at) return {kNoLetter, 1};
    char32_t code = first.bits;
    for (std::size_t n = 1; n < first.bytes; ++n) {
        const auto byte = static_cast<unsigned char>(text[at + n]);
        if (!isInsideLetter(text[at + n])) return {kNoLetter, 1};
        code = code << 6 | (byte & 0x3fu);
    }
    if (code < first.least || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return {kNoLetter, 1};
    return {code, first.bytes};
}

std::string_view firstBytes(std::string_view text, std::size_t most) {
    constexpr std::size_t kLongestLetter = 4;
    std::size_t end = std::min(most, text.size());
    for (std::size_t n = 1; end < text.size() && n < kLongestLetter && end > 0 && isInsideLetter(text[end]);
         ++n)
        --end;
    return text.substr(0, end);
}

std::string firstLetters(const std::string& text, std::size_t most) {
    std::size_t letters = 0;
    for (std::size_t at = 0; at < text.size(); at += letterAt(text, at).bytes)
        if (letters++ == most) return text.substr(0, at) + "\u2026";
    return text;
}

}  // namespace stereonav
