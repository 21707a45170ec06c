// Areas over the ground: over the plan, along the ground, and volumes over and under a level plane.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "terrain/ground/heightfield.h"

namespace stereonav {

struct AreaMeasure {
    double plan = 0;                 // square metres
    double along = 0;                // square metres of the surface
    double perimeter = 0;            // metres over the plan
    double above = 0, below = 0;     // cubic metres of ground over the plane, and of room under it
    double highest = 0, lowest = 0;  // metres, of the samples inside and the border's crossings
};

// corners: world, three or more, in order; the last is joined to the first. Where the border crosses itself
// what it goes around twice counts twice. plane: metres, in the heights of the ground. Exact over the plan;
// surfaces by a rule of fifth order in each cell, volumes exact but in cells that the plane cuts, which are
// halved kHalvings times. What lies over a hole makes all but plan and perimeter NaN.
constexpr int kHalvings = 6;
AreaMeasure measureArea(const Heightfield& ground, const std::vector<glm::dvec2>& corners, double plane);

// As errorsOfLine().
AreaMeasure errorsOfArea(const Heightfield& ground, const std::vector<glm::dvec2>& corners, double plane);

}  // namespace stereonav
