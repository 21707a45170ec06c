// Figures of lines and areas on the ground, each with the uncertainty from the sample spacing, and with names
// for files and for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terrain/survey/ground_area.h"
#include "terrain/survey/ground_samples.h"

namespace stereonav {

struct GroundFigure {
    const char* key;    // in JSON, GeoJSON and CSV
    const char* label;  // for people
    const char* unit;
    double value, error;  // error: 0 where there is none, NaN where it is not known
};

// Returns the figures of a line. world: see groundLine().
std::vector<GroundFigure> figuresOfLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world);
// Returns the figures of an area. plane: height in metres that volumes refer to; empty: the lowest ground
// inside.
std::vector<GroundFigure> figuresOfArea(const GroundSamples& ground, const std::vector<glm::dvec2>& world,
                                        const std::optional<double>& plane, const ShareDone& done = {});

// Returns the figure for people, in a unit by its size: "12.346 km2 +- 0.021". Values in files stay in
// `unit`.
std::string figureText(const GroundFigure& figure);
// Returns " +- 0.2", " (error not known)", or "" where a figure has no error.
std::string errorText(const GroundFigure& figure);

}  // namespace stereonav
