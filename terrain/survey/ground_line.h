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
// world: two places or more, on the ground; those that repeat the one before are left out.
std::vector<LinePoint> groundLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world);

// Metres. A value that a hole leaves open is NaN.
struct LineMeasure {
    double plan = 0;      // over the plan
    double straight = 0;  // through the vertices' ground, in space
    double along = 0;     // along the ground
    double rise = 0;      // height of the last place over the first
    double climb = 0, descent = 0;
    double lowest = 0, highest = 0;
};
LineMeasure measureLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world);

// By how much each figure changes most where every second sample is left out, over the four ways of doing so.
// Half the spacing would change it by less wherever the ground is smoother than its samples are apart; it
// says nothing of errors of the samples themselves. NaN where the ground has less than four samples a side.
// whole: the figures of all samples. figures: of a ground whose origin lies `shift` from that of the whole
// one, in its world; as many each time.
using FiguresOfGround =
    std::function<std::vector<double>(const GroundSamples& ground, const glm::dvec2& shift)>;
std::vector<double> errorsOfSpacing(const GroundSamples& ground, const std::vector<double>& whole,
                                    const FiguresOfGround& figures);

// Each figure's, of the same fields. measured: what measureLine() gives.
LineMeasure errorsOfLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world,
                         const LineMeasure& measured);

}  // namespace stereonav
