// The type of an option's value, and a value read by it: numbers are checked against their range and words
// against their list before anything else is done.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/options/number_text.h"

namespace stereonav {

enum class ValueKind {
    Flag,         // without a value
    Number,       // a number in a range
    Whole,        // a whole number in a range
    WholeOrPart,  // Whole, or "FIRST..LAST": two from 0 to the range's end, in this order
    Numbers,      // a list of numbers (NumberList)
    Size,         // "500x400"
    Fraction,     // "0.0333" or "1/30", within a range
    Word,         // one of a list
    Words,        // several words, separated by commas, of a list that only the scene knows
    Text,         // any text
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
    std::vector<std::string> offered;  // words that completion offers; others may be valid
    // Returns what is wrong with a value of this kind; null: nothing can be.
    std::optional<ValueProblem> (*check)(const std::string& text) = nullptr;

    // Returns a copy of this type with a check.
    ValueType checked(std::optional<ValueProblem> (*by)(const std::string& text)) const;
    // Returns a copy of this type with words that completion offers.
    ValueType offering(std::vector<std::string> some) const;
    bool takesNumbers() const;
    bool takesText() const;  // true for names, files, and words that a scene knows
    bool isFile() const { return kind == ValueKind::File || kind == ValueKind::FileOrWord; }
    // Returns the range or list for messages: "1 to 170 degrees"; "" where any text is accepted.
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
    std::string text;             // the value as written
    std::vector<double> numbers;  // both sides of a size, or both ends of a part
    std::int64_t whole = 0;       // value of Whole
    std::string word;             // first word of a NumberList's form
    std::size_t choice = 0;       // index of a Word in its list
    std::vector<std::string> words;

    double number() const { return numbers.front(); }
};

// Reads and checks the text. Throws Error that names the option. advice: what to write instead.
OptionValue readValue(const std::string& option, const ValueType& type, const std::string& advice,
                      const std::string& text);

}  // namespace stereonav
