// The lists of numbers that options take; used where options are declared and where they are read.
#pragma once

#include "app/options/number_text.h"

namespace stereonav {

const NumberList& sunNumbers();     // --sun, --light-from: azimuth, elevation
const NumberList& lampNumbers();    // --lamp: "head", or a place
const NumberList& colorNumbers();   // --light-color: one or three
const NumberList& albedoNumbers();  // --albedo: one or three
const NumberList& skyNumbers();     // bake --sky: one or three
const NumberList& mistNumbers();    // --mist: top, optical depth
const NumberList& poseNumbers();    // --pose: place, and angles
const NumberList& seedNumbers();    // --seed of a study: millimetres
const NumberList& betweenNumbers();
const NumberList& pixelNumbers();        // --between: two places, millimetres
const NumberList& isovaluesNumbers();    // --isovalues: low, high
const NumberList& pointLightNumbers();   // --light of bake, --point-light: a place, and an intensity
const NumberList& groundPlaceNumbers();  // --from of instruments: x, y, height
const NumberList& contourNumbers();      // --contours: "auto", or metres

constexpr const char* kHeadLamp = "head";
constexpr const char* kAutoContours = "auto";
constexpr const char* kCentrelineLights = "centreline";
constexpr NumberRange kValueRange = within(-1e30, 1e30);  // values of a volume
constexpr double kBrightestLight = 1e30;                  // well within the range of floats

}  // namespace stereonav
