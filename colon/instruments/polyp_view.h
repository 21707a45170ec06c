// Views of a polyp: an eye beside it, and its longest diameter drawn on the wall.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "colon/instruments/polyp.h"
#include "colon/wall/line_of_sight.h"
#include "engine/camera/pose.h"

namespace stereonav {

// Returns a pose on the lumen's side of the polyp, turned to one side of its axis (side: -1, 1; 0: on the
// axis), with free sight.
Pose eyeBeside(const MeasuredPolyp& polyp, const LineOfSight& sight, double side);

// Returns places in the lumen just before the wall, world, metres, above the straight line between the ends
// of the longest diameter; isovalue: stored number, that of `sight`. Places where no wall is met are left
// out.
std::vector<glm::dvec3> widestOnWall(const MeasuredPolyp& polyp, const LineOfSight& sight, double isovalue);

}  // namespace stereonav
