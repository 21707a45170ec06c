// The sun over ground with a known place on the Earth.
#pragma once

#include <vector>

#include "app/scene/terrain/survey_ground.h"
#include "terrain/survey/sun_hours.h"

namespace stereonav {

// The middle of the ground, and the azimuth of true north there in its world.
struct SunPlaceOnGround {
    EarthPlace earth;
    double north = 0;
};
// Throws Error where the ground's place is not known.
SunPlaceOnGround sunPlaceOf(const SurveyGround& survey);

// Returns the sun's places on the day of the given time (seconds since 1970 in UTC), from midnight to
// midnight of local mean solar time. step: seconds.
std::vector<SunOverGround> sunsOfDay(const SunPlaceOnGround& place, double time, double step);

}  // namespace stereonav
