// What `measure` and `profile` take: a line or an area over the ground, and what is written of it.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/options/command.h"
#include "app/scene/survey_line.h"

namespace stereonav {

struct GroundLineOptions {
    SceneOptions scene;
    Telling telling;
    SurveyLine line;
    std::vector<glm::dvec2> area;   // corners, as places of the line
    std::optional<double> plane_m;  // that volumes lie over and under; none: of the area's lowest corner
    std::string csv, geojson, svg;  // "": not written
};

std::vector<Option> groundLineOptions();

}  // namespace stereonav
