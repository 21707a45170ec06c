#include "engine/text/length_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

std::string sizedText(double number, const SizedUnit& unit) {
    return fourDigits(number / unit.size) + " " + unit.name;
}

}  // namespace

std::string fixedText(double number, int decimals) {
    std::string text = fmt::format("{:.{}f}", number, decimals);
    const bool zero = text.find_first_not_of("-0.") == text.npos;
    return zero && text.starts_with('-') ? text.substr(1) : text;
}

std::string fourDigits(double number) {
    constexpr int kMostDecimals = 4;
    if (number == 0 || !std::isfinite(number)) return fixedText(number, 0);
    const int before = static_cast<int>(std::floor(std::log10(std::abs(number)))) + 1;
    return fixedText(number, std::clamp(4 - before, 0, kMostDecimals));
}

SizedUnit lengthUnit(double metres) {
    const double size = std::abs(metres);
    if (size >= 1000) return {1000, "km"};
    if (size >= 0.1) return {1, "m"};
    return size > 0 && size < 1e-4 ? SizedUnit{1e-6, "\u00b5m"} : SizedUnit{1e-3, "mm"};
}

SizedUnit areaUnit(double squareMetres) {
    const double size = std::abs(squareMetres);
    if (size >= 1e6) return {1e6, "km2"};
    return size > 0 && size < 0.01 ? SizedUnit{1e-6, "mm2"} : SizedUnit{1, "m2"};
}

SizedUnit volumeUnit(double cubicMetres) {
    const double size = std::abs(cubicMetres);
    if (size >= 1e9) return {1e9, "km3"};
    if (size >= 1e6) return {1e6, "million m3"};
    if (size == 0 || size >= 1e-3) return {1, "m3"};
    return size < 1e-6 ? SizedUnit{1e-9, "mm3"} : SizedUnit{1e-6, "ml"};
}

std::string lengthText(double metres) {
    const SizedUnit unit = lengthUnit(metres);
    const double number = metres / unit.size, size = std::abs(number);
    const int decimals = unit.size == 1000   ? 2
                         : unit.size == 1e-6 ? 0
                         : unit.size < 1     ? 1
                         : size >= 100       ? 0
                         : size >= 10        ? 1
                                             : 2;
    return fixedText(number, decimals) + " " + unit.name;
}

std::string areaText(double squareMetres) {
    return sizedText(squareMetres, areaUnit(squareMetres));
}

std::string volumeText(double cubicMetres) {
    return sizedText(cubicMetres, volumeUnit(cubicMetres));
}

}  // namespace stereonav
