#include "app/options/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "engine/base/error.h"
#include "engine/text/utf8.h"

namespace stereonav {
namespace {

constexpr std::size_t kLongestShown = 40;

// Returns the text without a leading plus sign, which from_chars does not accept.
std::string_view withoutPlus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    return text;
}

Error refusal(const std::string& option, const std::string& expected, std::string_view text,
              const std::string& advice) {
    return {option, "", "expected " + expected + ", got " + shownText(text), advice};
}

// Returns "0 to 1", "each 0 to 1" or "0 to 1, then 2 to 3": equal ranges are written once.
std::string rangesText(const std::vector<NumberRange>& ranges) {
    std::vector<std::string> texts;
    texts.reserve(ranges.size());
    for (const NumberRange& range : ranges) texts.push_back(rangeText(range));
    if (texts.size() > 1 &&
        std::adjacent_find(texts.begin(), texts.end(), std::not_equal_to<>()) == texts.end())
        return "each " + texts.front();
    std::string all;
    for (std::size_t n = 0; n < texts.size(); ++n) {
        if (n > 0 && texts[n] == texts[n - 1]) continue;
        all += (n ? ", then " : "") + texts[n];
    }
    return all;
}

std::optional<std::vector<double>> numbersOf(const NumberForm& form, const std::string& text) {
    std::string_view rest = text;
    if (!form.word.empty()) {
        if (!rest.starts_with(form.word)) return std::nullopt;
        rest.remove_prefix(form.word.size());
        if (rest.empty()) return form.least == 0 ? std::optional(std::vector<double>{}) : std::nullopt;
        if (rest.front() != ',') return std::nullopt;
        rest.remove_prefix(1);
    }
    std::vector<double> numbers = numbersFromText(rest);
    if (numbers.empty() || numbers.size() < form.least || numbers.size() > form.numbers.size())
        return std::nullopt;
    for (std::size_t n = 0; n < numbers.size(); ++n)
        if (!form.numbers[n].holds(numbers[n])) return std::nullopt;
    return numbers;
}

}  // namespace

std::optional<double> numberFromText(std::string_view text) {
    text = withoutPlus(text);
    double number = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

std::vector<double> numbersFromText(std::string_view text) {
    std::vector<double> numbers;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        const std::optional<double> number = numberFromText(text.substr(from, comma - from));
        if (!number) return {};
        numbers.push_back(*number);
        from = comma + 1;
    }
    return numbers;
}

std::string shownText(std::string_view text) {
    const std::string_view shown = firstBytes(text, kLongestShown);
    return fmt::format("\"{}{}\"", shown, shown.size() < text.size() ? "..." : "");
}

double numberIn(const std::string& option, const NumberRange& range, const std::string& advice,
                std::string_view text) {
    const std::optional<double> number = numberFromText(text);
    if (!number || !range.holds(*number)) throw refusal(option, rangeText(range), text, advice);
    return *number;
}

std::int64_t wholeIn(const std::string& option, const NumberRange& range, const std::string& advice,
                     std::string_view text) {
    const std::string_view digits = withoutPlus(text);
    std::int64_t number = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = code == std::errc() && end == digits.data() + digits.size();
    if (whole && range.holds(static_cast<double>(number))) return number;
    const bool fraction = !whole && numberFromText(text) && range.holds(*numberFromText(text));
    throw refusal(option, (fraction ? "a whole number, " : "") + rangeText(range), text, advice);
}

GivenNumbers numbersIn(const std::string& option, const NumberList& list, const std::string& text) {
    for (const NumberForm& form : list.forms)
        if (std::optional<std::vector<double>> numbers = numbersOf(form, text))
            return {form.word, std::move(*numbers)};
    throw refusal(option, listText(list), text, list.advice);
}

std::string listText(const NumberList& list) {
    // The longest form has the ranges of all others.
    const NumberForm* longest = &list.forms.front();
    for (const NumberForm& form : list.forms)
        if (form.numbers.size() > longest->numbers.size()) longest = &form;
    return list.what + " (" + rangesText(longest->numbers) + ")";
}

}  // namespace stereonav
