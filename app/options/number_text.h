// Numbers from text: decimal, finite, nothing beside them. Refusals have the same form everywhere: `OPTION:
// expected 1 to 170 degrees, got "nan"; ADVICE`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/number_range.h"

namespace stereonav {

// Returns the number in a text such as "-1.5e3"; empty for anything else: nan, inf, hexadecimal, blanks,
// trailing text, and what no double holds.
std::optional<double> numberFromText(std::string_view text);
// Returns the numbers of "1,2,3"; none for anything else.
std::vector<double> numbersFromText(std::string_view text);

// Returns the text in quotes, shortened where it is long.
std::string shownText(std::string_view text);

// Returns the number in `text`. Throws Error that names the option. advice: what to write instead.
double numberIn(const std::string& option, const NumberRange& range, const std::string& advice,
                std::string_view text);
// Returns the whole number in `text`; ranges end at whole numbers within +-2^63.
std::int64_t wholeIn(const std::string& option, const NumberRange& range, const std::string& advice,
                     std::string_view text);

// One form of a list of numbers: "x,y,z", or with a word first, as in "centreline,0.05".
struct NumberForm {
    std::string word;  // first word of the list; "": none
    std::vector<NumberRange> numbers;
    std::size_t least = numbers.size();  // least number of values
};
struct NumberList {
    std::string what;  // description: "x,y,z in metres"
    std::vector<NumberForm> forms;
    std::string advice;
};
struct GivenNumbers {
    std::string word;
    std::vector<double> numbers;
};
// Reads the text by the first form that fits. Throws Error that names the option.
GivenNumbers numbersIn(const std::string& option, const NumberList& list, const std::string& text);
// Returns the description of all forms: "x,y,z in metres: each -1e9 to 1e9 metres".
std::string listText(const NumberList& list);

}  // namespace stereonav
