// How a polyp is looked at: eyes beside it, and its longest diameter as it lies on its wall.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "colon/instruments/polyp.h"
#include "colon/wall/line_of_sight.h"
#include "engine/camera/pose.h"

namespace stereonav {

// Returns eyes at the side of the polyp that the lumen is on, turned to one side of its axis (side: -1, 1; 0:
// on it), with nothing between.
Pose eyeBeside(const MeasuredPolyp& polyp, const LineOfSight& sight, double side);

// Returns places of the lumen just before the wall, world, metres, above the way between the ends of the
// longest diameter; isovalue: stored number, that of `sight`. Left out where the wall is not met.
std::vector<glm::dvec3> widestOnWall(const MeasuredPolyp& polyp, const LineOfSight& sight, double isovalue);

}  // namespace stereonav
