// Areas on the ground: in plan and along the surface, and volumes above and below a level plane.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/survey/ground_samples.h"

namespace stereonav {

// Called now and then with the share of the work that is done, 0 to 1, on the calling thread; its exceptions
// end the work.
using ShareDone = std::function<void(double share)>;

// Figures of an area.
struct AreaMeasure {
    double plan = 0;       // square metres
    double along = 0;      // square metres of the surface
    double perimeter = 0;  // metres over the plan
    // Cubic metres of ground above the plane, and of space between plane and ground below it.
    double above = 0, below = 0;
    double highest = 0, lowest = 0;  // metres, of the samples inside and of the border's crossings of cells
};

// How many times measureArea() halves a cell that its plane cuts.
constexpr int kHalvings = 6;
// Measures an area. corners: world, metres, three or more, in order; the last is joined to the first. Where
// the border crosses itself, parts that it goes around twice count twice. plane: metres, in heights of the
// ground. The area in plan is exact; along the surface it is integrated with a rule of fifth order in each
// cell; volumes are exact except in cells that the plane cuts. Where a hole lies in the area, everything
// except plan and perimeter is NaN. Sums are made by rows of cells from the south, so that they depend
// neither on the thread count nor on where the samples are stored.
AreaMeasure measureArea(const GroundSamples& ground, const std::vector<glm::dvec2>& corners, double plane,
                        const ShareDone& done = {});

// Returns only the lowest height in metres, in a tenth of the time; NaN over a hole.
double lowestInArea(const GroundSamples& ground, const std::vector<glm::dvec2>& corners,
                    const ShareDone& done = {});

// Returns the errors of an area's figures, in their units, by the method of errorsOfLine(). measured: result
// of measureArea() for that plane.
AreaMeasure errorsOfArea(const GroundSamples& ground, const std::vector<glm::dvec2>& corners, double plane,
                         const AreaMeasure& measured, const ShareDone& done = {});

}  // namespace stereonav
