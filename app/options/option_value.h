// What an option takes, and a value that was read by that: numbers are checked against their range, words
// against their list, before anything else is done.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/options/number_text.h"

namespace stereonav {

enum class ValueKind {
    Flag,         // given or not
    Number,       // in a range
    Whole,        // a whole number in a range
    WholeOrPart,  // the same, or "FIRST..LAST": two from 0 to the range's end, in this order
    Numbers,      // a NumberList
    Size,         // "500x400"
    Fraction,     // "0.0333" or "1/30", in a range
    Word,         // one of a list
    Words,        // several of a list that only the scene knows, separated by commas
    Text,         // anything
    File,         // a file or folder
    FileOrWord    // a file, or one of a list
};

struct ValueProblem {
    std::string problem, advice;
};

struct ValueType {
    ValueKind kind = ValueKind::Text;
    NumberRange range;
    const NumberList* list = nullptr;
    std::vector<std::string> words;
    // What is wrong with a value that is of its kind; null: nothing.
    std::optional<ValueProblem> (*check)(const std::string& text) = nullptr;

    // Returns this type with a check.
    ValueType checked(std::optional<ValueProblem> (*by)(const std::string& text)) const;
    bool takesNumbers() const;
    bool takesText() const;  // a name, a file, words that a scene knows
    bool isFile() const { return kind == ValueKind::File || kind == ValueKind::FileOrWord; }
    // "1 to 170 degrees"; "" where anything may be written.
    std::string expected() const;
};

ValueType flagValue();
ValueType numberValue(const NumberRange& range);
ValueType wholeValue(const NumberRange& range);
ValueType wholeOrPartValue(const NumberRange& range);
ValueType numbersValue(const NumberList& list);
ValueType sizeValue();
ValueType fractionValue(const NumberRange& range);
ValueType wordValue(std::vector<std::string> words);
ValueType wordsValue();
ValueType textValue();
ValueType fileValue();
ValueType fileOrWordValue(std::vector<std::string> words);

struct OptionValue {
    std::string text;             // the value as it is written
    std::vector<double> numbers;  // both sides of a size, both ends of a part
    std::int64_t whole = 0;       // read by Whole
    std::string word;             // which a NumberList's form begins with
    std::size_t choice = 0;       // read by Word: which of the list
    std::vector<std::string> words;

    double number() const { return numbers.front(); }
};

// Throws Error that names the option. advice: what to write instead.
OptionValue readValue(const std::string& option, const ValueType& type, const std::string& advice,
                      const std::string& text);

}  // namespace stereonav
