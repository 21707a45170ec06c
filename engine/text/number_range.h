// Ranges of numbers for options of the command line and keys of scene files: the check and the message come
// from one declaration.
#pragma once

#include <limits>
#include <string>

namespace stereonav {

// Numbers from low to high in `unit`. An open end is not part of the range.
struct NumberRange {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    bool openLow = false, openHigh = false;
    const char* unit = "";  // "degrees", "metres"; "": none

    // Returns whether the number is in the range; false for NaN and infinite numbers.
    bool holds(double number) const;
};

// Returns a range that includes both ends; above() returns one without `low`.
constexpr NumberRange within(double low, double high, const char* unit = "") {
    return {low, high, false, false, unit};
}
constexpr NumberRange above(double low, double high, const char* unit = "") {
    return {low, high, true, false, unit};
}

// Returns the number as a person writes it: "170", "1e6", "0.001".
std::string shortNumber(double number);
// Returns a range in words: "1 to 170 degrees", "more than 0 and at most 1e6 mm", "any number".
std::string rangeText(const NumberRange& range);

}  // namespace stereonav
