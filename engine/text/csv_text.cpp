#include "engine/text/csv_text.h"

#include "engine/text/printable.h"
#include "engine/text/utf8.h"

namespace stereonav {
namespace {

// Spreadsheets look behind blanks and quotes, and take the wide forms of East Asia for the same signs.
bool beginsFormula(std::string_view text) {
    if (text.starts_with('\t') || text.starts_with('\r') || text.starts_with('\n')) return true;
    constexpr std::u32string_view kPassedOver = U" \t\r\n\v\f\u00a0\u3000\"'\u2018\u2019\u201c\u201d";
    constexpr std::u32string_view kSigns = U"=+-@\uff1d\uff0b\uff0d\uff20";
    for (std::size_t at = 0; at < text.size();) {
        const Letter letter = letterAt(text, at);
        if (kSigns.find(letter.code) != kSigns.npos) return true;
        const bool hidden = isNoLetter(letter) || !isPrintable(letter.code);
        if (!hidden && kPassedOver.find(letter.code) == kPassedOver.npos) return false;
        at += letter.bytes;
    }
    return false;
}

}  // namespace

std::string csvText(std::string_view text) {
    std::string cell = beginsFormula(text) ? "\"'" : "\"";
    for (const char c : printableLines(text)) cell.append(c == '"' ? 2 : 1, c);
    return cell + "\"";
}

}  // namespace stereonav
