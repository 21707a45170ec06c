#include "engine/text/printable.h"

#include <algorithm>
#include <iterator>

#include "engine/text/utf8.h"

namespace stereonav {
namespace {

struct LetterRange {
    char32_t first, last;
};
// Those of Unicode that are not drawn, but for the joiners (U+200C, U+200D), which scripts and signs need.
constexpr LetterRange kNotDrawn[] = {
    {0x7f, 0x9f},        // DEL, C1
    {0x61c, 0x61c},      // direction
    {0x180e, 0x180e},    // no width
    {0x200b, 0x200b},    // no width
    {0x200e, 0x200f},    // direction
    {0x2028, 0x202e},    // ends of lines and paragraphs; direction
    {0x2060, 0x206f},    // no width; direction
    {0xfdd0, 0xfdef},    // no characters
    {0xfeff, 0xfeff},    // no width
    {0xfff9, 0xfffb},    // annotations
    {0xe0000, 0xe0fff},  // tags and selectors
};

constexpr std::string_view kLeftOut = " ... ";

void addEscaped(std::string_view bytes, std::string& shown) {
    constexpr const char* kDigits = "0123456789abcdef";
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        shown += "\\x";
        shown += kDigits[byte >> 4];
        shown += kDigits[byte & 15];
    }
}

std::string withoutMiddle(const std::string& text, std::size_t most) {
    const std::size_t kept = most - std::min(most, kLeftOut.size());
    const std::string_view head = firstBytes(text, kept - kept / 4);
    std::size_t tail = text.size() - kept / 4;
    while (tail < text.size() && isInsideLetter(text[tail])) ++tail;
    return std::string(head).append(kLeftOut).append(text, tail);
}

}  // namespace

bool isPrintable(char32_t letter) {
    if (letter < 0x20 || (letter & 0xfffe) == 0xfffe) return false;
    return std::none_of(std::begin(kNotDrawn), std::end(kNotDrawn), [letter](const LetterRange& range) {
        return letter >= range.first && letter <= range.last;
    });
}

std::string printable(std::string_view text, std::size_t most, Breaks breaks) {
    std::string shown;
    for (std::size_t at = 0; at < text.size();) {
        const Letter letter = letterAt(text, at);
        const std::string_view bytes = text.substr(at, letter.bytes);
        at += letter.bytes;
        const bool kept = breaks == Breaks::Kept && (letter.code == '\n' || letter.code == '\t');
        if (kept || (isPrintable(letter.code) && !isNoLetter(letter)))
            shown += bytes;
        else
            addEscaped(bytes, shown);
    }
    return shown.size() <= most ? shown : withoutMiddle(shown, most);
}

std::string printableLines(std::string_view text) {
    return printable(text, std::string::npos, Breaks::Kept);
}

}  // namespace stereonav
