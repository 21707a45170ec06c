// Lengths, areas and volumes for people, in units by their size. Files and programs get metres.
#pragma once

#include <string>

namespace stereonav {

// A unit, and how many of the base unit (m, m2, m3) it is.
struct SizedUnit {
    double size = 1;
    const char* name = "m";
};

// Return the unit that suits the size: from µm to km, from mm2 to km2, from mm3 to km3.
SizedUnit lengthUnit(double metres);
SizedUnit areaUnit(double squareMetres);
SizedUnit volumeUnit(double cubicMetres);

// Returns metres in the unit that suits the size: "56 µm", "1.3 mm", "20.0 m", "1.25 km".
std::string lengthText(double metres);
// Return the same of areas and volumes, with four digits: "812.5 mm2", "12.35 km2", "3.4 million m3".
std::string areaText(double squareMetres);
std::string volumeText(double cubicMetres);

// Returns the number with this many decimals; what rounds to 0 has no minus.
std::string fixedText(double number, int decimals);
// Returns the number with about four digits and without an exponent: "0.0123", "812.5", "12350".
std::string fourDigits(double number);

}  // namespace stereonav
