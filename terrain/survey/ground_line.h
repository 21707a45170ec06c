// Lines over the ground: their heights and lengths, exact on the bilinear surface, and what the sample
// spacing leaves open of each.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/survey/ground_samples.h"

namespace stereonav {

// The ground at a line's vertices and wherever it crosses from a cell into the next.
struct LinePoint {
    double distance = 0;    // metres along the plan
    glm::dvec2 world{0.0};  // metres
    double height = 0;      // metres; NaN over a hole
    double along = 0;       // metres along the ground; holes are crossed level
};
// Returns a line in pieces. world: metres, two places or more, on the ground; those that repeat the one
// before are left out.
std::vector<LinePoint> groundLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world);

// Figures of a line, metres. A value that a hole leaves open is NaN.
struct LineMeasure {
    double plan = 0;                 // over the plan
    double straight = 0;             // through the vertices' ground, in space
    double along = 0;                // along the ground
    double rise = 0;                 // height of the last place over the first
    double climb = 0, descent = 0;   // sums of what goes up and of what goes down, both 0 or more
    double lowest = 0, highest = 0;  // heights
};
// world: as groundLine()'s.
LineMeasure measureLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world);

// Returns the figures of a ground whose origin lies `shift` metres from that of the whole one, in its world;
// as many each time.
using FiguresOfGround =
    std::function<std::vector<double>(const GroundSamples& ground, const glm::dvec2& shift)>;
// Returns by how much each figure changes most, in its unit, where every second sample is left out, over the
// four ways of doing so. Half the spacing would change it by less wherever the ground is smoother than its
// samples are apart; it says nothing of errors of the samples themselves. NaN where the ground has less than
// four samples a side. whole: the figures of all samples.
std::vector<double> errorsOfSpacing(const GroundSamples& ground, const std::vector<double>& whole,
                                    const FiguresOfGround& figures);

// Returns that for each figure of a line, in the same fields. measured: what measureLine() gives.
LineMeasure errorsOfLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world,
                         const LineMeasure& measured);

}  // namespace stereonav
