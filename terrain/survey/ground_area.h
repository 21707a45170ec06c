// Areas over the ground: over the plan, along the ground, and volumes over and under a level plane.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/survey/ground_samples.h"

namespace stereonav {

// Called now and then with the share of the work that is done, 0 to 1, on the thread that asked; what it
// throws ends the work.
using ShareDone = std::function<void(double share)>;

// Figures of an area.
struct AreaMeasure {
    double plan = 0;                 // square metres
    double along = 0;                // square metres of the surface
    double perimeter = 0;            // metres over the plan
    double above = 0, below = 0;     // cubic metres of ground over the plane, and of room under it
    double highest = 0, lowest = 0;  // metres, of the samples inside and the border's crossings
};

// How often measureArea() halves a cell that its plane cuts.
constexpr int kHalvings = 6;
// Measures an area. corners: world, metres, three or more, in order; the last is joined to the first. Where
// the border crosses itself what it goes around twice counts twice. plane: metres, in the heights of the
// ground. Exact over the plan; surfaces by a rule of fifth order in each cell, volumes exact but in cells
// that the plane cuts. What lies over a hole makes all but plan and perimeter NaN. Sums are made row by row
// of cells from the south on, whatever the thread count and wherever the samples lie.
AreaMeasure measureArea(const GroundSamples& ground, const std::vector<glm::dvec2>& corners, double plane,
                        const ShareDone& done = {});

// Returns the lowest height alone, metres, which takes a tenth of the time; NaN over a hole.
double lowestInArea(const GroundSamples& ground, const std::vector<glm::dvec2>& corners,
                    const ShareDone& done = {});

// Returns the errors of an area's figures, in their units, as errorsOfLine() does a line's. measured: what
// measureArea() gives over that plane.
AreaMeasure errorsOfArea(const GroundSamples& ground, const std::vector<glm::dvec2>& corners, double plane,
                         const AreaMeasure& measured, const ShareDone& done = {});

}  // namespace stereonav
