// Numbers out of text, whatever the language of the system: decimal, with a point.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace stereonav {

enum class Plus { Refused, Allowed };  // before a number

// Takes the number that the text begins with, which `rest` then begins behind; also "inf" and "nan". What no
// double holds is 0 or infinite. Returns none, and leaves `rest` as it was, where it begins with something
// else.
std::optional<double> takeNumber(std::string_view& rest, Plus plus = Plus::Refused);
// Returns the whole text as a number; also "inf" and "nan", and 0 where no double is so small. Returns
// nothing where it is something else or beyond all doubles.
std::optional<double> numberOf(std::string_view text, Plus plus = Plus::Refused);

// Takes the whole number that the text begins with, as takeNumber() does.
template <typename Whole>
std::optional<Whole> takeWhole(std::string_view& rest, Plus plus = Plus::Refused) {
    const std::string_view digits = rest.substr(plus == Plus::Allowed && rest.starts_with('+') ? 1 : 0);
    Whole value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code != std::errc()) return std::nullopt;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return value;
}
// Returns the whole text as a whole number; none where it is something else, or the type does not hold it.
template <typename Whole>
std::optional<Whole> wholeOf(std::string_view text, Plus plus = Plus::Refused) {
    const std::optional<Whole> value = takeWhole<Whole>(text, plus);
    return text.empty() ? value : std::nullopt;
}

}  // namespace stereonav
