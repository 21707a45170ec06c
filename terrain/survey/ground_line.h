// Lines over the ground: their heights and lengths, exact on the bilinear surface, and estimates of the
// errors that come from the sample spacing.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/survey/ground_samples.h"

namespace stereonav {

// The ground at a vertex of a line, or where it crosses from one cell into the next.
struct LinePoint {
    double distance = 0;    // metres along the line in plan
    glm::dvec2 world{0.0};  // metres
    double height = 0;      // metres; NaN over a hole
    double along = 0;       // metres along the ground; holes are crossed at constant height
};
// Returns a line in pieces. world: metres, two places or more, on the ground; repeated places are left out.
std::vector<LinePoint> groundLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world);

// Figures of a line, metres; NaN where a hole makes one unknown.
struct LineMeasure {
    double plan = 0;                 // length in plan
    double straight = 0;             // length through the vertices on the ground, in space
    double along = 0;                // along the ground
    double rise = 0;                 // height of the last place over the first
    double climb = 0, descent = 0;   // sums of all ascents and of all descents, both 0 or more
    double lowest = 0, highest = 0;  // heights
};
// Measures a line. world: as for groundLine().
LineMeasure measureLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world);

// Returns the figures of a ground whose origin is shifted by `shift` metres in the world of the whole one;
// the same number of figures each time.
using FiguresOfGround =
    std::function<std::vector<double>(const GroundSamples& ground, const glm::dvec2& shift)>;
// Returns the largest change of each figure, in its unit, when every second sample is left out, over the four
// ways to do so. Half the spacing would change it by less where the ground is smoother than the spacing;
// errors of the samples themselves are not included. NaN where the ground has less than four samples per
// side. whole: the figures from all samples.
std::vector<double> errorsOfSpacing(const GroundSamples& ground, const std::vector<double>& whole,
                                    const FiguresOfGround& figures);

// Returns these errors for each figure of a line, in the same fields. measured: result of measureLine().
LineMeasure errorsOfLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world,
                         const LineMeasure& measured);

}  // namespace stereonav
