// Duration of sunshine on each sample of the ground: lines of sight towards positions of the sun, hidden only
// by the ground.
#pragma once

#include <vector>

#include "engine/base/progress.h"
#include "engine/image/plane.h"
#include "terrain/survey/sight_line.h"

namespace stereonav {

// A position of the sun, radians: azimuth clockwise from the world's y axis, elevation above the horizontal,
// 0 to below a quarter turn.
struct SunOverGround {
    double azimuth = 0, elevation = 0;  // radians
};

// Returns whether the middle of the sun is visible from a sample.
bool sunShinesOn(const SightLines& lines, int i, int j, const SunOverGround& sun);

// Returns for each sample the share of these positions from which the sun shines on it, times `hours`; row 0
// southernmost, NaN without ground. Suns below the horizontal do not shine. Throws Cancelled.
Plane<float> hoursOfSun(const SightLines& lines, const std::vector<SunOverGround>& suns, double hours,
                        Progress& progress);

}  // namespace stereonav
