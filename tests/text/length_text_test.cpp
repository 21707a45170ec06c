// Units by the size of what is measured.
#include "engine/text/length_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stereonav {
namespace {

TEST(LengthText, HasTheUnitOfItsSize) {
    EXPECT_EQ(lengthText(5.63e-05), "56 \u00b5m");
    EXPECT_EQ(lengthText(0.00125), "1.2 mm");
    EXPECT_EQ(lengthText(0.04), "40.0 mm");
    EXPECT_EQ(lengthText(2.5), "2.50 m");
    EXPECT_EQ(lengthText(310), "310 m");
    EXPECT_EQ(lengthText(12345), "12.35 km");
    EXPECT_EQ(lengthText(-12345), "-12.35 km") << "below zero too";
    EXPECT_EQ(lengthText(0), "0.0 mm");
}

TEST(LengthText, AreasAndVolumesToo) {
    EXPECT_EQ(areaText(0.0008125), "812.5 mm2");
    EXPECT_EQ(areaText(12.5), "12.50 m2");
    EXPECT_EQ(areaText(1234567), "1.235 km2") << "seven digits are not read";
    EXPECT_EQ(areaText(98.7654e6), "98.77 km2");
    EXPECT_EQ(volumeText(3e-8), "30.00 mm3");
    EXPECT_EQ(volumeText(2.5e-4), "250.0 ml");
    EXPECT_EQ(volumeText(1234.5), "1234 m3");
    EXPECT_EQ(volumeText(3.4e6), "3.400 million m3");
    EXPECT_EQ(volumeText(2e9), "2.000 km3");
    EXPECT_EQ(volumeText(0), "0 m3");
}

TEST(LengthText, NothingHasAMinusBeforeZero) {
    EXPECT_EQ(fixedText(-0.04, 1), "0.0");
    EXPECT_EQ(fixedText(-0.06, 1), "-0.1");
    EXPECT_EQ(fixedText(-0.0, 0), "0");
    EXPECT_EQ(volumeText(-0.0), "0 m3");
    EXPECT_EQ(lengthText(-1e-9), "0 \u00b5m");
    EXPECT_EQ(fourDigits(-1e-7), "0.0000");
}

TEST(LengthText, TakesAnyNumber) {
    EXPECT_EQ(fourDigits(HUGE_VAL), "inf");
    EXPECT_NE(lengthText(std::nan("")).find("nan"), std::string::npos);
    EXPECT_EQ(fourDigits(1e20), "100000000000000000000");
}

}  // namespace
}  // namespace stereonav
