#include "app/options/option_numbers.h"

#include "engine/camera/view_ranges.h"

namespace stereonav {
namespace {

// Returns the list for a colour: one number for all three channels, or three.
NumberList colors(double most, const char* what, const char* advice) {
    const NumberRange range = within(0, most);
    return {what, {{"", {range}}, {"", {range, range, range}}}, advice};
}

const std::vector<NumberRange> kPlace{kPlaceRange, kPlaceRange, kPlaceRange};

}  // namespace

const NumberList& sunNumbers() {
    static const NumberList list{"azimuth,elevation",
                                 {{"", {kTurnRange, kUprightRange}}},
                                 "315,30 is from the north-west, 30 degrees high"};
    return list;
}

const NumberList& lampNumbers() {
    static const NumberList list{
        "head or x,y,z", {{kHeadLamp, {}}, {"", kPlace}}, "head is a lamp midway between the eyes"};
    return list;
}

const NumberList& colorNumbers() {
    static const NumberList list =
        colors(1e6, "one number or three", "1 is white, 1,0.8,0.6 a warm light; linear values");
    return list;
}

const NumberList& albedoNumbers() {
    static const NumberList list = colors(1, "one number or three", "0.7 is a bright wall");
    return list;
}

const NumberList& skyNumbers() {
    static const NumberList list = colors(kBrightestLight, "one number or three", "as in 1 or 0.3,0.4,0.6");
    return list;
}

const NumberList& mistNumbers() {
    static const NumberList list{"top,optical depth",
                                 {{"", {kPlaceRange, above(0, 1e4)}}},
                                 "as in 900,2: up to 900 m, and 2 straight down"};
    return list;
}

const NumberList& poseNumbers() {
    static const NumberList list{
        "x,y,z,heading,pitch,roll",
        {{"", {kPlaceRange, kPlaceRange, kPlaceRange, kTurnRange, kTurnRange, kTurnRange}, 3}},
        "the angles may be left out, as in 0,0,3000"};
    return list;
}

const NumberList& seedNumbers() {
    static const NumberRange place = within(-1e6, 1e6, "millimetres");
    static const NumberList list{
        "x,y,z, LPS", {{"", {place, place, place}}}, "give three numbers, as in 12.5,-40,310"};
    return list;
}

const NumberList& betweenNumbers() {
    static const NumberRange place = within(-1e6, 1e6, "millimetres");
    static const NumberList list{"x,y,z,x,y,z, LPS",
                                 {{"", {place, place, place, place, place, place}}},
                                 "give two places, as in 12.5,-40,310,14,-38,305"};
    return list;
}

const NumberList& pixelNumbers() {
    static const NumberRange place = within(0, 32767, "pixels");
    static const NumberList list{"x,y", {{"", {place, place}}}, "give two numbers, as in 1200,340"};
    return list;
}

const NumberList& isovaluesNumbers() {
    static const NumberList list{"LOW,HIGH", {{"", {kValueRange, kValueRange}}}, "as in 80,150"};
    return list;
}

const NumberList& pointLightNumbers() {
    static const NumberList list{
        "x,y,z,intensity or centreline,distance",
        {{kCentrelineLights, {within(1e-4, 1e9, "metres")}, 0},
         {"", {kPlaceRange, kPlaceRange, kPlaceRange, above(0, kBrightestLight)}, 3}},
        "the last may be left out, as in 0.1,0,0.3 or centreline"};
    return list;
}

const NumberList& groundPlaceNumbers() {
    static const NumberList list{"x,y,height above the ground",
                                 {{"", {kPlaceRange, kPlaceRange, within(0, 1e6, "metres")}, 2}},
                                 "as in 394268,3798272,20; the height may be left out"};
    return list;
}

const NumberList& contourNumbers() {
    static const NumberList list{
        "auto or metres", {{kAutoContours, {}}, {"", {within(0, 1e6, "metres")}}}, "as in 50; 0 draws none"};
    return list;
}

}  // namespace stereonav
