// The sun over ground that says where it lies.
#pragma once

#include <vector>

#include "app/scene/survey_ground.h"
#include "terrain/survey/sun_hours.h"

namespace stereonav {

// The middle of the ground, and the azimuth of true north there in its world.
struct SunPlaceOnGround {
    EarthPlace earth;
    double north = 0;
};
// Throws Error where the ground does not say.
SunPlaceOnGround sunPlaceOf(const SurveyGround& survey);

// The sun's places in the day that holds the time (seconds since 1970 in UTC), from midnight to midnight of
// mean solar time at the place. step: seconds.
std::vector<SunOverGround> sunsOfDay(const SunPlaceOnGround& place, double time, double step);

}  // namespace stereonav
