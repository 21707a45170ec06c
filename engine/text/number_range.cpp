#include "engine/text/number_range.h"

#include <fmt/format.h>

#include <cmath>

namespace stereonav {

bool NumberRange::holds(double number) const {
    return std::isfinite(number) && (openLow ? number > low : number >= low) &&
           (openHigh ? number < high : number <= high);
}

std::string shortNumber(double number) {
    std::string text = fmt::format("{:g}", number);
    if (std::isfinite(number) && std::stod(text) != number) return fmt::format("{:.15g}", number);
    // the exponent without its sign and zeros
    const std::size_t e = text.find('e');
    if (e == std::string::npos) return text;
    std::size_t digits = e + 1;
    const bool negative = text[digits] == '-';
    while (digits + 1 < text.size() && (text[digits] < '1' || text[digits] > '9')) ++digits;
    return text.substr(0, e + 1) + (negative ? "-" : "") + text.substr(digits);
}

std::string rangeText(const NumberRange& range) {
    const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
    std::string text;
    if (low && high && !range.openLow && !range.openHigh)
        text = shortNumber(range.low) + " to " + shortNumber(range.high);
    else if (!low && !high)
        text = "any number";
    else {
        if (low) text = (range.openLow ? "more than " : "at least ") + shortNumber(range.low);
        if (low && high) text += " and ";
        if (high) text += (range.openHigh ? "less than " : "at most ") + shortNumber(range.high);
    }
    return *range.unit ? text + " " + range.unit : text;
}

}  // namespace stereonav
