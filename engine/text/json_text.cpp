#include "engine/text/json_text.h"

#include <fmt/format.h>

#include <charconv>

#include "engine/text/printable.h"
#include "engine/text/utf8.h"

namespace stereonav {
namespace {

// Returns the escaped letter; what lies beyond U+FFFF is a surrogate pair.
std::string escapedLetter(char32_t letter) {
    constexpr char32_t kBeyond = 0x10000;
    if (letter < kBeyond) return fmt::format("\\u{:04x}", static_cast<unsigned>(letter));
    const auto over = static_cast<unsigned>(letter - kBeyond);
    return fmt::format("\\u{:04x}\\u{:04x}", 0xd800 + (over >> 10), 0xdc00 + (over & 0x3ff));
}

// The number behind a word of nlohmann's, 0 for none.
std::size_t numberAfter(std::string_view said, std::string_view word) {
    const std::size_t at = said.find(word);
    std::size_t number = 0;
    if (at != said.npos) std::from_chars(said.data() + at + word.size(), said.data() + said.size(), number);
    return number;
}

}  // namespace

std::string escapedJson(std::string_view document) {
    std::string text;
    text.reserve(document.size());
    for (std::size_t at = 0; at < document.size();) {
        const Letter letter = letterAt(document, at);
        if (letter.code < 0x20 || isPrintable(letter.code))  // ends of lines lay it out
            text += document.substr(at, letter.bytes);
        else
            text += escapedLetter(letter.code);
        at += letter.bytes;
    }
    return text;
}

std::string jsonProblem(const std::string& said) {
    const std::size_t at = said.find("[json.exception.");
    if (at == said.npos) return said;
    const std::string_view own = std::string_view(said).substr(at);
    if (!own.starts_with("[json.exception.parse_error.")) return "is JSON of another shape than expected";
    const std::size_t line = numberAfter(own, " at line "), column = numberAfter(own, ", column ");
    return line > 0 ? fmt::format("is no JSON from line {}, column {} on", line, column) : "is no JSON";
}

}  // namespace stereonav
