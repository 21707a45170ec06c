// Reads numbers from text, in any locale: decimal, with a point.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace stereonav {

enum class Plus { Refused, Allowed };  // before a number

// Takes the number at the beginning of the text, and moves `rest` behind it; also "inf" and "nan". Numbers
// that no double can hold become 0 or infinite. Returns empty, and leaves `rest` as it was, where it does not
// begin with a number.
std::optional<double> takeNumber(std::string_view& rest, Plus plus = Plus::Refused);
// Returns the whole text as a number; also "inf" and "nan", and 0 for numbers too small for a double. Empty
// where it is something else or too large for a double.
std::optional<double> numberOf(std::string_view text, Plus plus = Plus::Refused);

// Takes the whole number at the beginning of the text, as takeNumber() does.
template <typename Whole>
std::optional<Whole> takeWhole(std::string_view& rest, Plus plus = Plus::Refused) {
    const std::string_view digits = rest.substr(plus == Plus::Allowed && rest.starts_with('+') ? 1 : 0);
    Whole value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code != std::errc()) return std::nullopt;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return value;
}
// Returns the whole text as a whole number; empty where it is something else, or out of the type's range.
template <typename Whole>
std::optional<Whole> wholeOf(std::string_view text, Plus plus = Plus::Refused) {
    const std::optional<Whole> value = takeWhole<Whole>(text, plus);
    return text.empty() ? value : std::nullopt;
}

}  // namespace stereonav
