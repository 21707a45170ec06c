// Numbers out of what a person writes: decimal, finite, nothing beside them. What is refused says so in the
// same line everywhere: `OPTION: expected 1 to 170 degrees, got "nan"; ADVICE`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/number_range.h"

namespace stereonav {

// "-1.5e3"; none for anything else: nan, inf, hexadecimal, blanks, trailing text, what no double holds.
std::optional<double> numberFromText(std::string_view text);
// "1,2,3"; empty where it is anything else.
std::vector<double> numbersFromText(std::string_view text);

// The text in quotes, cut where it is long.
std::string shownText(std::string_view text);

// Throw Error, naming the option. advice: what to write instead.
double numberIn(const std::string& option, const NumberRange& range, const std::string& advice,
                std::string_view text);
// Whole numbers: ranges end at whole numbers within +-2^63.
std::int64_t wholeIn(const std::string& option, const NumberRange& range, const std::string& advice,
                     std::string_view text);

// What a list of numbers may be: "x,y,z", or after a word, as in "centreline,0.05".
struct NumberForm {
    std::string word;  // its first; "": none
    std::vector<NumberRange> numbers;
    std::size_t least = numbers.size();  // how many of them there are at least
};
struct NumberList {
    std::string what;  // "x,y,z in metres"
    std::vector<NumberForm> forms;
    std::string advice;
};
struct GivenNumbers {
    std::string word;
    std::vector<double> numbers;
};
// By the first form that it fits. Throws Error, naming the option.
GivenNumbers numbersIn(const std::string& option, const NumberList& list, const std::string& text);
// "x,y,z in metres: each -1e9 to 1e9 metres"
std::string listText(const NumberList& list);

}  // namespace stereonav
