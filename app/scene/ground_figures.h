// Figures of lines and areas on the ground, each with what the sample spacing leaves open: by their names in
// files and for people.
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

// world: as groundLine() takes it.
std::vector<GroundFigure> figuresOfLine(const GroundSamples& ground, const std::vector<glm::dvec2>& world);
// plane: metres; none: through the lowest ground inside.
std::vector<GroundFigure> figuresOfArea(const GroundSamples& ground, const std::vector<glm::dvec2>& world,
                                        const std::optional<double>& plane, const ShareDone& done = {});

// " +- 0.2", " (error not known)", or "" where there is none.
std::string errorText(const GroundFigure& figure);

}  // namespace stereonav
