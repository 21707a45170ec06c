// A rough way through the lumen made smooth, centred and even, without leaving it.
#pragma once

#include <functional>
#include <vector>

#include "colon/centreline/centreline_probe.h"

namespace stereonav {

// Refines a line. rough: points inside, metres, each straight line between neighbours inside, as
// roughCentreline's voxels are. The ends are drawn back from the wall to where a sphere fits about as well as
// further on, at most a quarter of the length each. Every point of the answer lies inside, and so do the
// lines between them; one point or more. poll: called now and then; may throw.
std::vector<glm::dvec3> refineCentreline(const LumenProbe& probe, const std::vector<glm::dvec3>& rough,
                                         const std::function<void()>& poll);

// Returns points evenly along a line, the ends kept; the distance is the nearest to `spacing` (metres, > 0)
// that divides the length. Points that would fall outside move to the nearest given point. Throws Error when
// there would be more than ten million.
std::vector<glm::dvec3> resampleEvenly(const LumenProbe& probe, const std::vector<glm::dvec3>& points,
                                       double spacing);

// Sum of the lengths of all pieces, in the points' unit.
double polylineLength(const std::vector<glm::dvec3>& points);

}  // namespace stereonav
