// Numbers that an option of the command line or a key of a scene file takes: what is checked and what is said
// come from one declaration.
#pragma once

#include <limits>
#include <string>

namespace stereonav {

// Numbers from low to high in `unit`. Open ends are not taken themselves.
struct NumberRange {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    bool openLow = false, openHigh = false;
    const char* unit = "";  // "degrees", "metres"; "": none

    // Returns false for NaN and what is infinite.
    bool holds(double number) const;
};

// Returns a range with both of its ends; above() one without `low`.
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
