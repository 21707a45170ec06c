// How long the sun shines on each sample of the ground: lines of sight towards places of the sun, by the
// ground alone.
#pragma once

#include <vector>

#include "engine/base/progress.h"
#include "engine/image/plane.h"
#include "terrain/survey/sight_line.h"

namespace stereonav {

// A place of the sun, radians: azimuth clockwise from the world's y axis, elevation above the level, 0 to
// below a quarter turn.
struct SunOverGround {
    double azimuth = 0, elevation = 0;  // radians
};

// Returns whether the middle of the sun stands free over a sample.
bool sunShinesOn(const SightLines& lines, int i, int j, const SunOverGround& sun);

// Returns, for each sample, the share of these places from which the sun shines, times `hours`; row 0
// southernmost, NaN where there is no ground. Suns below the level shine on nothing. Throws Cancelled.
Plane<float> hoursOfSun(const SightLines& lines, const std::vector<SunOverGround>& suns, double hours,
                        Progress& progress);

}  // namespace stereonav
