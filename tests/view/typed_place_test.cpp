// Places as people type them.
#include "app/view/typed_place.h"

#include <gmock/gmock.h>

#include <string>

namespace stereonav {
namespace {

using Kind = TypedPlace::Kind;

// Expects the likeliest reading.
void expectEarth(const std::string& text, double north, double east) {
    SCOPED_TRACE(text);
    const auto places = readTypedPlace(text);
    ASSERT_FALSE(places.empty());
    EXPECT_EQ(places.front().kind, Kind::Earth);
    EXPECT_NEAR(places.front().numbers.x, north, 1e-9);
    EXPECT_NEAR(places.front().numbers.y, east, 1e-9);
}

TEST(PlaceTyped, DegreesInAnyForm) {
    for (const char* const text :
         {"34.35,-118.1", " 34.35 , -118.1 ", "34.35; -118.1", "34.35 -118.1", "34.35 N 118.1 W",
          "118.1W, 34.35N", "N34.35 W118.1", "34 21 0 N 118 6 0 W", "34\u00b021'0\"N 118\u00b06'0\"W",
          "34 21 N, 118 6 W", "34:21:00 N 118:06:00 W", "+34.35, \u2212118.1", "34 21 0 -118 6 0"})
        expectEarth(text, 34.35, -118.1);
    expectEarth("0,0", 0, 0);
    expectEarth("33.5 S 70.25 W", -33.5, -70.25);
    expectEarth("-0 30 0 -0 30 0", -0.5, -0.5);
}

TEST(PlaceTyped, ZonesOfUtm) {
    for (const char* const text :
         {"11S 392000 3801000", "11 S 392000 3801000", "zone 11 392000 3801000",
          "UTM zone 11 north 392000 3801000", "utm 11N 392000E 3801000N", "11S 392000 m E 3801000 m N"}) {
        SCOPED_TRACE(text);
        const auto places = readTypedPlace(text);
        ASSERT_FALSE(places.empty());
        EXPECT_EQ(places.front(), (TypedPlace{Kind::Utm, {392000, 3801000, 0}, 2, 11, false}));
    }
    EXPECT_TRUE(readTypedPlace("32H 500000 6250000").front().south) << "a band of the south";
    EXPECT_EQ(readTypedPlace("11S 392000 3801000").size(), 2u) << "S is a band, or the south";
    for (const char* const text : {"61N 392000 3801000", "0N 392000 3801000", "11Q2 3 4", "11S 392000"})
        EXPECT_TRUE(readTypedPlace(text).empty()) << text;
}

TEST(PlaceTyped, NumbersOfTheSceneItself) {
    const TypedPlace own{Kind::Own, {392000, 3801000, 0}, 2, 0, false};
    EXPECT_THAT(readTypedPlace("392000 3801000"), testing::ElementsAre(own));
    EXPECT_THAT(readTypedPlace("392000 E, 3801000 N"), testing::ElementsAre(own));
    EXPECT_EQ(readTypedPlace("34.35,-118.1").back().kind, Kind::Own) << "where that is nowhere on the ground";
    EXPECT_THAT(readTypedPlace("-12.5 80 -340"),
                testing::ElementsAre(TypedPlace{Kind::Own, {-12.5, 80, -340}, 3, 0, false}));
    EXPECT_THAT(readTypedPlace("R 12.5  P 80.0  I 340.0 mm"),
                testing::ElementsAre(TypedPlace{Kind::Patient, {-12.5, 80, -340}, 3, 0, false}))
        << "as the line at the bottom has it";
}

TEST(PlaceTyped, LengthsAlongALine) {
    for (const char* const text : {"250 mm", "250mm", "25 cm", "0.25 m"}) {
        SCOPED_TRACE(text);
        const auto places = readTypedPlace(text);
        ASSERT_EQ(places.size(), 1u);
        EXPECT_EQ(places.front().kind, Kind::Along);
        EXPECT_NEAR(places.front().numbers.x, 0.25, 1e-12);
    }
}

TEST(PlaceTyped, OtherWordsAreNone) {
    for (const char* const text : {"", " ", "fov", "34.35", "nan 5", "inf,2", "1e400 2", "34 N 35 N",
                                   "1 2 3 4 5", "94 N 10 E", "34 61 0 N 118 6 0 W", "contours 50",
                                   "L 1 L 2 S 3", "\xff\xfe 3", "1 2 3 4 5 6 7 8 9 10 11 12 13 14"})
        EXPECT_TRUE(readTypedPlace(text).empty()) << text;
}

}  // namespace
}  // namespace stereonav
