#include "engine/text/number.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stereonav {
namespace {

// Returns whether digits that no double holds are too large for one. Their magnitude is that of the first
// digit that is not 0, and the exponent.
bool tooLarge(std::string_view digits) {
    long long exponent = 0;
    const std::size_t e = digits.find_first_of("eE");
    if (e != std::string_view::npos) {
        std::string_view rest = digits.substr(e + 1);
        const bool negative = rest.starts_with('-');
        const auto given = takeWhole<long long>(rest, Plus::Allowed);
        exponent = given ? *given : (negative ? -1 : 1) * std::numeric_limits<long long>::max() / 2;
        digits = digits.substr(0, e);
    }
    const std::size_t first = digits.find_first_of("123456789");
    if (first == std::string_view::npos) return false;
    const std::size_t point = std::min(digits.find('.'), digits.size());
    return exponent + static_cast<long long>(point) - static_cast<long long>(first) > 0;
}

}  // namespace

std::optional<double> takeNumber(std::string_view& rest, Plus plus) {
    std::string_view digits = rest;
    // A second sign would be taken by what reads the digits.
    if (plus == Plus::Allowed && digits.starts_with('+') && !digits.substr(1).starts_with('-'))
        digits.remove_prefix(1);
    double value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code == std::errc::invalid_argument) return std::nullopt;
    if (code == std::errc::result_out_of_range) {
        const std::string_view taken(digits.data(), static_cast<std::size_t>(end - digits.data()));
        value = std::copysign(tooLarge(taken) ? std::numeric_limits<double>::infinity() : 0.0,
                              taken.starts_with('-') ? -1.0 : 1.0);
    }
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return value;
}

std::optional<double> numberOf(std::string_view text, Plus plus) {
    const bool digits = text.find_first_of("0123456789") != std::string_view::npos;
    const std::optional<double> value = takeNumber(text, plus);
    // A number in digits is finite; "inf" has none.
    if (!value || !text.empty() || (digits && std::isinf(*value))) return std::nullopt;
    return value;
}

}  // namespace stereonav
