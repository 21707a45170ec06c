// Figures of measured ground, for people: units by their size, values as they were.
#include <gtest/gtest.h>

#include <cmath>

#include "app/scene/terrain/ground_figures.h"

namespace stereonav {
namespace {

TEST(GroundFigureText, HasTheUnitOfItsSize) {
    EXPECT_EQ(figureText({"area_m2", "area", "m2", 1234567.8, 0}), "1.235 km2");
    EXPECT_EQ(figureText({"surface_m2", "area", "m2", 9876543, 21000}), "9.877 km2 +- 0.021");
    EXPECT_EQ(figureText({"surface_m2", "area", "m2", 9876543, 21}), "9.877 km2 +- less than 0.001");
    EXPECT_EQ(figureText({"area_m2", "area", "m2", 1234.56, 0}), "1234.6 m2");
    EXPECT_EQ(figureText({"above_m3", "volume", "m3", 3.4e6, 0}), "3.400 million m3");
    EXPECT_EQ(figureText({"plan_m", "length", "m", 45678.9, 0}), "45.679 km");
    EXPECT_EQ(figureText({"highest_m", "highest", "m", 4321.06, 0.5}), "4321.1 m +- 0.5");
}

TEST(GroundFigureText, ZeroHasNoMinus) {
    EXPECT_EQ(figureText({"below_m3", "volume under it", "m3", -0.0, 0}), "0.0 m3");
    EXPECT_EQ(figureText({"rise_m", "height difference", "m", -0.04, 0}), "0.0 m");
    EXPECT_EQ(figureText({"below_m3", "volume under it", "m3", 0, std::nan("")}), "0.0 m3 (error not known)");
}

}  // namespace
}  // namespace stereonav
