// Plain numbers for air_formula.h.
#pragma once

#include <algorithm>
#include <cmath>

namespace stereonav {

// A number of the formula, of any unit.
struct AirNumber {
    double v = 0;
    AirNumber() = default;
    explicit AirNumber(double x) : v(x) {}
};
inline AirNumber operator+(AirNumber a, AirNumber b) {
    return AirNumber(a.v + b.v);
}
inline AirNumber operator-(AirNumber a, AirNumber b) {
    return AirNumber(a.v - b.v);
}
inline AirNumber operator*(AirNumber a, AirNumber b) {
    return AirNumber(a.v * b.v);
}
inline bool operator<(AirNumber a, AirNumber b) {
    return a.v < b.v;
}
inline AirNumber mulAdd(AirNumber a, AirNumber b, AirNumber c) {
    return AirNumber(a.v * b.v + c.v);
}
inline AirNumber max(AirNumber a, AirNumber b) {
    return AirNumber(std::max(a.v, b.v));
}
inline AirNumber abs(AirNumber a) {
    return AirNumber(std::abs(a.v));
}
inline AirNumber select(bool yes, AirNumber a, AirNumber b) {
    return yes ? a : b;
}
inline AirNumber airReciprocal(AirNumber a) {
    return AirNumber(1 / a.v);
}
inline AirNumber airRsqrt(AirNumber a) {
    return AirNumber(1 / std::sqrt(a.v));
}
inline AirNumber airLog(AirNumber a) {
    return AirNumber(std::log(a.v));
}
// Exponents as far as single precision goes, so that no product of two overflows there.
constexpr double kLeastOfAirExp = -12, kMostOfAirExp = 80;
inline AirNumber airExp(AirNumber x) {
    return AirNumber(std::exp(-std::clamp(x.v, kLeastOfAirExp, kMostOfAirExp)));
}

}  // namespace stereonav
