#include "app/options/option_value.h"

#include <algorithm>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr NumberRange kSideRange = within(1, 32768, "pixels");

ValueType typeOf(ValueKind kind) {
    ValueType type;
    type.kind = kind;
    return type;
}

ValueType rangedType(ValueKind kind, const NumberRange& range) {
    ValueType type = typeOf(kind);
    type.range = range;
    return type;
}

Error refusal(const std::string& option, const ValueType& type, const std::string& text,
              const std::string& advice) {
    return {option, "", "expected " + type.expected() + ", got " + shownText(text), advice};
}

// Returns "a, b or c".
std::string oneOf(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t n = 0; n < words.size(); ++n)
        text += (n == 0 ? "" : n + 1 == words.size() ? " or " : ", ") + words[n];
    return text;
}

// Reads the sides of a size. Whether memory suffices is checked where the size is used.
std::vector<double> sidesOf(const std::string& option, const ValueType& type, const std::string& advice,
                            const std::string& text) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const std::string_view all(text), width = all.substr(0, cross);
    const std::string_view height = cross < text.size() ? all.substr(cross + 1) : "";
    try {
        return {static_cast<double>(wholeIn("", kSideRange, "", width)),
                static_cast<double>(wholeIn("", kSideRange, "", height))};
    } catch (const Error&) {
        throw refusal(option, type, text, advice);
    }
}

// Reads one number, or the first and last number of a part.
std::vector<double> wholeOrPartIn(const std::string& option, const ValueType& type, const std::string& advice,
                                  const std::string& text) {
    const std::size_t dots = text.find("..");
    try {
        if (dots == std::string::npos) return {static_cast<double>(wholeIn("", type.range, "", text))};
        NumberRange ends = type.range;
        ends.low = 0;
        const auto first = static_cast<double>(wholeIn("", ends, "", text.substr(0, dots))),
                   last = static_cast<double>(wholeIn("", ends, "", text.substr(dots + 2)));
        if (first <= last) return {first, last};
    } catch (const Error&) {
    }
    throw refusal(option, type, text, advice);
}

double fractionIn(const std::string& option, const ValueType& type, const std::string& advice,
                  const std::string& text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto whole = numberFromText(text.substr(0, slash));
    const auto parts = slash < text.size() ? numberFromText(text.substr(slash + 1)) : std::optional(1.0);
    if (!whole || !parts || !type.range.holds(*whole / *parts)) throw refusal(option, type, text, advice);
    return *whole / *parts;
}

std::size_t choiceIn(const std::string& option, const ValueType& type, const std::string& advice,
                     const std::string& text) {
    const auto at = std::find(type.words.begin(), type.words.end(), text);
    if (at == type.words.end()) throw refusal(option, type, text, advice);
    return static_cast<std::size_t>(at - type.words.begin());
}

std::vector<std::string> splitAtCommas(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        words.push_back(text.substr(from, comma - from));
        from = comma + 1;
    }
    return words;
}

}  // namespace

ValueType flagValue() {
    return typeOf(ValueKind::Flag);
}
ValueType numberValue(const NumberRange& range) {
    return rangedType(ValueKind::Number, range);
}
ValueType wholeValue(const NumberRange& range) {
    return rangedType(ValueKind::Whole, range);
}
ValueType wholeOrPartValue(const NumberRange& range) {
    return rangedType(ValueKind::WholeOrPart, range);
}
ValueType numbersValue(const NumberList& list) {
    ValueType type = typeOf(ValueKind::Numbers);
    type.list = &list;
    return type;
}
ValueType sizeValue() {
    return rangedType(ValueKind::Size, kSideRange);
}
ValueType fractionValue(const NumberRange& range) {
    return rangedType(ValueKind::Fraction, range);
}
ValueType wordValue(std::vector<std::string> words) {
    ValueType type = typeOf(ValueKind::Word);
    type.words = std::move(words);
    return type;
}
ValueType wordsValue() {
    return typeOf(ValueKind::Words);
}
ValueType textValue() {
    return typeOf(ValueKind::Text);
}
ValueType fileValue() {
    return typeOf(ValueKind::File);
}
ValueType fileOrWordValue(std::vector<std::string> words) {
    ValueType type = typeOf(ValueKind::FileOrWord);
    type.words = std::move(words);
    return type;
}

ValueType ValueType::checked(std::optional<ValueProblem> (*by)(const std::string& text)) const {
    ValueType type = *this;
    type.check = by;
    return type;
}

ValueType ValueType::offering(std::vector<std::string> some) const {
    ValueType type = *this;
    type.offered = std::move(some);
    return type;
}

bool ValueType::takesNumbers() const {
    return kind == ValueKind::Number || kind == ValueKind::Whole || kind == ValueKind::Numbers ||
           kind == ValueKind::Size || kind == ValueKind::Fraction || kind == ValueKind::WholeOrPart;
}

bool ValueType::takesText() const {
    return kind == ValueKind::Text || kind == ValueKind::Words || isFile();
}

std::string ValueType::expected() const {
    switch (kind) {
        case ValueKind::Number:
        case ValueKind::Whole:
            return rangeText(range);
        case ValueKind::WholeOrPart:
            return "a whole number, " + rangeText(range) + ", or FIRST..LAST of those from 0 on";
        case ValueKind::Numbers:
            return listText(*list);
        case ValueKind::Size:
            return "WIDTHxHEIGHT, each " + rangeText(range);
        case ValueKind::Fraction:
            return rangeText(range) + " or a fraction";
        case ValueKind::Word:
            return oneOf(words);
        case ValueKind::Flag:
        case ValueKind::Words:
        case ValueKind::Text:
        case ValueKind::File:
        case ValueKind::FileOrWord:
            break;
    }
    return "";
}

OptionValue readValue(const std::string& option, const ValueType& type, const std::string& advice,
                      const std::string& text) {
    OptionValue value;
    value.text = text;
    switch (type.kind) {
        case ValueKind::Number:
            value.numbers = {numberIn(option, type.range, advice, text)};
            break;
        case ValueKind::Whole:
            value.whole = wholeIn(option, type.range, advice, text);
            value.numbers = {static_cast<double>(value.whole)};
            break;
        case ValueKind::WholeOrPart:
            value.numbers = wholeOrPartIn(option, type, advice, text);
            break;
        case ValueKind::Numbers: {
            GivenNumbers given = numbersIn(option, *type.list, text);
            value.word = std::move(given.word);
            value.numbers = std::move(given.numbers);
            break;
        }
        case ValueKind::Size:
            value.numbers = sidesOf(option, type, advice, text);
            break;
        case ValueKind::Fraction:
            value.numbers = {fractionIn(option, type, advice, text)};
            break;
        case ValueKind::Word:
            value.choice = choiceIn(option, type, advice, text);
            break;
        case ValueKind::Words:
            value.words = splitAtCommas(text);
            break;
        case ValueKind::Flag:
        case ValueKind::Text:
        case ValueKind::File:
        case ValueKind::FileOrWord:
            break;
    }
    const auto problem = type.check ? type.check(text) : std::nullopt;
    if (problem) throw Error(option, "", problem->problem, problem->advice);
    return value;
}

}  // namespace stereonav
